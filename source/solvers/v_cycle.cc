// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/v_cycle.h>

namespace Signorini
{
  using namespace dealii;

  VCycle::VCycle(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing,
                 const unsigned int max_level)
    : hierarchy(hierarchy)
    , smoothing(smoothing)
    , work(max_level + 1)
  {
    for (unsigned int l = 0; l <= max_level; ++l)
      {
        const NodePartition &partition = hierarchy.level(l).matrix.partition();
        partition.reinit(work[l].residual);
        work[l].free                      = ContactState(hierarchy.level(l).matrix);
        const LevelCorrection &correction = hierarchy.level(l).correction;
        if (l > 0 && (correction.n_cycles > 1 || correction.exact_step))
          for (Vector *vector : {&work[l].left, &work[l].left_after, &work[l].second})
            partition.reinit(*vector);
        if (l == max_level)
          continue;
        partition.reinit(work[l].solution);
        partition.reinit(work[l].rhs);
      }
  }



  void VCycle::correct(const unsigned int level, Vector &solution, const Vector &rhs,
                       Vector *const new_residual)
  {
    const LevelCorrection &correction = hierarchy.level(level).correction;
    if (level == 0 || (correction.n_cycles == 1 && !correction.exact_step))
      {
        run(level, solution, rhs, new_residual);
        return;
      }
    Work &here = work[level];
    run(level, solution, rhs, &here.left);
    for (unsigned int cycle = 1; cycle < correction.n_cycles; ++cycle)
      {
        run(level, here.second, here.left, &here.left_after);
        here.second.zero_out_ghost_values();
        solution.zero_out_ghost_values();
        solution += here.second;
        here.left.swap(here.left_after);
      }
    double length = 1.;
    if (correction.exact_step)
      {
        const double slope = solution * rhs, curvature = slope - solution * here.left;
        if (curvature > 0.)
          length = slope / curvature;
        solution *= length;
      }
    if (new_residual != nullptr)
      {
        new_residual->equ(1. - length, rhs);
        new_residual->add(length, here.left);
      }
  }



  void VCycle::run(const unsigned int level, Vector &solution, const Vector &rhs, Vector *const new_residual)
  {
    if (level == 0)
      {
        hierarchy.coarse_solver().solve(solution, rhs);
        return;
      }
    Smoother             &smoother = *hierarchy.level(level).smoother;
    const MultigridLevel &coarse   = hierarchy.level(level - 1);
    Vector               &residual = work[level].residual;
    smoother.smooth_from_zero(solution, rhs, work[level].free, smoothing, residual);
    hierarchy.level(level).empty.leave_out(residual, hierarchy.level(level).matrix, solution);
    work[level - 1].rhs = 0.;
    restrict_defect(coarse, work[level - 1].rhs, residual);
    correct(level - 1, work[level - 1].solution, work[level - 1].rhs, nullptr);
    Vector &step = residual;
    coarse.to_finer.prolongate(step, work[level - 1].solution);
    solution.zero_out_ghost_values();
    solution += step;
    smoother.smooth_to_residual(solution, rhs, work[level].free, smoothing, new_residual);
  }



  void VCycle::apply(Vector &correction, const Vector &defect)
  {
    correct(static_cast<unsigned int>(work.size()) - 1, correction, defect, nullptr);
  }



  void VCycle::apply(Vector &correction, const Vector &defect, Vector &residual)
  {
    Assert(work.size() > 1, ExcMessage("Level 0 has no residual at hand."));
    correct(static_cast<unsigned int>(work.size()) - 1, correction, defect, &residual);
  }
} // namespace Signorini
