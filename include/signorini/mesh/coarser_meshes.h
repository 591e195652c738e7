// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_coarser_meshes_h
#define signorini_mesh_coarser_meshes_h

#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/distributed/tria.h>

#include <p8est.h>

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
    /// The p4est forest of all hexahedra.
    using DistributedMesh = dealii::parallel::distributed::Triangulation<3>;

    /// Collective.
    explicit CoarseningSequence(const DistributedMesh &finest);
    ~CoarseningSequence();

    /// Collective. Goes to the next coarser forest; false behind the coarsest.
    bool coarsen();

    /// The present forest, distributed.
    const p8est &forest() const;

    /// Collective. The present forest as a mesh.
    std::unique_ptr<DistributedMesh> mesh() const;

  private:
    struct Forest;

    const DistributedMesh  &finest;
    std::unique_ptr<Forest> current;
    unsigned int            n_left;
  };

  /// The nodal spaces of the multigrid hierarchy below the current mesh: hexahedra by global coarsening,
  /// tetrahedra by the meshes they were refined from (except those without which the next finer level halves
  /// no edge more than once). The kind with fewer meshes keeps its coarsest.
  ///
  /// Remembers the hierarchy of the last mesh: in nested iteration most levels come up again, and building
  /// the triangulation of a level costs as much as some ten sweeps of a smoother.
  class CoarserSpaces
  {
  public:
    CoarserSpaces();
    ~CoarserSpaces();

    /// Collective. The spaces, coarsest first. `finest` is that of the bodies as they are.
    std::vector<std::shared_ptr<const NodalSpace>> update(const Bodies                     &bodies,
                                                          std::shared_ptr<const NodalSpace> finest);

  private:
    struct Level;

    std::vector<Level> levels;
  };
} // namespace Signorini

#endif
