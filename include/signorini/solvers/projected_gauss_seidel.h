// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_projected_gauss_seidel_h
#define signorini_solvers_projected_gauss_seidel_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/contact_state.h>
#include <signorini/solvers/sweep_schedule.h>

#include <vector>

namespace Signorini
{
  /// Block Gauss-Seidel by node (3x3 blocks) in double precision, with or without half-spaces.
  ///
  /// At a contact node the 3x3 problem with one half-space has a closed solution: solve without
  /// constraint; if it is violated, move along A_pp^-1 n_p onto the plane (doc/algorithm.md, (41)).
  /// The matrix must outlive the object.
  class ProjectedGaussSeidel
  {
  public:
    /// Collective.
    explicit ProjectedGaussSeidel(const NodeBlockMatrix &matrix);

    /// Reads some rows of the matrix again.
    void update(const std::vector<unsigned int> &rows);

    /// The order of all owned rows.
    const SweepSchedule &schedule() const
    {
      return all_rows;
    }

    /// Inverse diagonal blocks of all owned rows, nine numbers each.
    const double *inverse_diagonal() const
    {
      return inverses.data();
    }

    /// Whether a forward sweep visits the lower part of a row before and the upper part after it, and no
    /// other rank sees the row: the rows of which a residual can be kept up to date without messages.
    bool is_ordered(const unsigned int row) const
    {
      return ordered[row];
    }

    /// Collective. One sweep over all rows: v <- minimizer row by row. The energy never rises.
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) const
    {
      sweep(v, rhs, contact, direction, all_rows);
    }

    /// Collective. The same over some rows (a subset of schedule()).
    void sweep(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction,
               const SweepSchedule &rows) const;

    /// Collective. A sweep forward over some rows from a residual that is valid where rows are ordered, and
    /// stays so.
    void sweep_with_residual(Vector &v, const Vector &rhs, ContactState &contact, const SweepSchedule &rows,
                             Vector &residual) const;

    /// Collective. The residual at rows that are not ordered.
    void complete_residual(Vector &residual, const Vector &v, const Vector &rhs) const;

    /// v_row <- minimizer in the half-space of the row, where A_row,row v_row = s without it.
    void minimize_row(double *v_row, const double *s, const unsigned int row, ContactState &contact) const;

    /// minimize_row() from a whole row; memory is read in the given direction.
    template <Direction direction>
    void relax(double *v, const double *rhs, const unsigned int row, ContactState &contact) const;

    /// Bytes that a sweep reads and writes at least.
    double sweep_bytes() const;

  private:
    void find_ordered_rows();
    void relax_with_residual(Vector &v, const Vector &rhs, const unsigned int row, ContactState &contact,
                             Vector &residual) const;

    const NodeBlockMatrix &matrix;
    SweepSchedule          all_rows;
    std::vector<bool>      ordered;
    std::vector<double>    inverses;
  };



  /// Collective. Calls visit_row(row) in the order of a schedule; ghost values of v are exchanged before each
  /// phase.
  template <typename Visit>
  void visit_rows(const Vector &v, const SweepSchedule &schedule, const Direction direction,
                  const Visit &visit_row)
  {
    const std::size_t n_phases = schedule.phases().size();
    for (std::size_t i = 0; i < n_phases; ++i)
      {
        v.update_ghost_values();
        const auto       &rows = schedule.phases()[direction == Direction::forward ? i : n_phases - 1 - i];
        const std::size_t n    = rows.size();
        if (direction == Direction::forward)
          for (std::size_t k = 0; k < n; ++k)
            visit_row(rows[k]);
        else
          for (std::size_t k = n; k-- > 0;)
            visit_row(rows[k]);
      }
  }



  inline void ProjectedGaussSeidel::minimize_row(double *const y, const double *const s,
                                                 const unsigned int row, ContactState &contact) const
  {
    const double *const d = inverses.data() + 9 * static_cast<std::size_t>(row);
    y[0]                  = d[0] * s[0] + d[1] * s[1] + d[2] * s[2];
    y[1]                  = d[3] * s[0] + d[4] * s[1] + d[5] * s[2];
    y[2]                  = d[6] * s[0] + d[7] * s[1] + d[8] * s[2];
    if (const int p = contact.at(row); p >= 0)
      contact.project_node(y, p);
  }
} // namespace Signorini

#endif
