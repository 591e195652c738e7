// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/types.h>
#include <signorini/mesh/way_out.h>
#include <signorini/surface/normal_projection.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  WayOut::WayOut(const SurfaceMesh &boundary)
    : boundary(boundary)
    , tree(tree_of_triangles(boundary))
  {
  }



  bool WayOut::leads_from(const Point<3> &x, const Point<3> &y, const double width) const
  {
    const double  length    = x.distance(y);
    const Vector3 direction = (y - x) / length;
    found.clear();
    tree.find_along_segment(found, x, y);
    return std::any_of(found.begin(), found.end(), [&](const unsigned int t) {
      const auto                   &c       = boundary.triangles[t];
      const std::array<Point<3>, 3> corners = {
          {boundary.vertices[c[0]], boundary.vertices[c[1]], boundary.vertices[c[2]]}};
      std::array<double, 3> weights;
      double                along;
      // An edge between two triangles belongs to both.
      constexpr double rounding = -1e-9;
      return cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]) * direction > 0. &&
             NormalProjection::intersect_line(weights, along, x, direction, corners) && along > .5 * width &&
             along < length &&
             std::all_of(weights.begin(), weights.end(), [](const double w) { return w >= rounding; });
    });
  }
} // namespace Signorini
