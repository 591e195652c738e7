// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/part_region.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Cuts points in two halves along the longest side of their box, again and again.
    void cut(std::vector<std::vector<Point<3>>> &clusters, std::vector<Point<3>> points,
             const unsigned int n_times)
    {
      if (n_times == 0 || points.size() < 2)
        {
          clusters.push_back(std::move(points));
          return;
        }
      Point<3> low = points[0], high = points[0];
      for (const Point<3> &x : points)
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], x[d]);
            high[d] = std::max(high[d], x[d]);
          }
      const Tensor<1, 3> sides = high - low;
      unsigned int       axis  = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (sides[d] > sides[axis])
          axis = d;
      const auto middle = points.begin() + points.size() / 2;
      std::nth_element(points.begin(), middle, points.end(),
                       [axis](const Point<3> &a, const Point<3> &b) { return a[axis] < b[axis]; });
      cut(clusters, {points.begin(), middle}, n_times - 1);
      cut(clusters, {middle, points.end()}, n_times - 1);
    }
  } // namespace



  namespace
  {
    Point<3> centre_of(const SurfaceMesh &surface, const unsigned int triangle)
    {
      const auto     &corners = surface.triangles[triangle];
      const Point<3> &x       = surface.vertices[corners[0]];
      return x + (surface.vertices[corners[1]] - x + (surface.vertices[corners[2]] - x)) / 3.;
    }
  } // namespace



  std::vector<PartRegion::Ball> PartRegion::cover(const SurfaceMesh               &surface,
                                                  const std::vector<unsigned int> &triangles)
  {
    std::vector<Point<3>> centres;
    for (const unsigned int t : triangles)
      centres.push_back(centre_of(surface, t));
    std::vector<std::vector<Point<3>>> clusters;
    if (!centres.empty())
      cut(clusters, centres, 3);
    std::vector<Ball> balls;
    for (const auto &cluster : clusters)
      {
        Tensor<1, 3> sum;
        for (const Point<3> &x : cluster)
          sum += x - cluster[0];
        balls.push_back({cluster[0] + sum / static_cast<double>(cluster.size()), 0.});
      }
    for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        Ball &nearest = *std::min_element(balls.begin(), balls.end(), [&](const Ball &a, const Ball &b) {
          return centres[i].distance_square(a.centre) < centres[i].distance_square(b.centre);
        });
        for (const unsigned int v : surface.triangles[triangles[i]])
          nearest.radius = std::max(nearest.radius, surface.vertices[v].distance(nearest.centre));
      }
    return balls;
  }



  PartRegion::PartRegion(const SurfaceMesh                             &nonmortar,
                         const std::function<bool(const unsigned int)> &is_selected)
    : everything(!is_selected)
  {
    if (everything)
      return;
    std::vector<unsigned int> selected;
    for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
      if (is_selected(t))
        selected.push_back(t);
    balls = cover(nonmortar, selected);
    // Vertices found incident are moved by less than this.
    constexpr double slack = 1e-4;
    balls_of_vertex.assign(nonmortar.vertices.size(), 0);
    for (unsigned int v = 0; v < nonmortar.vertices.size(); ++v)
      for (unsigned int b = 0; b < balls.size(); ++b)
        if (nonmortar.vertices[v].distance(balls[b].centre) <= (1. + .5 * slack) * balls[b].radius)
          balls_of_vertex[v] |= static_cast<unsigned short>(1u << b);
    for (Ball &ball : balls)
      ball.radius *= 1. + slack;
    if (!balls.empty())
      {
        Ball all{balls[0].centre, 0.};
        for (const Ball &ball : balls)
          all.radius = std::max(all.radius, all.centre.distance(ball.centre) + ball.radius);
        balls.insert(balls.begin(), all);
      }
  }



  bool PartRegion::contains(const unsigned int vertex) const
  {
    return everything || balls_of_vertex[vertex] != 0;
  }



  bool PartRegion::contains(const unsigned int vertex, const unsigned int other) const
  {
    return everything || (balls_of_vertex[vertex] & balls_of_vertex[other]) != 0;
  }



  bool PartRegion::meets_curtain(const Point<3> &p0, const Tensor<1, 3> &n0, const Point<3> &p1,
                                 const Tensor<1, 3> &n1) const
  {
    if (everything)
      return true;
    if (balls.empty() || !balls[0].meets_curtain(p0, n0, p1, n1))
      return false;
    for (std::size_t b = 1; b < balls.size(); ++b)
      if (balls[b].meets_curtain(p0, n0, p1, n1))
        return true;
    return false;
  }



  bool PartRegion::Ball::meets_curtain(const Point<3> &p0, const Tensor<1, 3> &n0, const Point<3> &p1,
                                       const Tensor<1, 3> &n1) const
  {
    // For a point of the curtain in the ball, |n.(p + eta n - c)| <= r |n|: an interval for eta from the
    // range of the quadratic n(s).(c - p(s)) (its Bernstein coefficients) and that of |n(s)|^2.
    const Tensor<1, 3> d0 = centre - p0, d1 = centre - p1;
    const double       smallest = .5 * (1. + n0 * n1);
    if (smallest < 1e-3)
      return true;
    const double b0 = n0 * d0, b1 = .5 * (n0 * d1 + n1 * d0), b2 = n1 * d1;
    double low = std::min(b0, std::min(b1, b2)) - radius, high = std::max(b0, std::max(b1, b2)) + radius;
    low  = low < 0. ? low / smallest : low;
    high = high > 0. ? high / smallest : high;
    // There the curtain lies in the convex hull of four points. Seen along the mean normal:
    Tensor<1, 3> axis = n0 + n1;
    axis /= axis.norm();
    const auto flat = [&](const Tensor<1, 3> &x) -> Tensor<1, 3> { return x - (x * axis) * axis; };
    const std::array<Tensor<1, 3>, 4> corners = {
        {flat(low * n0 - d0), flat(high * n0 - d0), flat(low * n1 - d1), flat(high * n1 - d1)}};
    const Tensor<1, 3> middle = .25 * (corners[0] + corners[1] + corners[2] + corners[3]);
    double             extent = 0.;
    for (const auto &corner : corners)
      extent = std::max(extent, (corner - middle).norm());
    return middle.norm() <= radius + extent;
  }
} // namespace Signorini
