// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_pair_fields_h
#define signorini_application_pair_fields_h

#include <signorini/application/contact_solve.h>
#include <signorini/mortar/surface_values.h>

#include <vector>

namespace Signorini
{
  /// Collective. Multipliers of one pair, per row of its own coupling on this rank.
  ContactStress stress_of_pair(const Discretization &discretization, const ContactStress &stress,
                               const unsigned int pair);

  /// Collective. By vertex of the nonmortar surface, at the corners of this rank's faces: whether covered
  /// faces around it lie beyond a sharp edge (vertices_on_sharp_edges()).
  std::vector<bool> sharp_vertices(const ContactPair &pair);

  /// By face of the nonmortar surface: whether it is this rank's and the pair covers it. Others it has left
  /// to a nearer pair.
  std::vector<bool> faces_of_pair(const ContactPair &pair);

  /// The overlay of these faces.
  std::vector<OverlayTriangle> covered_overlay(const ContactPair &pair);

  /// Collective. The contact stress lambda n (force per area) of a pair at the corners of this rank's faces
  /// of its nonmortar surface. Where there is no multiplier it is the mean of the neighbours; on sharp edges,
  /// where it jumps, of those on the same face.
  CornerValues stress_at_corners(const Discretization &discretization, const ContactStress &stress,
                                 const unsigned int pair);

  /// Collective. Values at rows of a pair, by vertex of its nonmortar surface at the corners of this rank's
  /// faces: at hanging vertices that of their parents; where there is no multiplier though the other side
  /// covers most of what is around (at clamped nodes, on sharp edges) the mean of the neighbours, and else
  /// zero.
  std::vector<double>  at_vertices(const Discretization &discretization, const unsigned int pair,
                                   const std::vector<double> &of_rows);
  std::vector<Vector3> at_vertices(const Discretization &discretization, const unsigned int pair,
                                   const std::vector<Vector3> &of_rows);
} // namespace Signorini

#endif
