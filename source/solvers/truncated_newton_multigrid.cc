// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/truncated_newton_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  TruncatedNewtonMultigrid::TruncatedNewtonMultigrid(MultigridHierarchy     &hierarchy,
                                                     const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 2)
  {
  }



  bool TruncatedNewtonMultigrid::all_ranks(const bool condition) const
  {
    return Utilities::MPI::min(static_cast<int>(condition),
                               hierarchy.finest().matrix.partition().communicator()) != 0;
  }



  double TruncatedNewtonMultigrid::correct(Vector &v, const ObstacleProblem &problem, const bool search)
  {
    const NodeBlockMatrix &matrix   = hierarchy.finest().matrix;
    ProjectedGaussSeidel  &smoother = *hierarchy.finest().smoother;
    MultigridLevel        &coarse   = hierarchy.level(hierarchy.n_levels() - 2);
    if (hierarchy.truncate(problem.half_spaces, smoother.active()))
      ++n_updates;

    Vector residual, coarse_defect, coarse_correction, c;
    residual.reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    const double square = v * problem.rhs - v * residual;

    coarse.matrix.partition().reinit(coarse_defect);
    coarse.matrix.partition().reinit(coarse_correction);
    restrict_defect(coarse, coarse_defect, residual);
    cycle.apply(coarse_correction, coarse_defect);

    c.reinit(v);
    coarse.to_finer.prolongate(c, coarse_correction);
    if (problem.semidefinite)
      {
        // Motions that cost nothing come out very long: shortened as a whole they stay motions.
        smoother.restrict_to_tangents(c);
        c *= std::min(1., admissible_step(v, c, problem.half_spaces));
      }
    else
      smoother.project_correction(c, v);
    v.zero_out_ghost_values();
    if (!search)
      {
        v.add(1., c);
        return square;
      }
    add_searched(v, c, residual, problem);
    return square;
  }



  bool TruncatedNewtonMultigrid::accelerate(const Vector &start, const Vector &residual, Vector &z,
                                            Vector &az, const HalfSpaces &half_spaces)
  {
    const ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    if (has_direction)
      {
        const double beta = -(z * direction_product) / (direction * direction_product);
        z.add(beta, direction);
        az.add(beta, direction_product);
      }
    const double curvature = z * az;
    const double slope     = residual * z - smoother.normal_product(residual, z);
    const double step      = curvature > 0. ? slope / curvature : 0.;
    if (!(step > 0.) || step > admissible_step(start, z, half_spaces))
      return false;
    direction         = z;
    direction_product = az;
    has_direction     = true;
    z *= step;
    az *= step;
    return true;
  }



  ConvergenceReport TruncatedNewtonMultigrid::solve(Vector &v, const ObstacleProblem &problem,
                                                    const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix   = hierarchy.finest().matrix;
    ProjectedGaussSeidel  &smoother = *hierarchy.finest().smoother;
    smoother.set_half_spaces(problem.half_spaces);
    smoother.project(v);
    n_updates     = 0;
    has_direction = false;

    ConvergenceReport report;
    Vector            start, residual, correction, product;
    for (Vector *vector : {&start, &residual, &correction, &product})
      vector->reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    bool   rests  = false;
    double energy = std::numeric_limits<double>::infinity();
    while (goes_on(report))
      {
        const std::vector<unsigned char> active = smoother.active();
        start.copy_locally_owned_data_from(v);
        smoother.smooth(v, problem.rhs, parameters.smoothing, ProjectedGaussSeidel::forward);
        check_substep(report, energy, v, problem);
        bool         keeps_active = smoother.active() == active;
        const double square       = correct(v, problem, !rests);
        if (!rests)
          check_substep(report, energy, v, problem);
        smoother.smooth(v, problem.rhs, parameters.smoothing, ProjectedGaussSeidel::backward);
        keeps_active = all_ranks(keeps_active && smoother.active() == active);

        correction.copy_locally_owned_data_from(v);
        correction -= start;
        matrix.vmult(product, correction);
        double norm = std::sqrt(std::max(0., correction * product));
        rests       = keeps_active && parameters.method == SolverMethod::accelerated;
        if (rests && accelerate(start, residual, correction, product, problem.half_spaces))
          {
            v.copy_locally_owned_data_from(start);
            v += correction;
            norm = std::sqrt(std::max(0., correction * product));
          }
        else
          {
            if (rests)
              {
                // accelerate() has changed the correction.
                correction.copy_locally_owned_data_from(v);
                correction -= start;
                matrix.vmult(product, correction);
              }
            rests = has_direction = false;
          }
        // Rounding along motions that cost nothing feeds on itself through old directions.
        if (problem.semidefinite && !report.history.empty() && norm > report.history.back())
          rests = has_direction = false;
        residual -= product;
        check_substep(report, energy, v, problem);
        book_iteration(report, norm, std::sqrt(std::max(0., square)), monitor);
      }
    close(report, v, problem);
    report.hierarchy_updates = n_updates;
    return report;
  }
} // namespace Signorini
