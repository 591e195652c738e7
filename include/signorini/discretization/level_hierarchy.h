// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_level_hierarchy_h
#define signorini_discretization_level_hierarchy_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/level_spaces.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/mesh/coarser_meshes.h>
#include <signorini/solvers/multigrid_hierarchy.h>

#include <memory>
#include <vector>

namespace Signorini
{
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
  /// @param coupling has the rows of the nodes that this rank owns
  /// @param projections A_p of the rows of the coupling
  MultigridHierarchy build_hierarchy(LinearSystem &&system, const LevelSpaces &spaces,
                                     const InterfaceCoupling          &coupling,
                                     const std::vector<RowProjection> &projections,
                                     const HierarchyOptions           &options = {});

  /// Collective. The six rigid motions as v = T⁻¹ u, zero in fixed components, in the layout of a partition:
  /// what algebraic multigrid needs to know.
  /// @param positions of its owned nodes
  std::vector<Vector> rigid_motions(const std::vector<dealii::Point<3>> &positions,
                                    const NodePartition &partition, const std::vector<FixedDirections> &fixed,
                                    const InterfaceCoupling          &coupling,
                                    const std::vector<RowProjection> &projections);
} // namespace Signorini

#endif
