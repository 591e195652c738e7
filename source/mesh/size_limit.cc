// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/size_limit.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include <unistd.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Of this computer, or of the container around us.
    double memory_here()
    {
      double bytes =
          static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
      for (const char *file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        {
          std::ifstream in(file);
          // "max" is no number.
          if (double limit = 0.; in >> limit && limit > 0.)
            bytes = std::min(bytes, limit);
        }
      return bytes;
    }
  } // namespace



  double available_memory(const MPI_Comm communicator)
  {
    MPI_Comm computer;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &computer);
    const double share = memory_here() / Utilities::MPI::n_mpi_processes(computer);
    MPI_Comm_free(&computer);
    return Utilities::MPI::sum(share, communicator);
  }



  void refuse_too_many_cells(const double n_cells, const std::string &what, const std::string &cure,
                             const MPI_Comm communicator, const double unknowns_per_cell)
  {
    const double needed = n_cells * unknowns_per_cell * SizeRule().per_unknown,
                 there  = available_memory(communicator);
    if (needed <= there)
      return;
    std::ostringstream text;
    text << std::setprecision(2) << what << " would have " << n_cells << " cells, which take " << needed / 1e9
         << " GB of memory at least; there are " << there / 1e9 << " GB. " << cure;
    throw InputError(text.str());
  }



  void refuse_too_many_unknowns(const double n_unknowns)
  {
    const auto largest = static_cast<double>(std::numeric_limits<types::global_dof_index>::max());
    if (n_unknowns <= largest)
      return;
    std::ostringstream text;
    text << std::setprecision(2) << "The next mesh would have " << n_unknowns
         << " unknowns, and this deal.II numbers " << largest
         << " of them. Refine less, or build deal.II with DEAL_II_WITH_64BIT_INDICES.";
    throw InputError(text.str());
  }
} // namespace Signorini
