// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_sweep_damping_h
#define signorini_solvers_sweep_damping_h

#include <signorini/solvers/sweep_schedule.h>

#include <vector>

namespace Signorini
{
  /// Why damped sweeps of several ranks at once lower the energy. z is what a phase changes. Each rank
  /// minimizes its own rows exactly with A_ii + E_i in place of A_ii, where E_i = c_i A_ii: this lowers the
  /// energy that it sees by ½ Σ z_iᵀ(1 + 2c_i)A_ii z_i at least. What it did not see, the couplings to rows
  /// that others change at the same time, is ½ zᵀA z ≤ ½ Σ s_i z_iᵀA_ii z_i. So s_i ≤ 1 + 2c_i is enough:
  /// factors ω_i = 1/(1 + c_i) ≤ 2/(1 + s_i). Pure numbers.
  struct DampingRule
  {
    /// Of the sum s_i of couplings, against rounding.
    double margin = 1.2;

    /// The factor of the change of a row.
    double factor(const double sum) const
    {
      return std::min(1., 2. / (1. + margin * sum));
    }

    /// What is added to A_ii in a block of rows, relative to A_ii: a block is not larger than its diagonal,
    /// and only E counts. n: so many blocks of the phase have the row.
    double shift(const double sum, const unsigned int n) const
    {
      return .5 * margin * n * sum;
    }
  };

  /// The factors of rows that clash: that are coupled to rows which other ranks visit in the same phase.
  class SweepDamping
  {
  public:
    /// Without any.
    SweepDamping() = default;

    /// Collective. The matrix must outlive the object.
    SweepDamping(const NodeBlockMatrix &matrix, const NodePhases &phases, const RelativeCouplings &couplings);

    /// Of all rows again, after the matrix has changed.
    void update(const RelativeCouplings &couplings);

    /// The factor of the change of a row; 1 for most.
    double operator[](const unsigned int row) const
    {
      return factors.empty() ? 1. : factors[row];
    }

  private:
    const NodeBlockMatrix *matrix = nullptr;
    /// Pairs of a coupling and its ghost.
    std::vector<std::pair<NodeBlockMatrix::GhostCoupling, unsigned int>> clashes;
    std::vector<double>                                                  factors;
  };
} // namespace Signorini

#endif
