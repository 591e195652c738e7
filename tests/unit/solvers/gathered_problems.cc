// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Small obstacle problems that are solved on one rank: the result fulfils the conditions of a minimizer, also
// where bodies move sideways at next to no cost, as on facets.

#include <signorini/solvers/gathered_obstacle_problem.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <random>

using namespace Signorini;

namespace
{
  /// Nodes that springs connect, on facets that are inclined by some angle at most, and pressed down.
  class Nodes
  {
  public:
    Nodes(const unsigned int seed, const std::size_t n, const double inclination)
      : generator(seed)
      , matrix(n, std::vector<double>(n, 0.))
      , states(n)
    {
      for (std::size_t i = 1; i < n; ++i)
        for (const std::size_t k : {i - 1, index(i)})
          connect(i, k, std::exp(number(-2., 2.)));
      for (NodeState &node : states)
        {
          node.normal = Vector3({number(-inclination, inclination), number(-inclination, inclination), -1.});
          node.normal /= node.normal.norm();
          node.residual = Vector3({0., 0., -number(0., 1.)});
          node.room     = number(0., 1.) < .2 ? -1. : number(0., .1);
        }
      // Sideways less than the facets hold.
      states[0].residual[0] = .01 * inclination;
    }

    GatheredObstacleProblem::Blocks blocks() const
    {
      GatheredObstacleProblem::Blocks result;
      for (std::size_t i = 0; i < states.size(); ++i)
        for (std::size_t k = 0; k < states.size(); ++k)
          if (matrix[i][k] != 0.)
            {
              Block block;
              for (unsigned int c = 0; c < dim; ++c)
                block[c][c] = matrix[i][k];
              result.add(i, k, block);
            }
      return result;
    }

    /// The residual at a node after a step.
    Vector3 residual(const std::size_t i, const std::vector<NodeStep> &steps) const
    {
      Vector3 result = states[i].residual;
      for (std::size_t k = 0; k < states.size(); ++k)
        result -= matrix[i][k] * steps[k].step;
      return result;
    }

  private:
    double number(const double from, const double to)
    {
      return std::uniform_real_distribution<double>(from, to)(generator);
    }

    std::size_t index(const std::size_t below)
    {
      return std::uniform_int_distribution<std::size_t>(0, below - 1)(generator);
    }

    void connect(const std::size_t i, const std::size_t k, const double stiffness)
    {
      matrix[i][i] += stiffness;
      matrix[k][k] += stiffness;
      matrix[i][k] -= stiffness;
      matrix[k][i] -= stiffness;
    }

    std::mt19937                     generator;
    std::vector<std::vector<double>> matrix;

  public:
    std::vector<NodeState> states;
  };



  void check_minimizer(const Nodes &nodes, const std::vector<NodeStep> &steps)
  {
    double way = 0., load = 0.;
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        way = std::max(way, steps[i].step.norm());
        load += nodes.states[i].residual.norm_square();
      }
    const double small_force = 1e-6 * std::sqrt(load);
    for (std::size_t i = 0; i < steps.size(); ++i)
      {
        const NodeState &node     = nodes.states[i];
        Vector3          residual = nodes.residual(i, steps);
        const double     distance = node.room - node.normal * steps[i].step;
        if (steps[i].is_active != 0.)
          {
            EXPECT_NEAR(distance, 0., 1e-8 * way) << "node " << i;
            EXPECT_GE(node.normal * residual, -small_force) << "node " << i;
            residual -= (node.normal * residual) * node.normal;
          }
        else if (node.room >= 0.)
          {
            EXPECT_GE(distance, -1e-8 * way) << "node " << i;
          }
        EXPECT_LT(residual.norm(), small_force) << "node " << i;
      }
  }
} // namespace



TEST(GatheredObstacleProblem, MovesAlongFacets)
{
  const bool is_owner = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  for (const double inclination : {.3, 1e-3, 1e-5})
    for (unsigned int seed = 0; seed < 20; ++seed)
      {
        SCOPED_TRACE("inclination " + std::to_string(inclination) + ", seed " + std::to_string(seed));
        const Nodes             nodes(seed, 60, inclination);
        GatheredObstacleProblem problem;
        problem.set_matrix(is_owner ? nodes.blocks() : GatheredObstacleProblem::Blocks(), nodes.states.size(),
                           MPI_COMM_WORLD);
        const std::vector<NodeStep> steps = problem.solve(is_owner ? nodes.states : std::vector<NodeState>());
        if (is_owner)
          check_minimizer(nodes, steps);
      }
}
