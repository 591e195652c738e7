// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/true_shape.h>
#include <signorini/surface/contact_mapping.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace Signorini;
  using dealii::Point;
  using dealii::Tensor;
  using dealii::numbers::PI;

  /// The side of a cylinder of radius 1 and height 1 with some edges around, and its end at z = 0.
  SurfaceMesh cup(const unsigned int n)
  {
    SurfaceMesh mesh;
    for (const double z : {0., 1.})
      for (unsigned int i = 0; i < n; ++i)
        mesh.vertices.emplace_back(std::cos(2. * PI * i / n), std::sin(2. * PI * i / n), z);
    mesh.vertices.emplace_back(0., 0., 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int j = (i + 1) % n;
        mesh.triangles.push_back({{i, j, n + j}});
        mesh.triangles.push_back({{i, n + j, n + i}});
        mesh.triangles.push_back({{j, i, 2 * n}});
      }
    return mesh;
  }
} // namespace



// Exact shapes are where they are at each place; over the chords of the rim between them both end at the
// circle.
TEST(TrueShape, ExactShapesMeetAtTheirRim)
{
  const Tensor<1, 3> axis({0., 0., 1.});
  for (const unsigned int n : {6u, 8u, 16u})
    {
      const SurfaceMesh         mesh = cup(n);
      std::vector<unsigned int> shape_of_triangle;
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        shape_of_triangle.push_back(t % 3 == 2 ? 1 : 0);
      const TrueShape shape(mesh,
                            {make_cylinder_shape(Point<3>(), axis, 1.), make_plane_shape(Point<3>(), axis)},
                            shape_of_triangle, true);
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        for (const auto &w : {std::array<double, 3>{{.2, .3, .5}},
                              {{.6, .1, .3}},
                              {{.5, .5, 0.}},
                              {{.3, .7, 0.}},
                              {{0., .4, .6}},
                              {{1., 0., 0.}}})
          {
            const Point<3> x      = evaluate(mesh, t, w) + shape.offset(mesh, t, w);
            const double   radius = std::hypot(x[0], x[1]);
            if (t % 3 != 2)
              {
                EXPECT_NEAR(radius, 1., 1e-14) << n << ' ' << t;
                continue;
              }
            EXPECT_NEAR(x[2], 0., 1e-14) << n << ' ' << t;
            // The edge between the first two vertices is a chord of the rim.
            if (w[2] == 0.)
              {
                EXPECT_NEAR(radius, 1., 1e-14) << n << ' ' << t;
              }
            else
              {
                EXPECT_LT(radius, 1.) << n << ' ' << t;
              }
          }
    }
}



// A piece of a surface knows the rim although what is beyond it is not there.
TEST(TrueShape, PiecesAreThoseOfTheWhole)
{
  const Tensor<1, 3>        axis({0., 0., 1.});
  const SurfaceMesh         mesh = cup(8);
  std::vector<unsigned int> shape_of_triangle;
  std::vector<bool>         is_end;
  for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
    {
      is_end.push_back(t % 3 == 2);
      shape_of_triangle.push_back(is_end[t] ? 1 : 0);
    }
  const TrueShape whole(mesh, {make_cylinder_shape(Point<3>(), axis, 1.), make_plane_shape(Point<3>(), axis)},
                        shape_of_triangle, true);
  const Renumbering kept(is_end);
  const TrueShape   piece(whole, kept);
  SurfaceMesh       end         = mesh;
  end.triangles                 = kept.select(mesh.triangles);
  const std::array<double, 3> w = {{.3, .6, .1}};
  for (unsigned int t = 0; t < end.triangles.size(); ++t)
    {
      const Tensor<1, 3> difference = piece.offset(end, t, w) - whole.offset(mesh, kept.kept()[t], w);
      EXPECT_EQ(difference.norm(), 0.) << t;
      EXPECT_GT(piece.offset(end, t, w).norm(), 1e-2) << t;
    }
}
