// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_solvers_gathered_states_h
#define signorini_source_solvers_gathered_states_h

#include <signorini/solvers/gathered_obstacle_problem.h>

#include <Eigen/Core>

namespace Signorini
{
  // Vectors of a gathered problem, three entries a node.

  /// The residuals of all nodes.
  inline Eigen::VectorXd residual_of(const std::vector<NodeState> &states)
  {
    Eigen::VectorXd result(dim * states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result[dim * i + c] = states[i].residual[c];
    return result;
  }

  /// n . x at a node.
  inline double normal_part(const Eigen::VectorXd &x, const std::size_t node, const Vector3 &n)
  {
    return n[0] * x[dim * node] + n[1] * x[dim * node + 1] + n[2] * x[dim * node + 2];
  }

  /// Adds a multiple of n at a node.
  inline void add_normal(Eigen::VectorXd &x, const std::size_t node, const Vector3 &n, const double length)
  {
    for (unsigned int c = 0; c < dim; ++c)
      x[dim * node + c] += length * n[c];
  }
} // namespace Signorini

#endif
