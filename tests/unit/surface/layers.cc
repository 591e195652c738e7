// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/mapping_quality.h>

using namespace TestSurfaces;

namespace
{
  SurfaceMesh rectangle(const unsigned int n, const double x0, const double x1, const double y0,
                        const double y1, const double z, const bool up)
  {
    return grid(
        n,
        [=](const double x, const double y) { return Point<3>(x0 + x * (x1 - x0), y0 + y * (y1 - y0), z); },
        up);
  }

  SurfaceMesh join(SurfaceMesh a, const SurfaceMesh &b)
  {
    const auto n = static_cast<unsigned int>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto &t : b.triangles)
      a.triangles.push_back({{t[0] + n, t[1] + n, t[2] + n}});
    a.compute_vertex_normals();
    return a;
  }
} // namespace



// A piece that lies much farther away than the rest, between the vertices of the other surface: only edges
// over its border find it.
TEST(Layers, FarDetachedPatch)
{
  for (const double distance : {.3, 3., 300.})
    for (const double shift : {0., .13, .21})
      {
        const double      x = 7.1 + shift, y = 4.2 + .5 * shift;
        const SurfaceMesh near = rectangle(5, 1., 6., 1., 8., .1, true),
                          far = rectangle(3, x, x + .55, y, y + .45, -distance, true), both = join(near, far),
                          plane = rectangle(10, 0., 10., 0., 10., .2, false);
        const ContactMapping mapping(both, plane), alone(far, plane), beside(near, plane);
        EXPECT_EQ(violated_invariant(both, plane, mapping, true), "") << distance << ' ' << shift;
        EXPECT_EQ(mapping.report().n_pairs, alone.report().n_pairs + beside.report().n_pairs);
        // The other way round: every side may be the mortar side.
        const SurfaceMesh    from = join(rectangle(5, 1., 6., 1., 8., .1, false),
                                         rectangle(3, x, x + .55, y, y + .45, -distance, false));
        const SurfaceMesh    onto = rectangle(10, 0., 10., 0., 10., -400., true);
        const ContactMapping turned(onto, from);
        EXPECT_NEAR(turned.report().area_covered, 35. + .55 * .45, 1e-11 * 100.);
        EXPECT_EQ(violated_invariant(onto, from, turned, false), "") << distance << ' ' << shift;
      }
}



// Oblique and spread normals: the mortar side is a cap, the far piece lies under no vertex of it.
TEST(Layers, FarPatchUnderACap)
{
  const SurfaceMesh mortar = grid(
      4,
      [](const double x, const double y) {
        const dealii::Tensor<1, 3> direction = Point<3>(x - .5, y - .5, .6);
        return Point<3>(direction / direction.norm());
      },
      true);
  SurfaceMesh outside;
  // Triangles around a far sphere, each of them seen from the cap, with radii that differ by four orders.
  double area = 0.;
  for (const double radius : {1.1, 30., 1e4})
    {
      const double      x     = radius < 2. ? .22 : radius < 100. ? .55 : .78;
      const SurfaceMesh piece = grid(
          2,
          [=](const double u, const double v) {
            const dealii::Tensor<1, 3> direction = Point<3>(x + .05 * u - .5, .3 + .07 * v - .5, .6);
            return Point<3>(radius / direction.norm() * direction);
          },
          false);
      area += area_of(piece);
      outside = outside.vertices.empty() ? piece : join(outside, piece);
    }
  const ContactMapping mapping(outside, mortar);
  EXPECT_EQ(violated_invariant(outside, mortar, mapping, true), "");
  EXPECT_NEAR(mapping.report().area_covered / area, 1., 1e-12);
}



// Two nonmortar plates one above the other: the mortar side meets the nearer one, whole, and the farther one
// not at all where the nearer one is.
TEST(Layers, TwoPlatesBelowOne)
{
  for (const unsigned int n : {3u, 4u, 7u})
    {
      const SurfaceMesh near = rectangle(n, 0., 2., 0., 2., 0., true),
                        far = rectangle(5, 0., 2., 0., 2., -1., true), both = join(near, far);
      const SurfaceMesh    plate = rectangle(4, 0., 2., 0., 2., .1, false);
      const ContactMapping mapping(both, plate), alone(near, plate);
      EXPECT_EQ(violated_invariant(both, plate, mapping, false), "");
      EXPECT_NEAR(mapping.report().area_covered, 4., 1e-12);
      EXPECT_EQ(mapping.report().n_pairs, alone.report().n_pairs);
      for (const auto &[t, m] : mapping.polygon_triangles)
        EXPECT_LT(t, near.triangles.size());
    }
}



// The sheets of a folded strip lie over each other, each with a partner of its own beside it.
TEST(Layers, FoldedSurface)
{
  // A strip in the form of an S: along x, round a half circle and back. The other one follows it at a
  // distance.
  const auto strip = [](const double offset, const bool up, const unsigned int n) {
    const Shape shape = [offset](const double s, const double y) {
      const double length = 3., turn = dealii::numbers::PI, way = s * (2. * length + turn);
      if (way < length)
        return Point<3>(way, y, offset);
      if (way < length + turn)
        {
          const double angle = way - length, r = 1. - offset;
          return Point<3>(length + r * std::sin(angle), y, 1. - r * std::cos(angle));
        }
      return Point<3>(length - (way - length - turn), y, 2. - offset);
    };
    return in_space(flat_grid(n, 3), shape, up);
  };
  for (const unsigned int n : {40u, 61u})
    {
      const SurfaceMesh    lower = strip(0., true, 50), upper = strip(.05, false, n);
      const ContactMapping mapping(lower, upper);
      EXPECT_EQ(violated_invariant(lower, upper, mapping, true), "") << n;
      const MappingQuality quality = assess_mapping(mapping, lower, upper);
      EXPECT_GT(quality.min_gap, .03) << n;
      EXPECT_LT(quality.max_gap, .07) << n;
    }
}



// Two mortar plates above one nonmortar plate both count: that is said.
TEST(Layers, TwoMortarPlatesAreAnError)
{
  const SurfaceMesh upper = rectangle(3, 0., 2., 0., 2., .1, false),
                    top   = rectangle(4, 0., 2., 0., 2., 1., false),
                    plate = rectangle(5, 0., 2., 0., 2., 0., true);
  const ContactMapping twice(plate, join(upper, top)), once(plate, upper);
  EXPECT_EQ(describe_errors(once.report()), "");
  EXPECT_NE(describe_errors(twice.report()), "");
}
