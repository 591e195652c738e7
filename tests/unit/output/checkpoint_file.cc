// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/output/checkpoint_file.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

using namespace Signorini;
using namespace dealii;
namespace fs = std::filesystem;

namespace
{
  struct Row
  {
    std::uint64_t place;
    double        value;
  };

  /// A checkpoint in a folder of this test, the same on all ranks; rank 0 makes and removes it.
  class Checkpoint : public testing::Test
  {
  protected:
    Checkpoint()
      : base((fs::temp_directory_path() /
              ("signorini-test-" +
               std::to_string(Utilities::MPI::broadcast(MPI_COMM_WORLD, static_cast<long>(getpid()), 0))))
                 .string())
      , file(base + "/state")
    {
      if (is_root())
        fs::create_directories(base);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    ~Checkpoint() override
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_root())
        fs::remove_all(base);
    }

    static bool is_root()
    {
      return rank() == 0;
    }

    static unsigned int rank()
    {
      return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    }

    /// The items from first to last of a list with a piece on each rank.
    static std::pair<std::size_t, std::size_t> piece(const std::size_t n)
    {
      const std::size_t p = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      return {n * rank() / p, n * (rank() + 1) / p};
    }

    static std::vector<double> values(const double factor)
    {
      const auto          range = piece(37);
      std::vector<double> result;
      for (std::size_t i = range.first; i < range.second; ++i)
        result.push_back(factor * static_cast<double>(i));
      return result;
    }

    static std::vector<unsigned char> marks()
    {
      const auto                 range = piece(61);
      std::vector<unsigned char> result;
      for (std::size_t i = range.first; i < range.second; ++i)
        result.push_back(i % 3 == 0);
      return result;
    }

    void write(const double factor) const
    {
      CheckpointWriter writer("program 1", MPI_COMM_WORLD);
      writer.add("words", std::string("some of them"));
      writer.add("values", values(factor));
      writer.add("marks", marks());
      const auto       range = piece(5);
      std::vector<Row> rows;
      for (std::size_t i = range.first; i < range.second; ++i)
        rows.push_back({i, factor});
      writer.add("rows", rows);
      writer.add("nothing", std::vector<double>());
      writer.write(file);
    }

    /// Whether it is what write() wrote.
    bool is_good(const double factor) const
    {
      const CheckpointReader reader(file, MPI_COMM_WORLD);
      return reader.text("words") == "some of them" && reader.program() == "program 1" &&
             reader.read_piece<double>("values", values(1.).size()) == values(factor) &&
             reader.read_piece<unsigned char>("marks", marks().size()) == marks() &&
             reader.size("rows") == 5 && reader.read<Row>("rows", 3, 1)[0].place == 3 &&
             reader.read<Row>("rows", 3, 1)[0].value == factor && reader.size("nothing") == 0;
    }

    /// Why it is refused; empty if it is not.
    std::string refusal() const
    {
      MPI_Barrier(MPI_COMM_WORLD);
      std::string reason;
      try
        {
          CheckpointReader reader(file, MPI_COMM_WORLD);
        }
      catch (const InputError &e)
        {
          reason = e.what();
        }
      MPI_Barrier(MPI_COMM_WORLD);
      return reason;
    }

    std::string bytes() const
    {
      std::ifstream in(file, std::ios::binary);
      return std::string(std::istreambuf_iterator<char>(in), {});
    }

    void put(const std::string &content) const
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (is_root())
        std::ofstream(file, std::ios::binary) << content;
      MPI_Barrier(MPI_COMM_WORLD);
    }

    const std::string base, file;
  };
} // namespace

TEST_F(Checkpoint, GivesBackWhatItWasGiven)
{
  write(1.5);
  EXPECT_TRUE(is_good(1.5));
  const CheckpointReader reader(file, MPI_COMM_WORLD);
  EXPECT_FALSE(reader.has("other"));
  EXPECT_THROW(reader.text("other"), InputError);
  EXPECT_THROW(reader.read<Row>("rows", 5, 1), InputError);
  EXPECT_THROW(reader.read<Row>("values", 0, 1), InputError);
  EXPECT_THROW(reader.read_piece<double>("values", values(1.).size() + 1), InputError);
}

TEST_F(Checkpoint, IsTheSameOnAnyNumberOfRanks)
{
  // A file of one rank is written by each of them to a place of its own.
  write(2.);
  const std::string all = bytes();
  {
    CheckpointWriter           alone("program 1", MPI_COMM_SELF);
    std::vector<double>        v;
    std::vector<unsigned char> m;
    std::vector<Row>           rows;
    for (unsigned int i = 0; i < 37; ++i)
      v.push_back(2. * i);
    for (unsigned int i = 0; i < 61; ++i)
      m.push_back(i % 3 == 0);
    for (unsigned int i = 0; i < 5; ++i)
      rows.push_back({i, 2.});
    alone.add("words", std::string("some of them"));
    alone.add("values", v);
    alone.add("marks", m);
    alone.add("rows", rows);
    alone.add("nothing", std::vector<double>());
    alone.write(file + std::to_string(rank()));
  }
  std::ifstream in(file + std::to_string(rank()), std::ios::binary);
  EXPECT_EQ(all, std::string(std::istreambuf_iterator<char>(in), {}));
}

TEST_F(Checkpoint, TakesThePlaceOfTheOneBefore)
{
  write(1.);
  write(3.);
  EXPECT_TRUE(is_good(3.));
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(std::distance(fs::directory_iterator(base), fs::directory_iterator()), 1);
}

TEST_F(Checkpoint, StaysWhenTheNextCannotBeWritten)
{
  write(1.);
  CheckpointWriter writer("program 1", MPI_COMM_WORLD);
  writer.add("values", values(1.));
  EXPECT_THROW(writer.write(base + "/no folder/state"), InputError);
  EXPECT_TRUE(is_good(1.));
}

TEST_F(Checkpoint, IsRefusedAtEachLengthButItsOwn)
{
  write(1.);
  const std::string all = bytes();
  for (std::size_t n = 0; n < all.size(); ++n)
    {
      put(all.substr(0, n));
      ASSERT_NE(refusal().find(n == 0 ? "torn" : "is "), std::string::npos) << n << ": " << refusal();
    }
  put(all + "x");
  EXPECT_NE(refusal().find("torn"), std::string::npos);
  put(all);
  EXPECT_EQ(refusal(), "");
}

TEST_F(Checkpoint, IsRefusedWithEachByteChanged)
{
  write(1.);
  const std::string all = bytes();
  for (std::size_t n = 0; n < all.size(); ++n)
    {
      std::string changed = all;
      changed[n]          = static_cast<char>(changed[n] ^ (1 << n % 8));
      put(changed);
      // The few bytes between sections belong to none.
      if (refusal().empty())
        {
          ASSERT_TRUE(is_good(1.)) << n;
          ASSERT_EQ(all[n], '\0') << n;
        }
    }
}

TEST_F(Checkpoint, OfAnotherFormatIsRefusedByItsNumber)
{
  write(1.);
  const std::string all = bytes();
  for (const std::uint32_t format : {0u, CheckpointHeader::present_format + 1})
    {
      std::string changed = all;
      changed.replace(16, 4, reinterpret_cast<const char *>(&format), 4);
      put(changed);
      EXPECT_NE(refusal().find(format == 0 ? "older version" : "newer version"), std::string::npos);
    }
}

TEST_F(Checkpoint, OfOthersIsNone)
{
  put("a text that somebody has written with more than forty letters in it");
  EXPECT_NE(refusal().find("no checkpoint"), std::string::npos);
  MPI_Barrier(MPI_COMM_WORLD);
  if (is_root())
    fs::remove(file);
  EXPECT_NE(refusal().find("cannot be opened"), std::string::npos);
}
