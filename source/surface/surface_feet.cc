// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/normal_projection.h>
#include <signorini/surface/surface_feet.h>

#include <algorithm>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Weights of the point of a triangle nearest to p (Ericson: Real-Time Collision Detection, 5.1.5).
    std::array<double, 3> nearest_in_triangle(const std::array<Point<3>, 3> &x, const Point<3> &p)
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

    Point<3> combine(const std::array<double, 3> &weights, const std::array<Point<3>, 3> &x)
    {
      return Point<3>(weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2]);
    }

    double box_distance(const std::array<Point<3>, 3> &x, const Point<3> &p)
    {
      Tensor<1, 3> way;
      for (unsigned int c = 0; c < 3; ++c)
        way[c] = std::max(
            {std::min({x[0][c], x[1][c], x[2][c]}) - p[c], p[c] - std::max({x[0][c], x[1][c], x[2][c]}), 0.});
      return way.norm();
    }

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



  SurfaceFeet::SurfaceFeet(const SurfaceMesh &mesh, std::vector<unsigned int> triangle_list,
                           std::vector<CornerNormals> corner_normals)
    : mesh(mesh)
    , triangles(std::move(triangle_list))
    , normals(std::move(corner_normals))
    , tree(boxes_of(mesh, triangles))
  {
    AssertDimension(triangles.size(), normals.size());
  }



  std::array<Point<3>, 3> SurfaceFeet::corners(const unsigned int i) const
  {
    const auto &v = mesh.triangles[triangles[i]];
    return {{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]}};
  }



  SurfaceFeet::Foot SurfaceFeet::nearest(std::vector<unsigned int> &found, const Point<3> &p) const
  {
    Foot   best;
    double distance = std::numeric_limits<double>::max();
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
            const auto     weights = nearest_in_triangle(x, p);
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



  SurfaceFeet::Foot SurfaceFeet::find(const Point<3> &p) const
  {
    std::vector<unsigned int> found;
    Foot                      best  = nearest(found, p);
    double                    least = 2. * p.distance(best.point) + 1e-300;
    for (const unsigned int i : found)
      {
        const auto            x = corners(i);
        std::array<double, 3> weights;
        double                eta;
        if (box_distance(x, p) >= least ||
            !NormalProjection::inverse_project(weights, eta, p, x, normals[i]) ||
            *std::min_element(weights.begin(), weights.end()) < -1e-10)
          continue;
        for (double &w : weights)
          w = std::max(0., w);
        const Point<3> foot = combine(weights, x);
        if (p.distance(foot) < least)
          {
            least = p.distance(foot);
            best  = {i, weights, foot};
          }
      }
    best.triangle = triangles[best.triangle];
    return best;
  }



  Tensor<1, 3> SurfaceFeet::normal(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    std::vector<unsigned int> found;
    const Foot                best = nearest(found, p);
    const auto                x    = corners(best.triangle);
    const double distance = p.distance(best.point), size = x[0].distance(x[1]) + x[0].distance(x[2]);
    Tensor<1, 3> result;
    double       cosine = -std::numeric_limits<double>::max();
    for (const unsigned int i : found)
      {
        const auto corner = corners(i);
        if (box_distance(corner, p) > distance + 1e-6 * size)
          continue;
        const auto weights = nearest_in_triangle(corner, p);
        if (p.distance(combine(weights, corner)) > distance + 1e-6 * size)
          continue;
        Tensor<1, 3> n = weights[0] * normals[i][0] + weights[1] * normals[i][1] + weights[2] * normals[i][2];
        if (!(n.norm() > 0.))
          continue;
        n /= n.norm();
        const Tensor<1, 3> triangle = cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]);
        if (const double agreement = triangle * facing / triangle.norm(); agreement > cosine)
          {
            cosine = agreement;
            result = n;
          }
      }
    return result.norm() > 0. ? result : facing;
  }



  namespace
  {
    /// Which triangles are taken for the one that a facet of a finer mesh belongs to. Pure numbers.
    struct FacingTriangleRule
    {
      /// How much farther than the nearest triangle, relative to its size: a facet on an arc over twelve
      /// edges of a circle lies off by 0.07 of an edge, over six by 0.13.
      double reach = .2;
      /// How much less than the best one (cosine). Facets of twelve edges turn by 15 degrees (0.03) from
      /// their arcs, creases have more than 40 (0.23).
      double equal = .1;
    };
  } // namespace



  unsigned int SurfaceFeet::facing(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    constexpr FacingTriangleRule rule;
    std::vector<unsigned int>    found;
    const Foot                   best = nearest(found, p);
    const auto                   x    = corners(best.triangle);
    const double                 reach =
        p.distance(best.point) +
        rule.reach * std::max({x[0].distance(x[1]), x[1].distance(x[2]), x[2].distance(x[0])});
    BoxTree::Box box = {p, p};
    for (unsigned int c = 0; c < 3; ++c)
      {
        box.low[c] -= reach;
        box.high[c] += reach;
      }
    tree.find_overlapping(found, box);
    std::sort(found.begin(), found.end());
    const double        length = facing.norm();
    std::vector<double> cosines, distances;
    double              largest = -1.;
    for (const unsigned int i : found)
      {
        const auto         corner = corners(i);
        const Tensor<1, 3> n      = cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]);
        distances.push_back(p.distance(combine(nearest_in_triangle(corner, p), corner)));
        cosines.push_back(n.norm() > 0. && length > 0. ? n * facing / (n.norm() * length) : -1.);
        if (distances.back() <= reach)
          largest = std::max(largest, cosines.back());
      }
    unsigned int result = best.triangle;
    double       least  = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < found.size(); ++k)
      if (distances[k] < least && distances[k] <= reach && cosines[k] >= largest - rule.equal)
        {
          least  = distances[k];
          result = found[k];
        }
    return triangles[result];
  }
} // namespace Signorini
