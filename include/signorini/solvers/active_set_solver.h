// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_active_set_solver_h
#define signorini_solvers_active_set_solver_h

#include <signorini/solvers/conjugate_gradients.h>
#include <signorini/solvers/free_motion_correction.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/plane_solver.h>

namespace Signorini
{
  /// Primal-dual active set steps (doc/solvers.md, safety net) from an iterate and the active set that it
  /// has, each linear problem by conjugate gradients with a PlaneSolver.
  ///
  /// Such steps end in few or, the active set going round in a circle, never. So there are only so many of
  /// them, and then the iterate of least energy that was admissible is left: whoever calls goes on from there
  /// with a method that lowers the energy, and may come again. With the minimizer itself the active set
  /// rests at once. Of bodies that only contact holds an active set may be one on which they would fly away:
  /// such steps have not ended, either.
  class ActiveSetSolver : public ObstacleSolver
  {
  public:
    /// All must outlive the object.
    /// @param level the finest one of the problem
    ActiveSetSolver(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                    const unsigned int level, PlaneSolver &planes);

    /// The one without a monitor.
    using ObstacleSolver::solve;

    /// Collective. From the projected start.
    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

    /// Collective. Goes on from an admissible iterate and what is active there; the report goes on, too.
    /// Returns whether it converged; if not, v is admissible and its energy has not risen.
    bool go_on(Vector &v, const std::vector<unsigned char> &active, const ObstacleProblem &problem,
               ConvergenceReport &report, const Monitor &monitor);

    /// Active sets for which a linear problem was solved.
    unsigned int n_steps() const
    {
      return n_sets;
    }

  private:
    enum class Outcome
    {
      converged,
      set_changed,
      stopped
    };

    /// Collective. Solves on the planes of the active nodes as far as it takes to see another active set, or
    /// to the end.
    Outcome solve_on_planes(Vector &v, const ObstacleProblem &problem, FreeMotionCorrection &motions,
                            ConvergenceReport &report, const Monitor &monitor);

    /// Collective. What the linear solver and the free motions make of the residual, tangential at active
    /// nodes.
    void find_correction(const Vector &v, const FreeMotionCorrection &motions);

    /// Collective. Moves active nodes onto their planes; the energy norm of that.
    double move_to_planes(Vector &v);

    /// Collective. Makes active what pushes or penetrates; whether anything changes on any rank.
    bool update_set(const Vector &v);

    /// Collective. Keeps the projection of v if its energy is the least.
    void offer(const Vector &v, const ObstacleProblem &problem);

    PlaneSolver       &planes;
    ConjugateGradients conjugate;
    unsigned int       n_sets = 0;
    Vector             residual, tangential, correction, product;
    /// The admissible iterate of least energy.
    Vector best;
    double least_energy = 0.;
  };
} // namespace Signorini

#endif
