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
    , inverses(9 * static_cast<std::size_t>(matrix.n_rows()))
  {
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    update(rows);
    const RelativeCouplings couplings(matrix);
    node_phases = std::make_unique<NodePhases>(matrix, couplings);
    all_rows    = schedule(rows);
    factors     = SweepDamping(matrix, *node_phases, couplings);
  }



  void ProjectedGaussSeidel::update(const std::vector<unsigned int> &rows)
  {
    for (const unsigned int row : rows)
      write_block(inverses.data() + 9 * static_cast<std::size_t>(row),
                  invert(read_block(matrix.block(matrix.diagonal(row)))));
    if (matrix.partition().n_ranks() > 1 && node_phases)
      factors.update(RelativeCouplings(matrix));
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

  void ProjectedGaussSeidel::sweep(Vector &v, const Vector &rhs, ContactState &contact,
                                   const Direction direction, const SweepSchedule &rows) const
  {
    double *const                    values = v.begin();
    const double *const              right  = rhs.begin();
    const std::vector<unsigned int> &order  = rows.order();
    const auto                       visit  = [&](const std::size_t begin, const std::size_t end) {
      if (direction == Direction::forward)
        for (std::size_t k = begin; k < end; ++k)
          relax<Direction::forward>(values, right, order[k], contact);
      else
        for (std::size_t k = end; k-- > begin;)
          relax<Direction::backward>(values, right, order[k], contact);
    };
    rows.visit(v, direction, visit, [](const unsigned int, const double *) {});
  }



  void ProjectedGaussSeidel::sweep_with_residual(Vector &v, ContactState &contact, const SweepSchedule &rows,
                                                 Vector &residual) const
  {
    const auto visit = [&](const std::size_t begin, const std::size_t end) {
      for (std::size_t k = begin; k < end; ++k)
        relax_with_residual(v, rows.order()[k], contact, residual);
    };
    rows.visit(v, Direction::forward, visit, [&](const unsigned int ghost, const double *const change) {
      subtract_change(residual.begin(), matrix, matrix.n_rows() + ghost, change);
    });
  }



  inline void ProjectedGaussSeidel::relax_with_residual(Vector &v, const unsigned int row,
                                                        ContactState &contact, Vector &residual) const
  {
    const std::size_t   i      = dim * static_cast<std::size_t>(row);
    double *const       y      = v.begin() + i;
    const double        old[3] = {y[0], y[1], y[2]};
    const double *const r      = residual.begin() + i;
    const double *const a      = matrix.block(matrix.diagonal(row));
    double              s[3];
    for (unsigned int c = 0; c < dim; ++c)
      s[c] = r[c] + a[dim * c] * old[0] + a[dim * c + 1] * old[1] + a[dim * c + 2] * old[2];
    minimize_row(y, s, row, contact);
    const double change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
    subtract_change(residual.begin(), matrix, row, change);
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
