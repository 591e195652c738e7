// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/gauss_seidel_iteration.h>

namespace Signorini
{
  ConvergenceReport GaussSeidelIteration::solve(Vector &v, const ObstacleProblem &problem,
                                                const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix   = hierarchy.finest().matrix;
    ProjectedGaussSeidel  &smoother = *hierarchy.finest().smoother;
    smoother.set_half_spaces(problem.half_spaces);
    smoother.project(v);
    ConvergenceReport report;
    Vector            correction, product;
    correction.reinit(v);
    product.reinit(v);
    double energy = std::numeric_limits<double>::infinity();
    while (goes_on(report))
      {
        correction.copy_locally_owned_data_from(v);
        for (const auto direction : {ProjectedGaussSeidel::forward, ProjectedGaussSeidel::backward})
          {
            smoother.smooth(v, problem.rhs, {1, 1, 0}, direction);
            check_substep(report, energy, v, problem);
          }
        correction.sadd(-1., 1., v);
        matrix.vmult(product, correction);
        const double size = std::sqrt(std::max(product * correction, 0.));
        matrix.vmult(product, v);
        book_iteration(report, size, std::sqrt(std::max(product * v, 0.)), monitor);
      }
    close(report, v, problem);
    return report;
  }
} // namespace Signorini
