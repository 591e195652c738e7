// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>

#ifdef SIGNORINI_AVX2
#  include <immintrin.h>
#endif

namespace Signorini
{
  namespace
  {
    /// How many blocks ahead memory is asked for: the hardware's own fetching starts anew on each page.
    constexpr std::size_t blocks_ahead = 32;
    constexpr std::size_t line         = 64;

    /// Asks for the two blocks that are read `blocks_ahead` later.
    template <bool backward>
    inline __attribute__((always_inline)) void ask_for_two_blocks(const double *const block)
    {
      const char *const p =
          reinterpret_cast<const char *>(backward ? block - 9 * blocks_ahead - 9 : block + 9 * blocks_ahead);
      __builtin_prefetch(p);
      __builtin_prefetch(p + line);
      __builtin_prefetch(p + 2 * line);
    }

    /// Plain loops, for processors without AVX2.
    namespace Plain
    {
      template <bool backward>
      void multiply(double *const sums, const double *const blocks, const unsigned int *const columns,
                    const BlockRange *const ranges, const unsigned int n_ranges, const double *const x)
      {
        for (unsigned int r = 0; r < n_ranges; ++r)
          {
            double s[3] = {0., 0., 0.};
            for (std::size_t i = 0; i < ranges[r].size(); ++i)
              {
                const std::size_t   k = backward ? ranges[r].end - 1 - i : ranges[r].begin + i;
                const double *const a = blocks + 9 * k;
                const double *const y = x + 3 * static_cast<std::size_t>(columns[k]);
                if (i % 2 == 0)
                  ask_for_two_blocks<backward>(a);
                for (unsigned int c = 0; c < 3; ++c)
                  s[c] += a[3 * c] * y[0] + a[3 * c + 1] * y[1] + a[3 * c + 2] * y[2];
              }
            std::memcpy(sums + 3 * r, s, sizeof(s));
          }
      }

      void subtract_transposed(double *const values, const double *const blocks,
                               const unsigned int *const columns, const BlockRange range,
                               const double *const change)
      {
        const double c0 = change[0], c1 = change[1], c2 = change[2];
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const double *const a = blocks + 9 * k;
            double *const       y = values + 3 * static_cast<std::size_t>(columns[k]);
            for (unsigned int c = 0; c < 3; ++c)
              y[c] -= c0 * a[c] + c1 * a[3 + c] + c2 * a[6 + c];
          }
      }

      void multiply_mirrored(double *const sums, const MirroredBlocks &row, const double *const x)
      {
        double s[3] = {0., 0., 0.};
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const double *const a = row.blocks + 9 * static_cast<std::size_t>(row.positions[m]);
            const double *const y = x + 3 * static_cast<std::size_t>(row.columns[m]);
            for (unsigned int c = 0; c < 3; ++c)
              s[c] += a[c] * y[0] + a[3 + c] * y[1] + a[6 + c] * y[2];
          }
        std::memcpy(sums, s, sizeof(s));
      }

      void subtract_mirrored(double *const values, const MirroredBlocks &row, const double *const change)
      {
        const double c0 = change[0], c1 = change[1], c2 = change[2];
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const double *const a = row.blocks + 9 * static_cast<std::size_t>(row.positions[m]);
            double *const       y = values + 3 * static_cast<std::size_t>(row.columns[m]);
            for (unsigned int c = 0; c < 3; ++c)
              y[c] -= a[3 * c] * c0 + a[3 * c + 1] * c1 + a[3 * c + 2] * c2;
          }
      }
    } // namespace Plain



#ifdef SIGNORINI_AVX2
    /// Three numbers at once. The rows of a block are read with the number behind them, which meets a zero or
    /// is not written.
    namespace Avx2
    {
      SIGNORINI_AVX2 inline __m256d load(const double *const x)
      {
        return _mm256_maskload_pd(x, _mm256_setr_epi64x(-1, -1, -1, 0));
      }

      SIGNORINI_AVX2 inline void store(double *const x, const __m256d numbers)
      {
        _mm_storeu_pd(x, _mm256_castpd256_pd128(numbers));
        _mm_store_sd(x + 2, _mm256_extractf128_pd(numbers, 1));
      }

      /// Products with the rows of blocks, number by number.
      struct RowSum
      {
        __m256d rows[3];

        SIGNORINI_AVX2 inline void reset()
        {
          rows[0] = rows[1] = rows[2] = _mm256_setzero_pd();
        }

        SIGNORINI_AVX2 inline void add(const double *const a, const double *const x)
        {
          const __m256d y = load(x);
          rows[0]         = _mm256_fmadd_pd(_mm256_loadu_pd(a), y, rows[0]);
          rows[1]         = _mm256_fmadd_pd(_mm256_loadu_pd(a + 3), y, rows[1]);
          rows[2]         = _mm256_fmadd_pd(_mm256_loadu_pd(a + 6), y, rows[2]);
        }

        SIGNORINI_AVX2 inline void write(double *const sum, const RowSum &other) const
        {
          const __m256d pairs = _mm256_hadd_pd(_mm256_add_pd(rows[0], other.rows[0]),
                                               _mm256_add_pd(rows[1], other.rows[1])),
                        third = _mm256_add_pd(rows[2], other.rows[2]);
          _mm_storeu_pd(sum, _mm_add_pd(_mm256_castpd256_pd128(pairs), _mm256_extractf128_pd(pairs, 1)));
          const __m128d low = _mm256_castpd256_pd128(third);
          _mm_store_sd(sum + 2, _mm_add_sd(_mm_hadd_pd(low, low), _mm256_extractf128_pd(third, 1)));
        }
      };

      /// Two sums, so that one need not wait for the other.
      template <bool backward>
      SIGNORINI_AVX2 void multiply(double *const sums, const double *const blocks,
                                   const unsigned int *const columns, const BlockRange *const ranges,
                                   const unsigned int n_ranges, const double *const x)
      {
        for (unsigned int i = 0; i < n_ranges; ++i)
          {
            const unsigned int   r    = backward ? n_ranges - 1 - i : i;
            const std::ptrdiff_t step = backward ? -1 : 1;
            const std::size_t    n    = ranges[r].size();
            const double        *a    = blocks + 9 * (backward ? ranges[r].end - 1 : ranges[r].begin);
            const unsigned int  *c    = columns + (backward ? ranges[r].end - 1 : ranges[r].begin);
            RowSum               one, other;
            one.reset();
            other.reset();
            for (std::size_t k = 0; k + 1 < n; k += 2, a += 18 * step, c += 2 * step)
              {
                ask_for_two_blocks<backward>(a);
                one.add(a, x + 3 * static_cast<std::size_t>(c[0]));
                other.add(a + 9 * step, x + 3 * static_cast<std::size_t>(c[step]));
              }
            if (n % 2 == 1)
              one.add(a, x + 3 * static_cast<std::size_t>(c[0]));
            one.write(sums + 3 * r, other);
          }
      }

      SIGNORINI_AVX2 void subtract_transposed(double *const values, const double *const blocks,
                                              const unsigned int *const columns, const BlockRange range,
                                              const double *const change)
      {
        const __m256d c0 = _mm256_set1_pd(change[0]), c1 = _mm256_set1_pd(change[1]),
                      c2 = _mm256_set1_pd(change[2]);
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const double *const a   = blocks + 9 * k;
            double *const       y   = values + 3 * static_cast<std::size_t>(columns[k]);
            __m256d             sum = load(y);
            sum                     = _mm256_fnmadd_pd(c0, _mm256_loadu_pd(a), sum);
            sum                     = _mm256_fnmadd_pd(c1, _mm256_loadu_pd(a + 3), sum);
            sum                     = _mm256_fnmadd_pd(c2, _mm256_loadu_pd(a + 6), sum);
            store(y, sum);
          }
      }

      /// The sum of products with the columns of blocks, added up over the numbers of x.
      SIGNORINI_AVX2 void multiply_mirrored(double *const sums, const MirroredBlocks &row,
                                            const double *const x)
      {
        __m256d one = _mm256_setzero_pd(), two = one, three = one;
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const double *const a = row.blocks + 9 * static_cast<std::size_t>(row.positions[m]);
            const double *const y = x + 3 * static_cast<std::size_t>(row.columns[m]);
            one                   = _mm256_fmadd_pd(_mm256_loadu_pd(a), _mm256_broadcast_sd(y), one);
            two                   = _mm256_fmadd_pd(_mm256_loadu_pd(a + 3), _mm256_broadcast_sd(y + 1), two);
            three = _mm256_fmadd_pd(_mm256_loadu_pd(a + 6), _mm256_broadcast_sd(y + 2), three);
          }
        store(sums, _mm256_add_pd(_mm256_add_pd(one, two), three));
      }

      SIGNORINI_AVX2 void subtract_mirrored(double *const values, const MirroredBlocks &row,
                                            const double *const change)
      {
        for (std::size_t m = 0; m < row.n; ++m)
          {
            RowSum product, nothing;
            product.reset();
            nothing.reset();
            product.add(row.blocks + 9 * static_cast<std::size_t>(row.positions[m]), change);
            double sum[3];
            product.write(sum, nothing);
            double *const y = values + 3 * static_cast<std::size_t>(row.columns[m]);
            for (unsigned int c = 0; c < 3; ++c)
              y[c] -= sum[c];
          }
      }
    } // namespace Avx2

    bool has_avx2()
    {
      __builtin_cpu_init();
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    }

    bool avx2_is_used = has_avx2();
#endif
  } // namespace



  bool uses_avx2()
  {
#ifdef SIGNORINI_AVX2
    return avx2_is_used;
#else
    return false;
#endif
  }



  bool use_avx2([[maybe_unused]] const bool wanted)
  {
#ifdef SIGNORINI_AVX2
    avx2_is_used = wanted && has_avx2();
#endif
    return uses_avx2();
  }



  void multiply_block_ranges(double *const sums, const double *const blocks,
                             const unsigned int *const columns, const BlockRange *const ranges,
                             const unsigned int n_ranges, const double *const x)
  {
#ifdef SIGNORINI_AVX2
    if (avx2_is_used)
      return Avx2::multiply<false>(sums, blocks, columns, ranges, n_ranges, x);
#endif
    Plain::multiply<false>(sums, blocks, columns, ranges, n_ranges, x);
  }



  void multiply_block_ranges_backward(double *const sums, const double *const blocks,
                                      const unsigned int *const columns, const BlockRange *const ranges,
                                      const unsigned int n_ranges, const double *const x)
  {
#ifdef SIGNORINI_AVX2
    if (avx2_is_used)
      return Avx2::multiply<true>(sums, blocks, columns, ranges, n_ranges, x);
#endif
    Plain::multiply<true>(sums, blocks, columns, ranges, n_ranges, x);
  }



  void subtract_transposed_blocks(double *const values, const double *const blocks,
                                  const unsigned int *const columns, const BlockRange range,
                                  const double *const change)
  {
#ifdef SIGNORINI_AVX2
    if (avx2_is_used)
      return Avx2::subtract_transposed(values, blocks, columns, range, change);
#endif
    Plain::subtract_transposed(values, blocks, columns, range, change);
  }



  void multiply_mirrored_blocks(double *const sums, const MirroredBlocks &row, const double *const x)
  {
#ifdef SIGNORINI_AVX2
    if (avx2_is_used)
      return Avx2::multiply_mirrored(sums, row, x);
#endif
    Plain::multiply_mirrored(sums, row, x);
  }



  void subtract_mirrored_blocks(double *const values, const MirroredBlocks &row, const double *const change)
  {
#ifdef SIGNORINI_AVX2
    if (avx2_is_used)
      return Avx2::subtract_mirrored(values, row, change);
#endif
    Plain::subtract_mirrored(values, row, change);
  }
} // namespace Signorini
