// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/linear_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  LinearMultigrid::LinearMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 1)
  {
  }



  ConvergenceReport LinearMultigrid::solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix = hierarchy.finest().matrix;
    AssertThrow(Utilities::MPI::sum(problem.half_spaces.size(), matrix.partition().communicator()) == 0,
                ExcMessage("The linear multigrid cannot solve problems with contact."));
    hierarchy.finest().smoother->set_half_spaces(problem.half_spaces);

    ConvergenceReport  report;
    ConjugateDirection conjugate;
    Vector             z, product, residual, new_residual;
    for (Vector *vector : {&z, &product, &residual, &new_residual})
      vector->reinit(v);
    matrix.symmetric_residual(residual, v, problem.rhs);
    while (goes_on(report))
      {
        cycle.apply(z, residual, new_residual);
        product = residual;
        product -= new_residual;
        const double norm = std::sqrt(std::max(z * product, 0.));
        z.zero_out_ghost_values();
        v.zero_out_ghost_values();
        // Rounding along motions that cost nothing feeds on itself through old directions.
        if (problem.semidefinite && !report.history.empty() && norm > report.history.back())
          conjugate.restart();
        bool has_step = false;
        if (parameters.method == SolverMethod::multigrid_cg)
          {
            conjugate.update(z, product);
            const Vector &p = conjugate.direction(), &ap = conjugate.product();
            const double  curvature = p * ap, slope = residual * p;
            has_step = curvature > 0. && slope > 0.;
            if (has_step)
              {
                v.add(slope / curvature, p);
                residual.add(-slope / curvature, ap);
              }
            else
              conjugate.restart();
          }
        if (!has_step)
          {
            v += z;
            residual.swap(new_residual);
          }
        const double square = v * problem.rhs - v * residual;
        book_iteration(report, norm, std::sqrt(std::max(square, 0.)), monitor);
      }
    close(report, v, problem, residual);
    return report;
  }
} // namespace Signorini
