// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>

namespace Signorini
{
  namespace
  {
    typedef double Vector4 __attribute__((vector_size(4 * sizeof(double))));

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
  void multiply_block_row(double *const sum, const double *const blocks, const unsigned int *const columns,
                          const std::size_t n, const double *const x, const double *const wanted)
  {
    RowSum row;
    for (std::size_t k = 0; k < n; ++k)
      {
        __builtin_prefetch(wanted + 9 * k);
        row.add(blocks + 9 * k, x + 3 * static_cast<std::size_t>(columns[k]));
      }
    row.write(sum);
  }



  SIGNORINI_VECTORIZED
  void multiply_block_row_backward(double *const sum, const double *const blocks,
                                   const unsigned int *const columns, const std::size_t n,
                                   const double *const x, const double *const wanted)
  {
    RowSum row;
    for (std::size_t k = n; k-- > 0;)
      {
        __builtin_prefetch(wanted + 9 * k);
        row.add(blocks + 9 * k, x + 3 * static_cast<std::size_t>(columns[k]));
      }
    row.write(sum);
  }


  SIGNORINI_VECTORIZED
  void subtract_transposed_block_row(double *const values, const double *const blocks,
                                     const unsigned int *const columns, const std::size_t n,
                                     const double *const change)
  {
    const double c0 = change[0], c1 = change[1], c2 = change[2];
    for (std::size_t k = 0; k < n; ++k)
      {
        const double *const a = blocks + 9 * k;
        double *const       y = values + 3 * static_cast<std::size_t>(columns[k]);
        y[0] -= c0 * a[0] + c1 * a[3] + c2 * a[6];
        y[1] -= c0 * a[1] + c1 * a[4] + c2 * a[7];
        y[2] -= c0 * a[2] + c1 * a[5] + c2 * a[8];
      }
  }
} // namespace Signorini
