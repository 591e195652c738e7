// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "random_pair.h"

#include <cstdlib>

using namespace TestSurfaces;
using dealii::Tensor;

namespace
{
  /// Two surfaces of the same or of overlapping shape whose rims, edges and vertices coincide but for noise,
  /// turned, moved far away, and rounded to a number of digits, as files have them.
  struct MatchingPair
  {
    SurfaceMesh nonmortar, mortar;
    /// The area that they have in common, less than `noise` times a perimeter away from what is found.
    double      area;
    double      noise = 0.;
    std::string description;

    explicit MatchingPair(const unsigned int seed)
      : random(seed)
    {
      const bool curved = number(0, 2) == 0;
      // Cells of both on the same raster of m x n squares, each surface cut in its own way.
      const unsigned int m = number(1, 6), n = number(1, 6);
      const Part         common[2] = {part(m, n), part(m, n)};
      const bool         same      = number(0, 1) == 0;
      const unsigned int cuts[2]   = {number(1, 3), number(1, 3)};
      std::ostringstream text;
      const double       uneven = number(0, 1) * .35 * uniform();
      const unsigned int shape  = number(0, 2);
      const double       gap    = curved || number(0, 1) ? 0. : .1 * (uniform() - .5);
      Shape              place  = [=](const double x, const double y) {
        // Uneven cells: the raster goes with it.
        const double u = x + uneven * x * (1. - x), v = y - uneven * y * (1. - y);
        return !curved ? flat(u, v) : shape == 0 ? saddle(u, v) : shape == 1 ? wave(u, v) : cap(u, v);
      };
      // Curved surfaces coincide where their meshes do.
      const bool      refine           = !curved;
      const Diagonals common_diagonals = diagonals();
      SurfaceMesh     made[2];
      for (unsigned int side = 0; side < 2; ++side)
        {
          const unsigned int cut = refine ? cuts[side] : 1;
          const Part        &p   = common[same ? 0 : side];
          const FlatGrid grid = flat_grid(m * cut, n * cut, 0., 0, curved ? common_diagonals : diagonals());
          made[side]          = in_space(grid, place, side == 0);
          if (!curved && uneven == 0. && number(0, 1))
            jitter(made[side], m * cut, n * cut, m, n);
          keep(made[side], grid, p, m, n);
        }
      area = 0.;
      {
        const FlatGrid grid   = flat_grid(m, n, 0., 0, common_diagonals);
        SurfaceMesh    meshes = in_space(grid, place, true);
        for (unsigned int t = 0; t < grid.triangles.size(); ++t)
          if (contains(common[0], grid, t, m, n) && contains(common[same ? 0 : 1], grid, t, m, n))
            area += triangle_area(meshes, t);
      }
      for (Point<3> &p : made[1].vertices)
        p[2] += gap;
      // Noise of one's own, of a size that is anything.
      const double own   = number(0, 1) ? std::pow(10., -16. + 11. * uniform()) : 0.;
      SurfaceMesh &noisy = made[number(0, 1)];
      for (Point<3> &p : noisy.vertices)
        for (unsigned int c = 0; c < 3; ++c)
          p[c] += own * (2. * uniform() - 1.);
      // Turned and moved, in one go for both.
      const Tensor<2, 3> rotation = random_rotation();
      const double       size     = number(0, 1) ? std::pow(10., 6. * uniform()) : 0.;
      const Tensor<1, 3> shift    = size * Point<3>(uniform() - .5, uniform() - .5, uniform() - .5);
      const double       scale    = number(0, 1) ? std::pow(10., 12. * uniform() - 6.) : 1.;
      unsigned int       digits   = number(6, 17);
      while (std::pow(10., 1. - digits) * (1. + size) > 1e-5)
        ++digits;
      for (SurfaceMesh &mesh : made)
        {
          for (Point<3> &p : mesh.vertices)
            p = rounded(Point<3>(scale * (rotation * p + shift)), digits);
          mesh.compute_vertex_normals();
        }
      noise = own + std::pow(10., 1. - std::min(digits, 16u)) * (1. + size);
      area *= scale * scale;
      noise *= scale;
      text << "raster " << m << " x " << n << ", cut by " << (refine ? cuts[0] : 1) << " and "
           << (refine ? cuts[1] : 1) << (curved ? ", curved" : ", flat") << (same ? ", same rims" : "")
           << ", gap " << gap << ", noise " << own << ", moved by " << size << ", " << digits
           << " digits, scale " << scale;
      description        = text.str();
      const bool swapped = number(0, 1);
      nonmortar          = std::move(made[swapped]);
      mortar             = std::move(made[!swapped]);
    }

  private:
    /// A rectangle of cells less another one.
    struct Part
    {
      unsigned int x0, x1, y0, y1, hole_x0, hole_x1, hole_y0, hole_y1;
    };

    Part part(const unsigned int m, const unsigned int n)
    {
      Part p{0, m, 0, n, 0, 0, 0, 0};
      if (number(0, 1))
        {
          p.x0 = number(0, m - 1);
          p.x1 = number(p.x0 + 1, m);
          p.y0 = number(0, n - 1);
          p.y1 = number(p.y0 + 1, n);
        }
      if (number(0, 2) == 0 && (p.x1 - p.x0 > 1 || p.y1 - p.y0 > 1))
        do
          {
            p.hole_x0 = number(p.x0, p.x1 - 1);
            p.hole_x1 = number(p.hole_x0, p.x1);
            p.hole_y0 = number(p.y0, p.y1 - 1);
            p.hole_y1 = number(p.hole_y0, p.y1);
          }
        while (p.hole_x1 - p.hole_x0 == p.x1 - p.x0 && p.hole_y1 - p.hole_y0 == p.y1 - p.y0);
      return p;
    }

    static bool contains(const Part &p, const FlatGrid &grid, const unsigned int triangle,
                         const unsigned int m, const unsigned int n)
    {
      double x = 0., y = 0.;
      for (const unsigned int v : grid.triangles[triangle])
        {
          x += m * grid.vertices[v][0] / 3.;
          y += n * grid.vertices[v][1] / 3.;
        }
      return x > p.x0 && x < p.x1 && y > p.y0 && y < p.y1 &&
             !(x > p.hole_x0 && x < p.hole_x1 && y > p.hole_y0 && y < p.hole_y1);
    }

    static void keep(SurfaceMesh &mesh, const FlatGrid &grid, const Part &p, const unsigned int m,
                     const unsigned int n)
    {
      std::vector<std::array<unsigned int, 3>> kept;
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        if (contains(p, grid, t, m, n))
          kept.push_back(mesh.triangles[t]);
      mesh.triangles = kept;
    }

    /// Moves vertices of an M x N grid that lie on no line of the m x n raster.
    void jitter(SurfaceMesh &mesh, const unsigned int M, const unsigned int N, const unsigned int m,
                const unsigned int n)
    {
      for (unsigned int j = 0; j <= N; ++j)
        for (unsigned int i = 0; i <= M; ++i)
          if ((i * m) % M != 0 && (j * n) % N != 0)
            {
              mesh.vertices[j * (M + 1) + i][0] += .24 / M * (2. * uniform() - 1.);
              mesh.vertices[j * (M + 1) + i][1] += .24 / N * (2. * uniform() - 1.);
            }
    }

    static Point<3> rounded(Point<3> p, const unsigned int digits)
    {
      for (unsigned int c = 0; c < 3; ++c)
        {
          std::array<char, 64> text;
          std::snprintf(text.data(), text.size(), "%.*g", static_cast<int>(digits), p[c]);
          p[c] = std::strtod(text.data(), nullptr);
        }
      return p;
    }

    Tensor<2, 3> random_rotation()
    {
      Tensor<1, 3> a, b;
      for (unsigned int c = 0; c < 3; ++c)
        {
          a[c] = uniform() - .5;
          b[c] = uniform() - .5;
        }
      a /= a.norm();
      b -= (a * b) * a;
      b /= b.norm();
      const Tensor<1, 3> c = cross_product_3d(a, b);
      Tensor<2, 3>       rotation;
      for (unsigned int i = 0; i < 3; ++i)
        {
          rotation[i][0] = a[i];
          rotation[i][1] = b[i];
          rotation[i][2] = c[i];
        }
      return rotation;
    }

    double uniform()
    {
      return std::uniform_real_distribution<double>(0., 1.)(random);
    }

    unsigned int number(const unsigned int low, const unsigned int high)
    {
      return std::uniform_int_distribution<unsigned int>(low, high)(random);
    }

    Diagonals diagonals()
    {
      return number(0, 1) ? Diagonals::parallel : Diagonals::alternating;
    }

    std::mt19937 random;
  };
} // namespace



// SIGNORINI_RANDOM_PAIRS=10000 for the long run. A pair that fails is written to OFF files.
TEST(MatchingRims, AreCoveredWhateverTheNoise)
{
  const char        *wanted  = std::getenv("SIGNORINI_RANDOM_PAIRS");
  const unsigned int n_pairs = wanted ? static_cast<unsigned int>(std::stoul(wanted)) : 500;
  for (unsigned int seed = 0; seed < n_pairs; ++seed)
    {
      const MatchingPair   pair(seed);
      const ContactMapping mapping(pair.nonmortar, pair.mortar);
      std::string          error = violated_invariant(pair.nonmortar, pair.mortar, mapping, false);
      const double         size  = std::sqrt(area_of(pair.nonmortar)),
                   difference    = mapping.report().area_covered - pair.area;
      if (error.empty() &&
          !(std::abs(difference) <= 1e-9 * area_of(pair.nonmortar) + 40. * pair.noise * size))
        error = "covered " + std::to_string(1e12 * difference / area_of(pair.nonmortar)) + "e-12 too much";
      if (error.empty() && mapping.report().n_flips > 0)
        error = std::to_string(mapping.report().n_flips) + " turned";
      if (!error.empty())
        {
          const std::string name = testing::TempDir() + "rims_" + std::to_string(seed);
          write_off(name + "_non.off", pair.nonmortar);
          write_off(name + "_mor.off", pair.mortar);
          ADD_FAILURE() << "pair " << seed << ": " << error << " (" << pair.description << "); written to "
                        << name << "_{non,mor}.off";
        }
    }
}
