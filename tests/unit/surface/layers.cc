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



// A second mortar plate behind the first, larger, smaller or of the same size: the layer in front is the
// partner, whole, and the one behind is left out.
TEST(Layers, SecondMortarPlateBehindTheFirst)
{
  for (const double size : {.6, 2., 3.1})
    for (const double front_size : {2., 2.7})
      for (const double angle : {0., .4})
        {
          const auto plate = [&](const unsigned int n, const double s, const double z, const bool up) {
            SurfaceMesh mesh = rectangle(n, -s / 2., s / 2., -s / 2., s / 2., z, up);
            for (Point<3> &p : mesh.vertices)
              p = Point<3>(std::cos(angle) * p[0] - std::sin(angle) * p[2], p[1],
                           std::sin(angle) * p[0] + std::cos(angle) * p[2]);
            mesh.compute_vertex_normals();
            return mesh;
          };
          const SurfaceMesh    plane = plate(5, 2., 0., true), front = plate(3, front_size, .1, false);
          const ContactMapping alone(plane, front);
          for (const SurfaceMesh &both :
               {join(front, plate(4, size, 1., false)),
                join(join(front, plate(4, size, 1., false)), plate(7, size, 1.3, false))})
            {
              const ContactMapping mapping(plane, both);
              EXPECT_EQ(violated_invariant(plane, both, mapping, true), "") << size << ' ' << front_size;
              EXPECT_EQ(describe_errors(mapping.report()), "") << size << ' ' << front_size;
              EXPECT_EQ(mapping.polygon_triangles, alone.polygon_triangles) << size << ' ' << front_size;
              EXPECT_NEAR(mapping.report().area_covered, 4., 1e-12);
              EXPECT_GT(count_unmapped(mapping.report()).at("behind another layer"), 0u);
            }
        }
}



// Two bodies in a stack with two others between them: each layer has its nearest partner, whichever side it
// lies on.
TEST(Layers, PlatesInTurn)
{
  const SurfaceMesh low       = rectangle(5, 0., 2., 0., 2., 0., true),
                    high      = rectangle(4, 0., 2., 0., 2., 1., true),
                    over_low  = rectangle(3, 0., 2., 0., 2., .1, false),
                    over_high = rectangle(6, 0., 2., 0., 2., 1.1, false);
  for (const double penetration : {0., .2})
    {
      SurfaceMesh mortar = join(over_low, over_high);
      for (Point<3> &p : mortar.vertices)
        p[2] -= penetration;
      const SurfaceMesh    nonmortar = join(low, high);
      const ContactMapping mapping(nonmortar, mortar);
      EXPECT_EQ(violated_invariant(nonmortar, mortar, mapping, true), "");
      EXPECT_EQ(describe_errors(mapping.report()), "");
      const MappingQuality quality = assess_mapping(mapping, nonmortar, mortar);
      EXPECT_NEAR(quality.min_gap, .1 - penetration, 1e-12);
      EXPECT_NEAR(quality.max_gap, .1 - penetration, 1e-12);
    }
}



// Parts of the nonmortar surface see the same layers as the whole.
TEST(Layers, PartsSeeTheSameLayers)
{
  const SurfaceMesh plane  = rectangle(8, 0., 2., 0., 2., 0., true),
                    mortar = join(rectangle(3, -.1, 2.2, -.1, 2.2, .1, false),
                                  rectangle(5, -1., 3., -1., 3., .7, false));
  const ContactMapping                               whole(plane, mortar);
  std::vector<std::pair<unsigned int, unsigned int>> pairs;
  for (unsigned int p = 0; p < 4; ++p)
    {
      const ContactMapping part(plane, mortar, [&](const unsigned int t) { return t / 32 == p; });
      pairs.insert(pairs.end(), part.polygon_triangles.begin(), part.polygon_triangles.end());
    }
  EXPECT_EQ(pairs, whole.polygon_triangles);
}



// The mortar side folds back over itself.
TEST(Layers, FoldedMortarSurfaceAboveAPlate)
{
  const Shape fold = [](const double s, const double y) {
    const double turn = dealii::numbers::PI, way = s * (6. + 2. * turn) - 1.;
    if (way < 2.)
      return Point<3>(way, y, .1);
    if (way < 2. + turn)
      return Point<3>(2. + std::sin(way - 2.), y, 1.1 - std::cos(way - 2.));
    if (way < 4. + turn)
      return Point<3>(4. + turn - way, y, 2.1);
    if (way < 4. + 2. * turn)
      return Point<3>(-std::sin(way - 4. - turn), y, 3.1 - std::cos(way - 4. - turn));
    return Point<3>(way - 4. - 2. * turn, y, 4.1);
  };
  const SurfaceMesh    plate  = rectangle(4, 0., 1.5, .1, .9, 0., true);
  const SurfaceMesh    mortar = in_space(flat_grid(120, 3), fold, false);
  const ContactMapping mapping(plate, mortar);
  EXPECT_EQ(violated_invariant(plate, mortar, mapping, true), "");
  EXPECT_EQ(describe_errors(mapping.report()), "");
  EXPECT_NEAR(assess_mapping(mapping, plate, mortar).max_gap, .1, 1e-12);
}



// Where the layer in front ends over the middle of the other one, cells of that one lie under both: that is
// said.
TEST(Layers, MortarLayerThatEndsInFrontOfAnotherOneIsAnError)
{
  const SurfaceMesh front  = rectangle(3, 0., 1.1, 0., 2., .1, false),
                    behind = rectangle(4, 0., 2., 0., 2., 1., false),
                    plate  = rectangle(5, 0., 2., 0., 2., 0., true);
  const ContactMapping both(plate, join(front, behind)), once(plate, front);
  EXPECT_EQ(describe_errors(once.report()), "");
  EXPECT_NE(describe_errors(both.report()), "");
}
