// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/coarsening_sequence.h>

#include <deal.II/grid/grid_tools.h>

#include <p8est.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using DistributedMesh = parallel::distributed::Triangulation<3>;

    struct ForestDeleter
    {
      void operator()(p8est_t *forest) const
      {
        p8est_destroy(forest);
      }
    };

    int coarsen_always(p8est_t *, p4est_topidx_t, p8est_quadrant_t **)
    {
      return 1;
    }
  } // namespace



  std::vector<std::unique_ptr<DistributedMesh>> create_coarsening_sequence(const DistributedMesh &finest)
  {
    const unsigned int                            n_coarser = finest.n_global_levels() - 1;
    std::vector<std::unique_ptr<DistributedMesh>> sequence(n_coarser);
    if (n_coarser == 0)
      return sequence;

    const auto [vertices, cells, ids]                       = GridTools::get_coarse_mesh_description(finest);
    const auto                                    manifolds = finest.get_manifold_ids();
    const std::unique_ptr<p8est_t, ForestDeleter> forest(
        p8est_copy(const_cast<p8est_t *>(finest.get_p4est()), 0));
    for (unsigned int level = n_coarser; level-- > 0;)
      {
        p8est_coarsen(forest.get(), 0, coarsen_always, nullptr);
        p8est_balance(forest.get(), P8EST_CONNECT_FULL, nullptr);
        p8est_partition(forest.get(), 1, nullptr);

        auto mesh = std::make_unique<DistributedMesh>(finest.get_communicator(), finest.get_mesh_smoothing());
        mesh->create_triangulation(vertices, cells, ids);
        for (const types::manifold_id id : manifolds)
          if (id != numbers::flat_manifold_id)
            mesh->set_manifold(id, finest.get_manifold(id));
        mesh->load(forest.get());
        sequence[level] = std::move(mesh);
      }
    return sequence;
  }
} // namespace Signorini
