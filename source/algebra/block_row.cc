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
    template <bool backward, typename Number>
    inline __attribute__((always_inline)) void ask_for_two_blocks(const Number *const block)
    {
      const char *const p =
          reinterpret_cast<const char *>(backward ? block - 9 * blocks_ahead - 9 : block + 9 * blocks_ahead);
      __builtin_prefetch(p);
      __builtin_prefetch(p + line);
      if (sizeof(Number) == sizeof(double))
        __builtin_prefetch(p + 2 * line);
    }

    /// Where kernels find blocks of one kind.
    struct ExactBlocks
    {
      explicit ExactBlocks(const BlockNumbers &blocks)
        : numbers(blocks.exact)
      {
      }

      /// Nine numbers.
      struct Block
      {
        const double *numbers;

        double operator[](const unsigned int c) const
        {
          return numbers[c];
        }

        template <bool backward>
        inline __attribute__((always_inline)) void ask_ahead() const
        {
          ask_for_two_blocks<backward>(numbers);
        }

#ifdef SIGNORINI_AVX2
        /// The numbers from c to c + 3.
        SIGNORINI_AVX2 inline __m256d load(const unsigned int c) const
        {
          return _mm256_loadu_pd(numbers + c);
        }
#endif
      };

      Block operator[](const std::size_t k) const
      {
        return {numbers + 9 * k};
      }

      const double *numbers;
    };

    /// Rounded, and what is missing then.
    struct SplitBlocks
    {
      explicit SplitBlocks(const BlockNumbers &blocks)
        : rounded(blocks.rounded)
        , remainders(blocks.remainders)
        , first(blocks.first_split)
      {
      }

      struct Block
      {
        const float        *rounded;
        const std::int32_t *remainders;

        double operator[](const unsigned int c) const
        {
          return put_together(rounded[c], remainders[c]);
        }

        template <bool backward>
        inline __attribute__((always_inline)) void ask_ahead() const
        {
          ask_for_two_blocks<backward>(rounded);
          ask_for_two_blocks<backward>(remainders);
        }

#ifdef SIGNORINI_AVX2
        SIGNORINI_AVX2 inline __m256d load(const unsigned int c) const
        {
          const __m256d exponent = _mm256_castsi256_pd(_mm256_set1_epi64x(0x7ff0000000000000));
          const __m256d x        = _mm256_cvtps_pd(_mm_loadu_ps(rounded + c));
          const __m256d remainder =
              _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i *>(remainders + c)));
          return _mm256_fmadd_pd(_mm256_mul_pd(remainder, _mm256_set1_pd(unit_of_remainders)),
                                 _mm256_and_pd(x, exponent), x);
        }
#endif
      };

      Block operator[](const std::size_t k) const
      {
        return {rounded + 9 * (k - first), remainders + 9 * (k - first)};
      }

      const float        *rounded;
      const std::int32_t *remainders;
      std::size_t         first;
    };

    /// Calls action(blocks of one kind).
    template <typename Action>
    inline void with_kind(const BlockNumbers &blocks, const std::size_t position, const Action &action)
    {
      if (position < blocks.first_split)
        action(ExactBlocks(blocks));
      else
        action(SplitBlocks(blocks));
    }

    /// Plain loops, for processors without AVX2.
    namespace Plain
    {
      template <bool backward, typename Blocks>
      void multiply(double *const sum, const Blocks &blocks, const unsigned int *const columns,
                    const BlockRange &range, const double *const x)
      {
        double s[3] = {0., 0., 0.};
        for (std::size_t i = 0; i < range.size(); ++i)
          {
            const std::size_t   k = backward ? range.end - 1 - i : range.begin + i;
            const auto          a = blocks[k];
            const double *const y = x + 3 * static_cast<std::size_t>(columns[k]);
            if (i % 2 == 0)
              a.template ask_ahead<backward>();
            for (unsigned int c = 0; c < 3; ++c)
              s[c] += a[3 * c] * y[0] + a[3 * c + 1] * y[1] + a[3 * c + 2] * y[2];
          }
        std::memcpy(sum, s, sizeof(s));
      }

      template <typename Blocks>
      void subtract_transposed(double *const values, const Blocks &blocks, const unsigned int *const columns,
                               const BlockRange &range, const double *const change)
      {
        const double c0 = change[0], c1 = change[1], c2 = change[2];
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const auto    a = blocks[k];
            double *const y = values + 3 * static_cast<std::size_t>(columns[k]);
            for (unsigned int c = 0; c < 3; ++c)
              y[c] -= c0 * a[c] + c1 * a[3 + c] + c2 * a[6 + c];
          }
      }

      template <typename Blocks>
      void subtract_both_ways(double *const values, const unsigned int row, const Blocks &blocks,
                              const unsigned int *const columns, const BlockRange &range,
                              const double *const x)
      {
        const std::size_t here = 3 * static_cast<std::size_t>(row);
        double            sum[3];
        multiply<false>(sum, blocks, columns, range, x);
        subtract_transposed(values, blocks, columns, range, x + here);
        for (unsigned int c = 0; c < 3; ++c)
          values[here + c] -= sum[c];
      }

      template <typename Blocks>
      void multiply_mirrored(double *const sums, const Blocks &blocks, const MirroredBlocks &row,
                             const double *const x)
      {
        double s[3] = {0., 0., 0.};
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const auto          a = blocks[row.positions[m]];
            const double *const y = x + 3 * static_cast<std::size_t>(row.columns[m]);
            for (unsigned int c = 0; c < 3; ++c)
              s[c] += a[c] * y[0] + a[3 + c] * y[1] + a[6 + c] * y[2];
          }
        std::memcpy(sums, s, sizeof(s));
      }

      template <typename Blocks>
      void subtract_mirrored(double *const values, const Blocks &blocks, const MirroredBlocks &row,
                             const double *const change)
      {
        const double c0 = change[0], c1 = change[1], c2 = change[2];
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const auto    a = blocks[row.positions[m]];
            double *const y = values + 3 * static_cast<std::size_t>(row.columns[m]);
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

        template <typename Block>
        SIGNORINI_AVX2 inline void add(const Block &a, const double *const x)
        {
          const __m256d y = load(x);
          rows[0]         = _mm256_fmadd_pd(a.load(0), y, rows[0]);
          rows[1]         = _mm256_fmadd_pd(a.load(3), y, rows[1]);
          rows[2]         = _mm256_fmadd_pd(a.load(6), y, rows[2]);
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
      template <bool backward, typename Blocks>
      SIGNORINI_AVX2 void multiply(double *const sum, const Blocks &blocks, const unsigned int *const columns,
                                   const BlockRange &range, const double *const x)
      {
        const std::ptrdiff_t step = backward ? -1 : 1;
        const std::size_t    n    = range.size();
        std::size_t          k    = backward ? range.end - 1 : range.begin;
        RowSum               one, other;
        one.reset();
        other.reset();
        for (std::size_t i = 0; i + 1 < n; i += 2, k += 2 * step)
          {
            const auto a = blocks[k];
            a.template ask_ahead<backward>();
            one.add(a, x + 3 * static_cast<std::size_t>(columns[k]));
            other.add(blocks[k + step], x + 3 * static_cast<std::size_t>(columns[k + step]));
          }
        if (n % 2 == 1)
          one.add(blocks[k], x + 3 * static_cast<std::size_t>(columns[k]));
        one.write(sum, other);
      }

      template <typename Blocks>
      SIGNORINI_AVX2 void subtract_transposed(double *const values, const Blocks &blocks,
                                              const unsigned int *const columns, const BlockRange &range,
                                              const double *const change)
      {
        const __m256d c0 = _mm256_set1_pd(change[0]), c1 = _mm256_set1_pd(change[1]),
                      c2 = _mm256_set1_pd(change[2]);
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const auto    a   = blocks[k];
            double *const y   = values + 3 * static_cast<std::size_t>(columns[k]);
            __m256d       sum = load(y);
            sum               = _mm256_fnmadd_pd(c0, a.load(0), sum);
            sum               = _mm256_fnmadd_pd(c1, a.load(3), sum);
            sum               = _mm256_fnmadd_pd(c2, a.load(6), sum);
            store(y, sum);
          }
      }

      /// A block is read, and put together where it is split, once.
      template <typename Blocks>
      SIGNORINI_AVX2 void subtract_both_ways(double *const values, const unsigned int row,
                                             const Blocks &blocks, const unsigned int *const columns,
                                             const BlockRange &range, const double *const x)
      {
        const double *const x_row = x + 3 * static_cast<std::size_t>(row);
        const __m256d       c0 = _mm256_set1_pd(x_row[0]), c1 = _mm256_set1_pd(x_row[1]),
                      c2 = _mm256_set1_pd(x_row[2]);
        RowSum one, nothing;
        one.reset();
        nothing.reset();
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const auto a = blocks[k];
            if ((k - range.begin) % 2 == 0)
              a.template ask_ahead<false>();
            const std::size_t column = 3 * static_cast<std::size_t>(columns[k]);
            const __m256d     a0 = a.load(0), a1 = a.load(3), a2 = a.load(6), y = load(x + column);
            one.rows[0]   = _mm256_fmadd_pd(a0, y, one.rows[0]);
            one.rows[1]   = _mm256_fmadd_pd(a1, y, one.rows[1]);
            one.rows[2]   = _mm256_fmadd_pd(a2, y, one.rows[2]);
            __m256d other = _mm256_fnmadd_pd(c0, a0, load(values + column));
            other         = _mm256_fnmadd_pd(c1, a1, other);
            other         = _mm256_fnmadd_pd(c2, a2, other);
            store(values + column, other);
          }
        double sum[3];
        one.write(sum, nothing);
        for (unsigned int c = 0; c < 3; ++c)
          values[3 * static_cast<std::size_t>(row) + c] -= sum[c];
      }

      /// The sum of products with the columns of blocks, added up over the numbers of x.
      template <typename Blocks>
      SIGNORINI_AVX2 void multiply_mirrored(double *const sums, const Blocks &blocks,
                                            const MirroredBlocks &row, const double *const x)
      {
        __m256d one = _mm256_setzero_pd(), two = one, three = one;
        for (std::size_t m = 0; m < row.n; ++m)
          {
            const auto          a = blocks[row.positions[m]];
            const double *const y = x + 3 * static_cast<std::size_t>(row.columns[m]);
            one                   = _mm256_fmadd_pd(a.load(0), _mm256_broadcast_sd(y), one);
            two                   = _mm256_fmadd_pd(a.load(3), _mm256_broadcast_sd(y + 1), two);
            three                 = _mm256_fmadd_pd(a.load(6), _mm256_broadcast_sd(y + 2), three);
          }
        store(sums, _mm256_add_pd(_mm256_add_pd(one, two), three));
      }

      template <typename Blocks>
      SIGNORINI_AVX2 void subtract_mirrored(double *const values, const Blocks &blocks,
                                            const MirroredBlocks &row, const double *const change)
      {
        for (std::size_t m = 0; m < row.n; ++m)
          {
            RowSum product, nothing;
            product.reset();
            nothing.reset();
            product.add(blocks[row.positions[m]], change);
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



  namespace
  {
    template <bool backward>
    void multiply_ranges(double *const sums, const BlockNumbers &blocks, const unsigned int *const columns,
                         const BlockRange *const ranges, const unsigned int n_ranges, const double *const x)
    {
      for (unsigned int i = 0; i < n_ranges; ++i)
        {
          const unsigned int r = backward ? n_ranges - 1 - i : i;
          with_kind(blocks, ranges[r].begin, [&](const auto &of_kind) {
#ifdef SIGNORINI_AVX2
            if (avx2_is_used)
              return Avx2::multiply<backward>(sums + 3 * r, of_kind, columns, ranges[r], x);
#endif
            Plain::multiply<backward>(sums + 3 * r, of_kind, columns, ranges[r], x);
          });
        }
    }
  } // namespace



  void multiply_block_ranges(double *const sums, const BlockNumbers &blocks,
                             const unsigned int *const columns, const BlockRange *const ranges,
                             const unsigned int n_ranges, const double *const x)
  {
    multiply_ranges<false>(sums, blocks, columns, ranges, n_ranges, x);
  }



  void multiply_block_ranges_backward(double *const sums, const BlockNumbers &blocks,
                                      const unsigned int *const columns, const BlockRange *const ranges,
                                      const unsigned int n_ranges, const double *const x)
  {
    multiply_ranges<true>(sums, blocks, columns, ranges, n_ranges, x);
  }



  void subtract_transposed_blocks(double *const values, const BlockNumbers &blocks,
                                  const unsigned int *const columns, const BlockRange range,
                                  const double *const change)
  {
    with_kind(blocks, range.begin, [&](const auto &of_kind) {
#ifdef SIGNORINI_AVX2
      if (avx2_is_used)
        return Avx2::subtract_transposed(values, of_kind, columns, range, change);
#endif
      Plain::subtract_transposed(values, of_kind, columns, range, change);
    });
  }



  void subtract_both_ways(double *const values, const unsigned int row, const BlockNumbers &blocks,
                          const unsigned int *const columns, const BlockRange range, const double *const x)
  {
    with_kind(blocks, range.begin, [&](const auto &of_kind) {
#ifdef SIGNORINI_AVX2
      if (avx2_is_used)
        return Avx2::subtract_both_ways(values, row, of_kind, columns, range, x);
#endif
      Plain::subtract_both_ways(values, row, of_kind, columns, range, x);
    });
  }



  void multiply_mirrored_blocks(double *const sums, const MirroredBlocks &row, const double *const x)
  {
    with_kind(row.blocks, row.n > 0 ? row.positions[0] : 0, [&](const auto &of_kind) {
#ifdef SIGNORINI_AVX2
      if (avx2_is_used)
        return Avx2::multiply_mirrored(sums, of_kind, row, x);
#endif
      Plain::multiply_mirrored(sums, of_kind, row, x);
    });
  }



  void subtract_mirrored_blocks(double *const values, const MirroredBlocks &row, const double *const change)
  {
    with_kind(row.blocks, row.n > 0 ? row.positions[0] : 0, [&](const auto &of_kind) {
#ifdef SIGNORINI_AVX2
      if (avx2_is_used)
        return Avx2::subtract_mirrored(values, of_kind, row, change);
#endif
      Plain::subtract_mirrored(values, of_kind, row, change);
    });
  }
} // namespace Signorini
