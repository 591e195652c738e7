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



  namespace
  {
    /// How often edges of mesh `coarse` of a forest were halved, one after the other, up to mesh `fine`.
    unsigned int depth(const TetrahedralForest &forest, const unsigned int coarse, const unsigned int fine)
    {
      const unsigned int         first = forest.n_vertices(coarse);
      std::vector<unsigned char> depths(forest.n_vertices(fine) - first);
      unsigned int               largest = 0;
      for (unsigned int v = first; v < forest.n_vertices(fine); ++v)
        {
          unsigned char d = 0;
          for (const unsigned int parent : forest.parents(v))
            if (parent >= first)
              d = std::max(d, depths[parent - first]);
          depths[v - first] = d + 1;
          largest           = std::max<unsigned int>(largest, d + 1);
        }
      return largest;
    }

    /// The meshes below the finest that become levels, finest first: a mesh is left out where the next finer
    /// level halves no edge more than once without it.
    std::vector<unsigned int> select_levels(const TetrahedralForest &forest)
    {
      std::vector<unsigned int> levels;
      for (unsigned int l = forest.n_levels() - 1, last = l; l-- > 0;)
        if (l == 0 || depth(forest, l - 1, last) > 1)
          levels.push_back(last = l);
      return levels;
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
      tetrahedral_levels = select_levels(*view.tetrahedra);

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
