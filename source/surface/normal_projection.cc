// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/normal_projection.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  namespace NormalProjection
  {
    namespace
    {
      /// Newton's method is at rounding after a step of this size in a parameter: what is left is its square.
      constexpr double last_step = 1e-9;

      /// Solves a 3x3 system given by columns; false if it is singular.
      bool solve(Tensor<1, 3> &x, const Tensor<1, 3> &c0, const Tensor<1, 3> &c1, const Tensor<1, 3> &c2,
                 const Tensor<1, 3> &rhs)
      {
        const Tensor<1, 3> c12 = cross_product_3d(c1, c2);
        const double       det = c0 * c12;
        if (!(det * det > 1e-28 * c0.norm_square() * c1.norm_square() * c2.norm_square()))
          return false;
        x[0] = (rhs * c12) / det;
        x[1] = (c0 * cross_product_3d(rhs, c2)) / det;
        x[2] = (c0 * cross_product_3d(c1, rhs)) / det;
        return true;
      }
    } // namespace



    double distance_from_edge(const Point<3> &p, const Tensor<1, 3> &n, const OrientedEdge &edge,
                              double &position)
    {
      const Tensor<1, 3> d      = edge.b - edge.a;
      const Tensor<1, 3> across = cross_product_3d(d, n);
      const double       length = across.norm();
      if (!(length > 0.))
        {
          position = .5;
          return 0.;
        }
      // Foot on the edge of the common perpendicular of the two lines.
      const Tensor<1, 3> w      = p - edge.a;
      const Tensor<1, 3> normal = cross_product_3d(n, across);
      position                  = (w * normal) / (d * normal);
      return (w * across) / length;
    }



    double distance_from_curtain(const Point<3> &v, const OrientedEdge &edge, double &s)
    {
      const Tensor<1, 3> d     = edge.b - edge.a;
      const Tensor<1, 3> slope = edge.normal_b - edge.normal_a;
      s                        = .5;
      Tensor<1, 3> n;
      // f(s) = (v - x(s)) . (part of d orthogonal to n(s)); n changes slowly along an edge.
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          n                          = edge.normal_a + s * slope;
          const Tensor<1, 3> tangent = d - ((d * n) / n.norm_square()) * n;
          const Tensor<1, 3> r       = (v - edge.a) - s * d;
          // The tangential motion of the foot when s grows: along d, and by the turning of the normal.
          const double eta  = (r * n) / n.norm_square();
          const double step = (r * tangent) / ((d + eta * slope) * tangent);
          const double old  = s;
          s                 = std::min(2., std::max(-1., s + step));
          if (!(std::abs(s - old) > last_step))
            break;
        }
      n = edge.normal_a + s * slope;
      const Tensor<1, 3> across =
          cross_product_3d(d + ((((v - edge.a) - s * d) * n) / n.norm_square()) * slope, n);
      return (((v - edge.a) - s * d) * across) / across.norm();
    }



    bool intersect_edges(const OrientedEdge &mortar, const OrientedEdge &nonmortar, double &s, double &t)
    {
      const Tensor<1, 3> d     = mortar.b - mortar.a;
      const Tensor<1, 3> slope = mortar.normal_b - mortar.normal_a;
      const Tensor<1, 3> e     = nonmortar.b - nonmortar.a;
      Tensor<1, 3>       n     = mortar.normal_a + s * slope;
      double             eta   = ((nonmortar.a + t * e - mortar.a - s * d) * n) / n.norm_square();
      for (unsigned int iteration = 0; iteration < 20; ++iteration)
        {
          n                           = mortar.normal_a + s * slope;
          const Tensor<1, 3> residual = (mortar.a + s * d + eta * n) - (nonmortar.a + t * e);
          Tensor<1, 3>       step;
          if (!solve(step, d + eta * slope, n, -e, -residual))
            return false;
          s += step[0];
          eta += step[1];
          t += step[2];
          if (std::abs(step[0]) < last_step && std::abs(step[2]) < last_step)
            break;
        }
      return std::isfinite(s) && std::isfinite(t);
    }



    bool inverse_project(std::array<double, 3> &weights, double &eta, const Point<3> &v,
                         const std::array<Point<3>, 3> &x, const std::array<Tensor<1, 3>, 3> &n)
    {
      weights = {{1. / 3., 1. / 3., 1. / 3.}};
      eta     = (v - (x[0] + x[1] + x[2]) / 3.) * ((n[0] + n[1] + n[2]) / 3.);
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
        {
          Tensor<1, 3> normal, point;
          for (unsigned int i = 0; i < 3; ++i)
            {
              normal += weights[i] * n[i];
              point += weights[i] * x[i];
            }
          const Tensor<1, 3> residual = point + eta * normal - v;
          Tensor<1, 3>       step;
          if (!solve(step, (x[1] - x[0]) + eta * (n[1] - n[0]), (x[2] - x[0]) + eta * (n[2] - n[0]), normal,
                     -residual))
            return false;
          weights[1] += step[0];
          weights[2] += step[1];
          weights[0] = 1. - weights[1] - weights[2];
          eta += step[2];
          if (std::abs(step[0]) < last_step && std::abs(step[1]) < last_step)
            break;
        }
      return std::isfinite(weights[0]) && std::isfinite(eta);
    }



    bool intersect_line(std::array<double, 3> &weights, double &eta, const Point<3> &p, const Tensor<1, 3> &n,
                        const std::array<Point<3>, 3> &x)
    {
      Tensor<1, 3> solution;
      if (!solve(solution, x[1] - x[0], x[2] - x[0], -n, p - x[0]))
        return false;
      weights = {{1. - solution[0] - solution[1], solution[0], solution[1]}};
      eta     = solution[2];
      return true;
    }
  } // namespace NormalProjection
} // namespace Signorini
