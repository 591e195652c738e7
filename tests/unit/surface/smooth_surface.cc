// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/smooth_surface.h>

namespace
{
  using namespace Signorini;
  using dealii::Point;
  using dealii::Tensor;
  using TestSurfaces::bent;

  SmoothSurface smooth(const SurfaceMesh &mesh)
  {
    return SmoothSurface(mesh, std::vector<bool>(mesh.triangles.size(), true));
  }

  const std::array<double, 3> samples[] = {{{1. / 3., 1. / 3., 1. / 3.}},
                                           {{.5, .5, 0.}},
                                           {{0., .5, .5}},
                                           {{.5, 0., .5}},
                                           {{.6, .3, .1}}};

  /// Largest distances of facets and of patches from a shape.
  std::array<double, 2> heights(const SmoothSurface                           &surface,
                                const std::function<double(const Point<3> &)> &distance)
  {
    std::array<double, 2> worst = {{0., 0.}};
    for (unsigned int t = 0; t < surface.mesh().triangles.size(); ++t)
      for (const auto &w : samples)
        {
          const Point<3> x = evaluate(surface.mesh(), t, w);
          worst[0]         = std::max(worst[0], std::abs(distance(x)));
          worst[1]         = std::max(worst[1], std::abs(distance(x + surface.offset(t, w))));
        }
    return worst;
  }

  unsigned int n_smooth(const SmoothSurface &surface)
  {
    unsigned int n = 0;
    for (unsigned int t = 0; t < surface.mesh().triangles.size(); ++t)
      n += surface.patch(t).is_smooth;
    return n;
  }

  Point<3> on_sphere(const double s, const double t)
  {
    const Tensor<1, 3> d({s - .5, t - .5, 1.});
    return Point<3>(d / d.norm());
  }

  Point<3> on_cylinder(const double s, const double t)
  {
    return {std::cos(s), std::sin(s), t};
  }
} // namespace



TEST(SmoothSurface, IsExactOnSpheresAndCylinders)
{
  const auto sphere   = [](const Point<3> &x) { return x.norm() - 1.; };
  const auto cylinder = [](const Point<3> &x) { return std::hypot(x[0], x[1]) - 1.; };
  for (const unsigned int n : {5, 8, 16})
    {
      EXPECT_LT(heights(smooth(bent(n, .2, on_sphere)), sphere)[1], 1e-13);
      EXPECT_LT(heights(smooth(bent(n, .2, on_cylinder)), cylinder)[1], 1e-13);
      // Cells that are long beside the radius.
      EXPECT_LT(
          heights(smooth(bent(n, .2, [](const double s, const double t) { return on_cylinder(s, 20. * t); })),
                  cylinder)[1],
          1e-13);
    }
}



TEST(SmoothSurface, HasOrderThreeOnSmoothSurfaces)
{
  // A cubic graph, a cone and a torus.
  const auto on_graph = [](const double s, const double t) {
    return Point<3>(s, t, .3 * s * s * s - .2 * s * t * t);
  };
  const auto on_cone = [](const double s, const double t) {
    return Point<3>((1. + t) * std::cos(s), (1. + t) * std::sin(s), -t);
  };
  const auto on_torus = [](const double s, const double t) {
    return Point<3>((2. + std::cos(t)) * std::cos(.5 * s), (2. + std::cos(t)) * std::sin(.5 * s),
                    std::sin(t));
  };
  const auto graph = [](const Point<3> &x) {
    return x[2] - .3 * x[0] * x[0] * x[0] + .2 * x[0] * x[1] * x[1];
  };
  const auto cone  = [](const Point<3> &x) { return std::hypot(x[0], x[1]) - 1. + x[2]; };
  const auto torus = [](const Point<3> &x) { return std::hypot(std::hypot(x[0], x[1]) - 2., x[2]) - 1.; };
  using Distance   = std::function<double(const Point<3> &)>;
  for (const double jitter : {0., .2})
    for (const auto &[shape, distance] : std::initializer_list<std::pair<TestSurfaces::Shape, Distance>>{
             {on_graph, graph}, {on_cone, cone}, {on_torus, torus}})
      {
        std::vector<std::array<double, 2>> h;
        for (const unsigned int n : {8, 16, 32})
          h.push_back(heights(smooth(bent(n, jitter, shape)), distance));
        EXPECT_LT(h[2][1], .03 * h[2][0]);
        EXPECT_GT(std::log2(h[0][1] / h[2][1]) / 2., 2.6) << h[0][1] << ' ' << h[1][1] << ' ' << h[2][1];
      }
}



// Curvature that changes is not taken for a slope, neither in the normals nor between the corners; and the
// doubt is of the size of the error.
TEST(SmoothSurface, FreeSurfaces)
{
  using Function  = std::function<double(const Point<3> &)>;
  const auto near = [](const Function &f) {
    return [f](const Point<3> &x) {
      constexpr double step = 1e-5;
      Tensor<1, 3>     gradient;
      for (unsigned int k = 0; k < 3; ++k)
        {
          Point<3> before = x, behind = x;
          before[k] -= step;
          behind[k] += step;
          gradient[k] = (f(behind) - f(before)) / (2. * step);
        }
      return f(x) / gradient.norm();
    };
  };
  struct Case
  {
    TestSurfaces::Shape shape;
    Function            distance;
    /// Largest error relative to that of facets, in rows and not.
    std::array<double, 2> error;
  };
  const std::vector<Case> cases = {
      {[](const double s, const double t) {
         const Tensor<1, 3> d({s - .5, t - .3, .6});
         return Point<3>(5. * d[0] / d.norm(), 3. * d[1] / d.norm(), 2. * d[2] / d.norm());
       },
       near([](const Point<3> &x) {
         return std::sqrt(x[0] * x[0] / 25. + x[1] * x[1] / 9. + x[2] * x[2] / 4.) - 1.;
       }),
       {{.009, .007}}},
      {[](const double s, const double t) {
         return Point<3>(s, t, .1 * std::sin(4. * s) * std::cos(3. * t));
       },
       near([](const Point<3> &x) { return x[2] - .1 * std::sin(4. * x[0]) * std::cos(3. * x[1]); }),
       {{.06, .04}}},
      {[](const double s, const double t) {
         const double r = 1. + .15 * std::sin(3. * t);
         return Point<3>(r * std::cos(1.2 * s), r * std::sin(1.2 * s), t);
       },
       near([](const Point<3> &x) { return std::hypot(x[0], x[1]) - 1. - .15 * std::sin(3. * x[2]); }),
       {{.015, .015}}},
      {[](const double s, const double t) {
         return Point<3>(5. * std::cos(1.57 * s - .3), 3. * std::sin(1.57 * s - .3), 5. * t);
       },
       near([](const Point<3> &x) { return std::hypot(x[0] / 5., x[1] / 3.) - 1.; }),
       {{.035, .035}}}};
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (const unsigned int i : {0, 1})
      {
        const SmoothSurface surface      = smooth(bent(16, .2 * i, cases[c].shape));
        const auto [facets, patches]     = heights(surface, cases[c].distance);
        const SurfaceMesh &mesh          = surface.mesh();
        double             largest_doubt = 0.;
        EXPECT_LT(patches, cases[c].error[i] * facets) << c << ' ' << i;
        // Of the waves all but ends and crests; also where they are straight and their curvature changes
        // sign.
        EXPECT_GT(n_smooth(surface), .9 * mesh.triangles.size()) << c << ' ' << i;
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          {
            double error = 0.;
            for (const auto &w : samples)
              error =
                  std::max(error, std::abs(cases[c].distance(evaluate(mesh, t, w) + surface.offset(t, w))));
            // Where fits agree by chance, as one-sided ones at ends of curves, a doubt may be small.
            EXPECT_LT(error, 3. * surface.patch(t).doubt + .01 * facets) << c << ' ' << i << ' ' << t;
            largest_doubt = std::max(largest_doubt, surface.patch(t).doubt);
          }
        EXPECT_LT(largest_doubt, 8. * patches) << c << ' ' << i;
      }
}



// All around an ellipse, with vertices in rows and anywhere: cubics between the corners.
TEST(SmoothSurface, EllipticCylinders)
{
  constexpr unsigned int n_around = 64, n_layers = 8;
  // Away from the ends.
  const auto distance = [](const Point<3> &x) {
    if (std::abs(x[2] - .2 * n_layers) > .7)
      return 0.;
    const double f = std::hypot(x[0] / 5., x[1] / 3.);
    return (f - 1.) * f / std::hypot(x[0] / 25., x[1] / 9.);
  };
  for (const double jitter : {0., .2})
    {
      std::mt19937                           random(5);
      std::uniform_real_distribution<double> noise(-jitter, jitter);
      SurfaceMesh                            mesh;
      for (unsigned int j = 0; j <= n_layers; ++j)
        for (unsigned int i = 0; i < n_around; ++i)
          {
            const double inner = j > 0 && j < n_layers ? 1. : 0.,
                         angle = (i + inner * noise(random)) * 2. * M_PI / n_around;
            mesh.vertices.emplace_back(5. * std::cos(angle), 3. * std::sin(angle),
                                       .4 * (j + inner * noise(random)));
          }
      for (unsigned int j = 0; j < n_layers; ++j)
        for (unsigned int i = 0; i < n_around; ++i)
          {
            const unsigned int a = j * n_around + i, b = j * n_around + (i + 1) % n_around;
            mesh.triangles.push_back({{a, b, b + n_around}});
            mesh.triangles.push_back({{a, b + n_around, a + n_around}});
          }
      const auto [facets, patches] = heights(smooth(mesh), distance);
      EXPECT_LT(patches, (jitter > 0. ? .007 : .0015) * facets) << patches << ' ' << facets;
    }
}



// An ellipse extruded by one cell, to its ends: two places beside a vertex would not do.
TEST(SmoothSurface, EndsOfCurves)
{
  const TestSurfaces::FlatGrid grid = TestSurfaces::flat_grid(16, 1);
  SurfaceMesh                  mesh;
  for (const auto &[s, t] : grid.vertices)
    mesh.vertices.push_back({5. * std::cos(1.57 * s - .3), 3. * std::sin(1.57 * s - .3), .5 * t});
  mesh.triangles = grid.triangles;
  const auto [facets, patches] =
      heights(smooth(mesh), [](const Point<3> &x) { return (std::hypot(x[0] / 5., x[1] / 3.) - 1.) * 3.; });
  EXPECT_LT(patches, .02 * facets);
}



// Two rows of vertices: straight from row to row.
TEST(SmoothSurface, StripsOfOneCell)
{
  const TestSurfaces::FlatGrid grid = TestSurfaces::flat_grid(7, 1);
  SurfaceMesh                  mesh;
  for (const auto &[s, t] : grid.vertices)
    mesh.vertices.push_back(on_cylinder(s, .2 * t));
  mesh.triangles              = grid.triangles;
  const SmoothSurface surface = smooth(mesh);
  EXPECT_EQ(n_smooth(surface), mesh.triangles.size());
  EXPECT_LT(heights(surface, [](const Point<3> &x) { return std::hypot(x[0], x[1]) - 1.; })[1], 1e-13);
}



// Extruded curves (gear teeth, profiles): normals lie across the direction of extrusion, so that rims of two
// such surfaces in one plane stay in it, and how well the surface is known does not depend on how long it is.
TEST(SmoothSurface, ExtrudedCurves)
{
  for (const unsigned int n_layers : {1, 4})
    {
      std::array<double, 3> doubts;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double                 length = std::array<double, 3>{{.2, 1., 30.}}[i];
          const TestSurfaces::FlatGrid grid   = TestSurfaces::flat_grid(9, n_layers);
          SurfaceMesh                  mesh;
          for (const auto &[s, t] : grid.vertices)
            mesh.vertices.push_back({std::cos(s + .1 * s * s), .7 * std::sin(s + .1 * s * s), length * t});
          mesh.triangles              = grid.triangles;
          const SmoothSurface surface = smooth(mesh);
          EXPECT_EQ(n_smooth(surface), mesh.triangles.size()) << n_layers << ' ' << length;
          doubts[i] = 0.;
          for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
            {
              doubts[i] = std::max(doubts[i], surface.patch(t).doubt);
              for (const Tensor<1, 3> &normal : surface.patch(t).normals)
                EXPECT_LT(std::abs(normal[2]), 1e-15) << n_layers << ' ' << length;
            }
          const auto ellipse = [](const Point<3> &x) { return std::hypot(x[0], x[1] / .7) - 1.; };
          const auto [of_facets, of_patches] = heights(surface, ellipse);
          EXPECT_LT(of_patches, .1 * of_facets) << n_layers << ' ' << length;
        }
      EXPECT_NEAR(doubts[1], doubts[0], 1e-9 * doubts[0]) << n_layers;
      EXPECT_NEAR(doubts[2], doubts[0], 1e-9 * doubts[0]) << n_layers;
    }
}



// Files leave digits out: vertices beside each other along the axis, however far away, are the same point of
// the curve still.
TEST(SmoothSurface, ExtrudedCurvesOfFewDigits)
{
  const Tensor<1, 3> axis = Point<3>(1., 2., 3.) / std::sqrt(14.), u = Point<3>(2., -1., 0.) / std::sqrt(5.),
                     v = cross_product_3d(axis, u);
  std::mt19937                           random(3);
  std::uniform_real_distribution<double> number(-1., 1.);
  for (const unsigned int n_layers : {1, 3})
    for (const double length : {.3, 3., 30.})
      for (const double noise : {1e-12, 1e-9, 2e-7, 2e-6})
        {
          const TestSurfaces::FlatGrid grid = TestSurfaces::flat_grid(14, n_layers);
          SurfaceMesh                  mesh;
          for (const auto &[s, t] : grid.vertices)
            {
              Point<3> p(std::cos(1.5 * s) * u + std::sin(1.5 * s) * v + length * t * axis);
              for (unsigned int c = 0; c < 3; ++c)
                p[c] += noise * number(random);
              mesh.vertices.push_back(p);
            }
          mesh.triangles              = grid.triangles;
          const SmoothSurface surface = smooth(mesh);
          EXPECT_EQ(n_smooth(surface), mesh.triangles.size()) << n_layers << ' ' << length << ' ' << noise;
          for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
            {
              EXPECT_LT(surface.patch(t).doubt, 1e-9 + 100. * noise)
                  << n_layers << ' ' << length << ' ' << noise;
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const Tensor<1, 3> x      = mesh.vertices[mesh.triangles[t][i]] - Point<3>();
                  const Tensor<1, 3> radial = x - (x * axis) * axis;
                  EXPECT_LT(1. - std::abs(surface.patch(t).normals[i] * radial) / radial.norm(),
                            1e-9 + 1e3 * noise * noise)
                      << n_layers << ' ' << length << ' ' << noise;
                }
            }
        }
}



// Tapers, countersinks, seats of valves: normals are exact, also those at borders.
TEST(SmoothSurface, KnowsConesAndWhereTheyEnd)
{
  struct Case
  {
    double half_angle;
    /// At z = 0 a cylinder goes on, at less than the angle of a crease.
    bool has_shank;
  };
  for (const Case &one : {Case{5.5, false}, {45., false}, {75., false}, {5.5, true}})
    for (const unsigned int n : {8, 16})
      {
        const double      half = one.half_angle * M_PI / 180., sine = std::sin(half), cosine = std::cos(half);
        const SurfaceMesh mesh      = bent(n, .15, [&](const double s, const double t) {
          const double place = one.has_shank ? 1.5 * t - .75 : .75 * (t - 1.),
                       along = std::abs(place) < .25 / n ? 0. : place, r = 1. + sine * std::min(0., along);
          return Point<3>(r * std::cos(1.5 * s), r * std::sin(1.5 * s), along < 0. ? cosine * along : along);
        });
        const SmoothSurface surface = smooth(mesh);
        EXPECT_EQ(n_smooth(surface), mesh.triangles.size());
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          {
            double highest = -1.;
            for (const unsigned int v : mesh.triangles[t])
              highest = std::max(highest, mesh.vertices[v][2]);
            for (const Tensor<1, 3> &normal : surface.patch(t).normals)
              EXPECT_NEAR(std::abs(normal[2]), highest < 1e-10 ? sine : 0., 1e-4)
                  << one.half_angle << ' ' << one.has_shank << ' ' << n;
          }
      }
}



// At the apex of a cone curvature has no bound: what is known farther out is not taken there, nor the sphere
// on which it lies with the vertices around it.
TEST(SmoothSurface, ApexOfACone)
{
  for (const double half_angle : {30., 60., 75.})
    {
      constexpr unsigned int n_around = 16, n_rings = 6;
      const double sine = std::sin(half_angle * M_PI / 180.), cosine = std::cos(half_angle * M_PI / 180.);
      SurfaceMesh  mesh;
      mesh.vertices.emplace_back();
      for (unsigned int ring = 1; ring <= n_rings; ++ring)
        for (unsigned int i = 0; i < n_around; ++i)
          {
            const double angle = 2. * M_PI * (i + .5 * (ring % 2)) / n_around;
            mesh.vertices.emplace_back(ring * sine * std::cos(angle), ring * sine * std::sin(angle),
                                       ring * cosine);
          }
      const auto at = [](const unsigned int ring, const unsigned int i) {
        return 1 + (ring - 1) * n_around + i % n_around;
      };
      for (unsigned int i = 0; i < n_around; ++i)
        {
          mesh.triangles.push_back({{0, at(1, i + 1), at(1, i)}});
          for (unsigned int ring = 1; ring < n_rings; ++ring)
            {
              const unsigned int shift = ring % 2;
              mesh.triangles.push_back({{at(ring, i), at(ring, i + 1), at(ring + 1, i + shift)}});
              mesh.triangles.push_back({{at(ring, i + 1 - shift), at(ring + 1, i + 1), at(ring + 1, i)}});
            }
        }
      const SmoothSurface surface = smooth(mesh);
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        {
          const SmoothSurface::Patch &patch      = surface.patch(t);
          const bool                  is_at_apex = t % (2 * n_rings - 1) == 0;
          EXPECT_EQ(patch.is_smooth, !is_at_apex) << half_angle << ' ' << t;
          double error = 0.;
          for (const auto &w : samples)
            {
              const Point<3> x = evaluate(mesh, t, w) + surface.offset(t, w);
              error            = std::max(error, std::abs(std::hypot(x[0], x[1]) * cosine - x[2] * sine));
            }
          EXPECT_LE(error, patch.doubt + 1e-10) << half_angle << ' ' << t;
          EXPECT_LT(patch.doubt, is_at_apex ? .3 : 2e-3) << half_angle << ' ' << t;
        }
    }
}



// A shaft with a fillet at its end, 3 faces and more around that: a part of a torus between a cylinder and a
// plane.
TEST(SmoothSurface, KnowsToriAndWhereTheyEnd)
{
  constexpr double radius = .4, shaft = 2.;
  for (const unsigned int n_chords : {3, 4, 6})
    for (const double jitter : {0., .1})
      {
        constexpr unsigned int n       = 14;
        const SurfaceMesh      mesh    = bent(n, jitter, [&](const double s, const double t) {
          // Rows of vertices: n_chords over the fillet, the others on the cylinder and the plane; those
          // between them stay in place.
          const double place = n * t - 4., nearest = std::round(place),
                       row   = nearest == 0. || nearest == n_chords ? nearest : place,
                       angle = .5 * M_PI * std::max(0., std::min(1., row / n_chords)),
                       r = shaft - radius * (1. - std::cos(angle)) - .1 * std::max(0., row - n_chords);
          return Point<3>(r * std::cos(s), r * std::sin(s),
                          .2 * std::min(0., row) + radius * std::sin(angle));
        });
        const SmoothSurface    surface = smooth(mesh);
        EXPECT_EQ(std::count(surface.creases().begin(), surface.creases().end(), true), 0);
        for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
          {
            EXPECT_TRUE(surface.patch(t).is_smooth || surface.patch(t).is_flat) << n_chords;
            for (unsigned int i = 0; i < 3; ++i)
              {
                const Point<3>    &x = mesh.vertices[mesh.triangles[t][i]];
                const double       r = std::hypot(x[0], x[1]), outwards = std::max(0., r - (shaft - radius));
                const Tensor<1, 3> normal = Tensor<1, 3>({x[0] / r * outwards, x[1] / r * outwards, 0.}) +
                                            Tensor<1, 3>({0., 0., outwards > 0. ? std::max(0., x[2]) : 1.});
                EXPECT_NEAR(std::abs(surface.patch(t).normals[i] * normal) / normal.norm(), 1., 1e-9)
                    << n_chords << ' ' << jitter << " at " << x;
              }
          }
      }
}



// Where a cylinder goes on as a sphere, or as two planes, curvature jumps: a surface fitted to both is
// neither.
TEST(SmoothSurface, IsExactOnBothSidesOfSeams)
{
  // A quarter of a capsule, without its pole.
  for (const unsigned int n : {6, 8, 16})
    {
      const SmoothSurface surface = smooth(bent(n, 0., [](const double s, const double t) {
        const double angle = .5 * M_PI * s, height = 2. * t - 1., latitude = 1.3 * std::max(0., height);
        return Point<3>(std::cos(latitude) * std::cos(angle), std::cos(latitude) * std::sin(angle),
                        std::min(0., height) + std::sin(latitude));
      }));
      EXPECT_EQ(n_smooth(surface), surface.mesh().triangles.size()) << n;
      const auto capsule = [](const Point<3> &x) { return std::hypot(x[0], x[1], std::max(0., x[2])) - 1.; };
      EXPECT_LT(heights(surface, capsule)[1], 1e-10) << n;
      for (unsigned int t = 0; t < surface.mesh().triangles.size(); ++t)
        EXPECT_LT(surface.patch(t).doubt, 1e-4) << n;
    }
}



// A right angle with a fillet of two faces or more: edges of 45 degrees are chords of it.
TEST(SmoothSurface, FilletsOfFewFaces)
{
  for (const unsigned int n_chords : {2, 3, 4})
    {
      constexpr unsigned int n       = 12;
      const SmoothSurface    surface = smooth(bent(n, 0., [&](const double s, const double t) {
        // Rows of vertices: n_chords over the fillet, the others on the planes before and after it.
        const double row = n * t - 4., angle = .5 * M_PI * std::max(0., std::min(1., row / n_chords));
        return Point<3>(std::sin(angle) + std::min(0., row), 2. * s,
                        std::cos(angle) - std::max(0., row - n_chords));
      }));
      for (const bool crease : surface.creases())
        EXPECT_FALSE(crease);
      const auto rounded = [](const Point<3> &x) {
        return x[0] < 0. ? x[2] - 1. : x[2] < 0. ? x[0] - 1. : std::hypot(x[0], x[2]) - 1.;
      };
      EXPECT_LT(heights(surface, rounded)[1], 1e-10) << n_chords;
      for (unsigned int t = 0; t < surface.mesh().triangles.size(); ++t)
        EXPECT_LT(surface.patch(t).doubt, 1e-10) << n_chords;
    }
}



// A fillet of few faces beside the flat part that it touches does not dip into it.
TEST(SmoothSurface, FilletsTouchFlatParts)
{
  for (const unsigned int n : {8, 12, 18})
    {
      // Elliptic; one column of vertices lies where they touch, the others anywhere.
      const SurfaceMesh   mesh    = bent(n, .15, [n](const double s, const double t) {
        const double x = std::abs(4. * s - 2.) < 2. / n ? 0. : 4. * s - 2., angle = std::max(0., x);
        return Point<3>(x < 0. ? x : std::sin(angle), 2. * t, .6 - .6 * std::cos(angle));
      });
      const SmoothSurface surface = smooth(mesh);
      double              lowest  = 0.;
      EXPECT_GT(n_smooth(surface), 0u) << n;
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        for (const auto &w : samples)
          lowest = std::min(lowest, (evaluate(mesh, t, w) + surface.offset(t, w))[2]);
      EXPECT_GT(lowest, -1e-10) << n;
    }
}



// A flat cone beside the flat part that it ends at stays a cone.
TEST(SmoothSurface, FlatConesDoNotTouchFlatParts)
{
  const double        slope   = std::tan(6. * dealii::numbers::PI / 180.);
  const SurfaceMesh   mesh    = bent(12, 0., [slope](const double s, const double t) {
    const double r = 2. + s, angle = .8 * t;
    return Point<3>(r * std::cos(angle), r * std::sin(angle), slope * std::max(0., s - .5));
  });
  const SmoothSurface surface = smooth(mesh);
  for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned int i = 0; i < 3; ++i)
      {
        double highest = 0.;
        for (const unsigned int v : mesh.triangles[t])
          highest = std::max(highest, mesh.vertices[v][2]);
        const double expected = highest > 1e-10 ? 1. / std::hypot(1., slope) : 1.;
        EXPECT_NEAR(std::abs(surface.patch(t).normals[i][2]), expected, 1e-3)
            << mesh.vertices[mesh.triangles[t][i]];
      }
}



TEST(SmoothSurface, KnowsHowWellItKnows)
{
  for (const auto &shape : {TestSurfaces::Shape(on_sphere), TestSurfaces::Shape(on_cylinder)})
    for (const unsigned int n : {6, 12, 24})
      {
        const SmoothSurface surface = smooth(bent(n, .2, shape));
        EXPECT_EQ(n_smooth(surface), surface.mesh().triangles.size()) << n;
      }
  // Noise as large as the heights of the facets.
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> noise(-1., 1.);
  const unsigned int                     n     = 16;
  const double                           h     = 1. / n;
  const SmoothSurface                    rough = smooth(bent(n, .2, [&](const double s, const double t) {
    return on_sphere(s, t) + .5 * h * h * noise(random) * Tensor<1, 3>(on_sphere(s, t));
  }));
  EXPECT_LT(n_smooth(rough), .25 * rough.mesh().triangles.size());
  // The doubt is of the size of what is really wrong.
  for (unsigned int t = 0; t < rough.mesh().triangles.size(); ++t)
    EXPECT_LT(rough.patch(t).doubt, 3. * h * h);
}



// Where facets stand for a rough part, the smooth part beside it goes down to them.
TEST(SmoothSurface, BelievedPartsGoDownToFacets)
{
  std::mt19937                           random(5);
  std::uniform_real_distribution<double> noise(-1., 1.);
  constexpr unsigned int                 n       = 16;
  const SmoothSurface                    surface = smooth(bent(n, .2, [&](const double s, const double t) {
    const Point<3> x = on_sphere(s, t);
    return s < .5 ? x : x + .5 / (n * n) * noise(random) * Tensor<1, 3>(x);
  }));
  const SurfaceTopology                  topology(surface.mesh().triangles, surface.mesh().vertices.size());
  unsigned int                           n_ends = 0, n_inside = 0;
  for (unsigned int e = 0; e < topology.edges.size(); ++e)
    if (!topology.is_border(e))
      {
        std::array<Tensor<1, 3>, 2> offsets;
        for (unsigned int side = 0; side < 2; ++side)
          {
            const unsigned int    t                     = topology.edge_triangles[e][side];
            std::array<double, 3> middle                = {{.5, .5, .5}};
            middle[(topology.local_edge(t, e) + 2) % 3] = 0.;
            offsets[side]                               = surface.believed_offset(t, middle);
          }
        EXPECT_LT((offsets[0] - offsets[1]).norm(), 1e-14) << e;
        const auto &[one, other] = topology.edge_triangles[e];
        if (surface.patch(one).is_smooth != surface.patch(other).is_smooth)
          ++n_ends;
        else if (surface.patch(one).is_smooth && offsets[0].norm() > .1 / (8 * n * n))
          ++n_inside;
      }
  EXPECT_GT(n_ends, n);
  EXPECT_GT(n_inside, 8 * n);
}



TEST(SmoothSurface, FlatStaysFlatAndCreasesStaySharp)
{
  // A quarter of a cylinder that goes over into a plane without an angle, and a plane at a right angle to
  // that.
  const unsigned int  n = 12;
  const double        r = .5, turn = r * dealii::numbers::PI / 2.;
  const SmoothSurface roof   = smooth(bent(3 * n, 0., [&](const double s, const double t) {
    const double way = 3. * s;
    if (way <= 1.)
      return Point<3>(r * std::sin(way * turn / r), t, r * std::cos(way * turn / r) - r);
    if (way <= 2.)
      return Point<3>(r, t, -r - (way - 1.));
    return Point<3>(r + (way - 2.), t, -r - 1.);
  }));
  unsigned int        n_flat = 0;
  for (unsigned int t = 0; t < roof.mesh().triangles.size(); ++t)
    {
      Point<3>   centre = evaluate(roof.mesh(), t, samples[0]);
      const bool plane  = centre[2] < -r;
      n_flat += roof.patch(t).is_flat;
      EXPECT_EQ(roof.patch(t).is_flat, plane) << centre;
      if (plane)
        {
          for (const auto &w : samples)
            EXPECT_EQ(roof.offset(t, w).norm(), 0.);
        }
      else
        {
          EXPECT_TRUE(roof.patch(t).is_smooth) << centre;
          for (const auto &w : samples)
            {
              const Point<3> x = evaluate(roof.mesh(), t, w) + roof.offset(t, w);
              EXPECT_NEAR(std::hypot(x[0], x[2] + r), r, .02 * turn * turn / (n * n * 8. * r)) << centre;
            }
        }
    }
  EXPECT_EQ(n_flat, 2 * 2 * n * 3 * n);
}



TEST(SmoothSurface, DoesNotDependOnUnitsAndPlace)
{
  const auto surface = smooth(bent(10, .2, on_sphere));
  for (const double scale : {1e-6, 1e6})
    {
      const auto other = smooth(bent(10, .2, [&](const double s, const double t) {
        const Point<3> x = on_sphere(s, t);
        return Point<3>(scale * x[1], scale * (x[2] + 3.), scale * x[0]);
      }));
      for (unsigned int t = 0; t < surface.mesh().triangles.size(); ++t)
        {
          EXPECT_EQ(surface.patch(t).is_smooth, other.patch(t).is_smooth);
          EXPECT_NEAR(other.offset(t, samples[0]).norm() / scale, surface.offset(t, samples[0]).norm(),
                      1e-10);
        }
    }
}
