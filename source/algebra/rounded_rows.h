// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_algebra_rounded_rows_h
#define signorini_source_algebra_rounded_rows_h

#include <signorini/algebra/rounded_sweep.h>

#ifdef SIGNORINI_AVX2
#  include <immintrin.h>
#endif

namespace Signorini
{
  /// The rows of a RoundedSweep one after the other: arrays of floats, and nothing that knows of matrices.
  namespace RoundedRows
  {
    constexpr unsigned int n_entries = dim * dim;

    /// A row of the arrays.
    struct Row
    {
      Row(const RoundedSweep::Arrays &arrays, const std::size_t row)
        : n(arrays.lower_start[row + 1] - arrays.lower_start[row])
        , columns(arrays.columns + arrays.lower_start[row])
        , blocks(arrays.blocks + n_entries * (arrays.lower_start[row] - arrays.lower_start[0]))
        , inverse(arrays.inverses + n_entries * row)
      {
      }

      std::size_t n_pairs() const
      {
        return n > 0 ? (n - 1) / 2 : 0;
      }

      /// The last block, if there is one.
      const float *last() const
      {
        return blocks + n_entries * (n - 1);
      }

      std::size_t         n;
      const unsigned int *columns;
      const float        *blocks, *inverse;
    };

    inline float *node(float *const values, const std::size_t i)
    {
      return values + 4 * i;
    }

    /// Plain loops, for processors without AVX2.
    namespace Plain
    {
      inline void pass_down(const RoundedSweep::Arrays &arrays, const Row &row, const float *const change)
      {
        for (std::size_t k = 0; k < row.n; ++k)
          {
            const float *const a = row.blocks + n_entries * k;
            float *const       y = node(arrays.reduced, row.columns[k]);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                y[d] -= a[dim * c + d] * change[c];
          }
      }

      /// s -= Σ_j L_row,j x_j
      inline void multiply(float *const s, const RoundedSweep::Arrays &arrays, const Row &row)
      {
        for (std::size_t k = 0; k < row.n; ++k)
          {
            const float *const a = row.blocks + n_entries * k;
            const float *const y = node(arrays.values, row.columns[k]);
            for (unsigned int c = 0; c < dim; ++c)
              s[c] -= a[dim * c] * y[0] + a[dim * c + 1] * y[1] + a[dim * c + 2] * y[2];
          }
      }

      inline void relax(const RoundedSweep::Arrays &arrays, double *const v, const std::size_t begin,
                        const std::size_t end, const RoundedSweep::Options &options)
      {
        for (std::size_t k = begin; k < end; ++k)
          {
            const std::size_t i = options.backward ? begin + end - 1 - k : k;
            const Row         row(arrays, i);
            float *const x = node(arrays.values, i), *const reduced = node(arrays.reduced, i);
            float s[dim], change[dim];
            std::copy_n(reduced, dim, s);
            multiply(s, arrays, row);
            const float *const inverse = row.inverse;
            for (unsigned int c = 0; c < dim; ++c)
              {
                const float y = inverse[c] * s[0] + inverse[dim + c] * s[1] + inverse[2 * dim + c] * s[2];
                change[c]     = options.passes_all ? y : y - x[c];
                x[c]          = y;
                v[dim * static_cast<std::size_t>(arrays.order[i]) + c] = arrays.value_unit * y;
                if (options.keeps_residual)
                  reduced[c] = 0.f;
              }
            pass_down(arrays, row, change);
          }
      }
    } // namespace Plain



#ifdef SIGNORINI_AVX2
    /// A row of two blocks at once, with the number behind each: these are multiplied with the fourth numbers
    /// of nodes, which are zero.
    namespace Avx2
    {
#  define SIGNORINI_INLINE_AVX2 SIGNORINI_AVX2 inline __attribute__((always_inline))

      /// How far ahead memory is asked for, in bytes.
      constexpr std::ptrdiff_t bytes_ahead = 2304;
      constexpr std::ptrdiff_t line        = 64;

      /// Four numbers and four others.
      SIGNORINI_INLINE_AVX2 __m256 side_by_side(const float *const one, const float *const other)
      {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(one)), _mm_loadu_ps(other), 1);
      }

      /// The sums of the numbers of each, and a zero.
      SIGNORINI_INLINE_AVX2 __m128 add_up(const __m128 &a, const __m128 &b, const __m128 &c)
      {
        return _mm_hadd_ps(_mm_hadd_ps(a, b), _mm_hadd_ps(c, _mm_setzero_ps()));
      }

      /// Σ_j L_row,j x_j over all j < row but the last one, which the sweep has just changed if it goes
      /// forward. Reads backward in sweeps that go backward: memory is read in one direction throughout.
      template <bool backward>
      SIGNORINI_INLINE_AVX2 __m128 multiply_but_last(const RoundedSweep::Arrays &arrays, const Row &row)
      {
        const std::size_t    n_pairs = row.n_pairs();
        const std::ptrdiff_t step    = backward ? -1 : 1;
        const float         *a       = row.blocks;
        const unsigned int  *columns = row.columns;
        if (backward && n_pairs > 0)
          {
            a += 2 * n_entries * (n_pairs - 1);
            columns += 2 * (n_pairs - 1);
          }
        __m256 sums[dim] = {_mm256_setzero_ps(), _mm256_setzero_ps(), _mm256_setzero_ps()};
        for (std::size_t p = 0; p < n_pairs; ++p, a += 18 * step, columns += 2 * step)
          {
            const char *const ahead = reinterpret_cast<const char *>(a) + step * bytes_ahead;
            __builtin_prefetch(ahead);
            __builtin_prefetch(ahead + line);
            const __m256 both =
                side_by_side(node(arrays.values, columns[0]), node(arrays.values, columns[1]));
            sums[0] = _mm256_fmadd_ps(side_by_side(a, a + 9), both, sums[0]);
            sums[1] = _mm256_fmadd_ps(side_by_side(a + 3, a + 12), both, sums[1]);
            sums[2] = _mm256_fmadd_ps(side_by_side(a + 6, a + 15), both, sums[2]);
          }
        if (row.n > 0 && row.n % 2 == 0)
          {
            const float *const single = row.last() - n_entries;
            const __m256       x =
                _mm256_zextps128_ps256(_mm_loadu_ps(node(arrays.values, row.columns[row.n - 2])));
            for (unsigned int c = 0; c < dim; ++c)
              sums[c] = _mm256_fmadd_ps(_mm256_zextps128_ps256(_mm_loadu_ps(single + dim * c)), x, sums[c]);
          }
        __m128 s[dim];
        for (unsigned int c = 0; c < dim; ++c)
          s[c] = _mm_add_ps(_mm256_castps256_ps128(sums[c]), _mm256_extractf128_ps(sums[c], 1));
        return add_up(s[0], s[1], s[2]);
      }

      /// s less the product that multiply_but_last() leaves out.
      SIGNORINI_INLINE_AVX2 __m128 subtract_last(const __m128 &s, const RoundedSweep::Arrays &arrays,
                                                 const Row &row)
      {
        if (row.n == 0)
          return s;
        const float *const a = row.last();
        const __m128       x = _mm_loadu_ps(node(arrays.values, row.columns[row.n - 1]));
        return _mm_sub_ps(s, add_up(_mm_mul_ps(_mm_loadu_ps(a), x), _mm_mul_ps(_mm_loadu_ps(a + 3), x),
                                    _mm_mul_ps(_mm_loadu_ps(a + 6), x)));
      }

      SIGNORINI_INLINE_AVX2 void subtract(float *const values, const __m128 &change)
      {
        _mm_storeu_ps(values, _mm_sub_ps(_mm_loadu_ps(values), change));
      }

      SIGNORINI_INLINE_AVX2 void subtract_single(const RoundedSweep::Arrays &arrays, const float *const a,
                                                 const unsigned int column, const __m128 &c0,
                                                 const __m128 &c1, const __m128 &c2)
      {
        __m128 sum = _mm_mul_ps(c0, _mm_loadu_ps(a));
        sum        = _mm_fmadd_ps(c1, _mm_loadu_ps(a + 3), sum);
        sum        = _mm_fmadd_ps(c2, _mm_loadu_ps(a + 6), sum);
        subtract(node(arrays.reduced, column), sum);
      }

      /// The last block first: a sweep that goes backward needs it next.
      SIGNORINI_INLINE_AVX2 void pass_down(const RoundedSweep::Arrays &arrays, const Row &row,
                                           const __m128 &change)
      {
        if (row.n == 0)
          return;
        const __m128 c0 = _mm_permute_ps(change, 0), c1 = _mm_permute_ps(change, 0x55),
                     c2 = _mm_permute_ps(change, 0xaa);
        subtract_single(arrays, row.last(), row.columns[row.n - 1], c0, c1, c2);
        if (row.n % 2 == 0)
          subtract_single(arrays, row.last() - n_entries, row.columns[row.n - 2], c0, c1, c2);
        const __m256 w0 = _mm256_set_m128(c0, c0), w1 = _mm256_set_m128(c1, c1), w2 = _mm256_set_m128(c2, c2);
        const float *a              = row.blocks;
        const unsigned int *columns = row.columns;
        for (std::size_t p = row.n_pairs(); p > 0; --p, a += 18, columns += 2)
          {
            __m256 sum = _mm256_mul_ps(w0, side_by_side(a, a + 9));
            sum        = _mm256_fmadd_ps(w1, side_by_side(a + 3, a + 12), sum);
            sum        = _mm256_fmadd_ps(w2, side_by_side(a + 6, a + 15), sum);
            subtract(node(arrays.reduced, columns[0]), _mm256_castps256_ps128(sum));
            subtract(node(arrays.reduced, columns[1]), _mm256_extractf128_ps(sum, 1));
          }
      }

      template <bool backward>
      SIGNORINI_AVX2 inline void relax(const RoundedSweep::Arrays &arrays, double *const v,
                                       const std::size_t begin, const std::size_t end,
                                       const RoundedSweep::Options &options)
      {
        const auto at  = [&](const std::size_t k) { return backward ? begin + end - 1 - k : k; };
        __m128     sum = multiply_but_last<backward>(arrays, Row(arrays, at(begin)));
        for (std::size_t k = begin; k < end; ++k)
          {
            const std::size_t i = at(k);
            const Row         row(arrays, i);
            float *const x = node(arrays.values, i), *const reduced = node(arrays.reduced, i);
            const __m128       old = _mm_loadu_ps(x);
            const __m128       s   = subtract_last(_mm_sub_ps(_mm_loadu_ps(reduced), sum), arrays, row);
            const float *const d   = row.inverse;
            __m128             y   = _mm_mul_ps(_mm_permute_ps(s, 0), _mm_loadu_ps(d));
            y                      = _mm_fmadd_ps(_mm_permute_ps(s, 0x55), _mm_loadu_ps(d + 3), y);
            y                      = _mm_fmadd_ps(_mm_permute_ps(s, 0xaa), _mm_loadu_ps(d + 6), y);
            // The fourth number stays zero: products rely on it.
            y = _mm_blend_ps(y, _mm_setzero_ps(), 8);
            _mm_storeu_ps(x, y);
            if (options.keeps_residual)
              _mm_storeu_ps(reduced, _mm_setzero_ps());
            const __m256d exact = _mm256_mul_pd(_mm256_cvtps_pd(y), _mm256_set1_pd(arrays.value_unit));
            double *const here  = v + dim * static_cast<std::size_t>(arrays.order[i]);
            _mm_storeu_pd(here, _mm256_castpd256_pd128(exact));
            _mm_store_sd(here + 2, _mm256_extractf128_pd(exact, 1));
            // In most cases this needs nothing of this row, and need not wait for it.
            if (k + 1 < end)
              sum = multiply_but_last<backward>(arrays, Row(arrays, at(k + 1)));
            pass_down(arrays, row, options.passes_all ? y : _mm_sub_ps(y, old));
          }
      }

      SIGNORINI_AVX2 inline void multiply(float *const s, const RoundedSweep::Arrays &arrays, const Row &row)
      {
        __m128 sum = _mm_setr_ps(s[0], s[1], s[2], 0.f);
        sum        = subtract_last(_mm_sub_ps(sum, multiply_but_last<false>(arrays, row)), arrays, row);
        float numbers[4];
        _mm_storeu_ps(numbers, sum);
        std::copy_n(numbers, dim, s);
      }

      SIGNORINI_AVX2 inline void pass_down_change(const RoundedSweep::Arrays &arrays, const Row &row,
                                                  const float *const change)
      {
        pass_down(arrays, row, _mm_setr_ps(change[0], change[1], change[2], 0.f));
      }
    } // namespace Avx2
#endif
  } // namespace RoundedRows
} // namespace Signorini

#endif
