// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/boundary_depth.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace Signorini;
  using dealii::Point;

  /// A closed surface of quadrilaterals, each in two triangles.
  struct Quads
  {
    SurfaceMesh               mesh;
    std::vector<unsigned int> faces;

    void add(const unsigned int a, const unsigned int b, const unsigned int c, const unsigned int d)
    {
      const unsigned int face = faces.empty() ? 0 : faces.back() + 1;
      mesh.triangles.push_back({{a, b, c}});
      mesh.triangles.push_back({{a, c, d}});
      faces.insert(faces.end(), 2, face);
    }
  };

  /// [0,1]³.
  Quads cube()
  {
    Quads quads;
    for (unsigned int i = 0; i < 8; ++i)
      quads.mesh.vertices.emplace_back(i % 2, i / 2 % 2, i / 4);
    quads.add(0, 2, 3, 1);
    quads.add(4, 5, 7, 6);
    quads.add(0, 1, 5, 4);
    quads.add(2, 6, 7, 3);
    quads.add(0, 4, 6, 2);
    quads.add(1, 3, 7, 5);
    return quads;
  }

  /// A prism with n sides around the z axis, of radius 1, from z = 0 to 1, with a hole of radius .5.
  Quads ring(const unsigned int n)
  {
    Quads quads;
    for (unsigned int i = 0; i < n; ++i)
      for (const double radius : {.5, 1.})
        for (const double z : {0., 1.})
          quads.mesh.vertices.emplace_back(radius * std::cos(2. * dealii::numbers::PI * i / n),
                                           radius * std::sin(2. * dealii::numbers::PI * i / n), z);
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int a = 4 * i, b = 4 * ((i + 1) % n);
        quads.add(a, a + 1, b + 1, b);
        quads.add(a + 2, b + 2, b + 3, a + 3);
        quads.add(a, b, b + 2, a + 2);
        quads.add(a + 1, a + 3, b + 3, b + 1);
      }
    return quads;
  }

  TEST(BoundaryDepth, IsThatInside)
  {
    const Quads         quads = cube();
    const BoundaryDepth depth(quads.mesh, quads.faces);
    // Meshes are taken to be exact to a thousandth of a face.
    EXPECT_NEAR(depth({.5, .4, .1}, 1.), .1, .001 + 1e-12);
    EXPECT_NEAR(depth({.02, .5, .01}, 1.), .01, .001 + 1e-12);
    EXPECT_EQ(depth({.5, .5, .0009}, 1.), 0.);
    for (const Point<3> &outside :
         {Point<3>(.5, .5, -.1), Point<3>(-.1, -.1, .5), Point<3>(1.1, 1.2, 1.3), Point<3>(.5, 1.2, 1.01)})
      EXPECT_EQ(depth(outside, 1.), 0.);
    EXPECT_EQ(depth({.5, .5, .4}, .3), 0.) << "farther than what is known";
  }

  /// Beside a groove the nearest place of a point outside is an edge whose facets both look away from it.
  TEST(BoundaryDepth, IsZeroInAHole)
  {
    const Quads         quads = ring(8);
    const BoundaryDepth depth(quads.mesh, quads.faces);
    for (unsigned int i = 0; i < 40; ++i)
      {
        const double angle = 2. * dealii::numbers::PI * i / 40;
        EXPECT_EQ(depth({.4 * std::cos(angle), .4 * std::sin(angle), .5}, 1.), 0.) << i;
        EXPECT_EQ(depth({1.1 * std::cos(angle), 1.1 * std::sin(angle), .5}, 1.), 0.) << i;
      }
    EXPECT_GT(depth({.75, 0., .1}, 1.), .09) << "flat there";
  }

  /// A pin that fits lies in the chords of the hole, and is no less than there in the body if it is too
  /// thick.
  TEST(BoundaryDepth, FacetsOfCurvedSurfacesMayBeWrong)
  {
    for (const unsigned int n : {8, 12, 24, 60})
      {
        const Quads         quads = ring(n);
        const BoundaryDepth depth(quads.mesh, quads.faces);
        const double        pi = dealii::numbers::PI, sagitta = .5 * (1. - std::cos(pi / n));
        const auto          at = [&](const double radius) {
          return depth({radius * std::cos(pi / n), radius * std::sin(pi / n), .5}, 1.);
        };
        EXPECT_EQ(at(.5), 0.) << n;
        EXPECT_EQ(at(.5 + sagitta), 0.) << n;
        EXPECT_EQ(at(1.), 0.) << n;
        EXPECT_GT(at(.5 + 5. * sagitta), .3 * sagitta) << n;
      }
  }

  TEST(BoundaryDepth, IsZeroWhereTheBoundaryEnds)
  {
    Quads quads = cube();
    quads.mesh.triangles.resize(2);
    quads.faces.resize(2);
    const BoundaryDepth depth(quads.mesh, quads.faces);
    EXPECT_GT(depth({.5, .4, .1}, 1.), 0.);
    EXPECT_EQ(depth({.5, -.1, .1}, 1.), 0.);
    const BoundaryDepth nothing(SurfaceMesh(), {});
    EXPECT_EQ(nothing({.5, .5, .5}, 1.), 0.);
  }
} // namespace
