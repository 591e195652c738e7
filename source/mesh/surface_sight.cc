// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/surface/normal_projection.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  SurfaceSight::SurfaceSight(const ContactSurface &surface)
    : surface(surface)
    , tree(tree_of_triangles(surface.mesh))
  {
  }



  bool SurfaceSight::find(Place &place, const Point<3> &p, const Vector3 &n, const double same_place,
                          const std::function<bool(double)> &is_open) const
  {
    found.clear();
    tree.find_along_line(found, p, n);
    bool is_seen = false;
    for (const double side : {1., -1.})
      {
        double nearest = std::numeric_limits<double>::infinity();
        Place  facing;
        facing.distance = nearest;
        for (const unsigned int t : found)
          {
            Place one;
            one.triangle = t;
            if (!meets(one, p, n) || one.distance * side < 0.)
              continue;
            one.distance       = std::abs(one.distance);
            nearest            = std::min(nearest, one.distance);
            const Vector3 area = area_vector(surface, surface.faces[surface.triangle_face[t]]);
            if (area * n < touching_cosine * area.norm() && one.distance < facing.distance)
              facing = one;
          }
        if (std::isfinite(facing.distance) && facing.distance <= nearest + same_place &&
            (!is_seen || facing.distance < std::abs(place.distance)) && is_open(side * facing.distance))
          {
            is_seen = true;
            place   = facing;
            place.distance *= side;
          }
      }
    return is_seen;
  }



  bool SurfaceSight::meets(Place &place, const Point<3> &p, const Vector3 &n) const
  {
    const auto      &t        = surface.mesh.triangles[place.triangle];
    constexpr double rounding = -1e-9;
    return NormalProjection::intersect_line(
               place.weights, place.distance, p, n,
               {{surface.mesh.vertices[t[0]], surface.mesh.vertices[t[1]], surface.mesh.vertices[t[2]]}}) &&
           std::all_of(place.weights.begin(), place.weights.end(),
                       [](const double w) { return w >= rounding; });
  }
} // namespace Signorini
