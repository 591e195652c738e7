// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_active_set_amg_h
#define signorini_solvers_active_set_amg_h

#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  /// Primal-dual active set (Hintermüller, Ito & Kunisch 2003), each linear problem by conjugate gradients
  /// with algebraic multigrid from the last iterate: the method of deal.II's step-41 and 42, what many use
  /// today. The baseline that the multigrid methods are measured against.
  ///
  /// It needs only the finest level of the hierarchy. An iteration of its report is one linear problem; the
  /// report counts the cycles of algebraic multigrid besides. The active set may cycle: then it stops at the
  /// largest number of iterations without having converged.
  class ActiveSetAmg : public ObstacleSolver
  {
  public:
    /// The hierarchy must outlive the object.
    ActiveSetAmg(MultigridHierarchy &hierarchy, const SolverParameters &parameters)
      : ObstacleSolver(hierarchy, parameters, hierarchy.n_levels() - 1)
    {
    }

    /// The one without a monitor.
    using ObstacleSolver::solve;

    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

    const std::vector<unsigned char> &active() const override
    {
      return is_active;
    }

  private:
    void remove_normal_parts(Vector &x, const HalfSpaces &half_spaces) const;

    /// The linear problem on an active set.
    struct LinearProblem;

    /// Collective. Puts active nodes on their planes and solves in them; returns the number of cycles.
    unsigned int solve_linear(Vector &v, const ObstacleProblem &problem, LinearProblem &linear) const;

    /// Collective. Contact pressure where it pushes, or penetration, in the measure of the node's own
    /// stiffness; whether that changed the active set.
    /// @param residual of v
    bool update_active(const Vector &v, const Vector &residual, const HalfSpaces &half_spaces);

    std::vector<unsigned char> is_active;
  };
} // namespace Signorini

#endif
