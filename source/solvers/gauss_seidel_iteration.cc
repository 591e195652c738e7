// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/gauss_seidel_iteration.h>
#include <signorini/solvers/substep_check.h>

namespace Signorini
{
  ConvergenceReport GaussSeidelIteration::solve(Vector &v, const ObstacleProblem &problem,
                                                const Monitor &monitor)
  {
    Smoother &smoother = *hierarchy.level(level).smoother;
    contact            = ContactState(matrix(), problem.half_spaces);
    contact.project(v);
    ConvergenceReport report;
    SubstepCheck      check(matrix(), problem, report, parameters.check_monotonicity);
    Vector            correction, product;
    correction.reinit(v);
    product.reinit(v);
    while (goes_on(report))
      {
        correction.copy_locally_owned_data_from(v);
        for (const auto direction : {Direction::forward, Direction::backward})
          {
            smoother.smooth(v, problem.rhs, contact, {1, 1, 0}, direction);
            check(v);
          }
        correction.sadd(-1., 1., v);
        matrix().vmult(product, correction);
        const double size = std::sqrt(std::max(product * correction, 0.));
        matrix().vmult(product, v);
        book_iteration(report, size, std::sqrt(std::max(product * v, 0.)), monitor);
      }
    close(report, v, problem);
    return report;
  }
} // namespace Signorini
