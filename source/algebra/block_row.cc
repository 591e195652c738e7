// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>

namespace Signorini
{
  namespace
  {
    /// How many blocks ahead memory is asked for: the hardware's own fetching starts anew in each row.
    constexpr std::size_t blocks_ahead = 16;

    typedef double Vector2 __attribute__((vector_size(2 * sizeof(double))));

    /// Adds up A_k x_k number by number, without mixing within a block, and sorts the sums out at the end.
    struct RowSum
    {
      Vector4 first = {0., 0., 0., 0.}, second = {0., 0., 0., 0.};
      double  last = 0.;

      inline __attribute__((always_inline)) void add(const double *const a, const double *const x)
      {
        Vector4 a_first, a_second;
        std::memcpy(&a_first, a, sizeof(Vector4));
        std::memcpy(&a_second, a + 4, sizeof(Vector4));
        const Vector4 x_first = {x[0], x[1], x[2], x[0]}, x_second = {x[1], x[2], x[0], x[1]};
        first += a_first * x_first;
        second += a_second * x_second;
        last += a[8] * x[2];
      }

      inline __attribute__((always_inline)) void write(double *const sum) const
      {
        sum[0] = first[0] + first[1] + first[2];
        sum[1] = first[3] + second[0] + second[1];
        sum[2] = second[2] + second[3] + last;
      }
    };
  } // namespace



  SIGNORINI_VECTORIZED
  void multiply_block_ranges(double *const sums, const double *const blocks,
                             const unsigned int *const columns, const BlockRange *const ranges,
                             const unsigned int n_ranges, const double *const x)
  {
    for (unsigned int r = 0; r < n_ranges; ++r)
      {
        RowSum              row;
        const double *const a = blocks + 9 * ranges[r].begin;
        const unsigned int *c = columns + ranges[r].begin;
        const std::size_t   n = ranges[r].size();
        for (std::size_t k = 0; k < n; ++k)
          {
            __builtin_prefetch(a + 9 * (k + blocks_ahead));
            row.add(a + 9 * k, x + 3 * static_cast<std::size_t>(c[k]));
          }
        row.write(sums + 3 * r);
      }
  }



  SIGNORINI_VECTORIZED
  void multiply_block_ranges_backward(double *const sums, const double *const blocks,
                                      const unsigned int *const columns, const BlockRange *const ranges,
                                      const unsigned int n_ranges, const double *const x)
  {
    for (unsigned int r = n_ranges; r-- > 0;)
      {
        RowSum              row;
        const double *const a = blocks + 9 * ranges[r].begin;
        const unsigned int *c = columns + ranges[r].begin;
        for (std::size_t k = ranges[r].size(); k-- > 0;)
          {
            __builtin_prefetch(a + 9 * k - 9 * blocks_ahead);
            row.add(a + 9 * k, x + 3 * static_cast<std::size_t>(c[k]));
          }
        row.write(sums + 3 * r);
      }
  }



  SIGNORINI_VECTORIZED
  void subtract_transposed_blocks(double *const values, const double *const blocks,
                                  const unsigned int *const columns, const BlockRange range,
                                  const double *const change)
  {
    const double  c0 = change[0], c1 = change[1], c2 = change[2];
    const Vector2 d0 = {c0, c0}, d1 = {c1, c1}, d2 = {c2, c2};
    for (std::size_t k = range.begin; k < range.end; ++k)
      {
        const double *const a = blocks + 9 * k;
        double *const       y = values + 3 * static_cast<std::size_t>(columns[k]);
        Vector2             a0, a1, a2, first;
        std::memcpy(&a0, a, sizeof(Vector2));
        std::memcpy(&a1, a + 3, sizeof(Vector2));
        std::memcpy(&a2, a + 6, sizeof(Vector2));
        std::memcpy(&first, y, sizeof(Vector2));
        first -= d0 * a0 + d1 * a1 + d2 * a2;
        std::memcpy(y, &first, sizeof(Vector2));
        y[2] -= c0 * a[2] + c1 * a[5] + c2 * a[8];
      }
  }
} // namespace Signorini
