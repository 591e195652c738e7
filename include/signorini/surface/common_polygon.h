// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_common_polygon_h
#define signorini_surface_common_polygon_h

#include <array>
#include <vector>

namespace Signorini
{
  /// Puts the corners of the polygon that two triangles have in common in order, from where each lies on the
  /// borders of the two.
  class CommonPolygon
  {
  public:
    /// A position on the border of a triangle: 2c at corner c, 2c + 1 on the edge from corner c to c + 1,
    /// with the way along it; feature -1 inside.
    struct Position
    {
      /// As said above; `along` in [0,1].
      int    feature = -1;
      double along   = 0.;
    };

    /// A corner of the polygon.
    struct Corner
    {
      /// Number of the node in the plane graph.
      unsigned int node;
      /// Counterclockwise on the nonmortar triangle, and on the mortar triangle as seen from the nonmortar
      /// side.
      Position nonmortar, mortar;
    };

    /// Brings corners into counterclockwise order. False if they are not those of one polygon.
    bool sort(std::vector<Corner> &corners);

  private:
    void collect(const std::vector<Corner> &corners);
    void follow_both(const std::vector<Corner> &corners);

    std::vector<unsigned int> on_nonmortar, on_mortar;
    std::vector<Corner>       sorted;
  };

  /// Cuts a polygon in the plane into triangles with the same orientation where that is possible, whatever
  /// its shape. Appends three corner numbers per triangle.
  void triangulate_polygon(std::vector<std::array<unsigned int, 3>> &triangles,
                           const std::vector<std::array<double, 2>> &corners);
} // namespace Signorini

#endif
