// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/mapping_quality.h>

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// A sphere from an octahedron with n cells on an edge, turned by an angle about (1, 2, 3).
  SurfaceMesh sphere(const unsigned int n, const double radius, const Point<3> &centre, const bool outward,
                     const double angle = 0.)
  {
    SurfaceMesh                                mesh;
    std::map<std::array<int, 3>, unsigned int> number;
    const Tensor<1, 3>                         axis   = Point<3>(1., 2., 3.) / std::sqrt(14.);
    const auto                                 vertex = [&](const std::array<int, 3> &i) {
      const auto [it, is_new] = number.emplace(i, static_cast<unsigned int>(mesh.vertices.size()));
      if (is_new)
        {
          Tensor<1, 3> x = Point<3>(i[0], i[1], i[2]);
          x *= radius / x.norm();
          x = std::cos(angle) * x + std::sin(angle) * cross_product_3d(axis, x) +
              (1. - std::cos(angle)) * (axis * x) * axis;
          mesh.vertices.push_back(centre + x);
        }
      return it->second;
    };
    const int m = static_cast<int>(n);
    for (const int sx : {-1, 1})
      for (const int sy : {-1, 1})
        for (const int sz : {-1, 1})
          for (int i = 0; i < m; ++i)
            for (int j = 0; i + j < m; ++j)
              {
                const auto at = [&](const int a, const int b) {
                  return vertex({{sx * a, sy * b, sz * (m - a - b)}});
                };
                const bool flip = sx * sy * sz < 0;
                const auto add  = [&](const unsigned int a, const unsigned int b, const unsigned int c) {
                  mesh.triangles.push_back(flip == outward ? std::array<unsigned int, 3>{{a, c, b}}
                                                            : std::array<unsigned int, 3>{{a, b, c}});
                };
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < m)
                  add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
              }
    mesh.compute_vertex_normals();
    return mesh;
  }
} // namespace



// A ball in a hollow: closed surfaces without borders, every line hits twice.
TEST(ClosedSurfaces, BallInHollow)
{
  const Point<3> origin;
  for (const unsigned int n : {3u, 5u, 8u})
    for (const unsigned int m : {4u, 5u, 9u})
      for (const double angle : {0., .3})
        {
          expect_full_cover(sphere(n, 1., origin, true), sphere(m, 1.1, origin, false, angle));
          expect_full_cover(sphere(n, 1.1, origin, false), sphere(m, 1., origin, true, angle));
        }
}

// A whole ball over a plane: only the half that faces it is mapped, the rest is said to be turned away.
TEST(ClosedSurfaces, BallOnPlane)
{
  const SurfaceMesh ball  = sphere(8, 1., Point<3>(0., 0., 1.05), true, .2),
                    plane = grid(
                        20,
                        [](const double x, const double y) { return Point<3>(6. * x - 3., 6. * y - 3., 0.); },
                        true);
  for (const bool ball_is_mortar : {true, false})
    {
      const SurfaceMesh   &non = ball_is_mortar ? plane : ball, &mor = ball_is_mortar ? ball : plane;
      const ContactMapping mapping(non, mor);
      EXPECT_EQ(violated_invariant(non, mor, mapping, false), "") << ball_is_mortar;
      EXPECT_EQ(mapping.report().n_flips, 0u);
      const MappingQuality quality = assess_mapping(mapping, non, mor);
      EXPECT_GT(quality.min_gap, .04);
      if (ball_is_mortar)
        {
          EXPECT_GT(count_unmapped(mapping.report()).at("wrong side"), 50u);
        }
      else
        // Straight down: the shadow of the half that faces the plane.
        EXPECT_NEAR(mapping.report().area_mortar_covered, dealii::numbers::PI, .15);
    }
}

// Two balls that touch anywhere. Where they turn away from each other,
// triangles are without their part of the overlay: no error, for nothing touches there.
TEST(ClosedSurfaces, BallBesideBall)
{
  for (const unsigned int n : {5u, 8u, 13u})
    for (const unsigned int m : {6u, 9u, 14u})
      for (const double x : {0., .2, .5, .9})
        for (const double y : {.1, .4})
          {
            const double      z     = std::sqrt(4.04 - x * x - y * y);
            const SurfaceMesh ball  = sphere(n, 1., Point<3>(x, y, z), true, .2),
                              other = sphere(m, 1., Point<3>(), true);
            const ContactMapping mapping(ball, other);
            EXPECT_EQ(mapping.report().n_lost_triangles, 0u) << n << ' ' << m << ' ' << x << ' ' << y;
          }
}

namespace
{
  /// The same surface with the vertices numbered the other way round.
  SurfaceMesh renumbered(const SurfaceMesh &mesh)
  {
    SurfaceMesh        result = mesh;
    const unsigned int n      = mesh.vertices.size();
    for (unsigned int v = 0; v < n; ++v)
      {
        result.vertices[n - 1 - v]       = mesh.vertices[v];
        result.vertex_normals[n - 1 - v] = mesh.vertex_normals[v];
      }
    for (auto &t : result.triangles)
      for (unsigned int &v : t)
        v = n - 1 - v;
    return result;
  }
} // namespace

// A ball over a plane whose faces are wider than the ball: no mortar vertex has an image, and mortar edges
// come in over the rim of what faces the plane, or there is none. The ball covers the same everywhere.
TEST(ClosedSurfaces, BallOnWideFaces)
{
  for (const unsigned int n : {5u, 8u})
    for (const unsigned int n_faces : {1u, 3u, 5u})
      {
        const SurfaceMesh plane = grid(
            n_faces, [](const double x, const double y) { return Point<3>(12. * x - 6., 12. * y - 6., 0.); },
            true);
        double covered = -1.;
        for (const double x : {0., .3, 1., 1.3, 2., 2.5, 3.1})
          for (const double y : {0., .7, 1., 1.9, 2., 4.})
            {
              const SurfaceMesh    ball = sphere(n, 1., Point<3>(x, y, 1.05), true, .2);
              const ContactMapping mapping(ball, plane);
              EXPECT_EQ(violated_invariant(ball, plane, mapping, false), "") << x << ' ' << y;
              const MappingReport &report = mapping.report();
              EXPECT_EQ(describe_errors(report), "") << x << ' ' << y;
              if (covered < 0.)
                covered = report.area_mortar_covered;
              EXPECT_NEAR(report.area_mortar_covered, dealii::numbers::PI, .4);
              EXPECT_NEAR(report.area_mortar_covered, covered, 1e-12)
                  << n << ' ' << n_faces << ' ' << x << ' ' << y;
              const SurfaceMesh    other = renumbered(ball);
              const ContactMapping again(other, plane);
              EXPECT_EQ(describe_errors(again.report()), "") << x << ' ' << y;
              EXPECT_NEAR(again.report().area_mortar_covered, covered, 1e-12) << x << ' ' << y;
              double of_parts = 0.;
              for (const bool upper : {false, true})
                of_parts += ContactMapping(ball, plane,
                                           [&](const unsigned int t) {
                                             return (ball.vertices[ball.triangles[t][0]][1] > y) == upper;
                                           })
                                .report()
                                .area_mortar_covered;
              EXPECT_NEAR(of_parts, covered, 1e-12) << x << ' ' << y;
            }
      }
}

// The same over the edge of the plane: half of it.
TEST(ClosedSurfaces, BallOverTheEdgeOfWideFaces)
{
  const SurfaceMesh plane = grid(
      2, [](const double x, const double y) { return Point<3>(12. * x - 6., 12. * y - 6., 0.); }, true);
  for (const double y : {0., 1.5, 2.9})
    {
      const SurfaceMesh    ball = sphere(8, 1., Point<3>(6., y, 1.05), true);
      const ContactMapping mapping(ball, plane);
      EXPECT_EQ(violated_invariant(ball, plane, mapping, false), "") << y;
      EXPECT_EQ(describe_errors(mapping.report()), "") << y;
      EXPECT_NEAR(mapping.report().area_mortar_covered, .5 * dealii::numbers::PI, .15) << y;
    }
}

namespace
{
  Tensor<1, 3> normal(const SurfaceMesh &mesh, const unsigned int triangle)
  {
    const auto        &t = mesh.triangles[triangle];
    const Tensor<1, 3> n = cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                            mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    return n / n.norm();
  }
} // namespace

// A ball in the groove that it runs in. Across the groove the surfaces fit, along it the ball turns away, up
// to a right angle: the cells of the groove, bent more than they are wide, tear the overlay or turn over.
// From 60 degrees on that is no error, for nothing touches there.
TEST(ClosedSurfaces, BallInAGroove)
{
  std::size_t n_turned_away = 0;
  for (const unsigned int n : {6u, 9u, 12u})
    for (const unsigned int m : {8u, 13u, 20u})
      for (const double angle : {0., .2, .4, .7, 1.1})
        {
          const auto shape = [](const double x, const double y) {
            const double along = .5 * (x - .5), across = 2.2 * (y - .5), r = 5. + 1.05 * std::cos(across);
            return Point<3>(r * std::cos(along) - 5., r * std::sin(along), 1.05 * std::sin(across));
          };
          const SurfaceMesh    ball   = sphere(n, 1., Point<3>(), true, angle);
          const SurfaceMesh    groove = grid(m, shape, false, .2, n);
          const ContactMapping mapping(ball, groove);
          n_turned_away += mapping.report().n_turned_away;
          std::map<unsigned int, double> best;
          for (const auto &[t, other] : mapping.polygon_triangles)
            best[t] = std::min(best[t], normal(ball, t) * normal(groove, other));
          for (const unsigned int t : mapping.report().wrong_triangles)
            EXPECT_TRUE(best.count(t) == 0 || best[t] < -.5);
          // Where the ball lies in the groove the mapping is right.
          for (const unsigned int t : mapping.report().wrong_triangles)
            EXPECT_GT(ball.vertices[ball.triangles[t][0]].distance(Point<3>(1., 0., 0.)), .4);
        }
  EXPECT_GT(n_turned_away, 0u);
}
