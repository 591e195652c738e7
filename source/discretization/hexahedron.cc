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

      /// Adds bulk V m mᵀ to the blocks a <= b: m are the mean gradients, of which the sum of the gradients
      /// times their weights is V times as much.
      void add_mean_dilatation(std::array<double, 576> &blocks, const double (&sum)[8][3], const double bulk,
                               const double volume)
      {
        for (unsigned int a = 0; a < 8; ++a)
          for (unsigned int b = a; b < 8; ++b)
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                blocks[9 * (8 * a + b) + 3 * c + d] += bulk / volume * sum[a][c] * sum[b][d];
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



    bool stiffness(std::array<double, 576> &blocks, const Corners &corners, const IsotropicMaterial &material,
                   const bool mean_dilatation)
    {
      const double mu = material.mu(), bulk = material.bulk_modulus();
      // What is left for the Gauss points beside the mean dilatation is the deviator.
      const double lambda = mean_dilatation ? -2. / 3. * mu : material.lambda();
      double       volume = 0., sum[8][3] = {};
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
          if (mean_dilatation)
            {
              volume += weight;
              for (unsigned int a = 0; a < 8; ++a)
                for (unsigned int c = 0; c < 3; ++c)
                  sum[a][c] += weight * g[a][c];
            }
        }
      if (mean_dilatation)
        add_mean_dilatation(blocks, sum, bulk, volume);
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



    namespace
    {
      /// How far inverse maps are followed.
      struct InversionRule
      {
        /// Steps of a damped Newton's method, and halvings of one. Of 25,000 points in cells whose corners
        /// are moved by up to half of an edge in each direction none took more than 11 steps.
        unsigned int steps = 20, halvings = 8;
        /// Reference coordinates farther away than this are of no use to anyone.
        double reach = 100.;
        /// Size of the residual on the scale of the terms it is the difference of.
        double tolerance = 1e-14;
        /// How often the cell is cut into eight to start from the pieces that may contain the point: 22 of
        /// those points were not reached from the centre, but after two cuts at most.
        unsigned int cuts = 6;
        /// A point that lies on the cell but for rounding is inside (reference coordinates).
        double inside = 1e-10;
      };

      constexpr InversionRule inversion_rule;

      double distance_from_cell(const Point<3> &reference)
      {
        double result = 0.;
        for (unsigned int c = 0; c < 3; ++c)
          result = std::max({result, -reference[c], reference[c] - 1.});
        return result;
      }

      /// Damped Newton's method for the image 0 of a cell.
      bool find_origin(Point<3> &reference, const Corners &corners)
      {
        const InversionRule &rule     = inversion_rule;
        double               farthest = 0., scale = 0.;
        for (const Point<3> &corner : corners)
          farthest = std::max(farthest, corner.norm());
        const auto residual_at = [&](const Point<3> &p) {
          const auto   values = shape_values(p);
          Tensor<1, 3> residual;
          scale = 0.;
          for (unsigned int a = 0; a < 8; ++a)
            {
              residual -= values[a] * corners[a];
              scale += std::abs(values[a]) * farthest;
            }
          return residual;
        };
        Tensor<1, 3> residual = residual_at(reference);
        for (unsigned int step = 0; step < rule.steps; ++step)
          {
            const double norm = residual.norm();
            if (norm <= rule.tolerance * scale)
              return true;
            const Block  j   = jacobian(corners, reference_gradients(reference));
            const double det = determinant(j);
            if (!(std::abs(det) > 0.))
              return false;
            const Tensor<1, 3> way     = invert(j) * residual;
            double             length  = 1.;
            unsigned int       halving = 0;
            Point<3>           next;
            for (; halving <= rule.halvings; ++halving, length *= .5)
              {
                next     = reference + length * way;
                residual = residual_at(next);
                if (residual.norm() <= (1. - .25 * length) * norm)
                  break;
              }
            if (halving > rule.halvings || !(distance_from_cell(next) < rule.reach))
              return false;
            reference = next;
          }
        return false;
      }

      /// A cube in the reference cell.
      struct Piece
      {
        Point<3> low;
        double   width;
      };

      /// Whether the box around the image of a piece, which contains the image, contains the origin.
      bool may_contain_origin(const Piece &piece, const Corners &corners, const double slack)
      {
        double low[3], high[3];
        for (unsigned int v = 0; v < 8; ++v)
          {
            Point<3> p = piece.low, x;
            for (unsigned int c = 0; c < 3; ++c)
              p[c] += (v >> c & 1) ? piece.width : 0.;
            const auto values = shape_values(p);
            for (unsigned int a = 0; a < 8; ++a)
              x += values[a] * corners[a];
            for (unsigned int c = 0; c < 3; ++c)
              {
                low[c]  = v == 0 ? x[c] : std::min(low[c], x[c]);
                high[c] = v == 0 ? x[c] : std::max(high[c], x[c]);
              }
          }
        for (unsigned int c = 0; c < 3; ++c)
          if (low[c] > slack || high[c] < -slack)
            return false;
        return true;
      }
    } // namespace



    namespace
    {
      /// The eighths of a piece.
      void add_children(std::vector<Piece> &pieces, const Piece &piece)
      {
        for (unsigned int child = 0; child < 8; ++child)
          {
            pieces.push_back({piece.low, .5 * piece.width});
            for (unsigned int c = 0; c < 3; ++c)
              pieces.back().low[c] += (child >> c & 1) ? .5 * piece.width : 0.;
          }
      }
    } // namespace



    bool invert_map(Point<3> &reference, const Corners &corners, const Point<3> &point)
    {
      const InversionRule &rule = inversion_rule;
      // Differences of coordinates carry no rounding of their own, however far the origin is.
      Corners shifted;
      double  size = 0.;
      for (unsigned int a = 0; a < 8; ++a)
        {
          shifted[a] = Point<3>(corners[a] - point);
          size       = std::max(size, corners[a].distance(corners[0]));
        }
      bool       found    = false;
      double     best     = std::numeric_limits<double>::max();
      const auto try_from = [&](const Point<3> &start) {
        Point<3> result = start;
        if (!find_origin(result, shifted))
          return;
        if (const double distance = distance_from_cell(result); distance < best)
          {
            found     = true;
            best      = distance;
            reference = result;
          }
      };
      try_from(Point<3>(.5, .5, .5));
      if (best <= rule.inside)
        return true;
      // Pieces whose image may contain the point, smaller and smaller: they close in on the point if it lies
      // in the cell, and run out if it does not.
      std::vector<Piece> pieces = {{Point<3>(), 1.}}, smaller;
      for (unsigned int cut = 0; cut <= rule.cuts && best > rule.inside; ++cut)
        {
          smaller.clear();
          for (const Piece &piece : pieces)
            {
              if (!may_contain_origin(piece, shifted, rule.inside * size))
                continue;
              if (cut > 0)
                {
                  const double half = .5 * piece.width;
                  try_from(piece.low + Point<3>(half, half, half));
                }
              add_children(smaller, piece);
            }
          std::swap(pieces, smaller);
        }
      return found;
    }
  } // namespace Hexahedron
} // namespace Signorini
