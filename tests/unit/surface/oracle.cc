// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surfaces.h"

#include <signorini/surface/normal_projection.h>

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// Corners of the common part of two triangles by brute force: every vertex against the other triangle,
  /// every edge against every edge by all solutions of the quadratic equation behind system (10). No
  /// neighbours, no walking, no memory. In barycentric coordinates (nonmortar, mortar).
  std::vector<std::array<double, 6>> corners_by_force(const SurfaceMesh &non, const unsigned int t,
                                                      const SurfaceMesh &mor, const unsigned int m)
  {
    constexpr double                   tolerance = 1e-9;
    std::array<Point<3>, 3>            a, x;
    std::array<Tensor<1, 3>, 3>        n;
    std::vector<std::array<double, 6>> corners;
    for (unsigned int i = 0; i < 3; ++i)
      {
        a[i] = non.vertices[non.triangles[t][i]];
        x[i] = mor.vertices[mor.triangles[m][i]];
        n[i] = mor.vertex_normals[mor.triangles[m][i]];
      }
    const auto add = [&](const std::array<double, 3> &w, const std::array<double, 3> &v) {
      for (const double y : {w[0], w[1], w[2], v[0], v[1], v[2]})
        if (!(y > -tolerance))
          return;
      for (const auto &c : corners)
        if (std::abs(c[0] - w[0]) + std::abs(c[1] - w[1]) + std::abs(c[2] - w[2]) < 1e-7)
          return;
      corners.push_back({{w[0], w[1], w[2], v[0], v[1], v[2]}});
    };
    const auto unit = [](const unsigned int i) {
      std::array<double, 3> w = {{0., 0., 0.}};
      w[i]                    = 1.;
      return w;
    };
    for (unsigned int i = 0; i < 3; ++i)
      {
        std::array<double, 3> w;
        double                eta;
        if (NormalProjection::intersect_line(w, eta, x[i], n[i], a))
          add(w, unit(i));
        if (NormalProjection::inverse_project(w, eta, a[i], x, n))
          add(unit(i), w);
        for (unsigned int j = 0; j < 3; ++j)
          {
            // (p - x(s)) . (n(s) x e) = 0 with p on the edge a_i + t e.
            const Tensor<1, 3> e = a[(i + 1) % 3] - a[i], d = x[(j + 1) % 3] - x[j], r = a[i] - x[j],
                               k = n[(j + 1) % 3] - n[j], ne = cross_product_3d(n[j], e),
                               ke  = cross_product_3d(k, e);
            const double        c0 = r * ne, c1 = r * ke - d * ne, c2 = -(d * ke);
            std::vector<double> roots;
            if (std::abs(c2) < 1e-12 * std::abs(c1))
              roots.push_back(-c0 / c1);
            else if (const double root = c1 * c1 - 4. * c2 * c0; root >= 0.)
              {
                const double q = -.5 * (c1 + std::copysign(std::sqrt(root), c1));
                roots          = {q / c2, c0 / q};
              }
            for (const double s : roots)
              {
                // The common perpendicular of the edge and the line.
                const Tensor<1, 3> normal = n[j] + s * k, y = x[j] + s * d - a[i],
                                   across = cross_product_3d(e, normal);
                const double          u   = (cross_product_3d(y, normal) * across) / across.norm_square();
                std::array<double, 3> w = {{0., 0., 0.}}, v = {{0., 0., 0.}};
                w[i]           = 1. - u;
                w[(i + 1) % 3] = u;
                v[j]           = 1. - s;
                v[(j + 1) % 3] = s;
                add(w, v);
              }
          }
      }
    return corners;
  }

  bool facing(const SurfaceMesh &non, const unsigned int t, const SurfaceMesh &mor, const unsigned int m)
  {
    const auto normal = [](const SurfaceMesh &mesh, const unsigned int k) {
      const auto &v = mesh.triangles[k];
      return cross_product_3d(mesh.vertices[v[1]] - mesh.vertices[v[0]],
                              mesh.vertices[v[2]] - mesh.vertices[v[0]]);
    };
    return normal(non, t) * normal(mor, m) < 0.;
  }

  /// Area of the convex hull of points in barycentric coordinates, as a part of the triangle.
  double share_of_hull(const std::vector<std::array<double, 6>> &corners)
  {
    std::vector<std::array<double, 2>> p;
    for (const auto &c : corners)
      p.push_back({{c[1], c[2]}});
    std::sort(p.begin(), p.end());
    const auto turn = [](const auto &a, const auto &b, const auto &c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    double area = 0.;
    // Andrew's two chains.
    for (const double side : {1., -1.})
      {
        std::vector<std::array<double, 2>> chain;
        for (const auto &x : p)
          {
            while (chain.size() > 1 && side * turn(chain[chain.size() - 2], chain.back(), x) <= 0.)
              chain.pop_back();
            chain.push_back(x);
          }
        for (std::size_t i = 1; i + 1 < chain.size(); ++i)
          area += side * turn(chain[0], chain[i], chain[i + 1]);
      }
    return area;
  }

  /// The same pairs with the same corners on both routes.
  void compare(const SurfaceMesh &non, const SurfaceMesh &mor, const bool planar)
  {
    const ContactMapping                                                    mapping(non, mor);
    std::map<std::pair<unsigned int, unsigned int>, std::set<unsigned int>> nodes;
    for (std::size_t i = 0; i < mapping.n_polygons(); ++i)
      for (unsigned int k = mapping.polygon_start[i]; k < mapping.polygon_start[i + 1]; ++k)
        nodes[mapping.polygon_triangles[i]].insert(mapping.polygon_corners[k]);
    double area = 0.;
    for (unsigned int t = 0; t < non.triangles.size(); ++t)
      for (unsigned int m = 0; m < mor.triangles.size(); ++m)
        {
          const auto corners = corners_by_force(non, t, mor, m);
          const auto it      = nodes.find({t, m});
          if (!facing(non, t, mor, m) || corners.size() < 3 || share_of_hull(corners) < 1e-12)
            {
              EXPECT_EQ(it, nodes.end()) << t << ' ' << m;
              continue;
            }
          area += share_of_hull(corners) * triangle_area(non, t);
          ASSERT_NE(it, nodes.end()) << t << ' ' << m;
          EXPECT_EQ(corners.size(), it->second.size()) << t << ' ' << m;
          for (const unsigned int node : it->second)
            {
              const auto w   = mapping.nodes()[node].nonmortar.weights_in(mapping.nonmortar_topology(), t),
                         v   = mapping.nodes()[node].mortar.weights_in(mapping.mortar_topology(), m);
              double nearest = 1.;
              for (const auto &c : corners)
                {
                  double distance = 0.;
                  for (unsigned int i = 0; i < 3; ++i)
                    distance = std::max(distance, std::max(std::abs(c[i] - w[i]), std::abs(c[3 + i] - v[i])));
                  nearest = std::min(nearest, distance);
                }
              EXPECT_LT(nearest, 1e-8) << t << ' ' << m;
            }
        }
    if (planar)
      {
        EXPECT_NEAR(mapping.report().area_covered / area, 1., 1e-12);
      }
  }
} // namespace



TEST(Oracle, PlanarPairs)
{
  for (unsigned int seed = 0; seed < 30; ++seed)
    {
      const double angle  = .1 * seed;
      const Shape  turned = [angle](const double x, const double y) {
        const double u = 1.1 * (x - .5), v = 1.3 * (y - .4);
        return Point<3>(.5 + std::cos(angle) * u - std::sin(angle) * v,
                        .5 + std::sin(angle) * u + std::cos(angle) * v, .1);
      };
      compare(in_space(flat_grid(1 + seed % 5, 1 + seed % 7, .3, seed), flat, true),
              in_space(flat_grid(1 + seed % 6, 1 + seed % 4, .3, 100 + seed), turned, false), true);
    }
}

TEST(Oracle, DegeneratePlanarPairs)
{
  for (const unsigned int n : {1u, 2u, 4u})
    for (const unsigned int m : {1u, 2u, 3u, 4u, 8u})
      for (const Diagonals d : {Diagonals::alternating, Diagonals::parallel})
        compare(in_space(flat_grid(n, n, 0., 0, d), flat, true), in_space(flat_grid(m, m), flat, false),
                true);
}

TEST(Oracle, CurvedPairs)
{
  const std::vector<Shape> shapes = {saddle, wave, cap, flat};
  for (unsigned int i = 0; i < shapes.size(); ++i)
    for (unsigned int j = 0; j < shapes.size(); ++j)
      for (unsigned int seed = 0; seed < 3; ++seed)
        {
          compare(grid(6 + seed, shapes[i], true, .2, seed),
                  grid(9, stretched(shapes[j]), false, .2, 50 + seed), false);
          compare(grid(9, stretched(shapes[i]), true, .2, seed),
                  grid(6 + seed, shapes[j], false, .2, 50 + seed), false);
        }
}
