// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_coarse_contact_h
#define signorini_discretization_coarse_contact_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/solvers/obstacle_problem.h>

#include <vector>

namespace Signorini
{
  /// Projections of coarse contact nodes, one per row of the coarse coupling, for means of the fine normals.
  /// They choose the basis of the coarse space only, but where they fit, motions of the mortar side alone
  /// have no relative normal displacements on the finest level.
  /// @param nodes sorted nodes of rows and columns of the fine coupling
  /// @param node_rows their interpolation rows
  /// @param coarse_masks one per row of the coarse coupling
  std::vector<RowProjection> coarsen_projections(const std::vector<RowProjection> &projections,
                                                 const InterfaceCoupling          &fine,
                                                 const std::vector<NodeIndex>     &nodes,
                                                 const NodeRows &node_rows, const InterfaceCoupling &coarse,
                                                 const std::vector<FixedDirections> &coarse_masks);

  /// A half-space for each row of a coupling, on all ranks; no half-space where the normal is zero.
  struct RowHalfSpaces
  {
    /// By row of the coarse problem: unit normals, and how far the node may move along them (length).
    std::vector<Vector3> normals;
    std::vector<double>  bounds;
  };

  /// Collective. `rows` are sorted, the same on all ranks.
  RowHalfSpaces replicate_half_spaces(const HalfSpaces &owned, const NodePartition &partition,
                                      const std::vector<NodeIndex> &rows);

  /// Those of the coarse contact nodes that are fine nodes too; parameters as in coarsen_projections().
  /// Bounds are taken from the one node and not averaged: a mean of nodal gaps is wrong by the curvature of
  /// the gap.
  RowHalfSpaces inject_half_spaces(const RowHalfSpaces &half_spaces, const InterfaceCoupling &fine,
                                   const std::vector<NodeIndex> &nodes, const NodeRows &node_rows,
                                   const InterfaceCoupling          &coarse,
                                   const std::vector<RowProjection> &coarse_projections);

  /// Those at nodes that this rank owns; `rows` are sorted.
  HalfSpaces own_half_spaces(const RowHalfSpaces &half_spaces, const std::vector<NodeIndex> &rows,
                             const NodePartition &partition);
} // namespace Signorini

#endif
