// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_substep_check_h
#define signorini_solvers_substep_check_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/convergence_report.h>
#include <signorini/solvers/obstacle_problem.h>

namespace Signorini
{
  /// Books, if wanted (SolverParameters::check_monotonicity), what each substep of an iteration does to
  /// energy and admissibility.
  class SubstepCheck
  {
  public:
    /// All must outlive the object.
    SubstepCheck(const NodeBlockMatrix &matrix, const ObstacleProblem &problem, ConvergenceReport &report,
                 const bool is_wanted)
      : matrix(matrix)
      , problem(problem)
      , report(report)
      , is_wanted(is_wanted)
    {
    }

    /// Collective. After a substep that ended at v.
    void operator()(const Vector &v);

    /// Collective. After a substep that ended at v + z.
    void operator()(const Vector &v, const Vector &z);

    /// Where return_to_start() goes back to.
    void begin_iteration()
    {
      at_start = energy;
    }

    /// The substeps to come are to be compared with the start of the iteration, not with the one before: it
    /// is the iteration as a whole that lowers the energy.
    void return_to_start()
    {
      energy = at_start;
    }

  private:
    const NodeBlockMatrix &matrix;
    const ObstacleProblem &problem;
    ConvergenceReport     &report;
    const bool             is_wanted;
    double                 energy   = std::numeric_limits<double>::infinity();
    double                 at_start = std::numeric_limits<double>::infinity();
  };
} // namespace Signorini

#endif
