// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_coarsening_sequence_h
#define signorini_mesh_coarsening_sequence_h

#include <deal.II/distributed/tria.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Collective. The meshes of global coarsening: from one to the next coarser every family of leaves is
  /// replaced by its parent where the 2:1 balance allows it, down to the coarse cells. Coarsest first, the
  /// given mesh is not among them. Each is partitioned evenly on its own.
  ///
  /// The same meshes as MGTransferGlobalCoarseningTools::create_geometric_coarsening_sequence, built from
  /// copies of the forest instead of copies of the mesh: deal.II does not compact the storage of coarsened
  /// meshes, so that its sequence loops over holes as many as the finest mesh has cells on every level
  /// (measured: 12 times slower on a mesh of 115,000 cells and 10 levels).
  std::vector<std::unique_ptr<dealii::parallel::distributed::Triangulation<3>>>
  create_coarsening_sequence(const dealii::parallel::distributed::Triangulation<3> &finest);
} // namespace Signorini

#endif
