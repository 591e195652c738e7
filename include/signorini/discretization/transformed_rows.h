// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_transformed_rows_h
#define signorini_discretization_transformed_rows_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/nodal_transfer.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/discretization/rigid_faces.h>

#include <vector>

namespace Signorini
{
  /// What is known at the contact of two neighbouring levels, around the local nodes of a rank.
  struct ContactOfLevels
  {
    /// The coupling of the finer level, rows of its local nodes.
    const InterfaceCoupling &fine;
    /// One per row of the coupling.
    const std::vector<RowProjection> &fine_projections;
    /// Sorted nodes of rows and columns of the fine coupling, and their interpolation rows.
    const std::vector<NodeIndex> &nodes;
    const NodeRows               &node_rows;
    /// Rows of the coarse nodes that these rows and those of P lead to.
    const InterfaceCoupling          &coarse;
    const std::vector<RowProjection> &coarse_projections;
    /// Whether coarse obstacles are wanted: see transformed_rows().
    bool relative_only;
    /// One per row of the fine coupling, or empty: rows that are zero, because their nodes are tied.
    const std::vector<unsigned char> &tied;
    /// Fixed components of the local nodes of the finer level, and of `nodes`; empty where the coarse
    /// functions are zero in them anyway.
    std::vector<FixedDirections> fixed, node_fixed;
    /// Rigid faces on the finer and on the coarser level; null without.
    const RigidFaces *fine_rigid = nullptr, *coarse_rigid = nullptr;
  };

  /// The rows of P̂ = (I - A S) E P (I + A_c S_c), E = I but in fixed components, that differ from those of P,
  /// for the local nodes of the fine level (doc/algorithm.md, (34)). With relative_only the rows of contact
  /// nodes have relative displacements only, turned from the coarse normals to the fine one, n·v = sum w
  /// n_c·v_c: what coarse obstacles need.
  /// @param rows the rows of P of the local nodes
  std::vector<NodalTransfer::BlockRow> transformed_rows(const NodePartition &partition, const NodeRows &rows,
                                                        const ContactOfLevels &contact);
} // namespace Signorini

#endif
