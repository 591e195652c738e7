// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_gathered_lists_h
#define signorini_algebra_gathered_lists_h

#include <signorini/algebra/checked_count.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <vector>

namespace Signorini
{
  /// Who gets the lists of all ranks.
  enum class Receivers
  {
    all,
    rank_zero
  };

  /// Collective. The lists of all ranks, one after the other, in the order of the ranks; empty where they are
  /// not received. They are sent as they are: deal.II's gather() and all_gather() compress, which takes
  /// longer than what is done with a matrix that is gathered.
  template <typename T>
  std::vector<T> gather_lists(std::vector<T> mine, const MPI_Comm communicator, const Receivers receivers)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return mine;
    MPI_Datatype item;
    MPI_Type_contiguous(sizeof(T), MPI_BYTE, &item);
    MPI_Type_commit(&item);
    const int        n = checked_count(mine.size(), "items of a list");
    std::vector<int> counts(n_ranks), starts(n_ranks, 0);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, communicator);
    checked_count(std::accumulate(counts.begin(), counts.end(), std::size_t(0)), "items of a gathered list");
    std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
    const bool receives =
        receivers == Receivers::all || dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    std::vector<T> all(receives ? starts.back() + counts.back() : 0);
    if (receivers == Receivers::all)
      MPI_Allgatherv(mine.data(), n, item, all.data(), counts.data(), starts.data(), item, communicator);
    else
      MPI_Gatherv(mine.data(), n, item, all.data(), counts.data(), starts.data(), item, 0, communicator);
    MPI_Type_free(&item);
    return all;
  }



  /// Collective. What gather_lists() would gather to the list of rank 0, in pieces to the ranks again.
  /// @param n length of the piece of this rank
  template <typename T>
  std::vector<T> scatter_list(std::vector<T> all, const std::size_t n, const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return all;
    MPI_Datatype item;
    MPI_Type_contiguous(sizeof(T), MPI_BYTE, &item);
    MPI_Type_commit(&item);
    const int        n_mine = checked_count(n, "items of a list");
    std::vector<int> counts(n_ranks), starts(n_ranks, 0);
    MPI_Gather(&n_mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, communicator);
    checked_count(all.size(), "items of a gathered list");
    std::partial_sum(counts.begin(), counts.end() - 1, starts.begin() + 1);
    std::vector<T> mine(n);
    MPI_Scatterv(all.data(), counts.data(), starts.data(), item, mine.data(), n_mine, item, 0, communicator);
    MPI_Type_free(&item);
    return mine;
  }
} // namespace Signorini

#endif
