// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/coarser_meshes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <p8est_algorithms.h>

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

    /// The meshes below the finest that become levels, finest first: a mesh is left out where the next finer
    /// level halves no edge more than once without it.
    std::vector<unsigned int> select_levels(const TetrahedralForest &forest)
    {
      std::vector<unsigned int> levels;
      for (unsigned int l = forest.n_levels() - 1, last = l; l-- > 0;)
        if (l == 0 || forest.history().halves_twice(l - 1, last))
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
    , current(std::make_unique<Forest>())
    , n_left(finest.n_global_levels() - 1)
  {
    std::tie(current->vertices, current->cells, current->ids) =
        GridTools::get_coarse_mesh_description(finest);
    current->tree.reset(p8est_copy(const_cast<p8est_t *>(finest.get_p4est()), 0));
  }



  CoarseningSequence::~CoarseningSequence() = default;



  bool CoarseningSequence::coarsen()
  {
    if (n_left == 0)
      return false;
    --n_left;
    p8est_coarsen(current->tree.get(), 0, coarsen_always, nullptr);
    p8est_balance(current->tree.get(), P8EST_CONNECT_FULL, nullptr);
    p8est_partition(current->tree.get(), 1, nullptr);
    return true;
  }



  const p8est_t &CoarseningSequence::forest() const
  {
    return *current->tree;
  }



  std::unique_ptr<CoarseningSequence::DistributedMesh> CoarseningSequence::mesh() const
  {
    auto mesh = std::make_unique<DistributedMesh>(finest.get_communicator(), finest.get_mesh_smoothing());
    mesh->create_triangulation(current->vertices, current->cells, current->ids);
    for (const types::manifold_id id : finest.get_manifold_ids())
      if (id != numbers::flat_manifold_id)
        mesh->set_manifold(id, finest.get_manifold(id));
    mesh->load(current->tree.get());
    return mesh;
  }



  struct CoarserSpaces::Level
  {
    /// Null without hexahedra.
    std::unique_ptr<p8est_t, ForestDeleter> hexahedra;
    unsigned int                            tetrahedral_level;
    std::shared_ptr<const NodalSpace>       space;

    bool equals(const p8est_t *const other_hexahedra, const unsigned int other_level,
                const MPI_Comm communicator) const
    {
      const bool same = tetrahedral_level == other_level &&
                        (other_hexahedra == nullptr) == (hexahedra == nullptr) &&
                        (other_hexahedra == nullptr ||
                         p8est_is_equal(hexahedra.get(), const_cast<p8est_t *>(other_hexahedra), 0) != 0);
      return Utilities::MPI::min(static_cast<int>(same), communicator) != 0;
    }
  };



  CoarserSpaces::CoarserSpaces()  = default;
  CoarserSpaces::~CoarserSpaces() = default;



  std::vector<std::shared_ptr<const NodalSpace>>
  CoarserSpaces::update(const Bodies &bodies, std::shared_ptr<const NodalSpace> finest)
  {
    MeshView                            view = bodies.mesh();
    std::unique_ptr<CoarseningSequence> sequence;
    if (view.hexahedra != nullptr)
      sequence = std::make_unique<CoarseningSequence>(*view.hexahedra);
    std::vector<unsigned int> tetrahedral_levels;
    if (view.tetrahedra != nullptr)
      tetrahedral_levels = select_levels(*view.tetrahedra);

    std::vector<Level> now;
    const auto         keep = [&](std::shared_ptr<const NodalSpace> space) {
      now.emplace_back();
      if (sequence)
        now.back().hexahedra.reset(p8est_copy(const_cast<p8est_t *>(&sequence->forest()), 0));
      now.back().tetrahedral_level = view.tetrahedral_level;
      now.back().space             = std::move(space);
    };
    keep(std::move(finest));
    // The mesh of the present forest, if a space needed it.
    std::unique_ptr<CoarseningSequence::DistributedMesh> mesh;
    for (unsigned int k = 0;; ++k)
      {
        const bool coarsens = sequence && sequence->coarsen();
        if (!coarsens && k >= tetrahedral_levels.size())
          break;
        if (coarsens)
          mesh.reset();
        if (k < tetrahedral_levels.size())
          view.tetrahedral_level = tetrahedral_levels[k];
        const p8est_t *const forest = sequence ? &sequence->forest() : nullptr;
        const auto           known  = std::find_if(levels.begin(), levels.end(), [&](const Level &level) {
          return level.equals(forest, view.tetrahedral_level, bodies.communicator());
        });
        if (known != levels.end())
          {
            keep(known->space);
            continue;
          }
        if (sequence && !mesh)
          mesh = sequence->mesh();
        view.hexahedra = mesh.get();
        keep(std::make_shared<NodalSpace>(bodies.communicator(), view));
      }
    levels = std::move(now);

    std::vector<std::shared_ptr<const NodalSpace>> spaces;
    for (std::size_t l = levels.size() - 1; l > 0; --l)
      spaces.push_back(levels[l].space);
    return spaces;
  }
} // namespace Signorini
