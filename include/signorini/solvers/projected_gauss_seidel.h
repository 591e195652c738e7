// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_projected_gauss_seidel_h
#define signorini_solvers_projected_gauss_seidel_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/contact_state.h>
#include <signorini/solvers/sweep_damping.h>
#include <signorini/solvers/sweep_schedule.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Block Gauss-Seidel by node (3x3 blocks) in double precision, with or without half-spaces.
  ///
  /// At a contact node the 3x3 problem with one half-space has a closed solution: solve without
  /// constraint; if it is violated, move along A_pp^-1 n_p onto the plane (doc/algorithm.md, (41)).
  /// Rows that clash with those of other ranks are damped before that (SweepDamping).
  /// The matrix must outlive the object.
  class ProjectedGaussSeidel
  {
  public:
    /// Collective.
    explicit ProjectedGaussSeidel(const NodeBlockMatrix &matrix);

    /// Collective. Reads some rows of the matrix again.
    void update(const std::vector<unsigned int> &rows);

    /// In which phase of a sweep rows are visited.
    const NodePhases &phases() const
    {
      return *node_phases;
    }

    /// The order of all owned rows.
    const SweepSchedule &schedule() const
    {
      return all_rows;
    }

    /// Collective. The same order for some of the owned rows only (ascending).
    SweepSchedule schedule(const std::vector<unsigned int> &rows) const
    {
      return SweepSchedule(matrix.partition(), *node_phases, rows);
    }

    /// Inverse diagonal blocks of all owned rows, nine numbers each.
    const double *inverse_diagonal() const
    {
      return inverses.data();
    }

    /// Factors of the rows' changes.
    const SweepDamping &damping() const
    {
      return factors;
    }

    /// Collective. One sweep over all rows: v <- minimizer row by row. The energy never rises. Ghost values
    /// of v must be up to date, and are so afterwards.
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) const
    {
      sweep(v, rhs, contact, direction, all_rows);
    }

    /// Collective. The same over some rows.
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction,
               const SweepSchedule &rows) const;

    /// Collective. A sweep forward over some rows that keeps a residual up to date.
    void sweep_with_residual(Vector &v, ContactState &contact, const SweepSchedule &rows,
                             Vector &residual) const;

    /// v_row <- minimizer in the half-space of the row, where A_row,row v_row = s without it.
    void minimize_row(double *v_row, const double *s, const unsigned int row, ContactState &contact) const;

    /// Bytes that a sweep reads and writes at least.
    double sweep_bytes() const;

  private:
    void sweep_all_rows(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction,
                        const SweepSchedule &rows) const;
    void sweep_some_rows(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction,
                         const SweepSchedule &rows) const;
    /// minimize_row() of a row from its three numbers of the right hand side, reduced by what is above the
    /// diagonal.
    void relax(double *v, const double *reduced, const unsigned int row, ContactState &contact,
               const Direction direction) const;
    void relax_with_residual(Vector &v, const unsigned int row, ContactState &contact,
                             Vector &residual) const;

    const NodeBlockMatrix            &matrix;
    std::vector<double>               inverses;
    std::unique_ptr<const NodePhases> node_phases;
    SweepSchedule                     all_rows;
    SweepDamping                      factors;
  };



  inline void ProjectedGaussSeidel::minimize_row(double *const y, const double *const s,
                                                 const unsigned int row, ContactState &contact) const
  {
    const double *const d      = inverses.data() + 9 * static_cast<std::size_t>(row);
    const double        factor = factors[row];
    const double x[3] = {d[0] * s[0] + d[1] * s[1] + d[2] * s[2], d[3] * s[0] + d[4] * s[1] + d[5] * s[2],
                         d[6] * s[0] + d[7] * s[1] + d[8] * s[2]};
    for (unsigned int c = 0; c < dim; ++c)
      y[c] = factor == 1. ? x[c] : y[c] + factor * (x[c] - y[c]);
    if (const int p = contact.at(row); p >= 0)
      contact.project_node(y, p);
  }
} // namespace Signorini

#endif
