// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// step-1: the contact mapping between two surfaces, without finite elements. README.md has the story and the
// results; this file is meant to be read from top to bottom.

// One header for the mapping and one for its errors in words. Both belong to Signorini::surface, which knows
// triangles only: no bodies, no meshes of volumes, no solver.
#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/mapping_quality.h>

// Points and tables come from deal.II.
#include <deal.II/base/convergence_table.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Step1
{
  using dealii::Point;
  using namespace Signorini;

  // @sect3{Two surfaces}

  // A ball and the socket around it, both with their centre at the origin. The unit of length is the radius
  // of the ball; nothing in the library depends on it.
  constexpr double ball_radius = 1., socket_radius = 1.2;

  // A piece of a sphere over the square [-a, a]^2 of the plane z = 1, seen from the centre, as triangles. A
  // SurfaceMesh is plain arrays, so that it takes a few lines to fill one from whatever mesh a program has.
  // Three promises are asked of it: triangles are oriented, their normals and those at the vertices point out
  // of the body, and vertices are shared by the triangles around them.
  //
  // The body is the ball inside of the sphere or the socket outside of it: `sign` is 1 or -1. The square is
  // turned by an angle, so that no two edges match, and its middle moved by `shift`.
  SurfaceMesh sphere_patch(const unsigned int n, const double radius, const double a, const double sign,
                           const double angle, const double shift)
  {
    SurfaceMesh mesh;
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const double               u = a * (2. * i / n - 1.), v = a * (2. * j / n - 1.);
          const dealii::Tensor<1, 3> direction = Point<3>(shift + std::cos(angle) * u - std::sin(angle) * v,
                                                          std::sin(angle) * u + std::cos(angle) * v, 1.);
          const dealii::Tensor<1, 3> unit      = direction / direction.norm();
          mesh.vertices.push_back(Point<3>(radius * unit));
          // The normals of the sphere. Where they are not known, mesh.compute_vertex_normals() makes them
          // from the triangles.
          mesh.vertex_normals.push_back(sign * unit);
        }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int p = j * (n + 1) + i, q = p + 1, r = p + n + 1, s = r + 1;
          for (std::array<unsigned int, 3> triangle : {std::array<unsigned int, 3>{{p, q, s}}, {{p, s, r}}})
            {
              if (sign < 0.)
                std::swap(triangle[1], triangle[2]);
              mesh.triangles.push_back(triangle);
            }
        }
    return mesh;
  }

  // @sect3{Integrals over the overlay}

  // The coupling matrices of a mortar method for piecewise linear functions,
  //
  //   D_pp' = int phi_p phi_p' ,    M_pq = int phi_p (theta_q o Phi) ,
  //
  // over that part of the nonmortar surface which the mapping Phi covers. Each cell of the overlay lies in
  // one nonmortar and one mortar triangle and knows the barycentric coordinates of its corners in both, which
  // are the values of the hat functions there. All of them are linear on the cell, so that the mass matrix of
  // a triangle integrates exactly: int f g = A/12 (sum_c f_c g_c + sum_c f_c sum_c g_c).
  using Matrix = std::map<std::pair<unsigned int, unsigned int>, double>;

  double integral(const std::array<double, 3> &f, const std::array<double, 3> &g, const double area)
  {
    double sum = (f[0] + f[1] + f[2]) * (g[0] + g[1] + g[2]);
    for (unsigned int c = 0; c < 3; ++c)
      sum += f[c] * g[c];
    return area / 12. * sum;
  }

  // Values of hat function i at the three corners of a cell.
  std::array<double, 3> hat(const std::array<std::array<double, 3>, 3> &corners, const unsigned int i)
  {
    return {{corners[0][i], corners[1][i], corners[2][i]}};
  }

  std::pair<Matrix, Matrix> coupling(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                                     const std::vector<OverlayTriangle> &overlay)
  {
    Matrix D, M;
    for (const OverlayTriangle &cell : overlay)
      {
        const auto  &t    = nonmortar.triangles[cell.nonmortar_triangle];
        const auto  &s    = mortar.triangles[cell.mortar_triangle];
        const double area = cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle); // of the cell
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              D[{t[i], t[j]}] += integral(hat(cell.nonmortar, i), hat(cell.nonmortar, j), area);
              M[{t[i], s[j]}] += integral(hat(cell.nonmortar, i), hat(cell.mortar, j), area);
            }
      }
    return {D, M};
  }

  // Both bases sum to one, so a row of D and the same row of M have the same sum: the balance of forces
  // across the interface. The largest difference, relative to the largest sum.
  double balance_defect(const Matrix &D, const Matrix &M)
  {
    std::map<unsigned int, double> row_D, row_M;
    for (const auto &[at, value] : D)
      row_D[at.first] += value;
    for (const auto &[at, value] : M)
      row_M[at.first] += value;
    double difference = 0., largest = 0.;
    for (const auto &[p, sum] : row_D)
      {
        difference = std::max(difference, std::abs(sum - row_M[p]));
        largest    = std::max(largest, std::abs(sum));
      }
    return difference / largest;
  }

  // The volume between the two surfaces where they face each other. The straight lines from x to Phi(x) at
  // the border of the ball's patch run through the centre, so it is the difference of two cones; the cone
  // over a triangle (a, b, c) has the volume a . (b x c) / 6. The corners of a cell on the mortar side are
  // those of the same number.
  double volume_between(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                        const std::vector<OverlayTriangle> &overlay)
  {
    const auto cone = [](const SurfaceMesh &mesh, const unsigned int triangle, const auto &corners) {
      std::array<dealii::Tensor<1, 3>, 3> x;
      for (unsigned int c = 0; c < 3; ++c)
        x[c] = evaluate(mesh, triangle, corners[c]);
      return x[0] * dealii::cross_product_3d(x[1], x[2]) / 6.;
    };
    double volume = 0.;
    for (const OverlayTriangle &cell : overlay)
      volume += cone(mortar, cell.mortar_triangle, cell.mortar) -
                cone(nonmortar, cell.nonmortar_triangle, cell.nonmortar);
    return volume;
  }

  // The solid angle of the square [-a, a]^2 in the plane z = 1 as seen from the origin, for the exact volume.
  double exact_volume(const double a)
  {
    const double solid_angle = 4. * std::atan(a * a / std::sqrt(1. + 2. * a * a));
    return solid_angle * (std::pow(socket_radius, 3) - std::pow(ball_radius, 3)) / 3.;
  }

  // @sect3{A picture}

  // The cells of the overlay on the nonmortar surface for ParaView, in the legacy format of VTK, which takes
  // a few lines: the distance from x to Phi(x), and the numbers of the two triangles that meet.
  void write_vtk(const std::string &name, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                 const std::vector<OverlayTriangle> &overlay)
  {
    std::ofstream out(name);
    out.precision(12);
    const std::size_t n = overlay.size();
    out << "# vtk DataFile Version 3.0\noverlay of two surfaces\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        << "POINTS " << 3 * n << " double\n";
    for (const OverlayTriangle &cell : overlay)
      for (const auto &corner : cell.nonmortar)
        out << evaluate(nonmortar, cell.nonmortar_triangle, corner) << '\n';
    out << "CELLS " << n << ' ' << 4 * n << '\n';
    for (std::size_t i = 0; i < n; ++i)
      out << "3 " << 3 * i << ' ' << 3 * i + 1 << ' ' << 3 * i + 2 << '\n';
    out << "CELL_TYPES " << n << '\n';
    for (std::size_t i = 0; i < n; ++i)
      out << "5\n";
    out << "CELL_DATA " << n << "\nSCALARS nonmortar_triangle int\nLOOKUP_TABLE default\n";
    for (const OverlayTriangle &cell : overlay)
      out << cell.nonmortar_triangle << '\n';
    out << "SCALARS mortar_triangle int\nLOOKUP_TABLE default\n";
    for (const OverlayTriangle &cell : overlay)
      out << cell.mortar_triangle << '\n';
    out << "POINT_DATA " << 3 * n << "\nSCALARS distance double\nLOOKUP_TABLE default\n";
    for (const OverlayTriangle &cell : overlay)
      for (unsigned int c = 0; c < 3; ++c)
        out << evaluate(nonmortar, cell.nonmortar_triangle, cell.nonmortar[c])
                   .distance(evaluate(mortar, cell.mortar_triangle, cell.mortar[c]))
            << '\n';
  }

  // @sect3{A ball well inside of its socket}

  // Four meshes, the socket's finer and turned by 30 degrees. Whatever the mesh, the cells of the overlay
  // tile every triangle of the ball and the two sums balance, both to rounding; only the volume has an error,
  // that of the facets, which is of second order.
  void convergence()
  {
    const double             a = .5;
    dealii::ConvergenceTable table;
    for (unsigned int n = 4; n <= 32; n *= 2)
      {
        const SurfaceMesh ball   = sphere_patch(n, ball_radius, a, 1., 0., 0.);
        const SurfaceMesh socket = sphere_patch(n + n / 2, socket_radius, .8, -1., std::acos(-1.) / 6., 0.);

        // Phi, from the nonmortar (the ball's) to the mortar surface. There is no search distance to choose.
        const ContactMapping               mapping(ball, socket);
        const MappingReport               &report  = mapping.report();
        const std::vector<OverlayTriangle> overlay = mapping.overlay();

        const auto [D, M]      = coupling(ball, socket, overlay);
        const double balance   = balance_defect(D, M);
        const double uncovered = std::abs(1. - report.area_covered / report.area_nonmortar);
        AssertThrow(describe_errors(report).empty(), dealii::ExcMessage(describe_errors(report)));
        AssertThrow(std::max({report.worst_tiling_defect, uncovered, balance}) < 1e-11,
                    dealii::ExcMessage("The overlay does not tile the ball."));

        table.add_value("ball", ball.triangles.size());
        table.add_value("socket", socket.triangles.size());
        table.add_value("pairs", report.n_pairs);
        table.add_value("cells", report.n_cells);
        table.add_value("uncovered", uncovered);
        table.add_value("tiling", report.worst_tiling_defect);
        table.add_value("balance", balance);
        table.add_value("volume error",
                        std::abs(volume_between(ball, socket, overlay) / exact_volume(a) - 1.));
      }
    for (const std::string column : {"uncovered", "tiling", "balance", "volume error"})
      {
        table.set_precision(column, 2);
        table.set_scientific(column, true);
      }
    table.evaluate_convergence_rates("volume error", dealii::ConvergenceTable::reduction_rate_log2);
    table.write_text(std::cout);
  }

  // @sect3{A ball on the rim of its socket}

  // Moved aside, the socket covers a part of the ball only. Nothing has to be said about that beforehand: the
  // rim is an edge of the plane graph like all others. Every vertex of the socket either has an image or says
  // why not.
  void rim()
  {
    const SurfaceMesh ball   = sphere_patch(8, ball_radius, .5, 1., 0., 0.);
    const SurfaceMesh socket = sphere_patch(9, socket_radius, .5, -1., std::acos(-1.) / 6., .45);

    const ContactMapping mapping(ball, socket);
    const MappingReport &report = mapping.report();
    std::cout << "\nAt the rim: " << report.n_pairs << " pairs, "
              << 100. * report.area_covered / report.area_nonmortar << " % of the ball covered, "
              << report.unmapped.size() << " of " << socket.vertices.size()
              << " vertices of the socket without an image, tiling defect " << report.worst_tiling_defect
              << '\n';

    // Phi at single points: the middles of the ball's first triangle and of its last one. The image is a
    // place on the mortar surface, or nothing.
    for (const unsigned int t : {0u, static_cast<unsigned int>(ball.triangles.size() - 1)})
      {
        const SurfacePoint image = mapping.image(t, {{1. / 3., 1. / 3., 1. / 3.}});
        std::cout << "The middle of triangle " << t;
        if (image.on == SurfacePoint::On::nothing)
          std::cout << " faces nothing.\n";
        else
          std::cout << " is mapped to "
                    << evaluate(socket, image.index, image.weights_in(mapping.mortar_topology(), image.index))
                    << " in triangle " << image.index << " of the socket.\n";
      }
    write_vtk("overlay.vtk", ball, socket, mapping.overlay());
  }
} // namespace Step1



int
main()
{
  try
    {
      Step1::convergence();
      Step1::rim();
    }
  catch (const std::exception &e)
    {
      std::cerr << e.what() << std::endl;
      return 1;
    }
  return 0;
}
