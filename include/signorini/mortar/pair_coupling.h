// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_pair_coupling_h
#define signorini_mortar_pair_coupling_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/mortar/face_moments.h>

#include <set>
#include <string>
#include <vector>

namespace Signorini
{
  /// A node of the nonmortar surface that touches the covered part but carries no multiplier.
  struct DroppedNode
  {
    enum Reason
    {
      fixed,
      normal_fixed,
      other_pair,
      thin_cover,
      large_row
    };

    NodeIndex        node;
    dealii::Point<3> position;
    Reason           reason;
    /// Covered share of the integral of the node's function.
    double share;
  };

  const char *
  to_string(const DroppedNode::Reason reason);

  /// D, M, S = D^-1 M and the weighted gap of one contact pair (method.md, section 3), the same on all ranks.
  struct PairCoupling
  {
    InterfaceCoupling coupling;
    /// In the order of the rows: outward unit normal n_p in free directions, weighted gap g_p (length),
    /// position, prescribed components, and the vertex of the nonmortar surface.
    std::vector<Vector3>          normals;
    std::vector<double>           gaps;
    std::vector<dealii::Point<3>> positions;
    std::vector<FixedMask>        fixed;
    std::vector<unsigned int>     vertices;
    /// Nodes of the columns that belong to the nonmortar surface (the set R), sorted.
    std::vector<NodeIndex> r_nodes;

    std::vector<DroppedNode> dropped;
    /// Areas: of the nonmortar surface, of its covered part, and of the covered part without any multiplier.
    double area = 0., covered_area = 0., lost_area = 0.;
  };

  /// Replicated. excluded: nodes that must not carry a multiplier because of another pair.
  /// prescribed_gap: the moments hold gap values, not vectors.
  PairCoupling
  couple(const ContactSurface           &nonmortar,
         const ContactSurface           &mortar,
         const std::vector<FaceMoments> &moments,
         const std::set<NodeIndex>      &excluded,
         const bool                      prescribed_gap);

  /// Nodes (conforming) of either side that the covered part of a pair touches.
  std::set<NodeIndex>
  touched_nonmortar_nodes(const ContactSurface &nonmortar, const std::vector<FaceMoments> &moments);
  std::set<NodeIndex>
  touched_mortar_nodes(const ContactSurface &mortar, const std::vector<FaceMoments> &moments);

  /// Joins the couplings of all pairs, rows sorted by node. Returns for each row (pair, row in the pair).
  /// Asserts S² = 0: no row is a column.
  std::vector<std::pair<unsigned int, std::size_t>>
  join_couplings(InterfaceCoupling &joined, const std::vector<PairCoupling> &pairs);
} // namespace Signorini

#endif
