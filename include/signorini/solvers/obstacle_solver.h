// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_obstacle_solver_h
#define signorini_solvers_obstacle_solver_h

#include <signorini/solvers/convergence_report.h>
#include <signorini/solvers/multigrid_hierarchy.h>
#include <signorini/solvers/obstacle_problem.h>
#include <signorini/solvers/safety_net_rule.h>
#include <signorini/solvers/v_cycle.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>

namespace Signorini
{
  enum class SolverMethod
  {
    /// Truncated Newton multigrid, conjugate gradients while the active set rests.
    accelerated,
    truncated_newton_multigrid,
    monotone_multigrid,
    active_set_amg,
    projected_gauss_seidel,
    /// V-cycles, for linear problems alone.
    multigrid,
    /// Conjugate gradients with the V-cycle as preconditioner, for linear problems alone.
    multigrid_cg
  };

  /// Which method, and how it goes about it.
  struct SolverParameters
  {
    /// The method, its smoothing, and the solver of level 0 with the steps of algebraic_shortened.
    SolverMethod        method = SolverMethod::accelerated;
    SmoothingParameters smoothing;
    LevelZeroMethod     level_zero       = LevelZeroMethod::automatic;
    unsigned int        level_zero_steps = 1;
    /// Stop when the energy norm of the correction is below this multiple of that of the iterate.
    double tolerance = 1e-12;
    /// Stop when the energy norm of the correction is below this; 0 for the relative rule.
    double       absolute_tolerance = 0.;
    unsigned int max_iterations     = 1000;
    /// Not to wait until accelerated converges slowly before it takes interface sweeps on the finest level.
    bool starts_with_interface_sweeps = false;
    /// Not to wait likewise before it smooths patches of nodes at once.
    bool starts_with_patches = false;
    /// Whether accelerated goes on with active-set steps where it stays slow.
    bool          safety_net = true;
    SafetyNetRule net_rule;
    /// Measure energy and admissibility after every substep.
    bool check_monotonicity = false;

    /// Declares the parameters in the current subsection.
    void add_parameters(dealii::ParameterHandler &prm);
  };

  /// Solves obstacle problems over a hierarchy. Without half-spaces it solves the linear problem.
  class ObstacleSolver
  {
  public:
    /// Called after each iteration: number, energy norm of the correction relative to the iterate, active
    /// nodes.
    using Monitor = std::function<void(unsigned int, double, unsigned int)>;

    virtual ~ObstacleSolver() = default;

    /// Collective. Solves from the given start, which is projected first. v has the layout of the finest
    /// level. Instead of zero, accelerated takes a start from the coarser levels, if they have half-spaces.
    virtual ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) = 0;

    /// Collective. The same without a monitor.
    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem)
    {
      return solve(v, problem, Monitor());
    }

    /// For each half-space of the last solve whether it is active.
    virtual const std::vector<unsigned char> &active() const
    {
      return contact.active();
    }

  protected:
    /// The hierarchy must outlive the object; its truncation is changed.
    /// @param level the finest one of the problem
    ObstacleSolver(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                   const unsigned int level);

    /// Of the finest level of the problem.
    const NodeBlockMatrix &matrix() const
    {
      return hierarchy.level(level).matrix;
    }

    /// Collective. Books an iteration with the norm of its correction and that of the iterate, and decides
    /// whether it was the last one: converged, or stagnant at rounding.
    void book_iteration(ConvergenceReport &report, const double correction, const double iterate,
                        const Monitor &monitor) const;

    /// Whether to go on.
    bool goes_on(const ConvergenceReport &report) const;

    /// Collective. Energy, rate and note at the end.
    void close(ConvergenceReport &report, const Vector &v, const ObstacleProblem &problem) const;

    /// The same with residual = b - A v at hand.
    void close(ConvergenceReport &report, const Vector &v, const ObstacleProblem &problem,
               const Vector &residual) const;

    /// What the object was made with.
    MultigridHierarchy    &hierarchy;
    const SolverParameters parameters;
    const unsigned int     level;
    /// Half-spaces of the last solve and which of them are active.
    ContactState contact;
  };

  /// Whether a method solves linear problems only.
  inline bool is_linear(const SolverMethod method)
  {
    return method == SolverMethod::multigrid || method == SolverMethod::multigrid_cg;
  }

  /// Whether a method works on the finest level alone.
  inline bool needs_levels(const SolverMethod method)
  {
    return method != SolverMethod::active_set_amg && method != SolverMethod::projected_gauss_seidel;
  }

  /// The solver that the parameters name. A monotone multigrid needs a hierarchy with coarse normals
  /// (MultigridLevel::contact).
  std::unique_ptr<ObstacleSolver> make_solver(MultigridHierarchy     &hierarchy,
                                              const SolverParameters &parameters);
} // namespace Signorini

#endif
