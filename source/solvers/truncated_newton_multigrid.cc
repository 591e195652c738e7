// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// An iteration that leaves more than this of the correction calls for interface sweeps: .25 for V(3,3),
    /// and more where fewer sweeps leave more in any case.
    double slow_rate(const SmoothingParameters &smoothing)
    {
      return 1.5 / std::max(2u, smoothing.n_pre + smoothing.n_post);
    }

    /// A longer step along a conjugate direction, in corrections of the V-cycle, is the ratio of two rounding
    /// errors: a motion that costs nothing.
    constexpr double longest_step = 100.;

    /// Tolerance on the levels that only give a start.
    constexpr double start_tolerance = 1e-2;
  } // namespace



  TruncatedNewtonMultigrid::TruncatedNewtonMultigrid(MultigridHierarchy     &hierarchy,
                                                     const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 2)
  {
    const NodePartition &coarse = hierarchy.level(hierarchy.n_levels() - 2).matrix.partition();
    coarse.reinit(coarse_defect);
    coarse.reinit(coarse_correction);
    hierarchy.finest().matrix.partition().reinit(scratch);
  }



  bool TruncatedNewtonMultigrid::all_ranks(const bool condition) const
  {
    return Utilities::MPI::min(static_cast<int>(condition),
                               hierarchy.finest().matrix.partition().communicator()) != 0;
  }



  bool TruncatedNewtonMultigrid::has_nested_start(const Vector &v, const ObstacleProblem &problem) const
  {
    if (parameters.method != SolverMethod::accelerated || problem.semidefinite || hierarchy.n_levels() < 3 ||
        !v.all_zero())
      return false;
    const MultigridLevel     &below = hierarchy.level(hierarchy.n_levels() - 2);
    const std::vector<double> sizes = {static_cast<double>(problem.half_spaces.size()),
                                       static_cast<double>(below.half_spaces.size())};
    std::vector<double>       sums(2);
    Utilities::MPI::sum(sizes, below.matrix.partition().communicator(), sums);
    return sums[0] > 0. && sums[1] > 0.;
  }



  std::vector<unsigned int> TruncatedNewtonMultigrid::start_below(Vector &v, const ObstacleProblem &problem)
  {
    MultigridLevel &below   = hierarchy.level(hierarchy.n_levels() - 2);
    const auto      nothing = [](const HalfSpaces &half_spaces) {
      return std::vector<unsigned char>(half_spaces.size(), 0);
    };
    // What an earlier solve has left.
    hierarchy.truncate(problem.half_spaces, nothing(problem.half_spaces));
    ObstacleProblem problem_below;
    below.matrix.partition().reinit(problem_below.rhs);
    restrict_defect(below, problem_below.rhs, problem.rhs);
    problem_below.half_spaces           = below.half_spaces;
    SolverParameters parameters_below   = parameters;
    parameters_below.tolerance          = start_tolerance;
    parameters_below.absolute_tolerance = 0.;
    parameters_below.check_monotonicity = false;

    Vector start;
    below.matrix.partition().reinit(start);
    ConvergenceReport report;
    {
      const MultigridHierarchy::WithoutFinest without_finest(hierarchy);
      report = TruncatedNewtonMultigrid(hierarchy, parameters_below).solve(start, problem_below);
      hierarchy.truncate(problem_below.half_spaces, nothing(problem_below.half_spaces));
      below.smoother->set_half_spaces(HalfSpaces());
    }
    below.to_finer.prolongate(v, start);
    report.start_iterations.push_back(report.iterations);
    return report.start_iterations;
  }



  Vector &TruncatedNewtonMultigrid::prolongate_correction()
  {
    hierarchy.level(hierarchy.n_levels() - 2).to_finer.prolongate(scratch, coarse_correction);
    hierarchy.finest().smoother->restrict_to_tangents(scratch);
    return scratch;
  }



  double TruncatedNewtonMultigrid::correct(Vector &z, Vector &residual, const bool semidefinite,
                                           bool &searches)
  {
    const ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    if (hierarchy.truncate(smoother.half_spaces(), smoother.active()))
      ++n_updates;
    coarse_defect = 0.;
    restrict_defect(hierarchy.level(hierarchy.n_levels() - 2), coarse_defect, residual);
    cycle.apply(coarse_correction, coarse_defect);
    z.zero_out_ghost_values();
    Vector      &step   = prolongate_correction();
    const double length = std::min(1., admissible_step(z, step, smoother.half_spaces()));
    searches            = searches || (length < 1. && !semidefinite);
    if (searches)
      {
        smoother.restrict_to_tangents(residual);
        return add_better(z, residual, length, semidefinite);
      }
    z.add(length, step);
    return 0.;
  }



  double TruncatedNewtonMultigrid::add_better(Vector &z, const Vector &residual, const double length,
                                              const bool semidefinite)
  {
    const ProjectedGaussSeidel &smoother    = *hierarchy.finest().smoother;
    const HalfSpaces           &half_spaces = smoother.half_spaces();
    Vector                     &step        = scratch;
    double                      square      = 0.;
    if (length < 1. && !semidefinite)
      {
        // A V-cycle is at most the inverse of A: the slope is at least the curvature.
        square                = std::max(residual * step, 0.);
        const double decrease = (length - .5 * length * length) * square;
        smoother.project_correction(step, z);
        const LineSearch projected = search_along(z, step, residual, half_spaces, semidefinite);
        if (projected.decrease >= decrease)
          {
            z.add(projected.length, step);
            return std::sqrt(square);
          }
        prolongate_correction();
      }
    if (length < 1.)
      step *= length;
    z.add(search_along(z, step, residual, half_spaces, semidefinite).length, step);
    return std::sqrt(square);
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
                                            const ObstacleProblem &problem)
  {
    const ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    conjugate.update(z, az);
    const Vector &direction = conjugate.direction();
    const double  curvature = direction * conjugate.product();
    const double  slope     = residual * direction - smoother.normal_product(residual, direction);
    const double  length    = curvature > 0. ? slope / curvature : 0.;
    if (!(length > 0.) || (problem.semidefinite && length > longest_step) ||
        length > admissible_step(v, direction, problem.half_spaces))
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
    ConvergenceReport report;
    bool              is_good_start = hierarchy.expects_active_set();
    if (!is_good_start && has_nested_start(v, problem))
      {
        report.start_iterations = start_below(v, problem);
        is_good_start           = true;
      }
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

    // One iteration: v + z from v. The residuals are those of v and v + z.
    Vector  z, residual, new_residual;
    Vector &product = scratch;
    for (Vector *vector : {&z, &residual, &new_residual})
      vector->reinit(v);
    matrix.symmetric_residual(residual, v, problem.rhs);
    // Whether active nodes lie on their planes: a shortened step leaves them on the way, and the next
    // iteration, with a search, is not shortened and takes them there. The way to the planes is no linear
    // function of the residual, as conjugate gradients need it.
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
        // From a good start a set that the first half keeps is mostly the last one. A search would cost a
        // product.
        if (accelerates && is_good_start && !problem.semidefinite)
          rests = is_on_planes && all_ranks(keeps_active);
        bool         searches = !rests;
        const double cut_off  = correct(z, new_residual, problem.semidefinite, searches);
        // Without a search the iteration as a whole lowers the energy, not each step after the first.
        if (searches)
          check(true);
        else
          energy = before;
        smoother.smooth_to_residual(z, residual, smoothing, &new_residual);
        keeps_active = all_ranks(keeps_active && smoother.active() == active);

        product = residual;
        product -= new_residual;
        Assert(searches || is_on_planes, ExcInternalError());
        // What was cut off is no linear function of the residual either.
        const bool is_linear = keeps_active && is_on_planes && cut_off == 0.;
        rests                = accelerates && is_linear && accelerate(v, residual, z, product, problem);
        // Before it is shortened: a correction that was cut off does not mean convergence.
        const double norm = std::max(std::sqrt(std::max(z * product, 0.)), cut_off);
        if (rests)
          residual -= product;
        else
          {
            conjugate.restart();
            const double length = searches ? 1. : safe_length(z, product, residual, keeps_active);
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
        is_slow = is_slow || (rests && !report.history.empty() &&
                              norm > slow_rate(parameters.smoothing) * report.history.back());
        // Rounding along motions that cost nothing feeds on itself through old directions.
        if (problem.semidefinite && !report.history.empty() && norm > report.history.back())
          {
            rests = false;
            conjugate.restart();
          }
        check(false);
        const double square = v * problem.rhs - v * residual;
        book_iteration(report, norm, std::sqrt(std::max(square, 0.)), monitor);
      }
    close(report, v, problem, residual);
    report.hierarchy_updates       = n_updates;
    report.needed_interface_sweeps = is_slow;
    return report;
  }
} // namespace Signorini
