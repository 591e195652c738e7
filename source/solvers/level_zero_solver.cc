// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/level_zero_solver.h>

namespace Signorini
{
  namespace
  {
    /// From here on the fill of the factors costs more than the cycles.
    constexpr NodeIndex    largest_for_cholesky = 500;
    constexpr double       amg_tolerance        = 1e-3;
    constexpr unsigned int amg_iterations       = 100;
  } // namespace



  bool LevelZero::uses_amg(const NodeIndex n_nodes) const
  {
    return method == LevelZeroMethod::amg ||
           (method == LevelZeroMethod::automatic && n_nodes > largest_for_cholesky);
  }



  void LevelZeroSolver::setup(const NodeBlockMatrix &new_matrix, const LevelZero &level_zero)
  {
    matrix = &new_matrix;
    if (!level_zero.uses_amg(new_matrix.partition().n_global()))
      {
        amg.reset();
        cholesky.factorize(new_matrix);
        return;
      }
    amg = std::make_unique<AlgebraicMultigrid>();
    amg->initialize(new_matrix, level_zero.near_kernel);
  }



  void LevelZeroSolver::solve(Vector &solution, const Vector &rhs) const
  {
    if (!amg)
      {
        cholesky.solve(solution, rhs);
        return;
      }
    solution = 0.;
    solve_cg(*matrix, *amg, solution, rhs, amg_tolerance, amg_iterations);
  }
} // namespace Signorini
