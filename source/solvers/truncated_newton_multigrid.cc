// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/interface_sweep_policy.h>
#include <signorini/solvers/safety_net.h>
#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct AccelerationRule
    {
      /// A longer step along a conjugate direction, in corrections of the V-cycle, is the ratio of two
      /// rounding errors: a motion that costs nothing.
      double longest_step = 100.;
      /// A v, the forces of a start, relative to the loads: less is rounding, of a rigid motion.
      double no_forces = 1e-6;
      /// Tolerance on the levels that only give a start: two or three iterations each.
      double start_tolerance = 1e-2;
    };
  } // namespace



  TruncatedNewtonMultigrid::TruncatedNewtonMultigrid(MultigridHierarchy     &hierarchy,
                                                     const SolverParameters &parameters,
                                                     const unsigned int      level)
    : ObstacleSolver(hierarchy, parameters, level)
  {
  }



  bool TruncatedNewtonMultigrid::has_nested_start(const Vector &v, const ObstacleProblem &problem) const
  {
    if (parameters.method != SolverMethod::accelerated || problem.semidefinite || level < 2 || !v.all_zero())
      return false;
    const MultigridLevel     &below = hierarchy.level(level - 1);
    const std::vector<double> sizes = {static_cast<double>(problem.half_spaces.size()),
                                       static_cast<double>(below.half_spaces.size())};
    std::vector<double>       sums(2);
    Utilities::MPI::sum(sizes, below.matrix.partition().communicator(), sums);
    return sums[0] > 0. && sums[1] > 0.;
  }



  std::vector<unsigned int> TruncatedNewtonMultigrid::nested_start(Vector &v, const ObstacleProblem &problem)
  {
    const MultigridLevel &below   = hierarchy.level(level - 1);
    const auto            release = [&](const unsigned int l, const HalfSpaces &half_spaces) {
      hierarchy.truncate(l, half_spaces, std::vector<unsigned char>(half_spaces.size(), 0));
    };
    // What an earlier solve has left.
    release(level, problem.half_spaces);
    ObstacleProblem problem_below;
    below.matrix.partition().reinit(problem_below.rhs);
    restrict_defect(below, problem_below.rhs, problem.rhs);
    problem_below.half_spaces           = below.half_spaces;
    SolverParameters parameters_below   = parameters;
    parameters_below.tolerance          = AccelerationRule().start_tolerance;
    parameters_below.absolute_tolerance = 0.;
    parameters_below.check_monotonicity = false;

    Vector start;
    below.matrix.partition().reinit(start);
    ConvergenceReport report =
        TruncatedNewtonMultigrid(hierarchy, parameters_below, level - 1).solve(start, problem_below);
    release(level - 1, problem_below.half_spaces);
    below.to_finer.prolongate(v, start);
    report.start_iterations.push_back(report.iterations);
    return report.start_iterations;
  }



  bool TruncatedNewtonMultigrid::start(Vector &v, const ObstacleProblem &problem, ConvergenceReport &report)
  {
    bool is_good = hierarchy.expects_active_set() && level + 1 == hierarchy.n_levels();
    if (!is_good && has_nested_start(v, problem))
      {
        report.start_iterations = nested_start(v, problem);
        is_good                 = true;
      }
    if (is_good)
      contact = find_active(hierarchy.level(level), problem.half_spaces, problem.rhs, v);
    else
      {
        contact = ContactState(matrix(), problem.half_spaces);
        contact.project(v);
      }
    return is_good;
  }



  bool TruncatedNewtonMultigrid::accelerate(const Vector &v, Vector &residual, TruncatedCycle &cycle,
                                            const ObstacleProblem &problem)
  {
    const double length = conjugate.find_step(cycle.correction, cycle.product, residual, contact);
    if (length == 0. || (problem.semidefinite && length > AccelerationRule().longest_step) ||
        length > contact.longest_step(v, conjugate.direction(), problem.half_spaces))
      return false;
    cycle.replace(length, conjugate.direction(), conjugate.product(), residual);
    return true;
  }



  IterationPhase TruncatedNewtonMultigrid::begin_from(const Vector &v, Vector &residual,
                                                      const ObstacleProblem &problem)
  {
    matrix().symmetric_residual(residual, v, problem.rhs);
    conjugate.restart();
    return IterationPhase::searching;
  }



  namespace
  {
    /// Whether A v is more than rounding.
    bool has_forces(const NodeBlockMatrix &matrix, const Vector &v, const Vector &rhs)
    {
      Vector forces;
      forces.reinit(v);
      matrix.vmult(forces, v);
      return forces.l2_norm() > AccelerationRule().no_forces * rhs.l2_norm();
    }
  } // namespace



  ConvergenceReport TruncatedNewtonMultigrid::solve(Vector &v, const ObstacleProblem &problem,
                                                    const Monitor &monitor)
  {
    ConvergenceReport    report;
    const bool           accelerates   = parameters.method == SolverMethod::accelerated;
    const bool           knows_contact = !problem.semidefinite || has_forces(matrix(), v, problem.rhs);
    const bool           trusts_set    = start(v, problem, report) && accelerates && !problem.semidefinite;
    InterfaceSweepPolicy sweeps(parameters.smoothing, trusts_set && !hierarchy.has_slow_interface(),
                                parameters.starts_with_interface_sweeps);
    TruncatedCycle       cycle(hierarchy, level, parameters.smoothing, problem, contact, knows_contact);
    SubstepCheck         check(matrix(), problem, report, parameters.check_monotonicity);
    SafetyNet            net(hierarchy, parameters, level, cycle, report);
    Vector               residual;
    residual.reinit(v);
    IterationPhase phase = begin_from(v, residual, problem);
    while (goes_on(report))
      {
        cycle.run(v, residual, {sweeps.choose(phase), phase, trusts_set}, check);
        StepTaken step;
        step.is_conjugate = accelerates && cycle.is_linear(phase) && accelerate(v, residual, cycle, problem);
        // Before the correction is shortened: one that was cut off does not mean convergence.
        const double norm = cycle.norm();
        if (!step.is_conjugate)
          step.is_shortened = cycle.shorten(residual);
        v.zero_out_ghost_values();
        cycle.correction.zero_out_ghost_values();
        v += cycle.correction;
        check(v);

        step.grows_freely = problem.semidefinite && !report.history.empty() && norm > report.history.back();
        sweeps.observe(step.is_conjugate, norm, report.history);
        phase = next_phase(step);
        if (phase != IterationPhase::resting)
          conjugate.restart();
        const double square = v * problem.rhs - v * residual;
        book_iteration(report, norm, std::sqrt(std::max(square, 0.)), monitor);
        if (net.acts(step.is_conjugate, v, problem, contact, report, monitor))
          phase = begin_from(v, residual, problem);
      }
    close(report, v, problem, residual);
    report.hierarchy_updates       = cycle.n_updates;
    report.subspace_minimizations  = cycle.n_minimizations;
    report.needed_interface_sweeps = sweeps.needs_sweeps();
    return report;
  }
} // namespace Signorini
