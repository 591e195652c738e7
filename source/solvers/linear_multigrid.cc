// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/linear_multigrid.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  LinearMultigrid::LinearMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters, hierarchy.n_levels() - 1)
    , cycle(hierarchy, parameters.smoothing, hierarchy.n_levels() - 1)
  {
  }



  ConvergenceReport LinearMultigrid::solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor)
  {
    AssertThrow(Utilities::MPI::sum(problem.half_spaces.size(), matrix().partition().communicator()) == 0,
                ExcMessage("The linear multigrid cannot solve problems with contact."));
    contact = ContactState(matrix());

    ConvergenceReport  report;
    ConjugateGradients conjugate;
    Vector             z, product, residual, new_residual;
    for (Vector *vector : {&z, &product, &residual, &new_residual})
      vector->reinit(v);
    matrix().symmetric_residual(residual, v, problem.rhs);
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
        const double length = parameters.method == SolverMethod::multigrid_cg
                                  ? conjugate.find_step(z, product, residual, contact)
                                  : 0.;
        if (length > 0.)
          {
            v.add(length, conjugate.direction());
            residual.add(-length, conjugate.product());
          }
        else
          {
            conjugate.restart();
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
