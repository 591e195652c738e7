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
  /// The transfer operator on the next coarser level (doc/algorithm.md, (36)):
  ///   S_{k-1} = diag(P_nonᵀ D_k 1)⁻¹ P_nonᵀ D_k S_k P_mor ,   D_{k-1} = diag(P_nonᵀ D_k 1),
  /// in the rows of the coarse nodes that a rank owns.
  struct CoarseCoupling
  {
    /// Rows and weights.
    InterfaceCoupling coupling;
    /// By row: the normals of the fine nodes, summed up with their weights.
    std::vector<Vector3> normals;
  };

  /// Collective.
  /// @param fine rows of the fine nodes that this rank owns; projections of these
  /// @param nodes sorted nodes of their rows and columns
  /// @param node_rows their interpolation rows
  /// @param partition of the coarse nodes
  CoarseCoupling coarsen_coupling(const InterfaceCoupling          &fine,
                                  const std::vector<RowProjection> &projections,
                                  const std::vector<NodeIndex> &nodes, const NodeRows &node_rows,
                                  const NodePartition &partition);

  /// Projections of coarse contact nodes, one per row, for means of the fine normals. They choose the basis
  /// of the coarse space only, but where they fit, motions of the mortar side alone have no relative normal
  /// displacements on the finest level.
  /// @param fixed of the owned nodes of the coarse level
  std::vector<RowProjection> coarse_projections(const CoarseCoupling               &coarse,
                                                const std::vector<FixedDirections> &fixed,
                                                const NodePartition                &partition);

  /// A half-space for each row of a coupling; none where the normal is zero.
  struct RowHalfSpaces
  {
    /// By row: unit normals, and how far the node may move along them (length).
    std::vector<Vector3> normals;
    std::vector<double>  bounds;
  };

  /// `rows` are sorted, and owned by this rank.
  RowHalfSpaces half_spaces_of_rows(const HalfSpaces &owned, const NodePartition &partition,
                                    const std::vector<NodeIndex> &rows);

  /// The coupling of a coarse level, and A of its rows.
  struct CoarseRows
  {
    /// Both must outlive the object.
    const InterfaceCoupling          &coupling;
    const std::vector<RowProjection> &projections;
  };

  /// Collective. Those of the coarse contact nodes that are fine nodes too; parameters as in
  /// coarsen_coupling(). Bounds are taken from the one node and not averaged: a mean of nodal gaps is wrong
  /// by the curvature of the gap.
  RowHalfSpaces inject_half_spaces(const RowHalfSpaces &half_spaces, const InterfaceCoupling &fine,
                                   const std::vector<NodeIndex> &nodes, const NodeRows &node_rows,
                                   const CoarseRows &coarse, const NodePartition &partition);

  /// Those at nodes that this rank owns; `rows` are sorted.
  HalfSpaces own_half_spaces(const RowHalfSpaces &half_spaces, const std::vector<NodeIndex> &rows,
                             const NodePartition &partition);
} // namespace Signorini

#endif
