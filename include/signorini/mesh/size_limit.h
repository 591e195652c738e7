// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_size_limit_h
#define signorini_mesh_size_limit_h

#include <mpi.h>

#include <string>

namespace Signorini
{
  /// What a mesh costs at least.
  struct SizeRule
  {
    /// Bytes. Measured: 1400 to 1600 for each unknown of a solved problem; cells of hexahedra have three
    /// unknowns each on large meshes, those of tetrahedra half of one.
    double per_unknown = 1000., unknowns_per_cell = .5;
  };

  /// Collective. Memory of all computers that the ranks run on (bytes), as far as they may use it.
  double available_memory(const MPI_Comm communicator);

  /// Collective. Errors: InputError if so many cells cannot fit into the memory.
  /// @param what "The bodies", say, which have the cells
  /// @param unknowns_per_cell 3 for hexahedra
  void refuse_too_many_cells(const double n_cells, const std::string &what, const std::string &cure,
                             const MPI_Comm communicator,
                             const double   unknowns_per_cell = SizeRule().unknowns_per_cell);
  /// Errors: InputError if unknowns could not be numbered by this deal.II.
  void refuse_too_many_unknowns(const double n_unknowns);
} // namespace Signorini

#endif
