// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/hexahedron.h>

namespace Signorini
{
  using namespace dealii;

  namespace Hexahedron
  {
    std::array<Vector3, 8> reference_gradients(const Point<3> &p)
    {
      std::array<Vector3, 8> gradients;
      for (unsigned int a = 0; a < 8; ++a)
        {
          double value[3], slope[3];
          for (unsigned int c = 0; c < 3; ++c)
            {
              const bool upper = a & (1u << c);
              value[c]         = upper ? p[c] : 1. - p[c];
              slope[c]         = upper ? 1. : -1.;
            }
          gradients[a][0] = slope[0] * value[1] * value[2];
          gradients[a][1] = value[0] * slope[1] * value[2];
          gradients[a][2] = value[0] * value[1] * slope[2];
        }
      return gradients;
    }



    namespace
    {
      struct ReferenceData
      {
        std::array<Point<3>, 8>               points;
        std::array<std::array<double, 8>, 8>  values;
        std::array<std::array<Vector3, 8>, 8> gradients;

        ReferenceData()
        {
          const double g[2] = {.5 - .5 / std::sqrt(3.), .5 + .5 / std::sqrt(3.)};
          for (unsigned int q = 0; q < 8; ++q)
            {
              points[q]    = Point<3>(g[q & 1], g[(q >> 1) & 1], g[q >> 2]);
              values[q]    = shape_values(points[q]);
              gradients[q] = reference_gradients(points[q]);
            }
        }
      };

      const ReferenceData &reference_data()
      {
        static const ReferenceData data;
        return data;
      }

      Block jacobian(const Corners &corners, const std::array<Vector3, 8> &gradients)
      {
        Block j;
        for (unsigned int a = 0; a < 8; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              j[c][d] += corners[a][c] * gradients[a][d];
        return j;
      }

      /// Adds the contribution of one Gauss point to the blocks a <= b.
      void add_gauss_point(std::array<double, 576> &blocks, const double (&g)[8][3], const double lambda,
                           const double mu)
      {
        for (unsigned int a = 0; a < 8; ++a)
          {
            const double l[3] = {lambda * g[a][0], lambda * g[a][1], lambda * g[a][2]};
            const double m[3] = {mu * g[a][0], mu * g[a][1], mu * g[a][2]};
            for (unsigned int b = a; b < 8; ++b)
              {
                double *const k   = blocks.data() + 9 * (8 * a + b);
                const double  dot = m[0] * g[b][0] + m[1] * g[b][1] + m[2] * g[b][2];
                for (unsigned int c = 0; c < 3; ++c)
                  for (unsigned int d = 0; d < 3; ++d)
                    k[3 * c + d] += l[c] * g[b][d] + m[d] * g[b][c];
                k[0] += dot;
                k[4] += dot;
                k[8] += dot;
              }
          }
      }
    } // namespace



    std::array<double, 8> shape_values(const Point<3> &p)
    {
      std::array<double, 8> values;
      for (unsigned int a = 0; a < 8; ++a)
        {
          values[a] = 1.;
          for (unsigned int c = 0; c < 3; ++c)
            values[a] *= (a & (1u << c)) ? p[c] : 1. - p[c];
        }
      return values;
    }



    const std::array<Point<3>, 8> &gauss_points()
    {
      return reference_data().points;
    }



    bool stiffness(std::array<double, 576> &blocks, const Corners &corners, const double young,
                   const double poisson)
    {
      const double lambda = young * poisson / ((1. + poisson) * (1. - 2. * poisson));
      const double mu     = .5 * young / (1. + poisson);
      blocks.fill(0.);
      for (unsigned int q = 0; q < 8; ++q)
        {
          const auto  &gradients = reference_data().gradients[q];
          const Block  j         = jacobian(corners, gradients);
          const double det       = determinant(j);
          if (!(det > 0.))
            return false;
          const Block t = transpose(invert(j));
          double      g[8][3];
          for (unsigned int a = 0; a < 8; ++a)
            for (unsigned int c = 0; c < 3; ++c)
              g[a][c] = t[c][0] * gradients[a][0] + t[c][1] * gradients[a][1] + t[c][2] * gradients[a][2];
          const double weight = .125 * det;
          add_gauss_point(blocks, g, weight * lambda, weight * mu);
        }
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < a; ++b)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              blocks[9 * (8 * a + b) + 3 * c + d] = blocks[9 * (8 * b + a) + 3 * d + c];
      return true;
    }



    std::pair<double, Point<3>> volume_element(const Corners &corners, const unsigned int q)
    {
      const double det = determinant(jacobian(corners, reference_data().gradients[q]));
      Point<3>     p;
      for (unsigned int a = 0; a < 8; ++a)
        p += reference_data().values[q][a] * corners[a];
      return {.125 * det, p};
    }



    bool invert_map(Point<3> &reference, const Corners &corners, const Point<3> &point)
    {
      const double size = corners[0].distance(corners[7]);
      reference         = Point<3>(.5, .5, .5);
      for (unsigned int iteration = 0; iteration < 30; ++iteration)
        {
          const auto   values   = shape_values(reference);
          Tensor<1, 3> residual = point;
          for (unsigned int a = 0; a < 8; ++a)
            residual -= values[a] * corners[a];
          if (residual.norm() < 1e-14 * size)
            return true;
          const Block j = jacobian(corners, reference_gradients(reference));
          if (!(std::abs(determinant(j)) > 1e-30 * size * size * size))
            return false;
          reference += invert(j) * residual;
          if (!(reference.norm() < 1e3))
            return false;
        }
      return true;
    }
  } // namespace Hexahedron
} // namespace Signorini
