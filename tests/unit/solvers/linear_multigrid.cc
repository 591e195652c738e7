// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/obstacle_solver.h>

#include <gtest/gtest.h>

#include "unit/solvers/cube_problem.h"

using namespace Signorini;

namespace
{
  ConvergenceReport solve(const SolverMethod method, MultigridHierarchy &hierarchy, Vector &v,
                          const ObstacleProblem &problem)
  {
    SolverParameters parameters;
    parameters.method = method;
    return make_solver(hierarchy, parameters)->solve(v, problem);
  }
} // namespace



// A solution that is known; conjugate gradients need fewer cycles; the number hardly depends on the mesh.
TEST(LinearMultigrid, FindsAKnownSolution)
{
  for (const unsigned int n : {8, 16})
    {
      const CubeProblem::Grid grid(n);
      MultigridHierarchy      hierarchy = CubeProblem::hierarchy(n);
      const NodeBlockMatrix  &matrix    = hierarchy.finest().matrix;
      ObstacleProblem         problem;
      Vector                  expected, start;
      for (Vector *vector : {&expected, &start, &problem.rhs})
        matrix.partition().reinit(*vector);
      for (const NodeIndex p : grid.owned)
        for (unsigned int c = 0; c < dim; ++c)
          if (grid.index(p)[2] < n)
            expected(dim * p + c) = std::sin(1. + 7. * static_cast<double>(p) + 3. * c);
      matrix.vmult(problem.rhs, expected);

      Vector     v = start, w = start;
      const auto plain       = solve(SolverMethod::multigrid, hierarchy, v, problem);
      const auto accelerated = solve(SolverMethod::multigrid_cg, hierarchy, w, problem);
      EXPECT_TRUE(plain.converged && accelerated.converged);
      EXPECT_LE(plain.iterations, 16u);
      EXPECT_LE(accelerated.iterations, 11u);
      EXPECT_NEAR(accelerated.energy / plain.energy, 1., 1e-12);
      for (Vector *solution : {&v, &w})
        {
          solution->zero_out_ghost_values();
          expected.zero_out_ghost_values();
          *solution -= expected;
          EXPECT_LE(solution->linfty_norm(), 1e-11);
        }
    }
}



TEST(LinearMultigrid, RefusesContact)
{
  MultigridHierarchy hierarchy = CubeProblem::hierarchy(4);
  ObstacleProblem    problem;
  problem.half_spaces = CubeProblem::paraboloid(CubeProblem::Grid(4));
  hierarchy.finest().matrix.partition().reinit(problem.rhs);
  Vector v = problem.rhs;
  EXPECT_THROW(solve(SolverMethod::multigrid, hierarchy, v, problem), dealii::ExceptionBase);
}
