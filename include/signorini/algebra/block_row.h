// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_block_row_h
#define signorini_algebra_block_row_h

#include <cstddef>
#include <cstdint>
#include <cstring>

// Compiled for processors with AVX2 as well; the loader chooses. Distributions build for the oldest
// processor.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define SIGNORINI_VECTORIZED __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#  define SIGNORINI_VECTORIZED
#endif

// For functions that are written for AVX2 by hand; whether the processor has it is asked by uses_avx2().
#if defined(__x86_64__) && defined(__GNUC__)
#  define SIGNORINI_AVX2 __attribute__((target("avx2,fma")))
#endif

namespace Signorini
{
  /// See put_together().
  constexpr double unit_of_remainders = 0x1p-53;

  /// Positions of consecutive blocks.
  struct BlockRange
  {
    /// The blocks from begin to end - 1, as numbers of the arrays of a matrix.
    std::size_t begin = 0, end = 0;

    /// Number of blocks.
    std::size_t size() const
    {
      return end - begin;
    }
  };

  /// A number in double precision is one in single precision and what is missing then, an integer of 32 bits
  /// in units of 2⁻⁵³ times the power of two of the former.
  inline double put_together(const float rounded, const std::int32_t remainder)
  {
    constexpr std::uint64_t exponent = 0x7ff0000000000000;
    const double            x        = rounded;
    std::uint64_t           bits;
    std::memcpy(&bits, &x, sizeof(bits));
    bits &= exponent;
    double power;
    std::memcpy(&power, &bits, sizeof(power));
    return x + remainder * unit_of_remainders * power;
  }

  /// The numbers of 3x3 blocks in memory, nine each, row by row: in double precision, or from some position
  /// on rounded and what is missing then. What only needs them rounded has half as much to read.
  struct BlockNumbers
  {
    /// Those before the first one that is split, and a number more.
    const double *exact;
    /// Where blocks begin that are split.
    std::size_t first_split;
    /// The numbers from there on, and eight more: put_together().
    const float        *rounded;
    const std::int32_t *remainders; ///< See there.

    /// Nine numbers of the block at position k.
    void read(double *const to, const std::size_t k) const
    {
      if (k < first_split)
        std::memcpy(to, exact + 9 * k, 9 * sizeof(double));
      else
        for (std::size_t i = 9 * (k - first_split), c = 0; c < 9; ++c)
          to[c] = put_together(rounded[i + c], remainders[i + c]);
    }

    /// The trace of that block.
    double trace(const std::size_t k) const
    {
      double numbers[9];
      read(numbers, k);
      return numbers[0] + numbers[4] + numbers[8];
    }
  };

  /// Four numbers at once.
  typedef double Vector4 __attribute__((vector_size(4 * sizeof(double))));

  /// Kernels on consecutive 3x3 blocks. Products ask for memory further on in the direction of reading. Of a
  /// range all blocks are split, or none.
  ///
  /// sums[3 r + c] = Σ_k (A_k x_{columns[k]})_c over the blocks k of range r, reading forward.
  void multiply_block_ranges(double *sums, const BlockNumbers &blocks, const unsigned int *columns,
                             const BlockRange *ranges, unsigned int n_ranges, const double *x);

  /// The same, reading from the last block to the first: for sweeps that go backward.
  void multiply_block_ranges_backward(double *sums, const BlockNumbers &blocks, const unsigned int *columns,
                                      const BlockRange *ranges, unsigned int n_ranges, const double *x);

  /// values_{columns[k]} -= A_kᵀ change for the blocks of a range: what a change of the row's node does to
  /// its neighbours.
  void subtract_transposed_blocks(double *values, const BlockNumbers &blocks, const unsigned int *columns,
                                  const BlockRange range, const double *change);

  /// Both at once, for a row of a symmetric matrix: values_row -= Σ_k A_k x_{columns[k]}, and
  /// values_{columns[k]} -= A_kᵀ x_row.
  void subtract_both_ways(double *values, unsigned int row, const BlockNumbers &blocks,
                          const unsigned int *columns, const BlockRange range, const double *x);

  /// Blocks that are in memory transposed, anywhere: A_m is the transposed block at positions[m]. All are
  /// split, or none.
  struct MirroredBlocks
  {
    /// Of all positions.
    BlockNumbers blocks;
    /// Positions and columns of a row.
    const unsigned int *positions, *columns;
    /// How many.
    std::size_t n;
  };

  /// sums[c] = Σ_m (A_m x_{columns[m]})_c.
  void multiply_mirrored_blocks(double *sums, const MirroredBlocks &row, const double *x);

  /// values_{columns[m]} -= A_mᵀ change.
  void subtract_mirrored_blocks(double *values, const MirroredBlocks &row, const double *change);

  /// Whether kernels use AVX2: where the processor has it.
  bool uses_avx2();

  /// Lets them use it or not; whether they do now. For tests.
  bool use_avx2(const bool wanted);

  /// y[c] += w[c] * x[c], c < 9: four weights, four more and the last.
  inline __attribute__((always_inline)) void add_weighted_block(double *const y, const double *const x,
                                                                const Vector4 &first, const Vector4 &second,
                                                                const double last)
  {
    Vector4 x_first, x_second, y_first, y_second;
    std::memcpy(&x_first, x, sizeof(Vector4));
    std::memcpy(&x_second, x + 4, sizeof(Vector4));
    std::memcpy(&y_first, y, sizeof(Vector4));
    std::memcpy(&y_second, y + 4, sizeof(Vector4));
    y_first += first * x_first;
    y_second += second * x_second;
    std::memcpy(y, &y_first, sizeof(Vector4));
    std::memcpy(y + 4, &y_second, sizeof(Vector4));
    y[8] += last * x[8];
  }



  /// y += weight * x, blocks.
  inline __attribute__((always_inline)) void add_scaled_block(double *const y, const double weight,
                                                              const double *const x)
  {
    const Vector4 weights = {weight, weight, weight, weight};
    add_weighted_block(y, x, weights, weights, weight);
  }



  /// y += x diag(w), blocks.
  inline __attribute__((always_inline)) void add_block_times_diagonal(double *const y, const double *const x,
                                                                      const double *const w)
  {
    add_weighted_block(y, x, Vector4{w[0], w[1], w[2], w[0]}, Vector4{w[1], w[2], w[0], w[1]}, w[2]);
  }



  /// y += diag(w) x, blocks.
  inline __attribute__((always_inline)) void add_diagonal_times_block(double *const y, const double *const w,
                                                                      const double *const x)
  {
    add_weighted_block(y, x, Vector4{w[0], w[0], w[0], w[1]}, Vector4{w[1], w[1], w[2], w[2]}, w[2]);
  }
} // namespace Signorini

#endif
