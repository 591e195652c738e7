// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_collectives_h
#define signorini_algebra_collectives_h

#include <signorini/algebra/byte_archive.h>
#include <signorini/algebra/gathered_lists.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  /// Lists by rank: of the one that they are for, or that they come from.
  template <typename T>
  using ListsByRank = std::map<unsigned int, std::vector<T>>;

  /// Collective. The bytes of all ranks, by rank; empty where they are not received.
  std::vector<std::string> gather_bytes(const std::string &mine, const MPI_Comm communicator,
                                        const Receivers receivers);

  /// Collective. The bytes of rank 0.
  std::string broadcast_bytes(std::string bytes, const MPI_Comm communicator);

  /// Collective. Sends bytes to each of some ranks and returns those that come, by sender. Ranks that have
  /// nothing for each other do not talk.
  ListsByRank<char> send_bytes(const ListsByRank<char> &bytes, const MPI_Comm communicator);

  /// Collective. The values of all ranks, by rank; anything that ByteWriter takes. (deal.II's functions
  /// for this compile Boost's archives and streams into each source that calls them.)
  template <typename T>
  std::vector<T> gather_values(const T &mine, const MPI_Comm communicator,
                               const Receivers receivers = Receivers::all)
  {
    if constexpr (is_bulk<T>)
      return gather_lists(std::vector<T>{mine}, communicator, receivers);
    else
      {
        std::vector<T> values;
        for (std::string &bytes : gather_bytes(to_bytes(mine), communicator, receivers))
          values.push_back(from_bytes<T>(std::move(bytes)));
        return values;
      }
  }

  /// Collective. The value of rank 0.
  template <typename T>
  T broadcast_value(const T &value, const MPI_Comm communicator)
  {
    const bool  is_sender = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    std::string bytes     = broadcast_bytes(is_sender ? to_bytes(value) : std::string(), communicator);
    return is_sender ? value : from_bytes<T>(std::move(bytes));
  }

  /// Collective. As send_bytes(), with values.
  template <typename T>
  std::map<unsigned int, T> send_values(const std::map<unsigned int, T> &values, const MPI_Comm communicator)
  {
    ListsByRank<char> parcels;
    for (const auto &[rank, value] : values)
      {
        const std::string bytes = to_bytes(value);
        parcels[rank].assign(bytes.begin(), bytes.end());
      }
    std::map<unsigned int, T> result;
    for (const auto &[rank, bytes] : send_bytes(parcels, communicator))
      result[rank] = from_bytes<T>(std::string(bytes.begin(), bytes.end()));
    return result;
  }
} // namespace Signorini

#endif
