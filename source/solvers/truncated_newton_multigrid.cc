// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// An iteration that leaves more than this of the correction calls for interface sweeps.
    constexpr double slow_rate = .25;
  } // namespace



  TruncatedNewtonMultigrid::TruncatedNewtonMultigrid(MultigridHierarchy     &hierarchy,
                                                     const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 2)
  {
    const NodePartition &coarse = hierarchy.level(hierarchy.n_levels() - 2).matrix.partition();
    coarse.reinit(coarse_defect);
    coarse.reinit(coarse_correction);
    hierarchy.finest().matrix.partition().reinit(step);
  }



  bool TruncatedNewtonMultigrid::all_ranks(const bool condition) const
  {
    return Utilities::MPI::min(static_cast<int>(condition),
                               hierarchy.finest().matrix.partition().communicator()) != 0;
  }



  void TruncatedNewtonMultigrid::correct(Vector &z, Vector &residual, const ObstacleProblem &problem,
                                         const bool search)
  {
    ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    MultigridLevel       &coarse   = hierarchy.level(hierarchy.n_levels() - 2);
    if (hierarchy.truncate(smoother.half_spaces(), smoother.active()))
      ++n_updates;
    coarse_defect = 0.;
    restrict_defect(coarse, coarse_defect, residual);
    cycle.apply(coarse_correction, coarse_defect);

    coarse.to_finer.prolongate(step, coarse_correction);
    if (problem.semidefinite)
      {
        // Motions that cost nothing come out very long: shortened as a whole they stay motions.
        smoother.restrict_to_tangents(step);
        step *= std::min(1., admissible_step(z, step, smoother.half_spaces()));
      }
    else
      smoother.project_correction(step, z);
    z.zero_out_ghost_values();
    if (search)
      add_searched(z, step, residual, smoother.half_spaces(), problem.semidefinite);
    else
      z += step;
  }



  double TruncatedNewtonMultigrid::safe_length(const Vector &z, const Vector &az, const Vector &residual,
                                               const bool keeps_active) const
  {
    double slope = residual * z;
    if (keeps_active)
      slope -= hierarchy.finest().smoother->normal_product(residual, z);
    const double curvature = z * az;
    return slope <= 0. ? 0. : curvature > slope ? slope / curvature : 1.;
  }



  bool TruncatedNewtonMultigrid::accelerate(const Vector &v, const Vector &residual, Vector &z, Vector &az,
                                            const HalfSpaces &half_spaces)
  {
    const ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    conjugate.update(z, az);
    const Vector &direction = conjugate.direction();
    const double  curvature = direction * conjugate.product();
    const double  slope     = residual * direction - smoother.normal_product(residual, direction);
    const double  length    = curvature > 0. ? slope / curvature : 0.;
    if (!(length > 0.) || length > admissible_step(v, direction, half_spaces))
      return false;
    z.equ(length, direction);
    az.equ(length, conjugate.product());
    return true;
  }



  ConvergenceReport TruncatedNewtonMultigrid::solve(Vector &v, const ObstacleProblem &problem,
                                                    const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix      = hierarchy.finest().matrix;
    ProjectedGaussSeidel  &smoother    = *hierarchy.finest().smoother;
    const bool             accelerates = parameters.method == SolverMethod::accelerated;
    smoother.set_half_spaces(problem.half_spaces);
    const bool is_good_start = hierarchy.expects_active_set();
    if (is_good_start)
      smoother.find_active(v, problem.rhs);
    else
      smoother.project(v);
    // From a good start the finest level does without interface sweeps in most problems once the active set
    // rests, but not in all.
    const bool may_spare_sweeps =
        accelerates && is_good_start && !problem.semidefinite && !hierarchy.has_slow_interface();
    bool is_slow = parameters.starts_with_interface_sweeps;
    n_updates    = 0;
    conjugate.restart();

    ConvergenceReport report;
    // One iteration: v + z from v. The residuals are those of v and v + z.
    Vector z, product, residual, new_residual;
    for (Vector *vector : {&z, &product, &residual, &new_residual})
      vector->reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    // Whether active nodes lie on their planes: a shortened step leaves them on the way. The way to the
    // planes is no linear function of the residual, as conjugate gradients need it.
    bool       is_on_planes = true;
    bool       rests        = false;
    double     energy       = std::numeric_limits<double>::infinity();
    const auto check        = [&](const bool with_correction) {
      if (!parameters.check_monotonicity)
        return;
      Vector now = v;
      now.zero_out_ghost_values();
      if (with_correction)
        now += z;
      check_substep(report, energy, now, problem);
    };
    while (goes_on(report))
      {
        const std::vector<unsigned char> active    = smoother.active();
        SmoothingParameters              smoothing = parameters.smoothing;
        if (may_spare_sweeps && rests && !is_slow)
          smoothing.n_interface_sweeps = 0;
        smoother.set_bounds_from(problem.half_spaces, v);
        smoother.smooth_from_zero(z, residual, smoothing, new_residual);
        const double before = energy;
        check(true);
        bool keeps_active = smoother.active() == active;
        // A good start shows itself by an active set that rests from the beginning.
        if (report.history.empty())
          rests = accelerates && is_good_start && !problem.semidefinite && all_ranks(keeps_active);
        const bool searches = !rests;
        // Without a search the iteration as a whole lowers the energy, not each step after this one.
        if (!searches)
          energy = before;
        correct(z, new_residual, problem, searches);
        if (searches)
          check(true);
        smoother.smooth_to_residual(z, residual, smoothing, &new_residual);
        keeps_active = all_ranks(keeps_active && smoother.active() == active);

        product = residual;
        product -= new_residual;
        const auto step_length = [&] {
          return searches ? 1. : safe_length(z, product, residual, keeps_active);
        };
        const bool goes_to_planes = !is_on_planes && step_length() == 1.;
        rests                     = keeps_active && accelerates && !goes_to_planes &&
                accelerate(v, residual, z, product, problem.half_spaces);
        // Before it is shortened: a correction that was cut off does not mean convergence.
        double norm = std::sqrt(std::max(0., z * product));
        if (rests)
          residual -= product;
        else
          {
            conjugate.restart();
            const double length = step_length();
            is_on_planes        = length == 1.;
            if (length == 1.)
              residual.swap(new_residual);
            else
              {
                z *= length;
                residual.add(-length, product);
              }
          }
        v.zero_out_ghost_values();
        z.zero_out_ghost_values();
        v += z;
        is_slow = is_slow || (rests && !report.history.empty() && norm > slow_rate * report.history.back());
        // Rounding along motions that cost nothing feeds on itself through old directions.
        if (problem.semidefinite && !report.history.empty() && norm > report.history.back())
          {
            rests = false;
            conjugate.restart();
          }
        check(false);
        const double square = v * problem.rhs - v * residual;
        book_iteration(report, norm, std::sqrt(std::max(0., square)), monitor);
      }
    close(report, v, problem, residual);
    report.hierarchy_updates       = n_updates;
    report.needed_interface_sweeps = is_slow;
    return report;
  }
} // namespace Signorini
