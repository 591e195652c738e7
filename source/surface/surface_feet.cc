// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/normal_projection.h>
#include <signorini/surface/surface_feet.h>

#include <algorithm>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  SurfaceFeet::SurfaceFeet(const SurfaceMesh &mesh, std::vector<unsigned int> triangle_list,
                           std::vector<CornerNormals> corner_normals)
    : triangles(mesh, std::move(triangle_list))
    , normals(std::move(corner_normals))
  {
  }



  SurfaceFeet::Foot SurfaceFeet::find(const Point<3> &p) const
  {
    std::vector<unsigned int> found;
    Foot                      best  = triangles.find(found, p);
    double                    least = 2. * p.distance(best.point) + 1e-300;
    for (const unsigned int i : found)
      {
        const auto            x = triangles.corners(i);
        std::array<double, 3> weights;
        double                eta;
        if (NearestTriangle::box_distance(x, p) >= least ||
            !NormalProjection::inverse_project(weights, eta, p, x, normals[i]) ||
            *std::min_element(weights.begin(), weights.end()) < -1e-10)
          continue;
        for (double &w : weights)
          w = std::max(0., w);
        const Point<3> foot = NearestTriangle::combine(weights, x);
        if (p.distance(foot) < least)
          {
            least = p.distance(foot);
            best  = {i, weights, foot};
          }
      }
    best.triangle = triangles.triangle(best.triangle);
    return best;
  }



  Tensor<1, 3> SurfaceFeet::normal(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    std::vector<unsigned int> found;
    const Foot                best = triangles.find(found, p);
    const auto                x    = triangles.corners(best.triangle);
    const double distance = p.distance(best.point), size = x[0].distance(x[1]) + x[0].distance(x[2]);
    Tensor<1, 3> result;
    double       cosine = -std::numeric_limits<double>::max();
    for (const unsigned int i : found)
      {
        const auto corner = triangles.corners(i);
        if (NearestTriangle::box_distance(corner, p) > distance + 1e-6 * size)
          continue;
        const auto weights = NearestTriangle::nearest_weights(corner, p);
        if (p.distance(NearestTriangle::combine(weights, corner)) > distance + 1e-6 * size)
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
    const Foot                   best = triangles.find(found, p);
    const auto                   x    = triangles.corners(best.triangle);
    const double                 reach =
        p.distance(best.point) +
        rule.reach * std::max({x[0].distance(x[1]), x[1].distance(x[2]), x[2].distance(x[0])});
    BoxTree::Box box = {p, p};
    for (unsigned int c = 0; c < 3; ++c)
      {
        box.low[c] -= reach;
        box.high[c] += reach;
      }
    triangles.boxes().find_overlapping(found, box);
    std::sort(found.begin(), found.end());
    const double        length = facing.norm();
    std::vector<double> cosines, distances;
    double              largest = -1.;
    for (const unsigned int i : found)
      {
        const auto         corner = triangles.corners(i);
        const Tensor<1, 3> n      = cross_product_3d(corner[1] - corner[0], corner[2] - corner[0]);
        distances.push_back(
            p.distance(NearestTriangle::combine(NearestTriangle::nearest_weights(corner, p), corner)));
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
    return triangles.triangle(result);
  }
} // namespace Signorini
