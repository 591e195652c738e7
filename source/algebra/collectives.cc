// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>

namespace Signorini
{
  using namespace dealii;

  std::vector<std::string> gather_bytes(const std::string &mine, const MPI_Comm communicator,
                                        const Receivers receivers)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return {mine};
    const auto sizes = gather_lists(std::vector<std::uint64_t>{mine.size()}, communicator, receivers);
    const auto all   = gather_lists(std::vector<char>(mine.begin(), mine.end()), communicator, receivers);
    std::vector<std::string> result;
    auto                     begin = all.begin();
    for (const std::uint64_t n : sizes)
      {
        result.emplace_back(begin, begin + n);
        begin += n;
      }
    return result;
  }



  std::string broadcast_bytes(std::string bytes, const MPI_Comm communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return bytes;
    bytes.resize(Utilities::MPI::broadcast(communicator, static_cast<unsigned long long>(bytes.size())));
    Utilities::MPI::broadcast(&bytes[0], bytes.size(), 0, communicator);
    return bytes;
  }



  ListsByRank<char> send_bytes(const ListsByRank<char> &bytes, const MPI_Comm communicator)
  {
    return Utilities::MPI::some_to_some(communicator, bytes);
  }
} // namespace Signorini
