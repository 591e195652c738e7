// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/coarser_meshes.h>

#include <deal.II/grid/grid_tools.h>

#include <p8est.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
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



  struct CoarseningSequence::Forest
  {
    std::vector<Point<3>>                   vertices;
    std::vector<CellData<3>>                cells;
    SubCellData                             ids;
    std::unique_ptr<p8est_t, ForestDeleter> tree;
  };



  CoarseningSequence::CoarseningSequence(const DistributedMesh &finest)
    : finest(finest)
    , n_left(finest.n_global_levels() - 1)
  {
    if (n_left == 0)
      return;
    forest                                                 = std::make_unique<Forest>();
    std::tie(forest->vertices, forest->cells, forest->ids) = GridTools::get_coarse_mesh_description(finest);
    forest->tree.reset(p8est_copy(const_cast<p8est_t *>(finest.get_p4est()), 0));
  }



  CoarseningSequence::~CoarseningSequence() = default;



  std::unique_ptr<CoarseningSequence::DistributedMesh> CoarseningSequence::next()
  {
    if (n_left == 0)
      return nullptr;
    --n_left;
    p8est_coarsen(forest->tree.get(), 0, coarsen_always, nullptr);
    p8est_balance(forest->tree.get(), P8EST_CONNECT_FULL, nullptr);
    p8est_partition(forest->tree.get(), 1, nullptr);

    auto mesh = std::make_unique<DistributedMesh>(finest.get_communicator(), finest.get_mesh_smoothing());
    mesh->create_triangulation(forest->vertices, forest->cells, forest->ids);
    for (const types::manifold_id id : finest.get_manifold_ids())
      if (id != numbers::flat_manifold_id)
        mesh->set_manifold(id, finest.get_manifold(id));
    mesh->load(forest->tree.get());
    return mesh;
  }



  std::vector<std::unique_ptr<NodalSpace>> coarser_spaces(const Bodies &bodies)
  {
    MeshView                            view = bodies.mesh();
    std::unique_ptr<CoarseningSequence> hexahedra;
    if (view.hexahedra != nullptr)
      hexahedra = std::make_unique<CoarseningSequence>(*view.hexahedra);
    std::vector<unsigned int> tetrahedral_levels;
    if (view.tetrahedra != nullptr)
      for (unsigned int l = view.tetrahedral_level, last = l; l-- > 0;)
        if (3 * static_cast<std::size_t>(view.tetrahedra->n_vertices(l)) <=
            2 * static_cast<std::size_t>(view.tetrahedra->n_vertices(last)))
          tetrahedral_levels.push_back(last = l);

    std::vector<std::unique_ptr<NodalSpace>>             spaces;
    std::unique_ptr<CoarseningSequence::DistributedMesh> mesh;
    for (unsigned int k = 0;; ++k)
      {
        auto next = hexahedra ? hexahedra->next() : nullptr;
        if (!next && k >= tetrahedral_levels.size())
          break;
        if (next)
          mesh = std::move(next);
        if (mesh)
          view.hexahedra = mesh.get();
        if (k < tetrahedral_levels.size())
          view.tetrahedral_level = tetrahedral_levels[k];
        spaces.push_back(std::make_unique<NodalSpace>(bodies.communicator(), view));
      }
    std::reverse(spaces.begin(), spaces.end());
    return spaces;
  }
} // namespace Signorini
