// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_surface_plane_graph_walk_h
#define signorini_source_surface_plane_graph_walk_h

#include <signorini/surface/plane_graph.h>

namespace Signorini
{
  inline std::array<dealii::Point<3>, 3> corners_of(const SurfaceMesh &mesh, const unsigned int triangle)
  {
    const auto &t = mesh.triangles[triangle];
    return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}};
  }


  /// The way of the image of a mortar edge over the nonmortar surface.
  struct PlaneGraph::Walk
  {
    unsigned int edge;
    /// 1 from its lower to its higher vertex, -1 the other way.
    int direction;
    /// The node where it ends, or none.
    unsigned int target;

    /// Where it is: at a vertex, or in a triangle that it has entered through a local edge (with the sides of
    /// the corners at the beginning and the end of that edge).
    unsigned int                   vertex = none, triangle = none, entry = none;
    std::array<Incidence::Side, 2> entry_sides = {};
    /// How far it has come, in its direction.
    double position = 0.;

    double forward(const double parameter) const
    {
      return direction > 0 ? parameter : 1. - parameter;
    }

    /// Whether a vertex that lies on the curtain, there, comes before the end of the edge. Where both
    /// surfaces end in one plane, all vertices of the rim lie on the curtain, those beyond the end of the
    /// edge as well.
    bool ends_after(const double parameter) const
    {
      return forward(parameter) < 1. + Incidence::near_end;
    }

    /// Whether it is still to come as well.
    bool passes_at(const double parameter) const
    {
      return forward(parameter) > position && ends_after(parameter);
    }
  };
} // namespace Signorini

#endif
