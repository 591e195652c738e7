// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/projected_gauss_seidel.h>
#include <signorini/solvers/smoother.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  ProjectedGaussSeidel::ProjectedGaussSeidel(const NodeBlockMatrix &matrix)
    : matrix(matrix)
    , all_rows(matrix.partition())
    , inverses(9 * static_cast<std::size_t>(matrix.n_rows()))
  {
    find_ordered_rows();
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    update(rows);
  }



  void ProjectedGaussSeidel::find_ordered_rows()
  {
    // The last phase is for nodes that no other rank sees.
    std::vector<bool> is_inner(matrix.n_rows(), false);
    for (const unsigned int row : all_rows.phases().back())
      is_inner[row] = true;
    ordered = is_inner;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        const BlockRange upper = matrix.upper(row);
        for (std::size_t k = upper.begin; k < upper.end && ordered[row]; ++k)
          ordered[row] = matrix.column(k) < matrix.n_rows() && is_inner[matrix.column(k)];
      }
  }



  void ProjectedGaussSeidel::update(const std::vector<unsigned int> &rows)
  {
    for (const unsigned int row : rows)
      write_block(inverses.data() + 9 * static_cast<std::size_t>(row),
                  invert(read_block(matrix.block(matrix.diagonal(row)))));
  }



  template <Direction direction>
  inline void ProjectedGaussSeidel::relax(double *const v, const double *const rhs, const unsigned int row,
                                          ContactState &contact) const
  {
    const BlockRange here[2] = {matrix.lower(row), matrix.upper(row)};
    double           sums[6];
    // Memory is read in one direction throughout, also within a row.
    (direction == Direction::forward ? multiply_block_ranges : multiply_block_ranges_backward)(
        sums, matrix.block_data(), matrix.column_data(), here, 2, v);
    const double s[3] = {rhs[dim * row] - sums[0] - sums[3], rhs[dim * row + 1] - sums[1] - sums[4],
                         rhs[dim * row + 2] - sums[2] - sums[5]};
    minimize_row(v + dim * static_cast<std::size_t>(row), s, row, contact);
  }

  template void ProjectedGaussSeidel::relax<Direction::forward>(double *, const double *, unsigned int,
                                                                ContactState &) const;
  template void ProjectedGaussSeidel::relax<Direction::backward>(double *, const double *, unsigned int,
                                                                 ContactState &) const;



  void ProjectedGaussSeidel::sweep(Vector &v, const Vector &rhs, ContactState &contact,
                                   const Direction direction, const SweepSchedule &rows) const
  {
    double *const       values = v.begin();
    const double *const right  = rhs.begin();
    if (direction == Direction::forward)
      visit_rows(v, rows, direction,
                 [&](const unsigned int row) { relax<Direction::forward>(values, right, row, contact); });
    else
      visit_rows(v, rows, direction,
                 [&](const unsigned int row) { relax<Direction::backward>(values, right, row, contact); });
  }



  void ProjectedGaussSeidel::sweep_with_residual(Vector &v, const Vector &rhs, ContactState &contact,
                                                 const SweepSchedule &rows, Vector &residual) const
  {
    visit_rows(v, rows, Direction::forward,
               [&](const unsigned int row) { relax_with_residual(v, rhs, row, contact, residual); });
  }



  inline void ProjectedGaussSeidel::relax_with_residual(Vector &v, const Vector &rhs, const unsigned int row,
                                                        ContactState &contact, Vector &residual) const
  {
    const std::size_t   i      = dim * static_cast<std::size_t>(row);
    double *const       y      = v.begin() + i;
    const double        old[3] = {y[0], y[1], y[2]};
    const double *const r      = residual.begin() + i;
    const double *const a      = matrix.block(matrix.diagonal(row));
    double              s[3]   = {r[0], r[1], r[2]};
    if (!ordered[row])
      {
        double product[3];
        matrix.multiply_row(product, row, v);
        for (unsigned int c = 0; c < dim; ++c)
          s[c] = rhs.local_element(i + c) - product[c];
      }
    for (unsigned int c = 0; c < dim; ++c)
      s[c] += a[dim * c] * old[0] + a[dim * c + 1] * old[1] + a[dim * c + 2] * old[2];
    minimize_row(y, s, row, contact);
    const double change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
    subtract_change(residual.begin(), matrix, row, change);
  }



  void ProjectedGaussSeidel::complete_residual(Vector &residual, const Vector &v, const Vector &rhs) const
  {
    // What the sweeps left at ghosts.
    residual.zero_out_ghost_values();
    v.update_ghost_values();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (!ordered[row])
        {
          double *const r = residual.begin() + dim * static_cast<std::size_t>(row);
          matrix.multiply_row(r, row, v);
          for (unsigned int c = 0; c < dim; ++c)
            r[c] = rhs.local_element(dim * row + c) - r[c];
        }
  }



  double ProjectedGaussSeidel::sweep_bytes() const
  {
    // Blocks and columns, row pointers and half-space index, inverse diagonal, right hand side,
    // solution read and written once; the diagonal blocks are skipped.
    const double rows = matrix.n_rows(), blocks_read = static_cast<double>(matrix.n_owned_blocks()) - rows;
    return blocks_read * (9. * sizeof(double) + sizeof(unsigned int)) +
           rows * (9. * sizeof(double) + 2 * sizeof(std::size_t) + 2 * sizeof(int) + 9. * sizeof(double));
  }
} // namespace Signorini
