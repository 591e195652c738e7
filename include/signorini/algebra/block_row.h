// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_block_row_h
#define signorini_algebra_block_row_h

#include <cstddef>
#include <cstring>

// Compiled for processors with AVX2 as well; the loader chooses. Distributions build for the oldest
// processor.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define SIGNORINI_VECTORIZED __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#  define SIGNORINI_VECTORIZED
#endif

namespace Signorini
{
  /// Kernels on consecutive 3x3 blocks (nine numbers each, row by row). `wanted` is where the blocks of a
  /// later call begin: their memory is asked for on the way. Without that the hardware's own fetching loses a
  /// quarter of the bandwidth, and more where rows are read in part.
  ///
  /// sum[c] = Σ_k (A_k x_{columns[k]})_c over n blocks, reading forward.
  void multiply_block_row(double *sum, const double *blocks, const unsigned int *columns, std::size_t n,
                          const double *x, const double *wanted);

  /// The same, reading from the last block to the first: for sweeps that go backward.
  void multiply_block_row_backward(double *sum, const double *blocks, const unsigned int *columns,
                                   std::size_t n, const double *x, const double *wanted);

  /// values_{columns[k]} -= A_kᵀ change for n blocks: what a change of the row's node does to its neighbours,
  /// if the matrix is symmetric.
  void subtract_transposed_block_row(double *values, const double *blocks, const unsigned int *columns,
                                     std::size_t n, const double *change);

  /// How many calls ahead `wanted` should be.
  constexpr unsigned int rows_ahead = 6;

  /// y[c] += weight * x[c], c < 9.
  inline __attribute__((always_inline)) void add_scaled_block(double *const y, const double weight,
                                                              const double *const x)
  {
    typedef double Vector4 __attribute__((vector_size(4 * sizeof(double))));
    Vector4        x_first, x_second, y_first, y_second;
    std::memcpy(&x_first, x, sizeof(Vector4));
    std::memcpy(&x_second, x + 4, sizeof(Vector4));
    std::memcpy(&y_first, y, sizeof(Vector4));
    std::memcpy(&y_second, y + 4, sizeof(Vector4));
    y_first += weight * x_first;
    y_second += weight * x_second;
    std::memcpy(y, &y_first, sizeof(Vector4));
    std::memcpy(y + 4, &y_second, sizeof(Vector4));
    y[8] += weight * x[8];
  }
} // namespace Signorini

#endif
