// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Sweeps of a multigrid cycle, which read half of each row.

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/projected_gauss_seidel.h>

namespace Signorini
{
  template <ProjectedGaussSeidel::Direction direction>
  inline void ProjectedGaussSeidel::relax_by_halves(double *const v, const double *const rhs,
                                                    const unsigned int row, const bool is_first,
                                                    double *const residual)
  {
    const auto visited = [&](const unsigned int i) {
      return direction == forward ? matrix.lower(i) : matrix.upper(i);
    };
    const auto unvisited = [&](const unsigned int i) {
      return direction == forward ? matrix.upper(i) : matrix.lower(i);
    };
    const bool       reads_all = is_first || !is_ordered[row];
    const BlockRange here[2]   = {visited(row), unvisited(row)};
    double           sums[6];
    (direction == forward ? multiply_block_ranges : multiply_block_ranges_backward)(
        sums, matrix.block_data(), matrix.column_data(), here, reads_all ? 2 : 1, v);
    const std::size_t i       = dim * static_cast<std::size_t>(row);
    double *const     reduced = reduced_rhs.data() + i;
    if (reads_all)
      for (unsigned int c = 0; c < dim; ++c)
        reduced[c] = rhs[i + c] - sums[dim + c];
    const double  s[3]   = {reduced[0] - sums[0], reduced[1] - sums[1], reduced[2] - sums[2]};
    double *const y      = v + i;
    const double  old[3] = {y[0], y[1], y[2]};
    minimize_row(y, s, row);
    if (residual != nullptr)
      {
        const bool          is_contact = half_space_of_row[row] >= 0;
        const double *const a          = matrix.block(matrix.diagonal(row));
        for (unsigned int c = 0; c < dim; ++c)
          residual[i + c] =
              is_contact ? s[c] - a[dim * c] * y[0] - a[dim * c + 1] * y[1] - a[dim * c + 2] * y[2] : 0.;
      }
    const double change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
    subtract_transposed_blocks(residual != nullptr ? residual : reduced_rhs.data(), matrix.block_data(),
                               matrix.column_data(), visited(row), change);
  }



  inline void ProjectedGaussSeidel::relax_with_residual(Vector &v, const Vector &rhs, const unsigned int row,
                                                        Vector &residual)
  {
    const std::size_t   i      = dim * static_cast<std::size_t>(row);
    double *const       y      = v.begin() + i;
    const double        old[3] = {y[0], y[1], y[2]};
    const double *const r      = residual.begin() + i;
    const double *const a      = matrix.block(matrix.diagonal(row));
    double              s[3]   = {r[0], r[1], r[2]};
    if (!is_ordered[row])
      {
        double product[3];
        matrix.multiply_row(product, row, v);
        for (unsigned int c = 0; c < dim; ++c)
          s[c] = rhs.local_element(i + c) - product[c];
      }
    for (unsigned int c = 0; c < dim; ++c)
      s[c] += a[dim * c] * old[0] + a[dim * c + 1] * old[1] + a[dim * c + 2] * old[2];
    minimize_row(y, s, row);
    const double change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
    pass_on(residual.begin(), row, change);
  }



  inline void ProjectedGaussSeidel::pass_on(double *const residual, const unsigned int row,
                                            const double *const change) const
  {
    for (const BlockRange &range : matrix.ranges(row))
      subtract_transposed_blocks(residual, matrix.block_data(), matrix.column_data(), range, change);
  }



  template <ProjectedGaussSeidel::Direction direction>
  void ProjectedGaussSeidel::run_by_halves(Vector &v, const Vector &rhs, const bool is_first,
                                           Vector *const residual)
  {
    double *const r = residual != nullptr ? residual->begin() : nullptr;
    visit(v, all_rows, direction, [&](const unsigned int row) {
      relax_by_halves<direction>(v.begin(), rhs.begin(), row, is_first, r);
    });
  }



  template <typename Action, typename PassOn>
  void ProjectedGaussSeidel::follow_changes(const std::vector<unsigned int> &rows, const Vector &v,
                                            const Action &action, const PassOn &pass_on_change) const
  {
    std::vector<double> old(dim * rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r)
      for (unsigned int c = 0; c < dim; ++c)
        old[dim * r + c] = v.local_element(dim * rows[r] + c);
    action();
    for (std::size_t r = 0; r < rows.size(); ++r)
      {
        double change[dim];
        for (unsigned int c = 0; c < dim; ++c)
          change[c] = v.local_element(dim * rows[r] + c) - old[dim * r + c];
        pass_on_change(rows[r], change);
      }
  }



  void ProjectedGaussSeidel::complete_residual(Vector &residual, const Vector &v, const Vector &rhs)
  {
    // What the sweeps left at ghosts.
    residual.zero_out_ghost_values();
    v.update_ghost_values();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (!is_ordered[row])
        {
          double *const r = residual.begin() + dim * static_cast<std::size_t>(row);
          matrix.multiply_row(r, row, v);
          for (unsigned int c = 0; c < dim; ++c)
            r[c] = rhs.local_element(dim * row + c) - r[c];
        }
  }



  void ProjectedGaussSeidel::smooth_from_zero(Vector &v, const Vector &rhs,
                                              const SmoothingParameters &parameters, Vector &residual)
  {
    v = 0.;
    residual.copy_locally_owned_data_from(rhs);
    std::copy_n(rhs.begin(), dim * static_cast<std::size_t>(matrix.n_rows()), reduced_rhs.begin());
    for (unsigned int i = 0; i < parameters.n_pre; ++i)
      {
        const bool is_last = i + 1 == parameters.n_pre;
        run_by_halves<forward>(v, rhs, false, is_last ? &residual : nullptr);
        follow_changes(
            block_rows, v, [&] { sweep_blocks(v, rhs, forward); },
            [&](const unsigned int row, const double *const change) {
              if (is_last)
                pass_on(residual.begin(), row, change);
              else
                subtract_transposed_blocks(reduced_rhs.data(), matrix.block_data(), matrix.column_data(),
                                           matrix.lower(row), change);
            });
      }
    for (unsigned int i = 0; i < parameters.n_interface_sweeps; ++i)
      {
        visit(v, interface_rows, forward,
              [&](const unsigned int row) { relax_with_residual(v, rhs, row, residual); });
        if (interface_correction)
          follow_changes(
              interface_correction->owned_rows(), v, [&] { correct_interface(v, rhs); },
              [&](const unsigned int row, const double *const change) {
                pass_on(residual.begin(), row, change);
              });
      }
    complete_residual(residual, v, rhs);
  }



  void ProjectedGaussSeidel::smooth_to_residual(Vector &v, const Vector &rhs,
                                                const SmoothingParameters &parameters, Vector *const residual)
  {
    smooth_interface(v, rhs, parameters, backward);
    for (unsigned int i = 0; i < parameters.n_post; ++i)
      {
        follow_changes(
            block_rows, v, [&] { sweep_blocks(v, rhs, backward); },
            [&](const unsigned int row, const double *const change) {
              // The first sweep reads all anyway.
              if (i > 0)
                subtract_transposed_blocks(reduced_rhs.data(), matrix.block_data(), matrix.column_data(),
                                           matrix.upper(row), change);
            });
        run_by_halves<backward>(v, rhs, i == 0, i + 1 == parameters.n_post ? residual : nullptr);
      }
    if (residual == nullptr)
      return;
    if (parameters.n_post > 0)
      complete_residual(*residual, v, rhs);
    else
      {
        matrix.vmult(*residual, v);
        residual->sadd(-1., 1., rhs);
      }
  }
} // namespace Signorini
