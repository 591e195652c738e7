// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Sweeps of a multigrid cycle, in single precision but for what must not be rounded.

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/projected_gauss_seidel.h>

namespace Signorini
{
  void ProjectedGaussSeidel::start_rounded(const Vector &v, const Vector &rhs)
  {
    rounded.start(v, rhs);
    for (const unsigned int row : constraints.nodes)
      if (is_ordered[row])
        rounded.leave_out_rhs(row);
  }



  void ProjectedGaussSeidel::relax_half_space(double *const y, const double *const rhs,
                                              const unsigned int row, const bool keeps_residual)
  {
    double s[dim] = {rhs[0], rhs[1], rhs[2]};
    rounded.subtract_product(s, row);
    minimize_row(y, s, row);
    if (!keeps_residual)
      return;
    const double *const a = matrix.block(matrix.diagonal(row));
    Vector3            &r = contact_residual[half_space_of_row[row]];
    for (unsigned int c = 0; c < dim; ++c)
      r[c] = s[c] - (a[dim * c] * y[0] + a[dim * c + 1] * y[1] + a[dim * c + 2] * y[2]);
    rounded.leave_out_rhs(row);
  }



  void ProjectedGaussSeidel::run_rounded(Vector &v, const Vector &rhs, const RoundedSweep::Options &options)
  {
    const auto is_apart = [&](const unsigned int row) {
      return !is_ordered[row] || half_space_of_row[row] >= 0;
    };
    const std::size_t n_phases = all_rows.phases().size();
    for (std::size_t phase = 0; phase < n_phases; ++phase)
      {
        v.update_ghost_values();
        const auto &rows = all_rows.phases()[options.backward ? n_phases - 1 - phase : phase];
        const auto at = [&](const std::size_t k) { return rows[options.backward ? rows.size() - 1 - k : k]; };
        for (std::size_t k = 0; k < rows.size();)
          {
            const std::size_t begin = k;
            while (k < rows.size() && !is_apart(at(k)))
              ++k;
            rounded.relax(v, rows.data() + (options.backward ? rows.size() - k : begin), k - begin, options);
            for (; k < rows.size() && is_apart(at(k)); ++k)
              {
                const unsigned int row      = at(k);
                double *const      y        = v.begin() + dim * static_cast<std::size_t>(row);
                const double       old[dim] = {y[0], y[1], y[2]};
                if (!is_ordered[row])
                  relax<forward>(v.begin(), rhs.begin(), row);
                else
                  relax_half_space(y, rhs.begin() + dim * static_cast<std::size_t>(row), row,
                                   options.keeps_residual);
                double change[dim];
                for (unsigned int c = 0; c < dim; ++c)
                  change[c] = options.passes_all ? y[c] : y[c] - old[c];
                rounded.set(row, y);
                rounded.pass_down(row, change);
              }
          }
      }
  }



  void ProjectedGaussSeidel::get_residual(Vector &residual) const
  {
    rounded.get_residual(residual);
    for (std::size_t p = 0; p < constraints.size(); ++p)
      if (const unsigned int row = constraints.nodes[p]; is_ordered[row])
        for (unsigned int c = 0; c < dim; ++c)
          residual.local_element(dim * row + c) += contact_residual[p][c];
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
    start_rounded(v, rhs);
    for (unsigned int i = 0; i < parameters.n_pre; ++i)
      {
        RoundedSweep::Options options;
        options.keeps_residual = i + 1 == parameters.n_pre;
        run_rounded(v, rhs, options);
        if (!options.keeps_residual)
          sweep_blocks_rounded(v, rhs, forward, true);
      }
    if (parameters.n_pre == 0)
      residual.copy_locally_owned_data_from(rhs);
    else
      {
        get_residual(residual);
        follow_changes(
            block_rows, v, [&] { sweep_blocks(v, rhs, forward); },
            [&](const unsigned int row, const double *const change) {
              pass_on(residual.begin(), row, change);
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



  void ProjectedGaussSeidel::sweep_blocks_rounded(Vector &v, const Vector &rhs, const Direction direction,
                                                  const bool passes_down)
  {
    follow_changes(
        block_rows, v, [&] { sweep_blocks(v, rhs, direction); },
        [&](const unsigned int row, const double *const change) {
          rounded.set(row, v.begin() + dim * static_cast<std::size_t>(row));
          if (passes_down)
            rounded.pass_down(row, change);
        });
  }



  void ProjectedGaussSeidel::smooth_to_residual(Vector &v, const Vector &rhs,
                                                const SmoothingParameters &parameters, Vector *const residual)
  {
    smooth_interface(v, rhs, parameters, backward);
    if (parameters.n_post > 0)
      start_rounded(v, rhs);
    for (unsigned int i = 0; i < parameters.n_post; ++i)
      {
        // Nothing has been passed on before the first sweep, which passes all on.
        RoundedSweep::Options options;
        options.backward   = true;
        options.passes_all = i == 0;
        sweep_blocks_rounded(v, rhs, backward, !options.passes_all);
        run_rounded(v, rhs, options);
      }
    if (residual == nullptr)
      return;
    matrix.symmetric_residual(*residual, v, rhs);
  }
} // namespace Signorini
