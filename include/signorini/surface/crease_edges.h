// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_crease_edges_h
#define signorini_surface_crease_edges_h

#include <signorini/surface/surface_mesh.h>

#include <vector>

namespace Signorini
{
  /// When an edge of a triangulated surface is a crease of the surface that the triangles stand for. Angles
  /// in degrees.
  struct CreaseEdgeRule
  {
    /// Edges whose triangles meet at a larger angle are creases. A circle of twelve edges has 30, chamfers
    /// have 45.
    double sharp = 40.;
    /// Up to this angle such an edge is the middle of a fillet of two faces, 22.5, 45, 22.5, if the surface
    /// turns on on both sides by between these shares of it. All 45 is an octagon.
    double largest_chord = 52., least_of_chord = .4, most_of_chord = .75;
    /// At a smaller one edges of facets look the same. But facets turn from edge to edge, and a crease is
    /// alone: within some heights of the triangle beside it the surface turns about it by less than a share
    /// of its own angle; a smaller share says so, a larger one that it may be. On cones and cylinders of
    /// unstructured triangles, 20 and 40 around, both are between .1 and .4 where they meet at 15 to 38
    /// degrees; on balls, tori, ellipsoids, capsules, fillets of 6 to 40 around more than .6, but at single
    /// edges (tests/unit/surface/crease_edges.cc).
    double shallow = 10., reach = 1.5, is_alone = .4, may_be_alone = .6;
    /// How many times the turn on one side counts if the other one ends at once (a chamfer of one cell): the
    /// facets of a round surface may get larger toward a sharp edge.
    double one_sided = 2.;
    /// What part of the edges along a crease must be alone, and how many: single ones are so by chance.
    double share_alone = .7;
    int    least_alone = 2;
  };

  /// By edge whether it is a crease; borders are none. Shallow creases are closed, or end at sharp ones and
  /// at borders. Needs all of a surface: where a part of it ends creases may.
  std::vector<bool> find_creases(const SurfaceMesh &mesh, const SurfaceTopology &topology,
                                 const CreaseEdgeRule &rule = {});
} // namespace Signorini

#endif
