// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_gathered_obstacle_problem_h
#define signorini_solvers_gathered_obstacle_problem_h

#include <signorini/algebra/node_block_matrix.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// What a rank tells about one of the nodes of a small obstacle problem.
  struct NodeState
  {
    /// rhs - A v at the node (force); the unit normal of its half-space.
    Vector3 residual, normal;
    /// Way to the plane (length); negative without a half-space.
    double room = -1.;
    /// Whether the half-space is active, 1 or 0: states are sent as numbers.
    double is_active = 0.;
  };

  /// How a node moves.
  struct NodeStep
  {
    /// Change of v (length).
    Vector3 step;
    /// Whether the half-space is active then, 1 or 0.
    double is_active = 0.;
  };

  /// A small obstacle problem, ½ sᵀ A s - residualᵀ s = min with n_p . s_p <= room_p, gathered and solved on
  /// rank 0 by a primal-dual active set method with sparse Cholesky factors (CHOLMOD). A may be singular: a
  /// small multiple of its diagonal is added to what is factorized then. Where the active sets do not settle,
  /// because motions cost next to nothing, an interior point method follows (Mehrotra 1992).
  class GatheredObstacleProblem
  {
  public:
    /// Blocks of some rows, by number of node.
    struct Blocks
    {
      /// Numbers of nodes, and nine numbers for each pair of them.
      std::vector<std::size_t> rows, columns;
      std::vector<double>      values;

      /// Appends a block.
      void add(const std::size_t row, const std::size_t column, const Block &block)
      {
        rows.push_back(row);
        columns.push_back(column);
        values.resize(values.size() + dim * dim);
        write_block(values.data() + values.size() - dim * dim, block);
      }
    };

    /// To be followed by set_matrix().
    GatheredObstacleProblem();
    ~GatheredObstacleProblem();
    /// Moves the factors.
    GatheredObstacleProblem(GatheredObstacleProblem &&) noexcept;

    /// Collective. The matrix, from the rows that each rank owns; the structure stays the same from the first
    /// call on.
    /// @param n_nodes of all ranks, which own them in the order of the ranks
    void set_matrix(Blocks mine, const std::size_t n_nodes, const MPI_Comm communicator);

    /// Collective. The minimizer, up to forces of 1e-6 of the residual; zero, and the active set of before,
    /// if there is none.
    /// @param mine the nodes of this rank, in order
    std::vector<NodeStep> solve(const std::vector<NodeState> &mine);

  private:
    struct Factors;

    MPI_Comm communicator = MPI_COMM_SELF;
    /// On rank 0.
    std::unique_ptr<Factors> factors;
  };
} // namespace Signorini

#endif
