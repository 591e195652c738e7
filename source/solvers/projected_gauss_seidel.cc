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



  namespace
  {
    /// rhs - U v without its ghosts, U the blocks above the diagonals: what rows of which only the lower half
    /// is in memory have to know of the nodes above. It follows the sweep: a row passes its change on to the
    /// rows below that it couples to, while its blocks are at hand.
    class ReducedRhs
    {
    public:
      ReducedRhs(const NodeBlockMatrix &matrix, const Vector &rhs, const Vector &v)
        : matrix(matrix)
        , values(rhs.begin(), rhs.begin() + dim * static_cast<std::size_t>(matrix.n_rows()))
      {
        for (unsigned int row = 0; row < matrix.n_rows(); ++row)
          pass_down(row, v.begin() + dim * static_cast<std::size_t>(row));
      }

      const double *operator[](const unsigned int row) const
      {
        return values.data() + dim * static_cast<std::size_t>(row);
      }

      void pass_down(const unsigned int row, const double *const change)
      {
        subtract_transposed_blocks(values.data(), matrix.block_data(), matrix.column_data(),
                                   matrix.lower(row), change);
      }

    private:
      const NodeBlockMatrix &matrix;
      std::vector<double>    values;
    };
  } // namespace



  inline void ProjectedGaussSeidel::relax(double *const v, const double *const reduced,
                                          const unsigned int row, ContactState &contact,
                                          const Direction direction) const
  {
    const BlockRange here[2] = {matrix.lower(row), matrix.outer(row)};
    double           sums[6];
    // Memory is read in one direction throughout, also within a row.
    (direction == Direction::forward ? multiply_block_ranges : multiply_block_ranges_backward)(
        sums, matrix.block_data(), matrix.column_data(), here, 2, v);
    double s[3];
    for (unsigned int c = 0; c < dim; ++c)
      s[c] = reduced[c] - sums[c] - sums[dim + c];
    minimize_row(v + dim * static_cast<std::size_t>(row), s, row, contact);
  }



  void ProjectedGaussSeidel::sweep(Vector &v, const Vector &rhs, ContactState &contact,
                                   const Direction direction, const SweepSchedule &rows) const
  {
    if (rows.order().size() < matrix.n_rows())
      sweep_some_rows(v, rhs, contact, direction, rows);
    else
      sweep_all_rows(v, rhs, contact, direction, rows);
  }



  void ProjectedGaussSeidel::sweep_all_rows(Vector &v, const Vector &rhs, ContactState &contact,
                                            const Direction direction, const SweepSchedule &rows) const
  {
    ReducedRhs reduced(matrix, rhs, v);
    const auto relax_and_pass_down = [&](const unsigned int row) {
      double *const y      = v.begin() + dim * static_cast<std::size_t>(row);
      const double  old[3] = {y[0], y[1], y[2]};
      relax(v.begin(), reduced[row], row, contact, direction);
      const double change[3] = {y[0] - old[0], y[1] - old[1], y[2] - old[2]};
      reduced.pass_down(row, change);
    };
    rows.visit_each(v, direction, relax_and_pass_down);
  }



  void ProjectedGaussSeidel::sweep_some_rows(Vector &v, const Vector &rhs, ContactState &contact,
                                             const Direction direction, const SweepSchedule &rows) const
  {
    const auto relax_row = [&](const unsigned int row) {
      double reduced[dim];
      multiply_mirrored_blocks(reduced, matrix.mirrored_blocks(row), v.begin());
      for (unsigned int c = 0; c < dim; ++c)
        reduced[c] = rhs.local_element(dim * row + c) - reduced[c];
      relax(v.begin(), reduced, row, contact, direction);
    };
    rows.visit_each(v, direction, relax_row);
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
    // Blocks and columns (those below the diagonal twice), row pointers and half-space index, inverse
    // diagonal, right hand side, solution read and written once; the diagonal blocks are skipped.
    const double rows = matrix.n_rows(), blocks_read = static_cast<double>(matrix.n_blocks()) - rows;
    return blocks_read * (9. * sizeof(double) + sizeof(unsigned int)) +
           rows * (9. * sizeof(double) + 2 * sizeof(std::size_t) + 2 * sizeof(int) + 9. * sizeof(double));
  }
} // namespace Signorini
