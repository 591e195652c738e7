// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/face_moments.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Points (barycentric) and weights (sum 1) on a triangle.
    struct TriangleRule
    {
      std::vector<std::array<double, 3>> points;
      std::vector<double>                weights;
    };

    /// Exact for polynomials of degree 4 (six points, Dunavant 1985).
    TriangleRule
    degree_four()
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
    TriangleRule
    collapsed(const unsigned int n)
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

    /// A bilinear face.
    class Quadrilateral
    {
    public:
      Quadrilateral(const ContactSurface &surface, const unsigned int face)
      {
        for (unsigned int v = 0; v < 4; ++v)
          x[v] = surface.mesh.vertices[surface.faces[face].corners[v]];
        const Tensor<1, 3> twist = (x[0] - x[1]) + (x[2] - x[3]);
        is_parallelogram         = twist.norm() <= 1e-12 * (x[0].distance(x[2]) + x[1].distance(x[3]));
      }

      static std::array<double, 4>
      shape(const double s, const double t)
      {
        return {{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t}};
      }

      /// Corner functions at the point of the face nearest to p (Gauss-Newton on the bilinear map).
      std::array<double, 4>
      shape_at(const Point<3> &p, double &s, double &t) const
      {
        for (unsigned int iteration = 0; iteration < 25; ++iteration)
          {
            const auto   phi = shape(s, t);
            Tensor<1, 3> r   = p;
            for (unsigned int v = 0; v < 4; ++v)
              r -= phi[v] * x[v];
            const Tensor<1, 3> ds = (1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
            const Tensor<1, 3> dt = (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
            const double       a = ds * ds, b = ds * dt, c = dt * dt, det = a * c - b * b;
            if (!(det > 0.))
              break;
            const double fs = r * ds, ft = r * dt;
            const double step_s = (c * fs - b * ft) / det, step_t = (a * ft - b * fs) / det;
            s += step_s;
            t += step_t;
            if (std::abs(step_s) + std::abs(step_t) < 1e-15 || (is_parallelogram && iteration > 0))
              break;
          }
        return shape(s, t);
      }

      /// Integrals of the corner functions over the face, and its area.
      std::pair<std::array<double, 4>, double>
      integrals() const
      {
        static const QGauss<1> gauss(4);
        std::array<double, 4>  sums = {{0., 0., 0., 0.}};
        double                 area = 0.;
        for (unsigned int i = 0; i < gauss.size(); ++i)
          for (unsigned int j = 0; j < gauss.size(); ++j)
            {
              const double       s = gauss.point(i)[0], t = gauss.point(j)[0];
              const Tensor<1, 3> ds = (1 - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
              const Tensor<1, 3> dt = (1 - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
              const double       w  = gauss.weight(i) * gauss.weight(j) * cross_product_3d(ds, dt).norm();
              const auto         phi = shape(s, t);
              for (unsigned int v = 0; v < 4; ++v)
                sums[v] += w * phi[v];
              area += w;
            }
        return {sums, area};
      }

      bool is_parallelogram;

    private:
      std::array<Point<3>, 4> x;
    };

    Point<3>
    combine(const std::array<Point<3>, 3> &corners, const std::array<double, 3> &weights)
    {
      return Point<3>(weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2]);
    }

    /// Adds the integrals over one overlay triangle.
    void
    integrate(FaceMoments           &moments,
              const ContactSurface  &nonmortar,
              const ContactSurface  &mortar,
              const OverlayTriangle &cell,
              const Quadrilateral   &face,
              const GapFunction     &prescribed_gap)
    {
      static const TriangleRule     exact = degree_four(), general = collapsed(8);
      const unsigned int            mortar_index = mortar.triangle_face[cell.mortar_triangle];
      const Quadrilateral           mortar_face(mortar, mortar_index);
      std::array<Point<3>, 3>       x, y;
      for (unsigned int i = 0; i < 3; ++i)
        {
          x[i] = evaluate(nonmortar.mesh, cell.nonmortar_triangle, cell.nonmortar[i]);
          y[i] = evaluate(mortar.mesh, cell.mortar_triangle, cell.mortar[i]);
        }
      const double area = .5 * cross_product_3d(x[1] - x[0], x[2] - x[0]).norm();
      const auto  &rule = face.is_parallelogram && mortar_face.is_parallelogram && !prescribed_gap ? exact : general;

      std::array<std::array<double, 4>, 4> products = {};
      double                               s = .5, t = .5, mortar_s = .5, mortar_t = .5;
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        {
          const Point<3> p = combine(x, rule.points[q]), image = combine(y, rule.points[q]);
          const auto     phi   = face.shape_at(p, s, t);
          const auto     theta = mortar_face.shape_at(image, mortar_s, mortar_t);
          const double   w     = rule.weights[q] * area;
          Vector3        gap;
          if (prescribed_gap)
            gap[0] = prescribed_gap(p);
          else
            gap = image - p;
          for (unsigned int a = 0; a < 4; ++a)
            {
              for (unsigned int b = 0; b < 4; ++b)
                {
                  moments.mass[4 * a + b] += w * phi[a] * phi[b];
                  products[b][a] += w * theta[b] * phi[a];
                }
              moments.gap[a] += (w * phi[a]) * gap;
            }
        }
      moments.covered += area;
      for (unsigned int b = 0; b < 4; ++b)
        {
          const unsigned int vertex = mortar.faces[mortar_index].corners[b];
          auto               it     = std::find_if(moments.coupling.begin(), moments.coupling.end(), [&](const auto &entry) {
            return entry.first == vertex;
          });
          if (it == moments.coupling.end())
            it = moments.coupling.insert(it, {vertex, {{0., 0., 0., 0.}}});
          for (unsigned int a = 0; a < 4; ++a)
            it->second[a] += products[b][a];
        }
    }
  } // namespace



  std::vector<FaceMoments>
  compute_face_moments(const ContactSurface               &nonmortar,
                       const ContactSurface               &mortar,
                       const std::vector<OverlayTriangle> &overlay,
                       const GapFunction                  &prescribed_gap,
                       const MPI_Comm                      communicator)
  {
    const unsigned int                   rank = Utilities::MPI::this_mpi_process(communicator);
    std::vector<std::vector<std::size_t>> cells_of(nonmortar.faces.size());
    for (std::size_t c = 0; c < overlay.size(); ++c)
      cells_of[nonmortar.triangle_face[overlay[c].nonmortar_triangle]].push_back(c);

    std::vector<FaceMoments> mine;
    for (unsigned int f = 0; f < nonmortar.faces.size(); ++f)
      if (nonmortar.faces[f].owner == rank)
        {
          const Quadrilateral face(nonmortar, f);
          mine.emplace_back();
          mine.back().face                              = f;
          std::tie(mine.back().full, mine.back().area) = face.integrals();
          for (const std::size_t c : cells_of[f])
            integrate(mine.back(), nonmortar, mortar, overlay[c], face, prescribed_gap);
        }
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return mine;
    std::vector<FaceMoments> all;
    for (const auto &piece : Utilities::MPI::all_gather(communicator, mine))
      all.insert(all.end(), piece.begin(), piece.end());
    std::sort(all.begin(), all.end(), [](const FaceMoments &a, const FaceMoments &b) { return a.face < b.face; });
    return all;
  }
} // namespace Signorini
