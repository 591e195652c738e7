// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "corner_sight.h"

#include <signorini/mesh/surface_normals.h>
#include <signorini/surface/contact_mapping.h>

#include <cmath>

namespace Signorini
{
  using namespace dealii;

  std::optional<CornerSight::Seen> CornerSight::look(const unsigned int triangle, const unsigned int vertex,
                                                     const Vector3 &normal) const
  {
    const auto    &x = surface.mesh.vertices;
    const auto    &c = surface.mesh.triangles[triangle];
    const Point<3> centre((Vector3(x[c[0]]) + Vector3(x[c[1]]) + Vector3(x[c[2]])) / 3.);
    Seen           seen;
    seen.place = centre + CornerSightRule().toward_vertex * (x[vertex] - centre);
    seen.width = std::sqrt(triangle_area(surface.mesh, triangle));
    if (!partner(seen.partner, seen.place, normal, seen.width))
      return {};
    return seen;
  }



  Vector3 normal_of_wall(const std::vector<Vector3> &normals)
  {
    Vector3 sum;
    for (const Vector3 &one : normals)
      {
        sum += one;
        for (const Vector3 &other : normals)
          if (one * other < CornerSightRule().one_wall)
            return Vector3();
      }
    return normals.empty() ? sum : sum / sum.norm();
  }
} // namespace Signorini
