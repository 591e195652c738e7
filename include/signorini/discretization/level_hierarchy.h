// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_level_hierarchy_h
#define signorini_discretization_level_hierarchy_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/discretization/background_levels.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/mesh/coarser_meshes.h>
#include <signorini/solvers/multigrid_hierarchy.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Collective. Nodal interpolation between two nested spaces: for every owned fine node its weights on
  /// conforming coarse nodes (empty for hanging fine nodes). The fine mesh must come from the coarse one
  /// by refining hexahedra at most once; the two may be partitioned differently.
  /// @param forest of the tetrahedra, if there are any
  NodeRows interpolation_rows(const NodalSpace &fine, const NodalSpace &coarse,
                              const TetrahedralForest *const forest);

  /// What levels there are below the coarsest mesh.
  enum class CoarseLevels
  {
    /// Background levels where the coarsest mesh is too large for sparse factors.
    automatic,
    background,
    none
  };

  /// The levels of the hierarchy as nodes and the interpolation between consecutive ones: the meshes, and
  /// below the coarsest one background levels, if wanted.
  class LevelSpaces
  {
  public:
    /// Collective. The coarser spaces (CoarserSpaces::update()) come coarsest first. The finest must outlive
    /// the object.
    LevelSpaces(const NodalSpace &finest, std::vector<std::shared_ptr<const NodalSpace>> coarser,
                const Bodies &bodies, const Loads &loads,
                const CoarseLevels coarse_levels = CoarseLevels::automatic);

    /// Level 0 is the coarsest.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(owned_nodes.size());
    }

    /// How many of the levels have no meshes.
    unsigned int n_background_levels() const
    {
      return n_background;
    }

    /// The nodes of a level.
    const dealii::IndexSet &owned(const unsigned int level) const
    {
      return owned_nodes[level];
    }

    /// Where the owned nodes of level 0 are.
    const NodePlaces &coarsest_places() const
    {
      return places;
    }

    /// Rows of the owned nodes of level `level` on level - 1.
    const NodeRows &interpolation(const unsigned int level) const
    {
      return rows[level - 1];
    }

    /// Fixed masks of the owned nodes of a level; hanging nodes are fixed altogether.
    const std::vector<FixedMask> &fixed(const unsigned int level) const
    {
      return masks[level];
    }

    /// Whether the functions of a level are zero where components of the next finer one are fixed: all but
    /// those under a mesh.
    bool is_nested(const unsigned int level) const
    {
      return level + 1 != n_background;
    }

  private:
    void add_background(std::vector<DistributedBackgroundLevel> &&levels);

    std::vector<dealii::IndexSet>       owned_nodes;
    std::vector<NodeRows>               rows;
    std::vector<std::vector<FixedMask>> masks;
    NodePlaces                          places;
    unsigned int                        n_background = 0;
  };

  /// The transfer operator on the next coarser level (doc/algorithm.md, (36)):
  ///   S_{k-1} = diag(P_nonᵀ D_k 1)⁻¹ P_nonᵀ D_k S_k P_mor ,   D_{k-1} = diag(P_nonᵀ D_k 1).
  /// `nodes` are the sorted nodes of rows and columns of S_k, `rows` their interpolation rows.
  InterfaceCoupling coarsen_coupling(const InterfaceCoupling &fine, const std::vector<NodeIndex> &nodes,
                                     const NodeRows &rows);

  /// Drops the weights below a tenth of the largest one of their row, and adds them to that one: translations
  /// still have no relative displacements. On coarse levels S is only a choice of the basis: their spaces
  /// stay the same, their matrices become sparser.
  void drop_small_weights(InterfaceCoupling &coupling);

  /// How build_hierarchy() goes about it.
  struct HierarchyOptions
  {
    /// For a monotone multigrid: relative displacements at contact nodes come from relative displacements
    /// alone, turned from normal to normal, and the coarse levels know their contact nodes. Else the exact
    /// nesting.
    bool            coarse_obstacles = false;
    LevelZeroMethod level_zero       = LevelZeroMethod::automatic;
    /// Motions of bodies that only contact holds.
    std::vector<FreeMotion> free_motions;
    /// One per row of the coupling: rows that are tied move on the finest level only (not at all). Empty:
    /// none.
    std::vector<unsigned char> tied;
    unsigned int               level_zero_steps = 1;
    /// Whether a nonmortar side is stiffer than its mortar side.
    bool has_stiff_nonmortar = false;
    /// If not null: half-spaces and right hand side on the finest level. With a start, the active set is
    /// guessed from it (HierarchyParts::start); without, the coarser levels get half-spaces
    /// (MultigridLevel::half_spaces) to make one.
    const ObstacleProblem *problem = nullptr;
    const Vector          *start   = nullptr;
  };

  /// Collective. Galerkin hierarchy with P̂_k = T_k⁻¹ P_k T_{k-1} on all levels. An empty coupling gives the
  /// hierarchy of the decoupled linear problem.
  /// @param projections A_p of the rows of the coupling
  MultigridHierarchy build_hierarchy(LinearSystem &&system, const LevelSpaces &spaces,
                                     const InterfaceCoupling          &coupling,
                                     const std::vector<RowProjection> &projections,
                                     const HierarchyOptions           &options = {});

  /// Collective. The six rigid motions as v = T⁻¹ u, zero in fixed components, in the layout of a partition:
  /// what algebraic multigrid needs to know.
  /// @param positions of its owned nodes
  std::vector<Vector> rigid_motions(const std::vector<dealii::Point<3>> &positions,
                                    const NodePartition &partition, const std::vector<FixedMask> &fixed,
                                    const InterfaceCoupling          &coupling,
                                    const std::vector<RowProjection> &projections);
} // namespace Signorini

#endif
