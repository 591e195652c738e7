// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_safety_net_h
#define signorini_solvers_safety_net_h

#include <signorini/solvers/active_set_solver.h>

#include <memory>

namespace Signorini
{
  /// What catches an iteration that stays slow: active-set steps, with sparse factors while the mesh is small,
  /// else with conjugate gradients and the truncated V-cycle. Between them the slow iteration has its turn:
  /// it lowers the energy in each step, so that nothing goes round in a circle.
  class SafetyNet
  {
  public:
    /// When an iteration is slow, and what takes over.
    struct Rule
    {
      /// The rate is the geometric mean over so many iterations.
      std::size_t n_watched = 8;
      /// So many iterations to go, at this rate, are slow: no problem of the tests that is not slow all the
      /// way has ever more to go.
      double most_left = 40.;
      /// Unknowns up to which sparse factors are taken: 0.1 s for 5,000, 0.7 s for 13,000.
      dealii::types::global_dof_index largest_for_factors = 20000;
      /// Of the iterations watched, those that conjugate gradients did not take: with fewer V-cycles are slow
      /// on the linear problem, too, and active-set steps that use them would gain nothing.
      unsigned int fewest_searched = 3;
    };

    /// All must outlive the object.
    /// @param level the finest one of the problem
    SafetyNet(MultigridHierarchy &hierarchy, const SolverParameters &parameters, const unsigned int level);

    /// After an iteration.
    /// @param is_conjugate whether it took a step of conjugate gradients
    void observe(const bool is_conjugate)
    {
      n_conjugate = is_conjugate ? n_conjugate + 1 : 0;
    }

    /// Whether the iteration is slow and something else would be faster: the same on all ranks.
    bool is_due(const ConvergenceReport &report, const ObstacleProblem &problem) const;

    /// Collective. Goes on from an admissible v and what is active there: ActiveSetSolver::go_on().
    bool take_over(Vector &v, const std::vector<unsigned char> &active, const ObstacleProblem &problem,
                   ConvergenceReport &report, const ObstacleSolver::Monitor &monitor);

    /// For each half-space whether it is active after the net has taken over.
    const std::vector<unsigned char> &active() const
    {
      return steps->active();
    }

  private:
    bool uses_factors() const;

    MultigridHierarchy              &hierarchy;
    const SolverParameters           parameters;
    const unsigned int               level;
    std::unique_ptr<PlaneSolver>     planes;
    std::unique_ptr<ActiveSetSolver> steps;
    /// Steps of conjugate gradients in a row; the iteration before which it does not take over (again).
    unsigned int n_conjugate = 0, not_before = 0;
  };
} // namespace Signorini

#endif
