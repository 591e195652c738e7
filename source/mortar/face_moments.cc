// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gap_fit.h"

#include <signorini/mortar/face_map.h>
#include <signorini/mortar/face_moments.h>
#include <signorini/mortar/surface_values.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Corners = std::array<Point<3>, 3>;

    constexpr std::array<double, 3> corner_weights[3] = {{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}};

    /// Points (barycentric) and weights (sum 1) on a triangle.
    struct TriangleRule
    {
      std::vector<std::array<double, 3>> points;
      std::vector<double>                weights;
    };

    /// Exact for polynomials of degree 4 (six points, Dunavant 1985).
    TriangleRule degree_four()
    {
      TriangleRule rule;
      for (const auto &[a, w] : {std::pair<double, double>(0.445948490915964886, 0.223381589678011466),
                                 std::pair<double, double>(0.091576213509770744, 0.109951743655321868)})
        for (unsigned int i = 0; i < 3; ++i)
          {
            std::array<double, 3> p = {{a, a, a}};
            p[i]                    = 1. - 2. * a;
            rule.points.push_back(p);
            rule.weights.push_back(w);
          }
      return rule;
    }

    /// Collapsed n x n Gauss rule: for integrands that are not polynomials.
    TriangleRule collapsed(const unsigned int n)
    {
      const QGauss<1> gauss(n);
      TriangleRule    rule;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            const double s = gauss.point(i)[0], t = gauss.point(j)[0] * (1. - s);
            rule.points.push_back({{1. - s - t, s, t}});
            rule.weights.push_back(2. * gauss.weight(i) * gauss.weight(j) * (1. - s));
          }
      return rule;
    }

    const TriangleRule &triangle_rule(const bool polynomial)
    {
      static const TriangleRule exact = degree_four(), general = collapsed(8);
      return polynomial ? exact : general;
    }

    Point<3> combine(const Corners &corners, const std::array<double, 3> &weights)
    {
      return Point<3>(weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2]);
    }

    double triangle_area(const Corners &x)
    {
      return .5 * cross_product_3d(x[1] - x[0], x[2] - x[0]).norm();
    }

    /// Corner functions of a face along the points of a triangle in it. On parallelograms the reference
    /// coordinates are linear: computed once for the corners.
    class ShapeOnTriangle
    {
    public:
      ShapeOnTriangle(const FaceMap &face, const Corners &x)
        : face(face)
      {
        if (face.is_parallelogram())
          for (unsigned int i = 0; i < 3; ++i)
            face.invert(s[i], t[i], x[i]);
      }

      std::array<double, 4> operator()(const std::array<double, 3> &w, const Point<3> &p)
      {
        if (face.is_parallelogram())
          return face.shape(w[0] * s[0] + w[1] * s[1] + w[2] * s[2], w[0] * t[0] + w[1] * t[1] + w[2] * t[2]);
        // The last point is a good guess for the next one.
        face.invert(s[0], t[0], p);
        return face.shape(s[0], t[0]);
      }

    private:
      const FaceMap        &face;
      std::array<double, 3> s = {{.5, .5, .5}}, t = {{.5, .5, .5}};
    };

    /// Where the gap is fitted.
    struct FitRule
    {
      /// Part of the face that must be covered, as of the functions of nodes with a multiplier
      /// (DroppingRule). A roller that ends over its plates, with 0.001 of clearance left, carries 1,250,
      /// 584, 238, 0 N there with .5, .35, .25, .15 (test roller_between_plates).
      double covered = .15;
      /// Part of the face where the mapping may be turned: rounding. There is no gap to be fitted where it
      /// is.
      double turned = 1e-6;
    };

    /// Integrates the moments of one face, overlay triangle by overlay triangle.
    class FaceIntegrator
    {
    public:
      FaceIntegrator(const ContactSurface &nonmortar, const ContactSurface &mortar,
                     const GapFunction &prescribed_gap, const unsigned int index)
        : nonmortar(nonmortar)
        , mortar(mortar)
        , prescribed_gap(prescribed_gap)
        , face(nonmortar, index)
        , mortar_face(face)
        , fit(nonmortar.faces[index].n_corners)
      {
        moments.face = index;
      }

      /// Adds a triangle of the face to the integrals over the whole face.
      void add_face_triangle(const unsigned int triangle)
      {
        Corners x;
        for (unsigned int i = 0; i < 3; ++i)
          x[i] = nonmortar.mesh.vertices[nonmortar.mesh.triangles[triangle][i]];
        const double        area = triangle_area(x);
        const TriangleRule &rule = triangle_rule(face.is_parallelogram());
        ShapeOnTriangle     phi_at(face, x);
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          {
            const auto phi = phi_at(rule.points[q], combine(x, rule.points[q]));
            for (unsigned int a = 0; a < 4; ++a)
              moments.full[a] += rule.weights[q] * area * phi[a];
          }
        moments.area += area;
      }

      /// Whether the triangles of a cell turn away from each other, or the image lies beside the triangle
      /// rather than before it, so that nothing touches there, and they are farther apart than the face is
      /// wide. Where most of a face is covered by such cells it counts as uncovered: gaps grow like 1/cos
      /// there, and the mapping may be turned, so that nodes would have to move by multiples of the bodies.
      /// (At the crease of a roof in its groove planes that turn away from each other are near.)
      bool is_out_of_reach(const OverlayTriangle &cell) const
      {
        constexpr std::array<double, 3> centre = {{1. / 3., 1. / 3., 1. / 3.}};
        const Point<3> x = evaluate(nonmortar.mesh, cell.nonmortar_triangle, compose(cell.nonmortar, centre)),
                       y = evaluate(mortar.mesh, cell.mortar_triangle, compose(cell.mortar, centre));
        if (prescribed_gap || x.distance_square(y) <= moments.area)
          return false;
        const Vector3 n   = unit_normal(nonmortar, cell.nonmortar_triangle);
        const Vector3 way = (y - x) / x.distance(y);
        return !may_touch(n, unit_normal(mortar, cell.mortar_triangle)) ||
               !(may_touch(n, way) || may_touch(n, -way));
      }

      void add_overlay_triangle(const OverlayTriangle &cell)
      {
        select_mortar_face(mortar.triangle_face[cell.mortar_triangle]);
        Corners x, y;
        for (unsigned int i = 0; i < 3; ++i)
          {
            x[i] = evaluate(nonmortar.mesh, cell.nonmortar_triangle, cell.nonmortar[i]);
            y[i] = evaluate(mortar.mesh, cell.mortar_triangle, cell.mortar[i]);
          }
        // Negative where the mapping is turned, so that the cells of a face add up to what they cover.
        const double area = cell.share() * Signorini::triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
        turned += std::max(0., -area);
        const TriangleRule &rule =
            triangle_rule(face.is_parallelogram() && mortar_face.is_parallelogram() && !prescribed_gap);
        ShapeOnTriangle phi_at(face, x), theta_at(mortar_face, y);
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          {
            const Point<3> p = combine(x, rule.points[q]), image = combine(y, rule.points[q]);
            add_point(rule.weights[q] * area, gap_at(cell, rule.points[q], p, image),
                      phi_at(rule.points[q], p), theta_at(rule.points[q], image));
          }
        if (!prescribed_gap)
          for (unsigned int i = 0; i < 3; ++i)
            fit.add(0., gap_at(cell, corner_weights[i], x[i], y[i]), phi_at(corner_weights[i], x[i]));
        moments.covered += area;
      }

      /// A triangle of the face with images given by a function.
      void add_triangle(const unsigned int triangle, const ImageFunction &image)
      {
        const auto         &t = nonmortar.mesh.triangles[triangle];
        Corners             x;
        const TriangleRule &rule = triangle_rule(false);
        for (unsigned int i = 0; i < 3; ++i)
          x[i] = nonmortar.mesh.vertices[t[i]];
        const auto has_gap = [&](Vector3 &gap, const std::array<double, 3> &w) {
          Vector3 normal;
          for (unsigned int i = 0; i < 3; ++i)
            normal += w[i] * nonmortar.mesh.vertex_normals[t[i]];
          const double   length = normal.norm();
          const Point<3> p      = combine(x, w) + nonmortar.offset(triangle, w);
          return length > 0. && image(gap, p, normal / length);
        };
        std::vector<Vector3> gaps(rule.points.size());
        for (std::size_t q = 0; q < gaps.size(); ++q)
          if (!has_gap(gaps[q], rule.points[q]))
            return;
        const double    area = triangle_area(x);
        ShapeOnTriangle phi_at(face, x);
        for (std::size_t q = 0; q < gaps.size(); ++q)
          add_functions(rule.weights[q] * area, gaps[q], phi_at(rule.points[q], combine(x, rule.points[q])));
        for (unsigned int i = 0; i < 3; ++i)
          if (Vector3 gap; has_gap(gap, corner_weights[i]))
            fit.add(0., gap, phi_at(corner_weights[i], x[i]));
        moments.covered += area;
      }

      /// After the last triangle: the gap becomes what displacements of linear elements can follow. One that
      /// bends away within the face would else count as penetration. Prescribed gaps are taken as they are.
      void smooth_gap()
      {
        if (prescribed_gap || turned > FitRule().turned * moments.area || !(moments.covered > 0.))
          return;
        std::array<Vector3, 4> normals;
        for (unsigned int a = 0; a < 4; ++a)
          normals[a] = nonmortar.mesh.vertex_normals[nonmortar.faces[moments.face].corners[a]];
        const std::array<Vector3, 4> change =
            fit.correction(normals, moments.covered >= FitRule().covered * moments.area);
        for (unsigned int a = 0; a < 4; ++a)
          moments.gap[a] += change[a];
      }

      /// After the last triangle.
      void add_facing()
      {
        for (const auto &[vertex, values] : moments.coupling)
          for (unsigned int a = 0; a < 4; ++a)
            moments.facing[a] += values[a] * mortar.mesh.vertex_normals[vertex];
      }

      FaceMoments moments;

    private:
      static Vector3 unit_normal(const ContactSurface &surface, const unsigned int triangle)
      {
        const auto   &t = surface.mesh.triangles[triangle];
        const auto   &x = surface.mesh.vertices;
        const Vector3 n = cross_product_3d(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
        return n.norm() > 0. ? n / n.norm() : n;
      }

      void add_functions(const double weight, const Vector3 &gap, const std::array<double, 4> &phi)
      {
        if (!prescribed_gap)
          fit.add(weight, gap, phi);
        for (unsigned int a = 0; a < 4; ++a)
          {
            const double w = weight * phi[a];
            for (unsigned int b = 0; b < 4; ++b)
              moments.mass[4 * a + b] += w * phi[b];
            moments.gap[a] += w * gap;
          }
      }

      /// From a point of the true nonmortar surface to its image on the true mortar surface, or the
      /// prescribed gap in component 0.
      Vector3 gap_at(const OverlayTriangle &cell, const std::array<double, 3> &weights, const Point<3> &p,
                     const Point<3> &image) const
      {
        if (prescribed_gap)
          return Vector3({prescribed_gap(p), 0., 0.});
        return initial_gap(nonmortar, mortar, cell, weights, p, image);
      }

      void add_point(const double weight, const Vector3 &gap, const std::array<double, 4> &phi,
                     const std::array<double, 4> &theta)
      {
        add_functions(weight, gap, phi);
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int b = 0; b < 4; ++b)
            moments.coupling[slots[b]].second[a] += weight * phi[a] * theta[b];
      }

      /// Finds or makes the entries of the corners of a mortar face.
      void select_mortar_face(const unsigned int index)
      {
        if (index == mortar_index)
          return;
        mortar_index = index;
        mortar_face  = FaceMap(mortar, index);
        for (unsigned int b = 0; b < 4; ++b)
          {
            const unsigned int vertex = mortar.faces[index].corners[b];
            slots[b]                  = 0;
            while (slots[b] < moments.coupling.size() && moments.coupling[slots[b]].first != vertex)
              ++slots[b];
            if (slots[b] == moments.coupling.size())
              moments.coupling.push_back({vertex, {{0., 0., 0., 0.}}});
          }
      }

      const ContactSurface &nonmortar, &mortar;
      const GapFunction    &prescribed_gap;
      const FaceMap         face;
      FaceMap               mortar_face;
      GapFit                fit;
      /// Area where the mapping is turned.
      double                     turned       = 0.;
      unsigned int               mortar_index = numbers::invalid_unsigned_int;
      std::array<std::size_t, 4> slots        = {};
    };

    /// Groups indices 0, 1, ... by key: those of key k are list[start[k]] ... list[start[k+1]-1], in order.
    struct Groups
    {
      template <typename Key>
      Groups(const std::size_t n_keys, const std::size_t n, const Key &key)
        : start(n_keys + 1, 0)
        , list(n)
      {
        for (std::size_t i = 0; i < n; ++i)
          ++start[key(i) + 1];
        for (std::size_t k = 0; k < n_keys; ++k)
          start[k + 1] += start[k];
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (std::size_t i = 0; i < n; ++i)
          list[next[key(i)]++] = i;
      }

      std::vector<std::size_t> start, list;
    };
  } // namespace



  namespace
  {
    /// Integrates the own faces, `add` on top of the triangles of each.
    template <typename Add>
    std::vector<FaceMoments> integrate_faces(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                             const GapFunction &prescribed_gap, const MPI_Comm communicator,
                                             const Add &add)
    {
      const unsigned int       rank = Utilities::MPI::this_mpi_process(communicator);
      const Groups             triangles(nonmortar.faces.size(), nonmortar.mesh.triangles.size(),
                                         [&](const std::size_t t) { return nonmortar.triangle_face[t]; });
      std::vector<FaceMoments> mine;
      for (unsigned int f = 0; f < nonmortar.faces.size(); ++f)
        if (nonmortar.faces[f].worker == rank)
          {
            FaceIntegrator integrator(nonmortar, mortar, prescribed_gap, f);
            for (std::size_t i = triangles.start[f]; i < triangles.start[f + 1]; ++i)
              integrator.add_face_triangle(static_cast<unsigned int>(triangles.list[i]));
            add(integrator, f, triangles);
            integrator.smooth_gap();
            integrator.add_facing();
            mine.push_back(std::move(integrator.moments));
          }
      return mine;
    }
  } // namespace



  std::vector<FaceMoments> compute_face_moments(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                                const std::vector<OverlayTriangle> &overlay,
                                                const GapFunction                  &prescribed_gap,
                                                const MPI_Comm                      communicator)
  {
    const Groups cells(nonmortar.faces.size(), overlay.size(), [&](const std::size_t c) {
      return nonmortar.triangle_face[overlay[c].nonmortar_triangle];
    });
    const auto   area_of = [&](const OverlayTriangle &cell) {
      return std::abs(cell.share()) * triangle_area(nonmortar.mesh, cell.nonmortar_triangle);
    };
    return integrate_faces(nonmortar, mortar, prescribed_gap, communicator,
                           [&](FaceIntegrator &integrator, const unsigned int f, const Groups &) {
                             double covered = 0., out_of_reach = 0.;
                             for (std::size_t i = cells.start[f]; i < cells.start[f + 1]; ++i)
                               {
                                 const OverlayTriangle &cell = overlay[cells.list[i]];
                                 covered += area_of(cell);
                                 out_of_reach += integrator.is_out_of_reach(cell) ? area_of(cell) : 0.;
                               }
                             if (out_of_reach > .5 * covered)
                               return;
                             for (std::size_t i = cells.start[f]; i < cells.start[f + 1]; ++i)
                               integrator.add_overlay_triangle(overlay[cells.list[i]]);
                           });
  }



  std::vector<FaceMoments> compute_face_moments(const ContactSurface &nonmortar, const ImageFunction &image,
                                                const MPI_Comm communicator)
  {
    return integrate_faces(nonmortar, nonmortar, GapFunction(), communicator,
                           [&](FaceIntegrator &integrator, const unsigned int f, const Groups &triangles) {
                             for (std::size_t i = triangles.start[f]; i < triangles.start[f + 1]; ++i)
                               integrator.add_triangle(static_cast<unsigned int>(triangles.list[i]), image);
                           });
  }
} // namespace Signorini
