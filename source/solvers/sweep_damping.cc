// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_damping.h>

namespace Signorini
{
  SweepDamping::SweepDamping(const NodeBlockMatrix &matrix, const NodePhases &phases,
                             const RelativeCouplings &couplings)
    : matrix(&matrix)
  {
    for (unsigned int ghost = 0; ghost < matrix.partition().ghosts().size(); ++ghost)
      {
        const auto [begin, end] = matrix.ghost_column(ghost);
        for (auto coupling = begin; coupling != end; ++coupling)
          if (phases[coupling->row] == phases[matrix.n_rows() + ghost])
            clashes.push_back({*coupling, ghost});
      }
    update(couplings);
  }



  void SweepDamping::update(const RelativeCouplings &couplings)
  {
    if (clashes.empty())
      return;
    factors.assign(matrix->n_rows(), 0.);
    for (const auto &[coupling, ghost] : clashes)
      factors[coupling.row] += couplings.bound(coupling, ghost);
    for (double &factor : factors)
      factor = DampingRule().factor(factor);
  }
} // namespace Signorini
