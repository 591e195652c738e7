// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_surfaces_h
#define signorini_tests_surfaces_h

#include <signorini/surface/contact_mapping.h>

#include <gtest/gtest.h>

#include <random>

/// Surfaces for tests of the contact mapping, and what must hold for every pair.
namespace TestSurfaces
{
  using namespace Signorini;
  using dealii::Point;

  using Shape = std::function<Point<3>(double, double)>;

  /// A triangulated grid in the plane.
  struct FlatGrid
  {
    std::vector<std::array<double, 2>>       vertices;
    std::vector<std::array<unsigned int, 3>> triangles;
  };

  enum class Diagonals
  {
    alternating,
    parallel
  };

  /// n x m squares of the unit square, split by diagonals; inner vertices moved by up to `jitter` cells (from
  /// a quarter on triangles may turn over).
  inline FlatGrid flat_grid(const unsigned int n, const unsigned int m, const double jitter = 0.,
                            const unsigned int seed = 0, const Diagonals diagonals = Diagonals::alternating)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> noise(-jitter, jitter);
    FlatGrid                               grid;
    for (unsigned int j = 0; j <= m; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const bool   inner = i > 0 && i < n && j > 0 && j < m;
          const double x = inner ? noise(random) : 0., y = inner ? noise(random) : 0.;
          grid.vertices.push_back({{(i + x) / n, (j + y) / m}});
        }
    for (unsigned int j = 0; j < m; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
          if (diagonals == Diagonals::parallel || (i + j) % 2)
            {
              grid.triangles.push_back({{a, b, c}});
              grid.triangles.push_back({{a, c, d}});
            }
          else
            {
              grid.triangles.push_back({{a, b, d}});
              grid.triangles.push_back({{b, c, d}});
            }
        }
    return grid;
  }

  /// Such a grid in space, its inner vertices moved by up to `jitter` cells.
  inline SurfaceMesh bent(const unsigned int n, const double jitter, const Shape &shape)
  {
    const FlatGrid grid = flat_grid(n, n, jitter, 7);
    SurfaceMesh    mesh;
    for (const auto &[s, t] : grid.vertices)
      mesh.vertices.push_back(shape(s, t));
    mesh.triangles = grid.triangles;
    return mesh;
  }

  /// Maps a grid into space. `up`: normals to +z.
  inline SurfaceMesh in_space(const FlatGrid &grid, const Shape &shape, const bool up)
  {
    SurfaceMesh mesh;
    for (const auto &v : grid.vertices)
      mesh.vertices.push_back(shape(v[0], v[1]));
    mesh.triangles = grid.triangles;
    if (!up)
      for (auto &t : mesh.triangles)
        std::swap(t[1], t[2]);
    mesh.compute_vertex_normals();
    return mesh;
  }

  inline SurfaceMesh grid(const unsigned int n, const Shape &shape, const bool up, const double jitter = 0.,
                          const unsigned int seed = 0)
  {
    return in_space(flat_grid(n, n, jitter, seed), shape, up);
  }

  inline Point<3> flat(const double x, const double y)
  {
    return Point<3>(x, y, 0.);
  }

  inline Point<3> saddle(const double x, const double y)
  {
    return Point<3>(x, y, .2 * (x - .5) * (y - .5));
  }

  inline Point<3> wave(const double x, const double y)
  {
    return Point<3>(x, y, .05 + .03 * std::sin(6. * x) * std::cos(5. * y));
  }

  inline Point<3> cap(const double x, const double y)
  {
    return Point<3>(x, y, 2. - std::sqrt(4. - (x - .5) * (x - .5) - (y - .5) * (y - .5)));
  }

  /// The unit square is a part of it: [-.2, 1.2]^2.
  inline Shape stretched(const Shape &shape)
  {
    return [shape](const double x, const double y) { return shape(1.4 * x - .2, 1.4 * y - .2); };
  }

  inline double area_of(const SurfaceMesh &mesh)
  {
    double area = 0.;
    for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
      area += triangle_area(mesh, t);
    return area;
  }

  /// Writes a surface for a look at a case that failed.
  inline void write_off(const std::string &file, const SurfaceMesh &mesh)
  {
    std::ofstream out(file);
    out.precision(17);
    out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
    for (const auto &p : mesh.vertices)
      out << p << '\n';
    for (const auto &t : mesh.triangles)
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }

  /// What must hold for every pair; the first thing that does not, or nothing.
  inline std::string violated_invariant(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                                        const ContactMapping &mapping, const bool fully_covered)
  {
    const MappingReport &report = mapping.report();
    if (report.lost_edges.size() > 0)
      return std::to_string(report.lost_edges.size()) + " edges lost";
    if (report.n_broken > 0)
      return std::to_string(report.n_broken) + " pairs without a polygon";
    if (report.n_flips == 0 && report.n_lost_triangles + report.n_torn_edges + report.n_slight > 0)
      return std::to_string(report.n_lost_triangles) + " triangles lost, " +
             std::to_string(report.n_torn_edges) + " edges torn";
    // Where the mapping is turned it is not one-to-one: the report says so, and pieces need not fit exactly.
    if (report.n_flips > 0 && report.worst_tiling_defect < 1e-2)
      return "";
    if (report.worst_tiling_defect > 1e-12)
      return "tiling defect " + std::to_string(report.worst_tiling_defect * 1e12) + "e-12, flips " +
             std::to_string(report.n_flips);
    if (fully_covered && std::abs(report.area_covered / area_of(nonmortar) - 1.) > 1e-12)
      return "covered " + std::to_string(1e12 * (report.area_covered / area_of(nonmortar) - 1.)) +
             "e-12 too much";
    double sum = 0.;
    for (const OverlayTriangle &cell : mapping.overlay())
      {
        sum += cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle);
        if (report.n_flips == 0 && cell.share() < -1e-12)
          return "a cell is turned";
        for (unsigned int c = 0; c < 3; ++c)
          for (const auto &w : {cell.nonmortar[c], cell.mortar[c]})
            if (std::abs(w[0] + w[1] + w[2] - 1.) > 1e-12 ||
                !(*std::min_element(w.begin(), w.end()) >= -1e-12))
              return "a corner lies outside of its triangle";
      }
    if (std::abs(sum - report.area_covered) > 1e-12 * area_of(nonmortar))
      return "cells and polygons have different areas";
    (void)mortar;
    return "";
  }

  inline void expect_full_cover(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar)
  {
    const ContactMapping mapping(nonmortar, mortar);
    EXPECT_EQ(violated_invariant(nonmortar, mortar, mapping, true), "");
    EXPECT_EQ(mapping.report().n_flips, 0u);
  }

  /// Both in one mesh, without common vertices.
  inline SurfaceMesh join(SurfaceMesh a, const SurfaceMesh &b)
  {
    const auto n = static_cast<unsigned int>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto &t : b.triangles)
      a.triangles.push_back({{t[0] + n, t[1] + n, t[2] + n}});
    a.compute_vertex_normals();
    return a;
  }
} // namespace TestSurfaces

#endif
