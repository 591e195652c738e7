// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/v_cycle.h>

namespace Signorini
{
  VCycle::VCycle(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing,
                 const unsigned int max_level)
    : hierarchy(hierarchy)
    , smoothing(smoothing)
    , work(max_level + 1)
  {
    for (unsigned int l = 0; l <= max_level; ++l)
      for (Vector *vector : {&work[l].solution, &work[l].rhs, &work[l].residual})
        hierarchy.level(l).matrix.partition().reinit(*vector);
  }



  void VCycle::run(const unsigned int level, Vector &solution, const Vector &rhs)
  {
    if (level == 0)
      {
        hierarchy.coarse_solver().solve(solution, rhs);
        return;
      }
    ProjectedGaussSeidel &smoother = *hierarchy.level(level).smoother;
    const MultigridLevel &coarse   = hierarchy.level(level - 1);
    Vector               &residual = work[level].residual;
    smoother.smooth_from_zero(solution, rhs, smoothing, residual);
    work[level - 1].rhs = 0.;
    restrict_defect(coarse, work[level - 1].rhs, residual);
    run(level - 1, work[level - 1].solution, work[level - 1].rhs);
    Vector &step = residual;
    coarse.to_finer.prolongate(step, work[level - 1].solution);
    solution.zero_out_ghost_values();
    solution += step;
    smoother.smooth_to_residual(solution, rhs, smoothing, nullptr);
  }



  void VCycle::apply(Vector &correction, const Vector &defect)
  {
    run(static_cast<unsigned int>(work.size()) - 1, correction, defect);
  }
} // namespace Signorini
