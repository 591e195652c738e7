// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_gauss_seidel_iteration_h
#define signorini_solvers_gauss_seidel_iteration_h

#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  /// Projected Gauss-Seidel alone, a forward and a backward sweep an iteration. Converges always, and slowly:
  /// for tiny problems and as a reference.
  class GaussSeidelIteration : public ObstacleSolver
  {
  public:
    /// The hierarchy must outlive the object.
    GaussSeidelIteration(MultigridHierarchy &hierarchy, const SolverParameters &parameters)
      : ObstacleSolver(hierarchy, parameters, hierarchy.n_levels() - 1)
    {
    }

    /// The one without a monitor.
    using ObstacleSolver::solve;

    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;
  };
} // namespace Signorini

#endif
