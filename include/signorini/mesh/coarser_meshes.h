// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_coarser_meshes_h
#define signorini_mesh_coarser_meshes_h

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/distributed/tria.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// The meshes of global coarsening, finest first: from one to the next coarser every family of leaves is
  /// replaced by its parent where the 2:1 balance allows it, down to the coarse cells. The given mesh is not
  /// among them. Each is partitioned evenly on its own.
  ///
  /// The same meshes as MGTransferGlobalCoarseningTools::create_geometric_coarsening_sequence, built from
  /// copies of the forest instead of copies of the mesh: deal.II does not compact the storage of coarsened
  /// meshes, so that its sequence loops over holes as many as the finest mesh has cells on every level
  /// (measured: 12 times slower on a mesh of 115,000 cells and 10 levels).
  class CoarseningSequence
  {
  public:
    using DistributedMesh = dealii::parallel::distributed::Triangulation<3>;

    /// Collective.
    explicit CoarseningSequence(const DistributedMesh &finest);
    ~CoarseningSequence();

    /// Collective. The next coarser mesh; null behind the coarsest.
    std::unique_ptr<DistributedMesh> next();

  private:
    struct Forest;

    const DistributedMesh  &finest;
    std::unique_ptr<Forest> forest;
    unsigned int            n_left;
  };

  /// Collective. The nodal spaces of the multigrid hierarchy below the current mesh, coarsest first:
  /// hexahedra by global coarsening, tetrahedra by the meshes they were refined from (except those without
  /// which the next finer level halves no edge more than once). The kind with fewer meshes keeps its
  /// coarsest.
  std::vector<std::unique_ptr<NodalSpace>> coarser_spaces(const Bodies &bodies);
} // namespace Signorini

#endif
