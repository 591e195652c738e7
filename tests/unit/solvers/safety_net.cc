// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "cube_problem.h"

#include <signorini/solvers/obstacle_solver.h>

#include <gtest/gtest.h>

using namespace Signorini;

namespace
{
  /// Catches every iteration that has not converged after three, on a mesh that is not small and whose
  /// factors are dear.
  SafetyNetRule strict()
  {
    SafetyNetRule rule;
    rule.n_to_settle     = 1000;
    rule.n_watched       = 2;
    rule.few_left        = 0.;
    rule.many_left       = 0.;
    rule.small           = 0.;
    rule.cheap_factors   = 0.;
    rule.fewest_searched = 0;
    return rule;
  }

  /// Problem S1 of doc/verification.md, 16^3 cells.
  ConvergenceReport solve(const SafetyNetRule &rule, const bool starts_with_patches = false)
  {
    MultigridHierarchy hierarchy = CubeProblem::hierarchy(16);
    ObstacleProblem    problem;
    problem.half_spaces = CubeProblem::paraboloid(CubeProblem::Grid(16));
    hierarchy.finest().matrix.partition().reinit(problem.rhs);
    Vector v;
    v.reinit(problem.rhs);
    SolverParameters parameters;
    parameters.net_rule            = rule;
    parameters.starts_with_patches = starts_with_patches;
    const ConvergenceReport report = make_solver(hierarchy, parameters)->solve(v, problem);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.active_nodes.back(), 21u);
    EXPECT_NEAR(report.energy / 2.328860217949e-4, 1., 1e-11);
    return report;
  }
} // namespace



TEST(SafetyNet, LeavesAFastIterationAlone)
{
  const ConvergenceReport report = solve(SafetyNetRule());
  EXPECT_EQ(report.safety_net.after, 0u);
  EXPECT_EQ(report.safety_net.n_steps, 0u);
  EXPECT_FALSE(report.needed_patches);
}

TEST(SafetyNet, FactorsWhereTheyAreCheapOrTheMeshIsSmall)
{
  for (const bool is_small : {true, false})
    {
      SafetyNetRule rule                           = strict();
      (is_small ? rule.small : rule.cheap_factors) = 1e12;
      const ConvergenceReport report               = solve(rule);
      EXPECT_EQ(report.safety_net.after, 3u);
      EXPECT_EQ(report.safety_net.linear_solver, "sparse factors");
      EXPECT_GE(report.safety_net.n_steps, 1u);
      EXPECT_EQ(report.safety_net.n_failed, 0u);
      EXPECT_FALSE(report.needed_patches);
      EXPECT_LT(report.iterations, 9u);
    }
}

// Neither cheap nor small enough that their cost is looked at.
TEST(SafetyNet, CyclesWhereTheActiveSetDoesNotRest)
{
  for (const bool is_large : {true, false})
    {
      SafetyNetRule rule = strict();
      if (is_large)
        {
          rule.largest_for_factors = 1.;
          rule.cheap_factors       = 1e12;
        }
      const ConvergenceReport report = solve(rule);
      EXPECT_EQ(report.safety_net.after, 3u);
      EXPECT_EQ(report.safety_net.linear_solver, "conjugate gradients with the V-cycle");
      EXPECT_EQ(report.safety_net.n_failed, 0u);
      EXPECT_FALSE(report.needed_patches);
    }
}

// Where conjugate gradients took most of the iterations the active set rests: patches, once, or nothing
// where these would be too large.
TEST(SafetyNet, PatchesWhereTheLinearProblemIsSlow)
{
  SafetyNetRule rule       = strict();
  rule.fewest_searched     = 3;
  ConvergenceReport report = solve(rule);
  EXPECT_TRUE(report.needed_patches);
  EXPECT_EQ(report.before_patches, 3u);
  EXPECT_EQ(report.safety_net.n_steps, 0u);
  rule.largest_for_patches = 1.;
  report                   = solve(rule);
  EXPECT_FALSE(report.needed_patches);
  EXPECT_EQ(report.safety_net.n_steps, 0u);
}

TEST(SafetyNet, MayStartWithPatches)
{
  SafetyNetRule rule       = strict();
  rule.n_watched           = 1000;
  ConvergenceReport report = solve(rule, true);
  EXPECT_TRUE(report.needed_patches);
  EXPECT_EQ(report.before_patches, 0u);
  rule.largest_for_patches = 1.;
  EXPECT_FALSE(solve(rule, true).needed_patches);
  // A small mesh has factors in reserve.
  rule       = strict();
  rule.small = 1e12;
  EXPECT_FALSE(solve(rule, true).needed_patches);
}
