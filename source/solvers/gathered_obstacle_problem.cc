// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gathered_states.h"
#include "interior_point.h"
#include "single_threaded.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/solvers/obstacle_problem.h>

#include <deal.II/base/mpi.h>

#include <Eigen/CholmodSupport>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct GatheredProblemRule
    {
      /// Steps of the primal-dual active set method, which may cycle.
      unsigned int n_steps = 20;
      /// Part of the diagonal that makes a singular matrix definite: the rounding of the residual does not
      /// move a body much, and a body that nothing holds moves as far as something does.
      double regularization = 1e-9;
      /// Forces that it may leave, relative to the residual of the start.
      double forces_left = 1e-6;
    };

    using States = std::vector<NodeState>;
    using Flags  = std::vector<unsigned char>;
  } // namespace



  /// The problem on rank 0.
  struct GatheredObstacleProblem::Factors
  {
    GatheredBlocks            matrix;
    GatheredBlocks::UpperHalf truncated;
    InteriorPoint::Cholesky   cholesky;
    /// The active set of the last result.
    Flags last;
    /// Planes that were cut off before the factorization; valid if has_factors.
    Flags factorized;
    bool  has_factors = false, is_definite = false;
    /// Singular matrices stay singular.
    bool is_singular = false;

    Factors()
    {
      cholesky.cholmod().print = 0;
    }

    void set_structure();
    void factorize(const States &states, const Flags &active);
    bool try_factors(const States &states);

    /// The step to the minimizer on the planes of active nodes; `residual` becomes that of the result.
    bool minimize(Eigen::VectorXd &step, Eigen::VectorXd &residual, const States &states,
                  const Flags &active);

    bool            settle(Eigen::VectorXd &step, const States &states, Flags &active);
    Eigen::VectorXd solve(const States &states, Flags &active);
  };



  namespace
  {
    /// Without normal parts at active nodes.
    Eigen::VectorXd in_planes(Eigen::VectorXd x, const States &states, const Flags &active)
    {
      for (std::size_t i = 0; i < states.size(); ++i)
        if (active[i])
          add_normal(x, i, states[i].normal, -normal_part(x, i, states[i].normal));
      return x;
    }

    /// Moves active nodes onto their planes.
    Eigen::VectorXd to_planes(Eigen::VectorXd step, const States &states, const Flags &active)
    {
      for (std::size_t i = 0; i < states.size(); ++i)
        if (active[i])
          add_normal(step, i, states[i].normal, states[i].room - normal_part(step, i, states[i].normal));
      return step;
    }
  } // namespace



  void GatheredObstacleProblem::Factors::set_structure()
  {
    has_factors = false;
    if (truncated.rows() != 0)
      return;
    truncated = matrix.upper_structure();
    cholesky.analyzePattern(truncated);
  }



  bool GatheredObstacleProblem::Factors::try_factors(const States &states)
  {
    const double stiffer  = is_singular ? 1. + GatheredProblemRule().regularization : 1.;
    const auto   plane_of = [&](const std::size_t node) {
      return factorized[node] ? states[node].normal : Vector3();
    };
    matrix.fill_upper(
        truncated, [&](const std::size_t row, const std::size_t column, const double *const block) {
          const Block result =
              restrict_to_planes(read_block(block), plane_of(row), plane_of(column), row == column);
          return row == column ? stiffer * result : result;
        });
    const SingleThreaded single_threaded;
    cholesky.factorize(truncated);
    return cholesky.info() == Eigen::Success;
  }



  void GatheredObstacleProblem::Factors::factorize(const States &states, const Flags &active)
  {
    if (has_factors && factorized == active)
      return;
    factorized  = active;
    has_factors = true;
    is_definite = try_factors(states);
    if (!is_definite && !is_singular)
      {
        is_singular = true;
        is_definite = try_factors(states);
      }
  }



  bool GatheredObstacleProblem::Factors::minimize(Eigen::VectorXd &step, Eigen::VectorXd &residual,
                                                  const States &states, const Flags &active)
  {
    factorize(states, active);
    if (!is_definite)
      return false;
    step                             = to_planes(Eigen::VectorXd::Zero(dim * states.size()), states, active);
    residual                         = residual_of(states) - matrix * step;
    const Eigen::VectorXd tangential = cholesky.solve(in_planes(residual, states, active));
    step += tangential;
    residual -= matrix * tangential;
    return true;
  }



  bool GatheredObstacleProblem::Factors::settle(Eigen::VectorXd &step, const States &states, Flags &active)
  {
    Eigen::VectorXd residual;
    for (unsigned int k = 0; k < GatheredProblemRule().n_steps; ++k)
      {
        if (!minimize(step, residual, states, active))
          return false;
        bool changes = false;
        for (std::size_t i = 0; i < states.size(); ++i)
          if (states[i].room >= 0.)
            {
              const bool now = active[i] ? normal_part(residual, i, states[i].normal) >= 0.
                                         : normal_part(step, i, states[i].normal) > states[i].room;
              changes        = changes || now != static_cast<bool>(active[i]);
              active[i]      = now;
            }
        if (!changes)
          return in_planes(residual, states, active).norm() <=
                 GatheredProblemRule().forces_left * residual_of(states).norm();
      }
    return false;
  }



  Eigen::VectorXd GatheredObstacleProblem::Factors::solve(const States &states, Flags &active)
  {
    const Flags     start = active;
    Eigen::VectorXd step;
    // Sweeps by node leave a poor guess behind; the result of the last visit is a better one.
    if (!last.empty())
      for (std::size_t i = 0; i < states.size(); ++i)
        active[i] = last[i] && states[i].room >= 0.;
    if (!settle(step, states, active))
      {
        has_factors = false;
        InteriorPoint interior(matrix, states, truncated, cholesky);
        if (!interior.run())
          {
            active = start;
            return Eigen::VectorXd::Zero(dim * states.size());
          }
        active = interior.active();
        step   = to_planes(interior.step(), states, active);
      }
    last = active;
    return step;
  }



  GatheredObstacleProblem::GatheredObstacleProblem() = default;



  GatheredObstacleProblem::~GatheredObstacleProblem() = default;



  GatheredObstacleProblem::GatheredObstacleProblem(GatheredObstacleProblem &&) noexcept = default;



  void GatheredObstacleProblem::set_matrix(Blocks mine, const std::size_t n_nodes, const MPI_Comm comm)
  {
    communicator = comm;
    if (!factors)
      factors = std::make_unique<Factors>();
    factors->matrix.gather(std::move(mine), n_nodes, comm);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      factors->set_structure();
  }



  std::vector<NodeStep> GatheredObstacleProblem::solve(const std::vector<NodeState> &mine)
  {
    const States          states = gather_lists(mine, communicator, Receivers::rank_zero);
    std::vector<NodeStep> steps;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        AssertDimension(states.size(), factors->matrix.n_rows());
        Flags active;
        for (const NodeState &node : states)
          active.push_back(node.is_active != 0.);
        const Eigen::VectorXd step = factors->solve(states, active);
        for (std::size_t i = 0; i < states.size(); ++i)
          steps.push_back({Vector3({step[dim * i], step[dim * i + 1], step[dim * i + 2]}),
                           static_cast<double>(active[i])});
      }
    return scatter_list(steps, mine.size(), communicator);
  }
} // namespace Signorini
