// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "rounded_rows.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace RoundedRows;

  namespace
  {
    /// The largest number on this rank.
    double largest(const Vector &x)
    {
      return Eigen::Map<const Eigen::VectorXd>(x.begin(), x.locally_owned_size()).lpNorm<Eigen::Infinity>();
    }

    /// Of three numbers.
    double largest_of(const double *const x)
    {
      return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    }

    /// 1 for zero; not so close to the ends of double precision that a product of two or its inverse
    /// overflows.
    double power_of_two_near(const double x)
    {
      constexpr int largest_exponent = 400;
      return x > 0. ? std::ldexp(1., std::clamp(std::ilogb(x), -largest_exponent, largest_exponent)) : 1.;
    }
  } // namespace



  namespace RoundingKernels
  {
    typedef float Float4 __attribute__((vector_size(4 * sizeof(float))));

    /// Writes n blocks times a factor.
    SIGNORINI_VECTORIZED
    void round_blocks(float *to, const double *const *from, const std::size_t n, const double factor)
    {
      const auto round = [&](const double *const row) {
        // The fourth number belongs to what comes behind.
        Vector4 numbers;
        std::memcpy(&numbers, row, sizeof(numbers));
        numbers *= factor;
        const auto rounded = __builtin_convertvector(numbers, Float4);
        std::memcpy(to, &rounded, dim * sizeof(float));
        to += dim;
      };
      for (std::size_t k = 0; k < n; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          round(from[k] + dim * c);
    }

    /// Subtracts n blocks (column by column) times three numbers from the nodes at given positions.
    SIGNORINI_VECTORIZED
    void subtract_blocks(float *const values, const float *a, const unsigned int *const positions,
                         const std::size_t n, const float *const change)
    {
      for (std::size_t k = 0; k < n; ++k, a += n_entries)
        {
          Float4 columns[dim], y;
          for (unsigned int c = 0; c < dim; ++c)
            std::memcpy(&columns[c], a + dim * c, sizeof(Float4));
          float *const here = node(values, positions[k]);
          std::memcpy(&y, here, sizeof(y));
          y -= change[0] * columns[0] + change[1] * columns[1] + change[2] * columns[2];
          std::memcpy(here, &y, sizeof(y));
        }
    }
  } // namespace RoundingKernels



  RoundedSweep::RoundedSweep(const NodeBlockMatrix &matrix, const std::vector<unsigned int> &order)
    : matrix(matrix)
    , order(order)
    , values(matrix.n_rows())
    , reduced(matrix.n_rows())
  {
    AssertDimension(order.size(), matrix.n_rows());
    const unsigned int n = matrix.n_rows();
    if (!std::is_sorted(order.begin(), order.end()))
      order_columns();
    if (!shares_blocks())
      matrix_unit = power_of_two_near(diagonal_scale(matrix));
    if (n == 0)
      return;
    ghost_positions.reserve(matrix.n_ghost_couplings());
    for (unsigned int ghost = 0; ghost < matrix.partition().ghosts().size(); ++ghost)
      for (auto [coupling, end] = matrix.ghost_column(ghost); coupling != end; ++coupling)
        ghost_positions.push_back(position(coupling->row));
    ghost_blocks.resize(n_entries * matrix.n_ghost_couplings() + 1);
    // Registers are filled from behind the last row. Nothing is set: who updates all rows touches the memory
    // for the first time.
    const auto allocate = [](const std::size_t n_blocks) {
      constexpr unsigned int   n_behind = 8;
      std::unique_ptr<float[]> memory(new float[n_entries * n_blocks + n_behind]);
      std::fill_n(memory.get() + n_entries * n_blocks, n_behind, 0.f);
      return memory;
    };
    inverses          = allocate(n);
    const Arrays here = arrays();
    if (!shares_blocks())
      own_blocks = allocate(here.lower_start[n] - here.lower_start[0]);
  }



  void RoundedSweep::order_columns()
  {
    const unsigned int n = matrix.n_rows();
    positions.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      positions[order[i]] = i;
    own_lower_start = {0};
    own_lower_start.reserve(n + 1);
    for (unsigned int i = 0; i < n; ++i)
      {
        const std::size_t begin = own_columns.size();
        matrix.visit_row(order[i], [&](const RowEntry &entry) {
          if (entry.column < n && positions[entry.column] < i)
            own_columns.push_back(positions[entry.column]);
        });
        std::sort(own_columns.begin() + begin, own_columns.end());
        own_lower_start.push_back(own_columns.size());
      }
  }



  RoundedSweep::Arrays RoundedSweep::arrays()
  {
    const bool is_own = !positions.empty();
    return {shares_blocks() ? matrix.block_data().rounded : own_blocks.get(),
            inverses.get(),
            is_own ? own_lower_start.data() : matrix.lower_start_data(),
            is_own ? own_columns.data() : matrix.column_data(),
            values.node(0),
            reduced.node(0),
            value_unit,
            order.data()};
  }



  void RoundedSweep::update(const std::vector<unsigned int> &rows, const double *const inverse_diagonal)
  {
    const double                factor = 1. / matrix_unit;
    const Arrays                here   = arrays();
    std::vector<const double *> lower;
    std::vector<double>         turned;
    for (const unsigned int i : rows)
      {
        const Row row(here, position(i));
        if (!shares_blocks())
          {
            find_lower(lower, turned, i);
            RoundingKernels::round_blocks(own_blocks.get() + (row.blocks - here.blocks), lower.data(), row.n,
                                          factor);
          }
        float              *a       = inverses.get() + n_entries * position(i);
        const double *const inverse = inverse_diagonal + n_entries * static_cast<std::size_t>(i);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            *a++ = static_cast<float>(matrix_unit * inverse[dim * d + c]);
      }
    update_ghost_couplings();
  }



  void RoundedSweep::find_lower(std::vector<const double *> &lower, std::vector<double> &turned,
                                const unsigned int i) const
  {
    lower.clear();
    if (positions.empty())
      {
        for (std::size_t k = matrix.lower(i).begin; k < matrix.lower(i).end; ++k)
          lower.push_back(matrix.block(k));
        return;
      }
    const BlockRange range = {own_lower_start[positions[i]], own_lower_start[positions[i] + 1]};
    turned.resize(n_entries * range.size() + 1);
    for (std::size_t k = range.begin; k < range.end; ++k)
      {
        const unsigned int column = order[own_columns[k]];
        double *const      copy   = turned.data() + n_entries * (k - range.begin);
        if (matrix.stores(i, column))
          matrix.block_data().read(copy, matrix.find(i, column));
        else
          {
            double numbers[n_entries];
            matrix.block_data().read(numbers, matrix.find(column, i));
            write_block(copy, transpose(read_block(numbers)));
          }
        lower.push_back(copy);
      }
  }



  void RoundedSweep::update_ghost_couplings()
  {
    float *a = ghost_blocks.data();
    for (unsigned int ghost = 0; ghost < matrix.partition().ghosts().size(); ++ghost)
      for (auto [coupling, end] = matrix.ghost_column(ghost); coupling != end; ++coupling)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            *a++ = static_cast<float>(matrix.block(coupling->block)[dim * d + c] / matrix_unit);
  }



  void RoundedSweep::find_unit(const double largest_value)
  {
    has_unit   = largest_value > 0.;
    value_unit = power_of_two_near(largest_value);
    rhs_unit   = value_unit * matrix_unit;
  }



  // What this rank had may be rounding beside what others, or gaps of its own nodes, bring.
  void RoundedSweep::fit_unit(const double largest_value)
  {
    constexpr double in_range = 1e12;
    if (!has_unit)
      return find_unit(largest_value);
    if (largest_value <= in_range * value_unit)
      return;
    const double old_unit = value_unit;
    find_unit(largest_value);
    const auto factor = static_cast<float>(old_unit / value_unit);
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      for (RoundedVector *const vector : {&values, &reduced})
        for (unsigned int c = 0; c < dim; ++c)
          vector->node(row)[c] *= factor;
  }



  void RoundedSweep::start(const Vector &v, const Vector &rhs)
  {
    has_unit = false;
    find_unit(std::max(largest(v), largest(rhs) / matrix_unit));
    const double  from_value = 1. / value_unit, from_rhs = 1. / rhs_unit;
    const double *x = v.begin(), *b = rhs.begin();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row, x += dim, b += dim)
      {
        float *const y = values.node(position(row)), *const r = reduced.node(position(row));
        for (unsigned int c = 0; c < dim; ++c)
          {
            y[c] = static_cast<float>(from_value * x[c]);
            r[c] = static_cast<float>(from_rhs * b[c]);
          }
      }
  }



  void RoundedSweep::relax(Vector &v, const std::size_t begin, const std::size_t end, const Options &options)
  {
    if (begin == end)
      return;
    const Arrays here = arrays();
#ifdef SIGNORINI_AVX2
    if (uses_avx2())
      return (options.backward ? Avx2::relax<true> : Avx2::relax<false>)(here, v.begin(), begin, end,
                                                                         options);
#endif
    Plain::relax(here, v.begin(), begin, end, options);
  }



  void RoundedSweep::set_reduced(const unsigned int row, const std::array<double, 3> &numbers)
  {
    for (unsigned int c = 0; c < dim; ++c)
      reduced.node(position(row))[c] = static_cast<float>(numbers[c] / rhs_unit);
  }



  void RoundedSweep::subtract_product(double *const s, const unsigned int row)
  {
    const Arrays here = arrays();
    float        rounded[dim];
    std::copy_n(reduced.node(position(row)), dim, rounded);
#ifdef SIGNORINI_AVX2
    if (uses_avx2())
      Avx2::multiply(rounded, here, Row(here, position(row)));
    else
#endif
      Plain::multiply(rounded, here, Row(here, position(row)));
    for (unsigned int c = 0; c < dim; ++c)
      s[c] += rhs_unit * rounded[c];
  }



  void RoundedSweep::set(const unsigned int row, const double *const v_row)
  {
    fit_unit(largest_of(v_row));
    for (unsigned int c = 0; c < dim; ++c)
      values.node(position(row))[c] = static_cast<float>(v_row[c] / value_unit);
  }



  void RoundedSweep::pass_down(const unsigned int row, const double *const change)
  {
    fit_unit(largest_of(change));
    const Arrays here = arrays();
    float        rounded[dim];
    for (unsigned int c = 0; c < dim; ++c)
      rounded[c] = static_cast<float>(change[c] / value_unit);
#ifdef SIGNORINI_AVX2
    if (uses_avx2())
      return Avx2::pass_down_change(here, Row(here, position(row)), rounded);
#endif
    Plain::pass_down(here, Row(here, position(row)), rounded);
  }



  void RoundedSweep::pass_from_ghost(const unsigned int ghost, const double *const change)
  {
    const double largest_change = largest_of(change);
    if (largest_change == 0.)
      return;
    fit_unit(largest_change);
    float rounded[dim];
    for (unsigned int c = 0; c < dim; ++c)
      rounded[c] = static_cast<float>(change[c] / value_unit);
    const auto        column = matrix.ghost_column(ghost);
    const std::size_t begin  = column.first - matrix.ghost_column(0).first;
    RoundingKernels::subtract_blocks(reduced.node(0), ghost_blocks.data() + n_entries * begin,
                                     ghost_positions.data() + begin, column.second - column.first, rounded);
  }



  void RoundedSweep::get_residual(Vector &residual) const
  {
    double *r = residual.begin();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row, r += dim)
      {
        const float *const rounded = reduced.node(position(row));
        for (unsigned int c = 0; c < dim; ++c)
          r[c] = rhs_unit * rounded[c];
      }
  }
} // namespace Signorini
