// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_random_pair_h
#define signorini_tests_random_pair_h

#include "surfaces.h"

namespace TestSurfaces
{
  /// A random pair; every third has its vertices on a raster, so that vertices and edges coincide by chance.
  struct RandomPair
  {
    SurfaceMesh nonmortar, mortar;
    bool        is_covered;

    explicit RandomPair(const unsigned int seed)
      : random(seed)
    {
      const bool on_raster = seed % 3 == 0;
      // Cells that are not bent more than they are wide: five across a wave and more.
      const unsigned int n = number(5, 12), m = number(5, 12);
      const auto         choose = [&]() -> Shape {
        switch (number(0, 4))
          {
            case 0:
              return saddle;
            case 1:
              return wave;
            case 2:
              return cap;
            default:
              return flat;
          }
      };
      auto non = flat_grid(n, number(5, 12), on_raster ? 0. : .24, seed, diagonals()),
           mor = flat_grid(m, number(5, 12), on_raster ? 0. : .24, seed + 1, diagonals());
      if (on_raster)
        for (auto *grid : {&non, &mor})
          for (auto &v : grid->vertices)
            for (double &x : v)
              x = std::round(x * 24.) / 24.;
      is_covered  = number(0, 2) > 0;
      Shape upper = choose();
      if (is_covered)
        upper = stretched(upper);
      else
        {
          // Anywhere, turned by anything, partly outside.
          const double angle = 7. * uniform(), dx = uniform() - .5, dy = uniform() - .5,
                       size = .3 + uniform();
          upper             = [=](const double x, const double y) {
            const double u = size * (x - .5), v = size * (y - .5);
            return cap(.5 + dx + std::cos(angle) * u - std::sin(angle) * v,
                                   .5 + dy + std::sin(angle) * u + std::cos(angle) * v);
          };
        }
      nonmortar        = in_space(non, choose(), true);
      mortar           = in_space(mor, upper, false);
      const double gap = .2 * (uniform() - .5);
      for (Point<3> &p : mortar.vertices)
        p[2] += gap;
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
} // namespace TestSurfaces

#endif
