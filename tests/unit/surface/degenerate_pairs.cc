// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

using namespace TestSurfaces;

namespace
{
  /// Removes triangles whose centre fulfils a condition (and leaves vertices without triangles behind).
  template <typename F>
  SurfaceMesh without(SurfaceMesh mesh, const F &condition)
  {
    std::vector<std::array<unsigned int, 3>> kept;
    for (const auto &t : mesh.triangles)
      if (!condition((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.))
        kept.push_back(t);
    mesh.triangles = kept;
    mesh.compute_vertex_normals();
    return mesh;
  }

  Shape shifted(const Shape &shape, const double dx, const double dy, const double dz = 0.)
  {
    return [=](const double x, const double y) { return shape(x, y) + Point<3>(dx, dy, dz); };
  }

  /// The rectangle [x0, x1] x [y0, y1].
  Shape rectangle(const double x0, const double x1, const double y0, const double y1, const double z = 0.)
  {
    return
        [=](const double x, const double y) { return Point<3>(x0 + x * (x1 - x0), y0 + y * (y1 - y0), z); };
  }

  void expect_area(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar, const double area)
  {
    const ContactMapping mapping(nonmortar, mortar);
    EXPECT_EQ(violated_invariant(nonmortar, mortar, mapping, false), "");
    EXPECT_NEAR(mapping.report().area_covered, area, 1e-12 * std::max(1., area));
  }
} // namespace



TEST(DegeneratePairs, IdenticalMeshes)
{
  for (const Shape &shape : {Shape(flat), Shape(saddle), Shape(wave)})
    for (const unsigned int n : {1u, 2u, 7u})
      {
        const SurfaceMesh    a = grid(n, shape, true, .2, n), b = grid(n, shape, false, .2, n);
        const ContactMapping mapping(a, b);
        EXPECT_EQ(violated_invariant(a, b, mapping, true), "");
        EXPECT_EQ(mapping.report().n_pairs, a.triangles.size());
      }
}

TEST(DegeneratePairs, ParallelDiagonalsOfNestedGrids)
{
  for (const unsigned int n : {1u, 2u, 4u})
    for (const unsigned int m : {1u, 2u, 4u, 8u, 12u})
      {
        const SurfaceMesh a = in_space(flat_grid(n, n, 0., 0, Diagonals::parallel), flat, true),
                          b = in_space(flat_grid(m, m, 0., 0, Diagonals::parallel), flat, false);
        expect_full_cover(a, b);
      }
}

TEST(DegeneratePairs, CrossedDiagonals)
{
  for (const unsigned int n : {1u, 2u, 4u})
    expect_full_cover(grid(n, flat, true),
                      in_space(flat_grid(n, n, 0., 0, Diagonals::parallel), flat, false));
}

TEST(DegeneratePairs, MortarVerticesOnNonmortarEdges)
{
  // Half a cell to the side: every mortar vertex lies in the middle of an edge.
  const auto a = flat_grid(6, 6);
  expect_full_cover(in_space(a, rectangle(0., 6., 0., 6.), true),
                    in_space(flat_grid(8, 8), rectangle(-1.5, 6.5, -1., 7.), false));
  expect_full_cover(
      in_space(a, rectangle(0., 6., 0., 6.), true),
      in_space(flat_grid(8, 8, 0., 0, Diagonals::parallel), rectangle(-1., 7., -1.5, 6.5), false));
  // On diagonals.
  expect_full_cover(in_space(a, rectangle(0., 6., 0., 6.), true),
                    in_space(flat_grid(8, 8), rectangle(-1.5, 6.5, -1.5, 6.5), false));
}

TEST(DegeneratePairs, NonmortarVerticesOnMortarEdges)
{
  for (const unsigned int n : {3u, 4u, 5u})
    expect_full_cover(in_space(flat_grid(2 * n, 3 * n), flat, true),
                      in_space(flat_grid(n, n, 0., 0, Diagonals::parallel), flat, false));
}

TEST(DegeneratePairs, VerticesOnVertices)
{
  // Every second vertex of the finer surface lies on one of the coarser, the others on edges.
  expect_full_cover(grid(8, flat, true), grid(4, flat, false));
  expect_full_cover(grid(4, flat, true), grid(8, flat, false));
  expect_full_cover(grid(8, saddle, true), grid(4, stretched(flat), false));
}

TEST(DegeneratePairs, OverlappingCollinearEdges)
{
  expect_full_cover(in_space(flat_grid(3, 1), flat, true), in_space(flat_grid(5, 1), flat, false));
  expect_full_cover(in_space(flat_grid(1, 7), flat, true), in_space(flat_grid(3, 5), flat, false));
}

// 1e-14, 1e-11, 1e-9 and 1e-6 of a cell beside each other: below, at and above the tolerance.
TEST(DegeneratePairs, NearlyCoincidingVerticesAndEdges)
{
  for (const double distance : {1e-16, 1e-14, 1e-12, 1e-11, 1e-10, 2e-10, 1e-9, 1e-8, 1e-6, 1e-4})
    for (const unsigned int m : {4u, 8u, 12u})
      for (const double angle : {0., 1., 2.5, 4.})
        {
          const Shape          near = shifted(flat, distance * std::cos(angle), distance * std::sin(angle));
          const auto           a = grid(4, flat, true), b = grid(m, near, false);
          const ContactMapping mapping(a, b);
          EXPECT_EQ(violated_invariant(a, b, mapping, false), "") << distance << ' ' << m << ' ' << angle;
          EXPECT_NEAR(mapping.report().area_covered, 1., 1e-9 + 4. * distance);
        }
}

TEST(DegeneratePairs, NearlyIdenticalJitteredMeshes)
{
  for (const double jitter : {1e-13, 1e-11, 1e-10, 1e-9, 1e-7, 1e-5, 1e-4})
    for (unsigned int seed = 0; seed < 20; ++seed)
      {
        const SurfaceMesh a = grid(6, flat, true), b = in_space(flat_grid(6, 6, jitter, seed), flat, false);
        const ContactMapping mapping(a, b);
        EXPECT_EQ(violated_invariant(a, b, mapping, true), "") << jitter << ' ' << seed;
      }
}

TEST(DegeneratePairs, TouchingAndPenetrating)
{
  for (const double gap : {0., -1e-9, -1e-3, -.05, .05, .3})
    {
      expect_full_cover(grid(5, saddle, true), grid(7, shifted(stretched(saddle), 0., 0., gap), false));
      expect_full_cover(grid(5, flat, true), grid(7, shifted(flat, 0., 0., gap), false));
    }
}

TEST(DegeneratePairs, Slivers)
{
  // Triangles as thin as 1e-6 of their length on either side.
  const double h        = 1e-6;
  auto         squeezed = flat_grid(4, 4);
  for (auto &v : squeezed.vertices)
    if (v[1] > .2 && v[1] < .8)
      v[1] = .5 + h * (v[1] - .5);
  expect_full_cover(in_space(squeezed, flat, true), grid(5, flat, false));
  expect_full_cover(grid(5, flat, true), in_space(squeezed, flat, false));
  // Flat ones: an inner vertex nearly on the opposite edge (angle of 180 degrees less 1e-5).
  auto thin        = flat_grid(2, 2);
  thin.vertices[4] = {{.5, 1e-5}};
  expect_full_cover(in_space(thin, flat, true), grid(3, flat, false));
  expect_full_cover(grid(3, flat, true), in_space(thin, flat, false));
}

TEST(DegeneratePairs, Holes)
{
  const auto in_hole = [](const Point<3> &p) { return p[0] > .25 && p[0] < .75 && p[1] > .25 && p[1] < .75; };
  const SurfaceMesh holed        = without(grid(8, flat, true), in_hole),
                    holed_mortar = without(grid(8, flat, false), in_hole);
  // A hole in the one, in the other, in both; edges of the coarse mortar surface run over it.
  for (const unsigned int m : {1u, 2u, 3u, 7u, 16u})
    {
      expect_area(holed, grid(m, flat, false), .75);
      expect_area(holed, grid(m, stretched(flat), false), .75);
      expect_area(grid(m, flat, true), holed_mortar, .75);
    }
  expect_area(holed, holed_mortar, .75);
}

TEST(DegeneratePairs, DisconnectedPatches)
{
  const SurfaceMesh two        = join(grid(3, rectangle(0., 1., 0., 1.), true),
                                      grid(4, rectangle(1.5, 2.5, .2, 1.), true)),
                    two_mortar = join(grid(4, rectangle(0., 1., 0., 1.), false),
                                      grid(3, rectangle(1.5, 2.5, .2, 1.), false));
  for (const unsigned int m : {1u, 2u, 5u, 20u})
    {
      expect_area(two, grid(m, rectangle(-1., 3., -1., 2.), false), 1.8);
      expect_area(grid(m, rectangle(-1., 3., -1., 2.), true), two_mortar, 1.8);
    }
  expect_area(two, two_mortar, 1.8);
  // Cut along lines between and through the patches.
  expect_area(two, grid(3, rectangle(.5, 2., .5, .8), false), .3 * (.5 + .5));
}

TEST(DegeneratePairs, MeshSizesOneToHundred)
{
  for (const Shape &shape : {Shape(flat), Shape(saddle)})
    {
      expect_full_cover(grid(2, shape, true), grid(200, stretched(shape), false, .24, 1));
      expect_full_cover(grid(200, shape, true, .24, 1), grid(2, stretched(shape), false));
    }
}

TEST(DegeneratePairs, BordersThatStickOut)
{
  for (const unsigned int n : {1u, 2u, 3u, 8u})
    for (const unsigned int m : {1u, 2u, 3u, 8u})
      {
        const auto non = [&](const double x0, const double x1, const double y0, const double y1) {
          return in_space(flat_grid(n, n), rectangle(x0, x1, y0, y1), true);
        };
        const auto mor = [&](const double x0, const double x1, const double y0, const double y1) {
          return in_space(flat_grid(m, m), rectangle(x0, x1, y0, y1, .1), false);
        };
        // A corner over a corner, a bar over a bar (no vertex of the one over the other), one inside.
        expect_area(non(0., 1., 0., 1.), mor(.3, 1.7, .45, 2.), .7 * .55);
        expect_area(non(0., 1., .4, .6), mor(.31, .63, -1., 2.), .32 * .2);
        expect_area(non(0., 1., 0., 1.), mor(.21, .43, .11, .77), .22 * .66);
        expect_area(non(.21, .43, .11, .77), mor(0., 1., 0., 1.), .22 * .66);
        // Common border lines.
        expect_area(non(0., 1., 0., 1.), mor(.5, 1., 0., 1.), .5);
        expect_area(non(0., 1., 0., 1.), mor(.5, 2., 0., 2.), .5);
        // Beside each other, with a border in common.
        expect_area(non(0., 1., 0., 1.), mor(1., 2., 0., 1.), 0.);
      }
}

// Two squares, one turned by 45 degrees: no corner of the one lies over the other.
TEST(DegeneratePairs, Octagon)
{
  const Shape diamond = [](const double x, const double y) {
    const double u = x - .5, v = y - .5;
    return Point<3>(.5 + u - v, .5 + u + v, .1);
  };
  const Shape square = [](const double x, const double y) {
    return Point<3>(.5 + 1.5 * (x - .5), .5 + 1.5 * (y - .5), 0.);
  };
  // The square of side 1.5 less four corners cut by |x| + |y| <= 1.
  const double area = 2.25 - 4. * .5 * .5 * .5;
  for (const unsigned int n : {1u, 2u, 5u})
    for (const unsigned int m : {1u, 2u, 5u})
      {
        expect_area(grid(n, square, true), grid(m, diamond, false), area);
        expect_area(grid(n, diamond, true), grid(m, square, false), area);
      }
}

// A vertex that ends a mortar edge right on the border of the nonmortar surface, or on its corner.
TEST(DegeneratePairs, EdgesThatEndOnTheBorder)
{
  const SurfaceMesh square = grid(2, flat, true);
  expect_area(square, grid(2, rectangle(0., 2., 0., 2.), false), 1.);
  expect_area(square, grid(4, rectangle(-1., 1., -1., 1.), false), 1.);
  expect_area(square,
              in_space(flat_grid(4, 4, 0., 0, Diagonals::parallel), rectangle(-1., 3., -1., 3.), false), 1.);
}
