// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/mapping_quality.h>

using namespace TestSurfaces;



TEST(ContactMapping, FlatNonmatchingGrids)
{
  for (const unsigned int m : {1u, 2u, 4u, 7u, 31u})
    expect_full_cover(grid(5, flat, true), grid(m, flat, false));
}



TEST(ContactMapping, IdenticalAndNestedGrids)
{
  expect_full_cover(grid(4, flat, true), grid(4, flat, false));
  expect_full_cover(grid(8, flat, true), grid(4, flat, false));
  expect_full_cover(grid(4, flat, true), grid(12, flat, false));
}



TEST(ContactMapping, PolygonsAreLeftOut)
{
  const SurfaceMesh    one = grid(3, flat, true), other = grid(4, flat, false);
  ContactMapping       mapping(one, other);
  const ContactMapping whole = mapping;
  std::vector<bool>    left_out(mapping.n_polygons(), false);
  for (std::size_t i = 0; i < left_out.size(); i += 2)
    left_out[i] = true;
  // Phi^-1 has its own order of the polygons.
  EXPECT_NE(mapping.preimage(0, {{1. / 3., 1. / 3., 1. / 3.}}).on, SurfacePoint::On::nothing);
  mapping.leave_out(left_out);
  ASSERT_EQ(mapping.n_polygons(), whole.n_polygons() / 2);
  for (std::size_t i = 0; i < mapping.n_polygons(); ++i)
    {
      std::vector<OverlayTriangle> cells, expected;
      mapping.triangulate(cells, i);
      whole.triangulate(expected, 2 * i + 1);
      ASSERT_EQ(cells.size(), expected.size());
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          EXPECT_EQ(cells[c].nonmortar, expected[c].nonmortar);
          EXPECT_EQ(cells[c].mortar_triangle, expected[c].mortar_triangle);
        }
    }
  unsigned int n_found = 0, n_found_in_whole = 0;
  for (unsigned int m = 0; m < other.triangles.size(); ++m)
    {
      const std::array<double, 3> place = {{.31, .32, .37}};
      n_found += mapping.preimage(m, place).on != SurfacePoint::On::nothing;
      n_found_in_whole += whole.preimage(m, place).on != SurfacePoint::On::nothing;
    }
  EXPECT_EQ(n_found_in_whole, other.triangles.size());
  EXPECT_GT(n_found, 0u);
  EXPECT_LT(n_found, n_found_in_whole);
}



TEST(ContactMapping, VeryDifferentSizes)
{
  expect_full_cover(grid(1, flat, true), grid(100, flat, false));
  expect_full_cover(grid(100, flat, true), grid(1, flat, false));
}



TEST(ContactMapping, JitteredGrids)
{
  for (unsigned int seed = 0; seed < 100; ++seed)
    expect_full_cover(grid(6, flat, true, .3, seed), grid(5 + seed % 5, flat, false, .3, 1000 + seed));
}



TEST(ContactMapping, CurvedSurfaces)
{
  expect_full_cover(grid(9, wave, true), grid(7, stretched(saddle), false));
  expect_full_cover(grid(9, saddle, true), grid(7, stretched(wave), false));
  expect_full_cover(grid(6, cap, true, .2, 3), grid(11, stretched(cap), false, .2, 4));
  expect_full_cover(grid(8, flat, true), grid(9, stretched(cap), false));
}



// The difference of Phi to the direct normal projection on a sphere falls with order 2.
TEST(ContactMapping, ConvergesToTheNormalProjection)
{
  const auto cap = [](const double radius) {
    return [radius](const double x, const double y) {
      const dealii::Tensor<1, 3> direction = Point<3>(x - .5, y - .5, 1.);
      return Point<3>(radius / direction.norm() * direction);
    };
  };
  double previous = 0.;
  for (unsigned int n = 4; n <= 16; n *= 2)
    {
      const SurfaceMesh inner = grid(n, cap(1.), true),
                        outer = grid(n + n / 2 + 1, stretched(cap(1.1)), false);
      const ContactMapping mapping(inner, outer);
      double               error = 0.;
      for (const OverlayTriangle &cell : mapping.overlay())
        for (unsigned int c = 0; c < 3; ++c)
          {
            const Point<3> x = evaluate(inner, cell.nonmortar_triangle, cell.nonmortar[c]);
            const Point<3> y = evaluate(outer, cell.mortar_triangle, cell.mortar[c]);
            error            = std::max(error, (x / x.norm() - y / y.norm()).norm());
          }
      if (previous > 0.)
        {
          EXPECT_GT(previous / error, 3.);
        }
      previous = error;
    }
}



TEST(ContactMapping, PartialCover)
{
  // The mortar surface covers [0.13, 0.77] x [0.21, 0.64], turned by nothing and by 0.3.
  for (const double angle : {0., .3})
    {
      const Shape patch = [angle](const double x, const double y) {
        const double u = .64 * (x - .5), v = .43 * (y - .5);
        return Point<3>(.5 + std::cos(angle) * u - std::sin(angle) * v,
                        .45 + std::sin(angle) * u + std::cos(angle) * v, 0.);
      };
      for (const unsigned int n : {1u, 5u})
        for (const unsigned int m : {1u, 4u, 9u})
          {
            const SurfaceMesh    square = grid(n, flat, true), small = grid(m, patch, false);
            const ContactMapping mapping(square, small);
            EXPECT_NEAR(mapping.report().area_covered, .64 * .43, 1e-12) << n << ' ' << m << ' ' << angle;
            EXPECT_EQ(violated_invariant(square, small, mapping, false), "");
            const SurfaceMesh square_mortar = grid(n, flat, false), small_nonmortar = grid(m, patch, true);
            expect_full_cover(small_nonmortar, square_mortar);
          }
    }
}



TEST(ContactMapping, ScalesAndGapsOfBothSigns)
{
  for (const double scale : {1e-9, 1., 1e9})
    {
      std::size_t n_cells = 0;
      for (const double gap : {-.05, 0., .05})
        {
          const Shape below = [scale](const double x, const double y) {
            return Point<3>(scale * x, scale * y, 0.);
          };
          const Shape above = [scale, gap](const double x, const double y) {
            return Point<3>(scale * x, scale * y, scale * gap);
          };
          const SurfaceMesh    a = grid(5, below, true, .2, 1), b = grid(7, above, false, .2, 2);
          const ContactMapping mapping(a, b);
          EXPECT_NEAR(mapping.report().area_covered / (scale * scale), 1., 1e-12);
          if (n_cells > 0)
            {
              EXPECT_EQ(mapping.report().n_cells, n_cells);
            }
          n_cells = mapping.report().n_cells;
        }
    }
}



TEST(ContactMapping, SurfacesThatFaceAwayDoNotMeet)
{
  const SurfaceMesh a = grid(3, flat, true), b = grid(4, flat, true);
  EXPECT_EQ(ContactMapping(a, b).report().n_cells, 0u);
}



TEST(ContactMapping, SelectionDoesNotChangeATriangle)
{
  const SurfaceMesh            a = grid(6, flat, true, .2, 5), b = grid(7, flat, false, .2, 6);
  const ContactMapping         all(a, b), odd(a, b, [](const unsigned int t) { return t % 2 == 1; });
  std::vector<OverlayTriangle> expected;
  for (const OverlayTriangle &cell : all.overlay())
    if (cell.nonmortar_triangle % 2 == 1)
      expected.push_back(cell);
  ASSERT_EQ(expected.size(), odd.overlay().size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    {
      EXPECT_EQ(expected[i].mortar_triangle, odd.overlay()[i].mortar_triangle);
      EXPECT_EQ(expected[i].nonmortar, odd.overlay()[i].nonmortar);
      EXPECT_EQ(expected[i].mortar, odd.overlay()[i].mortar);
    }
}

// Edges that are torn over slivers of triangles that are covered all the same are told apart.
TEST(MappingReport, SlightErrors)
{
  Signorini::MappingReport report;
  report.add_edge({3, 1e-12, true, false});
  report.add_edge({4, .1, false, false});
  report.add_edge({5, .1, true, true});
  report.add_edge({6, 1e-6, true, false});
  EXPECT_EQ(report.n_turned_away, 1u);
  EXPECT_EQ(report.n_slight, 2u);
  EXPECT_EQ(Signorini::describe_errors(report).find("torn"), std::string::npos);
  report.add_edge({7, .1, true, false});
  ASSERT_EQ(report.torn_edges.size(), 1u);
  EXPECT_EQ(report.torn_edges[0], 7u);
  EXPECT_NE(Signorini::describe_errors(report).find("torn"), std::string::npos);
}
