// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/crease_edges.h>
#include <signorini/surface/smooth_surface.h>

namespace
{
  using namespace Signorini;
  using dealii::Point;
  using TestSurfaces::bent;

  /// A quarter of a cylinder of radius 1 with a cone on it: edges of the n x n grid follow the line where
  /// they meet (height 1) at an angle (degrees).
  SurfaceMesh cone_on_cylinder(const unsigned int n, const double angle)
  {
    return bent(n, .2, [&](const double s, const double t) {
      const double z = 2. * (std::abs(t - .5) < .3 / n ? .5 : t), phi = .5 * M_PI * s;
      const double radius = 1. - std::max(0., z - 1.) * std::tan(angle * M_PI / 180.);
      return Point<3>(radius * std::cos(phi), radius * std::sin(phi), z);
    });
  }

  unsigned int n_creases(const SurfaceMesh &mesh)
  {
    const auto creases = find_creases(mesh, SurfaceTopology(mesh.triangles, mesh.vertices.size()));
    return std::count(creases.begin(), creases.end(), true);
  }
} // namespace



TEST(CreaseEdges, ConeOnCylinder)
{
  for (const unsigned int n : {6, 10, 20})
    for (const double angle : {15., 20., 25., 30., 38.})
      {
        // 24 around turn by 15 degrees themselves.
        if (n == 6 && angle < 25.)
          continue;
        const SurfaceMesh     mesh = cone_on_cylinder(n, angle);
        const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
        const auto            creases = find_creases(mesh, topology);
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          {
            const auto &[a, b] = topology.edges[e];
            EXPECT_EQ(creases[e], mesh.vertices[a][2] == 1. && mesh.vertices[b][2] == 1.)
                << n << ", " << angle << ": " << mesh.vertices[a] << " to " << mesh.vertices[b];
          }
        // What is smooth is, up to the crease: the cylinder is known exactly.
        const SmoothSurface surface(mesh, std::vector<bool>(mesh.triangles.size(), true));
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          {
            const auto &[a, b, c] = mesh.triangles[t];
            if (std::max({mesh.vertices[a][2], mesh.vertices[b][2], mesh.vertices[c][2]}) > 1.)
              continue;
            EXPECT_TRUE(surface.patch(t).is_smooth);
            const Point<3> x = mesh.vertices[a] + 1. / 3. * (mesh.vertices[b] - mesh.vertices[a]) +
                               1. / 3. * (mesh.vertices[c] - mesh.vertices[a]) +
                               surface.offset(t, {{1. / 3., 1. / 3., 1. / 3.}});
            EXPECT_NEAR(std::hypot(x[0], x[1]), 1., 1e-13);
          }
      }
}



// Angles of 45 degrees: chamfers of one cell and of more are creases, and those of an octagon,
// whose sides may have one cell; fillets of two faces have none (SmoothSurface.FilletsOfFewFaces).
TEST(CreaseEdges, ChordsOfCoarseFillets)
{
  constexpr unsigned int n = 12;
  for (const unsigned int n_cells : {1, 3})
    {
      const SurfaceMesh chamfer = bent(n, 0., [&](const double s, const double t) {
        const double row = n * t - 4., way = std::max(0., std::min(1., row / n_cells));
        return Point<3>(way + std::min(0., row), s, -way - std::max(0., row - n_cells));
      });
      EXPECT_EQ(n_creases(chamfer), 2 * n) << n_cells;
    }
  const SurfaceMesh octagon = bent(8, 0., [](const double s, const double t) {
    return Point<3>(std::cos(2. * M_PI * t), s, std::sin(2. * M_PI * t));
  });
  EXPECT_EQ(n_creases(octagon), 56u);
}



TEST(CreaseEdges, NoneOnRoundSurfaces)
{
  const auto sphere = [](const double s, const double t) {
    const dealii::Tensor<1, 3> d({s - .5, t - .5, .5});
    return Point<3>(d / d.norm());
  };
  const auto ellipsoid = [&](const double s, const double t) {
    const Point<3> x = sphere(s, t);
    return Point<3>(x[0], 1.5 * x[1], 2. * x[2]);
  };
  const auto torus = [](const double s, const double t) {
    const double phi = M_PI * s, theta = M_PI * t, r = 2. + .8 * std::cos(theta);
    return Point<3>(r * std::cos(phi), r * std::sin(phi), .8 * std::sin(theta));
  };
  const auto cylinder = [](const double s, const double t) {
    return Point<3>(std::cos(M_PI * s), std::sin(M_PI * s), t);
  };
  // A plane, a fillet, a plane.
  const auto fillet = [](const double s, const double t) {
    const double phi = std::max(0., std::min(.5 * M_PI, M_PI * (s - .25)));
    return Point<3>(std::sin(phi) + 2. * std::min(0., s - .25), std::cos(phi) - 2. * std::max(0., s - .75),
                    t);
  };
  for (const unsigned int n : {8, 12, 24})
    for (const double jitter : {0., .2})
      {
        EXPECT_EQ(n_creases(bent(n, jitter, sphere)), 0u) << n << ", " << jitter;
        EXPECT_EQ(n_creases(bent(n, jitter, ellipsoid)), 0u) << n << ", " << jitter;
        EXPECT_EQ(n_creases(bent(n, jitter, torus)), 0u) << n << ", " << jitter;
        EXPECT_EQ(n_creases(bent(n, jitter, cylinder)), 0u) << n << ", " << jitter;
        EXPECT_EQ(n_creases(bent(n, jitter, fillet)), 0u) << n << ", " << jitter;
      }
}



// A slab of one layer: each crease is a single edge from border to border, and those of a roller are none.
TEST(CreaseEdges, AcrossSlabsOfOneLayer)
{
  const auto slab = [](const unsigned int n, const std::function<Point<3>(double)> &profile) {
    SurfaceMesh mesh;
    for (unsigned int i = 0; i <= n; ++i)
      for (const double y : {0., .2})
        {
          mesh.vertices.push_back(profile(static_cast<double>(i) / n));
          mesh.vertices.back()[1] = y;
        }
    for (unsigned int i = 0; i < n; ++i)
      {
        mesh.triangles.push_back({{2 * i, 2 * i + 2, 2 * i + 1}});
        mesh.triangles.push_back({{2 * i + 2, 2 * i + 3, 2 * i + 1}});
      }
    return mesh;
  };
  for (const double angle : {10., 25., 38.})
    for (const unsigned int n : {4u, 12u})
      EXPECT_EQ(n_creases(slab(n,
                               [&](const double s) {
                                 const double way = std::max(0., s - .5), turn = angle * M_PI / 180.;
                                 return Point<3>(std::min(s, .5) + way * std::cos(turn), 0.,
                                                 way * std::sin(turn));
                               })),
                1u)
          << angle << ", " << n;
  for (const unsigned int n : {5u, 9u, 16u})
    EXPECT_EQ(n_creases(slab(
                  n, [](const double s) { return Point<3>(std::sin(M_PI * s), 0., std::cos(M_PI * s)); })),
              0u)
        << n;
}
