// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The contact mapping alone, between surfaces for which it is known.

#include "measurement.h"

#include <signorini/surface/mapping_quality.h>

namespace Signorini
{
  using dealii::Point;

  namespace
  {
    using Shape = std::function<Point<3>(double, double)>;

    /// The square [-1, 1]^2 in n x m pairs of triangles, its inner vertices moved; put into space. Normals to
    /// the side of z > 0, or to the other one.
    SurfaceMesh grid(const unsigned int n, const unsigned int m, const Shape &shape, const bool up)
    {
      SurfaceMesh mesh;
      for (unsigned int j = 0; j <= m; ++j)
        for (unsigned int i = 0; i <= n; ++i)
          {
            const bool   inner = i > 0 && i < n && j > 0 && j < m;
            const double x     = inner ? .2 * std::sin(3. * i + 5. * j) : 0.,
                         y     = inner ? .2 * std::cos(7. * i - 2. * j) : 0.;
            mesh.vertices.push_back(shape(2. * (i + x) / n - 1., 2. * (j + y) / m - 1.));
          }
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int i = 0; i < n; ++i)
          {
            const unsigned int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            mesh.triangles.push_back({{a, b, c}});
            mesh.triangles.push_back({{a, c, d}});
          }
      if (!up)
        for (auto &t : mesh.triangles)
          std::swap(t[1], t[2]);
      mesh.compute_vertex_normals();
      return mesh;
    }

    /// The largest distance between Phi at the corners of the overlay and where they belong.
    double image_error(const ContactMapping &mapping, const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                       const std::function<double(const Point<3> &, const Point<3> &)> &distance)
    {
      double error = 0.;
      for (const OverlayTriangle &cell : mapping.overlay())
        for (unsigned int c = 0; c < 3; ++c)
          error =
              larger_error(error, distance(evaluate(nonmortar, cell.nonmortar_triangle, cell.nonmortar[c]),
                                           evaluate(mortar, cell.mortar_triangle, cell.mortar[c])));
      return error;
    }

    /// Of Phi(x) from x, over the area of the overlay.
    double mean_distance(const ContactMapping &mapping, const SurfaceMesh &nonmortar,
                         const SurfaceMesh &mortar)
    {
      double sum = 0., all = 0.;
      for (const OverlayTriangle &cell : mapping.overlay())
        {
          const double area = cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle);
          all += area;
          for (unsigned int c = 0; c < 3; ++c)
            sum += area / 3. *
                   evaluate(nonmortar, cell.nonmortar_triangle, cell.nonmortar[c])
                       .distance(evaluate(mortar, cell.mortar_triangle, cell.mortar[c]));
        }
      return sum / all;
    }

    /// The largest distance of Phi^-1(Phi(x)) from x in the middles of the triangles that have an image.
    double way_back_error(const ContactMapping &mapping, const SurfaceMesh &nonmortar)
    {
      const std::array<double, 3> middle = {{1. / 3., 1. / 3., 1. / 3.}};
      const SurfaceTopology      &there = mapping.mortar_topology(), &here = mapping.nonmortar_topology();
      double                      error = 0.;
      for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
        {
          const SurfacePoint image = mapping.image(t, middle);
          if (image.on == SurfacePoint::On::nothing)
            continue;
          const unsigned int m = image.on == SurfacePoint::On::triangle ? image.index : there.none;
          if (m == there.none)
            continue;
          const SurfacePoint back = mapping.preimage(m, image.weights_in(there, m));
          error = larger_error(error, back.on == SurfacePoint::On::nothing || !back.lies_in(here, t)
                                          ? 1.
                                          : evaluate(nonmortar, t, back.weights_in(here, t))
                                                .distance(evaluate(nonmortar, t, middle)));
        }
      return error;
    }

    VerificationRun mapped(const ContactMapping &mapping, const std::vector<double> &errors)
    {
      VerificationRun run;
      run.errors = errors;
      if (const std::string text = describe_errors(mapping.report()); !text.empty())
        run.objections.push_back("mapping: " + text);
      return run;
    }

    using Polygon = std::vector<std::array<double, 2>>;

    double area(const Polygon &p)
    {
      double sum = 0.;
      for (std::size_t i = 0; i < p.size(); ++i)
        {
          const auto &a = p[i], &b = p[(i + 1) % p.size()];
          sum += .5 * (a[0] * b[1] - a[1] * b[0]);
        }
      return sum;
    }

    /// What a convex polygon has in common with another one, both counterclockwise (Sutherland and Hodgman).
    Polygon clip(Polygon p, const Polygon &by)
    {
      for (std::size_t k = 0; k < by.size(); ++k)
        {
          const auto &a = by[k], &b = by[(k + 1) % by.size()];
          const auto  side = [&](const std::array<double, 2> &x) {
            return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
          };
          Polygon rest;
          for (std::size_t i = 0; i < p.size(); ++i)
            {
              const auto  &x = p[i], &y = p[(i + 1) % p.size()];
              const double s = side(x), t = side(y);
              if (s >= 0.)
                rest.push_back(x);
              if ((s > 0. && t < 0.) || (s < 0. && t > 0.))
                rest.push_back({{x[0] + s / (s - t) * (y[0] - x[0]), x[1] + s / (s - t) * (y[1] - x[1])}});
            }
          p = rest;
        }
      return p;
    }

    /// A triangle of a surface over the plane z = 0, counterclockwise.
    Polygon flat_triangle(const SurfaceMesh &mesh, const unsigned int t)
    {
      Polygon p;
      for (const unsigned int v : mesh.triangles[t])
        p.push_back({{mesh.vertices[v][0], mesh.vertices[v][1]}});
      if (area(p) < 0.)
        std::swap(p[1], p[2]);
      return p;
    }

    /// By brute force for all pairs of triangles: the sum of the differences between the area of what they
    /// have in common and that of their overlay, and the area that all have in common.
    std::pair<double, double> compare_pieces(const ContactMapping &mapping, const SurfaceMesh &nonmortar,
                                             const SurfaceMesh &mortar)
    {
      std::map<std::pair<unsigned int, unsigned int>, double> pieces;
      for (const OverlayTriangle &cell : mapping.overlay())
        pieces[{cell.nonmortar_triangle, cell.mortar_triangle}] +=
            cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle);
      double difference = 0., common = 0.;
      for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
        for (unsigned int m = 0; m < mortar.triangles.size(); ++m)
          {
            const double exact = area(clip(flat_triangle(nonmortar, t), flat_triangle(mortar, m)));
            const auto   piece = pieces.find({t, m});
            common += exact;
            difference += std::abs(exact - (piece == pieces.end() ? 0. : piece->second));
          }
      return {difference, common};
    }

    /// Two planes with the distance 0.1, the upper square turned and larger in one direction.
    VerificationRun run_planes(const MPI_Comm, const unsigned int mesh)
    {
      const Shape below = [](const double x, const double y) { return Point<3>(x, y, 0.); };
      const Shape above = [](const double x, const double y) {
        const double c = std::cos(.35), s = std::sin(.35);
        return Point<3>(c * .9 * x - s * 1.2 * y, s * .9 * x + c * 1.2 * y, .1);
      };
      const unsigned int n         = 1u << mesh;
      const SurfaceMesh  nonmortar = grid(7 * n, 6 * n, below, true),
                        mortar     = grid(5 * n, 8 * n, above, false);
      const ContactMapping mapping(nonmortar, mortar);
      const double image = image_error(mapping, nonmortar, mortar, [](const Point<3> &x, const Point<3> &y) {
        return y.distance(x + Point<3>(0., 0., .1));
      });
      const auto [pieces, common] = compare_pieces(mapping, nonmortar, mortar);
      return mapped(mapping, {image, pieces / common, relative_error(mapping.report().area_covered, common),
                              way_back_error(mapping, nonmortar)});
    }

    /// A part of the sphere r = 1 in a larger part of the sphere r = 1.2. Normals along the radius are linear
    /// along chords, too: the mapping is along the radius on any mesh.
    VerificationRun run_spheres(const MPI_Comm, const unsigned int mesh)
    {
      const double half   = .6;
      const auto   sphere = [](const double r, const double width) {
        return [=](const double x, const double y) {
          const double s = width * x, t = width * y, scale = r / std::sqrt(1. + s * s + t * t);
          return Point<3>(scale * s, scale * t, scale);
        };
      };
      const unsigned int n         = 1u << mesh;
      SurfaceMesh        nonmortar = grid(7 * n, 6 * n, sphere(1., half), true),
                  mortar           = grid(8 * n, 9 * n, sphere(1.2, 1.3 * half), false);
      for (std::size_t v = 0; v < nonmortar.vertices.size(); ++v)
        nonmortar.vertex_normals[v] = nonmortar.vertices[v] / nonmortar.vertices[v].norm();
      for (std::size_t v = 0; v < mortar.vertices.size(); ++v)
        mortar.vertex_normals[v] = -mortar.vertices[v] / mortar.vertices[v].norm();
      const ContactMapping mapping(nonmortar, mortar);
      const auto           direction = [](const Point<3> &x, const Point<3> &y) {
        return (x / x.norm() - y / y.norm()).norm();
      };
      // The solid angle of a square of half the width w at the distance 1.
      const double exact = 4. * std::asin(half * half / (1. + half * half));
      return mapped(mapping, {image_error(mapping, nonmortar, mortar, direction),
                              relative_error(mean_distance(mapping, nonmortar, mortar), .2),
                              relative_error(mapping.report().area_covered, exact),
                              way_back_error(mapping, nonmortar)});
    }
  } // namespace



  std::vector<VerificationProblem> mapping_problems()
  {
    VerificationProblem planes;
    planes.name       = "mapping-planes";
    planes.what       = "The contact mapping between two triangulated planes that overlap in part.";
    planes.reference  = "all pairs of triangles clipped by brute force";
    planes.quantities = {{"image", "largest distance from the orthogonal projection", {1e-12}},
                         {"pieces", "area of each piece of the overlay", {1e-12}},
                         {"area", "of the overlay", {1e-12}},
                         {"way back", "largest distance of Phi^-1(Phi(x)) from x", {1e-12}}};
    planes.meshes     = {"84 on 80 triangles", "336 on 320", "1344 on 1280"};
    planes.run        = run_planes;

    VerificationProblem spheres;
    spheres.name      = "mapping-spheres";
    spheres.what      = "The contact mapping between two triangulated spheres inside of each other.";
    spheres.reference = "projection along the radius, which triangles keep; distance and area of the spheres";
    spheres.quantities = {{"direction", "largest distance from the radius", {1e-12}},
                          {"gap", "mean distance", {.006, .0014, .00033}, 1.9},
                          {"area", "of the overlay", {.01, .0025, .00065}, 1.9},
                          {"way back", "largest distance of Phi^-1(Phi(x)) from x", {1e-12}}};
    spheres.meshes     = {"84 in 144 triangles", "336 in 576", "1344 in 2304"};
    spheres.n_quick    = 3;
    spheres.run        = run_spheres;
    return {planes, spheres};
  }
} // namespace Signorini
