// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_linear_multigrid_h
#define signorini_solvers_linear_multigrid_h

#include <signorini/solvers/conjugate_gradients.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/v_cycle.h>

namespace Signorini
{
  /// Linear problems (no half-spaces) by V-cycles, each correction taken as it is, or by conjugate gradients
  /// with the V-cycle as preconditioner: what contact is compared with. One iteration is one application of
  /// the V-cycle, and neither needs a product with A more than it.
  class LinearMultigrid : public ObstacleSolver
  {
  public:
    /// The hierarchy must outlive the object and not be truncated. The method is multigrid or multigrid_cg.
    LinearMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters);

    /// The one without a monitor.
    using ObstacleSolver::solve;

    /// Throws if the problem has half-spaces.
    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

  private:
    VCycle cycle;
  };
} // namespace Signorini

#endif
