// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/nearest_triangle.h>

#include <algorithm>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::vector<BoxTree::Box> boxes_of(const SurfaceMesh &mesh, const std::vector<unsigned int> &triangles)
    {
      std::vector<BoxTree::Box> boxes;
      boxes.reserve(triangles.size());
      for (const unsigned int t : triangles)
        {
          const auto &v = mesh.triangles[t];
          boxes.push_back({mesh.vertices[v[0]], mesh.vertices[v[0]]});
          boxes.back().include(mesh.vertices[v[1]]);
          boxes.back().include(mesh.vertices[v[2]]);
        }
      return boxes;
    }
  } // namespace



  NearestTriangle::NearestTriangle(const SurfaceMesh &mesh, std::vector<unsigned int> triangle_list)
    : mesh(mesh)
    , triangles(std::move(triangle_list))
    , tree(boxes_of(mesh, triangles))
  {
  }



  NearestTriangle::Corners NearestTriangle::corners(const unsigned int i) const
  {
    const auto &v = mesh.triangles[triangles[i]];
    return {{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
  }



  SurfaceFoot NearestTriangle::find(std::vector<unsigned int> &found, const Point<3> &p) const
  {
    SurfaceFoot best;
    double      distance = std::numeric_limits<double>::max();
    // Boxes come nearest first or not: ask for more until the nearest point cannot improve.
    for (unsigned int n = 8;; n *= 4)
      {
        tree.find_nearest(found, p, n);
        double farthest = 0.;
        for (const unsigned int i : found)
          {
            const auto   x   = corners(i);
            const double box = box_distance(x, p);
            farthest         = std::max(farthest, box);
            if (box >= distance)
              continue;
            const auto     weights = nearest_weights(x, p);
            const Point<3> near    = combine(weights, x);
            if (p.distance(near) < distance)
              {
                distance = p.distance(near);
                best     = {i, weights, near};
              }
          }
        if (distance <= farthest || found.size() < n)
          return best;
      }
  }



  // Ericson: Real-Time Collision Detection, 5.1.5.
  std::array<double, 3> NearestTriangle::nearest_weights(const Corners &x, const Point<3> &p)
  {
    const Tensor<1, 3> ab = x[1] - x[0], ac = x[2] - x[0], ap = p - x[0], bp = p - x[1], cp = p - x[2];
    const double       d1 = ab * ap, d2 = ac * ap, d3 = ab * bp, d4 = ac * bp, d5 = ab * cp, d6 = ac * cp;
    if (d1 <= 0. && d2 <= 0.)
      return {{1., 0., 0.}};
    if (d3 >= 0. && d4 <= d3)
      return {{0., 1., 0.}};
    if (d6 >= 0. && d5 <= d6)
      return {{0., 0., 1.}};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0. && d1 >= 0. && d3 <= 0.)
      return {{1. - d1 / (d1 - d3), d1 / (d1 - d3), 0.}};
    if (vb <= 0. && d2 >= 0. && d6 <= 0.)
      return {{1. - d2 / (d2 - d6), 0., d2 / (d2 - d6)}};
    if (va <= 0. && d4 - d3 >= 0. && d5 - d6 >= 0.)
      {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {{0., 1. - t, t}};
      }
    const double sum = va + vb + vc;
    return {{va / sum, vb / sum, vc / sum}};
  }



  Point<3> NearestTriangle::combine(const std::array<double, 3> &weights, const Corners &x)
  {
    return Point<3>(weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2]);
  }



  double NearestTriangle::box_distance(const Corners &x, const Point<3> &p)
  {
    Tensor<1, 3> way;
    for (unsigned int c = 0; c < 3; ++c)
      way[c] = std::max(
          {std::min({x[0][c], x[1][c], x[2][c]}) - p[c], p[c] - std::max({x[0][c], x[1][c], x[2][c]}), 0.});
    return way.norm();
  }
} // namespace Signorini
