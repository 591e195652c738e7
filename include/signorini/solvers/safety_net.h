// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_safety_net_h
#define signorini_solvers_safety_net_h

#include <signorini/solvers/active_set_solver.h>
#include <signorini/solvers/truncated_cycle.h>

#include <memory>

namespace Signorini
{
  /// What catches an iteration that stays slow. Where it has lost the active set from the start, the contact
  /// subspace: of slender bodies on each other all nodes may touch and few do. After that active-set steps
  /// with sparse factors, where these are cheap: on small meshes, and on thin bodies. Elsewhere, if it is the
  /// active set that does not come to rest, active-set steps with conjugate gradients and the truncated
  /// V-cycle; if not, or if those do not end, the smoothers take patches of nodes (Smoother::strengthen()).
  /// Between active-set steps that do not end the slow iteration has its turn: it lowers the energy each
  /// time, so that nothing goes round in a circle.
  class SafetyNet
  {
  public:
    /// Collective. All must outlive the object. Where the parameters say so the smoothers take patches from
    /// the beginning.
    /// @param level the finest one of the problem
    /// @param cycle of the iteration
    SafetyNet(MultigridHierarchy &hierarchy, const SolverParameters &parameters, const unsigned int level,
              TruncatedCycle &cycle, ConvergenceReport &report);

    /// Collective. After an iteration, with its admissible v and what is active there: does what is due, and
    /// says whether it has done anything.
    /// @param is_conjugate whether the iteration took a step of conjugate gradients
    bool acts(const bool is_conjugate, Vector &v, const ObstacleProblem &problem, ContactState &contact,
              ConvergenceReport &report, const ObstacleSolver::Monitor &monitor);

  private:
    /// What goes on in place of an iteration that is slow.
    enum class Remedy
    {
      none,
      contact_subspace,
      patches,
      active_set_steps
    };

    bool is_wanted() const;

    /// Collective.
    Remedy due(const ConvergenceReport &report, const ObstacleProblem &problem);

    /// Collective. What is due because of the rate of the last iterations.
    Remedy due_to_rate(const ConvergenceReport &report, const ObstacleProblem &problem);

    /// Has a remedy show what it does before the next one: watches as many iterations as at the beginning.
    void watch_anew(const ConvergenceReport &report);

    /// Has the smoothers take patches, if the mesh is not small.
    void strengthen(ConvergenceReport &report);

    /// ActiveSetSolver::go_on().
    void take_over(Vector &v, const ObstacleProblem &problem, ContactState &contact,
                   ConvergenceReport &report, const ObstacleSolver::Monitor &monitor);

    double n_unknowns() const;
    bool   is_small() const;
    bool   may_take_patches() const;

    /// Collective. Makes `planes`, sparse factors if they are cheap.
    void choose_planes(const bool is_semidefinite);

    MultigridHierarchy              &hierarchy;
    const SolverParameters           parameters;
    const SafetyNetRule              net_rule;
    const unsigned int               level;
    TruncatedCycle                  &cycle;
    std::unique_ptr<PlaneSolver>     planes;
    std::unique_ptr<ActiveSetSolver> steps;
    /// Steps of conjugate gradients in a row; the iteration before which the rate is not looked at (again).
    unsigned int n_conjugate = 0, not_before = 0;
    /// How often active-set steps did not end, or could not begin.
    unsigned int n_given_back = 0;
    /// Whether active-set steps did not end since the smoothers were as they are.
    bool has_failed = false;
  };
} // namespace Signorini

#endif
