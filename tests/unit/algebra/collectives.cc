// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>

#include <gtest/gtest.h>

#include <limits>

using namespace Signorini;
using dealii::Point;

namespace
{
  struct Named
  {
    std::string               name;
    std::array<double, 2>     numbers;
    std::vector<unsigned int> list;

    bool operator==(const Named &other) const
    {
      return name == other.name && numbers == other.numbers && list == other.list;
    }
  };

  template <typename Archive>
  void transfer(Archive &archive, Named &value)
  {
    archive(value.name, value.numbers, value.list);
  }

  /// As long as the rank says: nothing on rank 0.
  Named of_rank(const unsigned int rank)
  {
    return {std::string(rank, 'x'), {{1. * rank, -0.5}}, std::vector<unsigned int>(rank, rank)};
  }

  unsigned int n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }

  unsigned int this_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }
} // namespace

TEST(ByteArchive, GivesBackWhatItWasGiven)
{
  const std::vector<double>        numbers = {1., std::numeric_limits<double>::infinity(), -0.};
  const std::vector<bool>          flags   = {true, false, true};
  const std::map<std::string, int> words   = {{"a", 1}, {"", -2}};
  const std::optional<double>      none, some = 3.;
  const Point<3>                   point(1., 2., 3.);
  ByteWriter                       writer;
  writer(numbers, flags, words, none, some, point, std::string("text"));
  std::vector<double>        n;
  std::vector<bool>          f;
  std::map<std::string, int> w;
  std::optional<double>      o, s;
  Point<3>                   p;
  std::string                t;
  ByteReader(writer.bytes())(n, f, w, o, s, p, t);
  EXPECT_EQ(n, numbers);
  EXPECT_EQ(f, flags);
  EXPECT_EQ(w, words);
  EXPECT_EQ(o, none);
  EXPECT_EQ(s, some);
  EXPECT_EQ(p, point);
  EXPECT_EQ(t, "text");
  // Where a list ends too early, in the middle of a number, and where its length is nonsense.
  for (const std::size_t length : {20, 9, 7})
    {
      ByteReader short_one(writer.bytes().substr(0, length));
      EXPECT_THROW(short_one(n), InputError) << length;
    }
  EXPECT_THROW(from_bytes<std::vector<double>>(writer.bytes()), std::logic_error);
  ByteReader long_one(to_bytes(std::numeric_limits<std::uint64_t>::max() / 8));
  EXPECT_THROW(long_one(n), InputError);
}

TEST(ByteArchive, ListsOfStructsPairsAndTuples)
{
  const auto lists = std::make_tuple(std::vector<Named>{of_rank(0), of_rank(3)},
                                     std::vector<std::pair<std::string, std::vector<bool>>>{{"b", {true}}},
                                     std::vector<std::vector<double>>{{}, {1.}});
  EXPECT_EQ(from_bytes<std::remove_const_t<decltype(lists)>>(to_bytes(lists)), lists);
}

TEST(Collectives, ValuesOfAllRanks)
{
  const std::vector<Named> all = gather_values(of_rank(this_rank()), MPI_COMM_WORLD);
  ASSERT_EQ(all.size(), n_ranks());
  for (unsigned int rank = 0; rank < n_ranks(); ++rank)
    EXPECT_EQ(all[rank], of_rank(rank));
}

TEST(Collectives, ValuesOfAllRanksOnOne)
{
  const auto all = gather_values(of_rank(this_rank()), MPI_COMM_WORLD, Receivers::rank_zero);
  ASSERT_EQ(all.size(), this_rank() == 0 ? n_ranks() : 0);
  for (unsigned int rank = 0; rank < all.size(); ++rank)
    EXPECT_EQ(all[rank], of_rank(rank));
}

TEST(Collectives, TheValueOfTheFirstRank)
{
  EXPECT_EQ(broadcast_value(of_rank(this_rank() + 7), MPI_COMM_WORLD), of_rank(7));
  EXPECT_EQ(broadcast_value(std::string(this_rank(), 'y'), MPI_COMM_WORLD), "");
}

TEST(Collectives, ValuesForSomeRanks)
{
  // To those after it, not to itself.
  std::map<unsigned int, Named> sent;
  for (unsigned int rank = this_rank() + 1; rank < n_ranks(); ++rank)
    sent[rank] = of_rank(10 * this_rank() + rank);
  const auto received = send_values(sent, MPI_COMM_WORLD);
  EXPECT_EQ(received.size(), this_rank());
  for (const auto &[rank, value] : received)
    EXPECT_EQ(value, of_rank(10 * rank + this_rank()));
}
