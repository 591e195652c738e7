// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_exchanged_lists_h
#define signorini_algebra_exchanged_lists_h

#include <deal.II/base/mpi.h>

#include <cstring>
#include <map>
#include <type_traits>
#include <vector>

namespace Signorini
{
  /// By rank a list.
  template <typename T>
  using ListsOfRanks = std::map<unsigned int, std::vector<T>>;

  /// Collective. Sends lists to other ranks (or to the own one); what came, in the order of the ranks that
  /// sent it. As bytes, in messages between those that have something to tell each other.
  template <typename T>
  ListsOfRanks<T> exchange_lists(const ListsOfRanks<T> &lists, const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return lists;
    ListsOfRanks<char> bytes;
    for (const auto &[rank, list] : lists)
      {
        const char *const begin = reinterpret_cast<const char *>(list.data());
        bytes[rank].assign(begin, begin + list.size() * sizeof(T));
      }
    ListsOfRanks<T> result;
    for (const auto &[rank, message] : dealii::Utilities::MPI::some_to_some(communicator, bytes))
      {
        std::vector<T> &list = result[rank];
        list.resize(message.size() / sizeof(T));
        std::memcpy(static_cast<void *>(list.data()), message.data(), message.size());
      }
    return result;
  }
} // namespace Signorini

#endif
