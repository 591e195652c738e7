// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/quadratic_tetrahedron.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Of the octahedron: its ends, and the other vertices in a circle around it.
    struct Diagonal
    {
      unsigned int ends[2], ring[4];
    };

    constexpr Diagonal diagonals[3] = {{{4, 9}, {5, 6, 7, 8}},
                                       {{5, 7}, {4, 8, 9, 6}},
                                       {{6, 8}, {4, 7, 9, 5}}};

    /// The first of equally long ones, to rounding.
    const Diagonal &shortest_diagonal(const std::vector<Point<3>> &x, const std::array<unsigned int, 10> &n)
    {
      const auto length = [&](const Diagonal &d) { return x[n[d.ends[0]]].distance_square(x[n[d.ends[1]]]); };
      return *std::min_element(
          std::begin(diagonals), std::end(diagonals),
          [&](const Diagonal &a, const Diagonal &b) { return length(a) < .999 * length(b); });
    }
  } // namespace



  std::array<std::array<unsigned int, 4>, 8> cut_quadratic_tetrahedron(const std::vector<Point<3>>        &x,
                                                                       const std::array<unsigned int, 10> &n)
  {
    std::array<std::array<unsigned int, 4>, 8> pieces = {{{{n[0], n[4], n[6], n[7]}},
                                                          {{n[4], n[1], n[5], n[8]}},
                                                          {{n[6], n[5], n[2], n[9]}},
                                                          {{n[7], n[8], n[9], n[3]}}}};
    const Diagonal                            &d      = shortest_diagonal(x, n);
    const unsigned int                         p = n[d.ends[0]], q = n[d.ends[1]];
    for (unsigned int i = 0; i < 4; ++i)
      {
        unsigned int a = n[d.ring[i]], b = n[d.ring[(i + 1) % 4]];
        if (cross_product_3d(x[b] - x[a], x[p] - x[a]) * (x[q] - x[a]) < 0.)
          std::swap(a, b);
        pieces[4 + i] = {{a, b, p, q}};
      }
    return pieces;
  }
} // namespace Signorini
