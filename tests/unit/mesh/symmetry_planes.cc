// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/symmetry_planes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace dealii;
using namespace Signorini;

namespace
{
  /// z = height(x, y) on [x0, 1] x [0, 1], in n_x x 4 quadrilaterals; nodes with x = 0 are fixed in x.
  ContactSurface make_surface(const double x0, const unsigned int n_x,
                              const std::function<double(const double, const double)> &height)
  {
    ContactSurface         surface;
    constexpr unsigned int n_y = 4;
    for (unsigned int j = 0; j <= n_y; ++j)
      for (unsigned int i = 0; i <= n_x; ++i)
        {
          const double x = x0 + (1. - x0) * i / n_x, y = j / (1. * n_y);
          surface.mesh.vertices.emplace_back(x, y, height(x, y));
          surface.vertex_fixed.push_back(std::abs(x) < 1e-14 ? 1 : 0);
        }
    auto &normals = surface.mesh.vertex_normals;
    normals.resize(surface.mesh.vertices.size());
    for (unsigned int j = 0; j < n_y; ++j)
      for (unsigned int i = 0; i < n_x; ++i)
        {
          const unsigned int                a = j * (n_x + 1) + i;
          const std::array<unsigned int, 4> c = {{a, a + 1, a + n_x + 2, a + n_x + 1}};
          surface.mesh.triangles.push_back({{c[0], c[1], c[2]}});
          surface.mesh.triangles.push_back({{c[0], c[2], c[3]}});
          const auto &x = surface.mesh.vertices;
          for (const unsigned int v : c)
            normals[v] += cross_product_3d(x[c[2]] - x[c[0]], x[c[3]] - x[c[1]]);
        }
    for (auto &n : normals)
      n /= n.norm();
    surface.hanging.resize(normals.size());
    return surface;
  }

  /// Normals at x = 0 after the projection, in the order of y.
  std::vector<Tensor<1, 3>> normals_at_plane(ContactSurface surface)
  {
    project_onto_symmetry_planes(surface);
    std::vector<Tensor<1, 3>> result;
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      if (std::abs(surface.mesh.vertices[v][0]) < 1e-14)
        result.push_back(surface.mesh.vertex_normals[v]);
    return result;
  }

  void expect_unchanged(const ContactSurface &surface)
  {
    ContactSurface projected = surface;
    project_onto_symmetry_planes(projected);
    for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
      EXPECT_EQ(projected.mesh.vertex_normals[v], surface.mesh.vertex_normals[v]);
  }

  double cylinder(const double x, const double)
  {
    return std::sqrt(4. - x * x);
  }
} // namespace

// The normals of half a surface are those of the whole one. (Around a vertex of the cylinder at the plane
// all facets are coplanar.)
TEST(SymmetryPlanes, HalfSurfaceHasNormalsOfWholeOne)
{
  for (const auto &height : std::vector<std::function<double(double, double)>>{
           cylinder, [](const double x, const double y) { return std::sqrt(4. - x * x - y * y); },
           [](const double x, const double y) { return .2 * x * x * y; }})
    for (const unsigned int n : {2u, 5u, 20u})
      {
        ContactSurface full = make_surface(-1., 2 * n, height);
        full.vertex_fixed.assign(full.vertex_fixed.size(), 0);
        const auto expected = normals_at_plane(full), found = normals_at_plane(make_surface(0., n, height));
        ASSERT_EQ(found.size(), expected.size());
        for (unsigned int i = 0; i < found.size(); ++i)
          EXPECT_LT((found[i] - expected[i]).norm(), 1e-14);
      }
  // One cell wide.
  for (const auto &normal : normals_at_plane(
           make_surface(0., 1, [](const double x, const double y) { return std::sqrt(4. - x * x - y * y); })))
    EXPECT_EQ(normal[0], 0.);
}

TEST(SymmetryPlanes, InclinedSurfacesStayInclined)
{
  for (const unsigned int n : {1u, 5u})
    {
      expect_unchanged(make_surface(0., n, [](const double x, const double y) { return .3 * x + .1 * y; }));
      // The noise of eight digits.
      expect_unchanged(make_surface(0., n, [](const double x, const double y) {
        return .3 * x + 1e-8 * std::sin(1e3 * (x + 2. * y));
      }));
    }
  // Curved as well, where the mesh resolves it.
  expect_unchanged(make_surface(0., 10, [](const double x, const double) { return .5 * x - .3 * x * x; }));
}

// A prescribed component along the border is not a symmetry plane.
TEST(SymmetryPlanes, BorderMustLieInThePlane)
{
  ContactSurface surface = make_surface(0., 5, cylinder);
  for (unsigned int v = 0; v < surface.mesh.vertices.size(); ++v)
    surface.vertex_fixed[v] = surface.mesh.vertices[v][1] < 1e-14 ? 1 : 0;
  expect_unchanged(surface);
  surface = make_surface(0., 5, cylinder);
  for (Point<3> &x : surface.mesh.vertices)
    x[0] += .1 * x[1];
  expect_unchanged(surface);
}

// Hanging vertices take after their projected parents.
TEST(SymmetryPlanes, HangingVertices)
{
  ContactSurface surface =
      make_surface(0., 5, [](const double x, const double y) { return -x * x * (1. + y); });
  const unsigned int v = 6, below = 0, above = 12;
  surface.hanging[v]      = {{below, .5}, {above, .5}};
  surface.vertex_fixed[v] = 0;
  project_onto_symmetry_planes(surface);
  const auto &n = surface.mesh.vertex_normals;
  EXPECT_EQ(n[v][0], 0.);
  EXPECT_LT((n[v] - (n[below] + n[above]) / (n[below] + n[above]).norm()).norm(), 1e-15);
}

// What is cut off there: the planes are counted at the part that touches them; in plane strain there are two
// of them, and clamped borders are none.
TEST(SymmetryPlanes, OfAPartOfASurface)
{
  ContactSurface quarter = make_surface(0., 5, cylinder);
  for (std::size_t v = 0; v < quarter.vertex_fixed.size(); ++v)
    if (quarter.mesh.vertices[v][1] == 0.)
      quarter.vertex_fixed[v] = quarter.mesh.vertices[v][0] == 0. ? 3 : 2;
  const auto count = [](const ContactSurface &surface, const std::function<bool(const Point<3> &)> &is_part) {
    std::vector<bool> marked;
    for (const Point<3> &x : surface.mesh.vertices)
      marked.push_back(is_part(x));
    return count_symmetry_planes(surface, marked, MPI_COMM_WORLD);
  };
  const auto everywhere = [](const Point<3> &) { return true; };
  EXPECT_EQ(count(quarter, everywhere), 2u);
  EXPECT_EQ(count(quarter, [](const Point<3> &x) { return x[0] == 0. && x[1] == 0.; }), 2u);
  EXPECT_EQ(count(quarter, [](const Point<3> &x) { return x[0] > .5; }), 1u);
  EXPECT_EQ(count(quarter, [](const Point<3> &x) { return x[0] > .5 && x[1] > .5; }), 0u);
  // Turned by 30 degrees about z.
  ContactSurface turned = quarter;
  const double   c = std::sqrt(.75), s = .5;
  const auto     turn = [&](const Vector3 &v) {
    return Vector3({c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]});
  };
  for (std::size_t v = 0; v < turned.vertex_fixed.size(); ++v)
    {
      turned.mesh.vertices[v]       = Point<3>(turn(Vector3(quarter.mesh.vertices[v])));
      turned.mesh.vertex_normals[v] = turn(quarter.mesh.vertex_normals[v]);
      std::vector<Vector3> directions;
      for (const Vector3 &d : quarter.vertex_fixed[v].basis())
        directions.push_back(turn(d));
      turned.vertex_fixed[v] = FixedDirections::span(directions);
    }
  EXPECT_EQ(count(turned, everywhere), 2u);
  // A node inside that is held.
  ContactSurface held      = make_surface(-1., 5, cylinder);
  held.vertex_fixed[6 + 2] = 1;
  EXPECT_EQ(count(held, everywhere), 0u);
  ContactSurface plane_strain = make_surface(0., 5, cylinder);
  for (FixedDirections &fixed : plane_strain.vertex_fixed)
    fixed = fixed.components() | 2;
  EXPECT_EQ(count(plane_strain, everywhere), 1u);
  ContactSurface clamped = make_surface(0., 5, cylinder);
  for (FixedDirections &fixed : clamped.vertex_fixed)
    fixed = fixed.any() ? all_fixed : fixed;
  EXPECT_EQ(count(clamped, everywhere), 0u);
}
