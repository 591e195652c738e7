// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Random cubes that nothing but half-spaces holds, against a dense method: proximal steps, each a definite
// problem that is solved by principal pivoting.

#include <signorini/algebra/vector_span.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/solvers/free_motion_correction.h>
#include <signorini/solvers/obstacle_solver.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

#include "unit/solvers/cube_problem.h"

using namespace Signorini;

namespace
{
  using CubeProblem::Grid;

  /// Translations and rotations of a grid, orthonormal.
  std::vector<Vector> rigid_motions(const Grid &grid, const NodePartition &partition)
  {
    std::vector<Vector> motions(6);
    for (unsigned int m = 0; m < 6; ++m)
      {
        partition.reinit(motions[m]);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          {
            const auto index = grid.index(partition.to_global(i));
            Vector3    u, x({index[0] / double(grid.n) - .5, index[1] / double(grid.n) - .5,
                             index[2] / double(grid.n) - .5});
            u[m % 3] = 1.;
            if (m >= 3)
              u = cross_product_3d(u, x);
            for (unsigned int c = 0; c < dim; ++c)
              motions[m].local_element(dim * i + c) = u[c];
          }
      }
    orthonormalize(motions);
    return motions;
  }



  /// No node is fixed.
  class FreeLevels : public CubeProblem::Levels
  {
  public:
    explicit FreeLevels(const unsigned int n)
      : CubeProblem::Levels(n, CubeProblem::downwards)
      , coarsest(n)
    {
    }

    std::optional<CoarserLevel> next(const NodePartition &finer) override
    {
      auto level = CubeProblem::Levels::next(finer);
      if (level)
        {
          level->fixed.assign(level->fixed.size(), 0);
          coarsest /= 2;
        }
      return level;
    }

    LevelZero level_zero(const NodePartition &partition) override
    {
      LevelZero result    = CubeProblem::Levels::level_zero(partition);
      result.free_motions = rigid_motions(Grid(coarsest), partition);
      return result;
    }

  private:
    unsigned int coarsest;
  };



  struct Dense
  {
    Eigen::MatrixXd matrix, normals;
    Eigen::VectorXd rhs, bounds;
  };

  Dense dense(const NodeBlockMatrix &matrix, const ObstacleProblem &problem)
  {
    const auto n = static_cast<Eigen::Index>(dim * matrix.n_rows());
    const auto m = static_cast<Eigen::Index>(problem.half_spaces.size());
    Dense d{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(m, n), Eigen::VectorXd(n), Eigen::VectorXd(m)};
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      matrix.visit_row(i, [&](const RowEntry &entry) {
        for (unsigned int c = 0; c < 9; ++c)
          d.matrix(dim * i + c / 3, dim * entry.column + c % 3) = entry.block()[c / 3][c % 3];
      });
    for (Eigen::Index i = 0; i < n; ++i)
      d.rhs[i] = problem.rhs.local_element(i);
    for (Eigen::Index p = 0; p < m; ++p)
      {
        for (unsigned int c = 0; c < dim; ++c)
          d.normals(p, dim * problem.half_spaces.nodes[p] + c) = problem.half_spaces.normals[p][c];
        d.bounds[p] = problem.half_spaces.bounds[p];
      }
    return d;
  }



  /// w = C lambda + q >= 0, lambda >= 0, w lambda = 0 by the pivots of Murty (least index), from a guess.
  Eigen::VectorXd pivot(const Eigen::MatrixXd &c, const Eigen::VectorXd &q, std::vector<bool> &in_contact)
  {
    const Eigen::Index m = q.size();
    while (true)
      {
        std::vector<Eigen::Index> set;
        for (Eigen::Index p = 0; p < m; ++p)
          if (in_contact[p])
            set.push_back(p);
        const auto      n = static_cast<Eigen::Index>(set.size());
        Eigen::MatrixXd reduced(n, n);
        Eigen::VectorXd rhs(n), lambda = Eigen::VectorXd::Zero(m);
        for (Eigen::Index i = 0; i < n; ++i)
          {
            rhs[i] = -q[set[i]];
            for (Eigen::Index j = 0; j < n; ++j)
              reduced(i, j) = c(set[i], set[j]);
          }
        const Eigen::VectorXd part = n > 0 ? Eigen::VectorXd(reduced.ldlt().solve(rhs)) : rhs;
        for (Eigen::Index i = 0; i < n; ++i)
          lambda[set[i]] = part[i];
        const Eigen::VectorXd w = c * lambda + q;
        const auto p = std::find_if(in_contact.begin(), in_contact.end(), [&, i = 0](bool is_in) mutable {
          const Eigen::Index at = i++;
          return is_in ? lambda[at] < 0. : w[at] < -1e-14 * q.cwiseAbs().maxCoeff();
        });
        if (p == in_contact.end())
          return lambda;
        *p = !*p;
      }
  }



  Eigen::VectorXd solve_dense(const Dense &d, const Eigen::VectorXd &start)
  {
    const double                      weight = 1e-6 * d.matrix.diagonal().mean();
    const Eigen::Index                n      = d.matrix.rows();
    const Eigen::LLT<Eigen::MatrixXd> factors(d.matrix + weight * Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd             c = d.normals * factors.solve(d.normals.transpose());
    std::vector<bool>                 in_contact(d.bounds.size(), false);
    Eigen::VectorXd                   v = start;
    for (unsigned int step = 0; step < 2000; ++step)
      {
        const Eigen::VectorXd load   = d.rhs + weight * v;
        const Eigen::VectorXd q      = d.bounds - d.normals * factors.solve(load);
        const Eigen::VectorXd lambda = pivot(c, q, in_contact);
        const Eigen::VectorXd next   = factors.solve(load - d.normals.transpose() * lambda);
        const double          change = weight * (next - v).norm();
        v                            = next;
        if (change <= 1e-13 * d.rhs.norm())
          break;
      }
    return v;
  }
} // namespace



TEST(FreeBodies, RandomCubesAreSolvedOrFlyAway)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    GTEST_SKIP() << "the dense solver has one rank";
  const char        *wanted = std::getenv("SIGNORINI_RANDOM_FREE_BODIES");
  const unsigned int n      = wanted ? static_cast<unsigned int>(std::stoul(wanted)) : 40;
  unsigned int       n_held = 0, most_iterations = 0, n_ended = 0;
  for (unsigned int i = 0; i < n; ++i)
    {
      std::mt19937 random(i);
      const auto   uniform = [&](const double low, const double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
      };
      const unsigned int size = i % 10 == 3 ? 8 : i % 3 == 0 ? 2 : 4;
      const Grid         grid(size);
      FreeLevels         levels(size);
      HierarchyParts     parts = CubeProblem::finest_level(size);
      parts.fixed.assign(parts.fixed.size(), 0);
      parts.levels = &levels;

      // The lower face rests on something rough; sides, of which some have a wall.
      ObstacleProblem problem;
      problem.semidefinite = true;
      const double bend = i % 2 ? uniform(0., .5) : 0., noise = i % 5 ? .002 : .05, share = uniform(.3, 1.);
      const std::array<bool, 4> wall = {
          {uniform(0., 1.) < .5, uniform(0., 1.) < .5, uniform(0., 1.) < .5, uniform(0., 1.) < .5}};
      parts.interface.contact_nodes.clear();
      for (const NodeIndex p : grid.owned)
        {
          const auto index = grid.index(p);
          Vector3    normal;
          if (index[2] == 0)
            normal = Vector3({bend * uniform(-1., 1.), bend * uniform(-1., 1.), -1.});
          else
            for (unsigned int c = 0; c < 2; ++c)
              if (index[c] % size == 0 && wall[2 * c + index[c] / size])
                normal[c] = index[c] == 0 ? -1. : 1.;
          if (!(normal.norm() > 0.) || uniform(0., 1.) > share)
            continue;
          problem.half_spaces.nodes.push_back(static_cast<unsigned int>(p));
          problem.half_spaces.normals.push_back(normal / normal.norm());
          problem.half_spaces.bounds.push_back(uniform(-noise, noise));
          parts.interface.contact_nodes.push_back(p);
        }
      if (problem.half_spaces.size() == 0)
        continue;
      MultigridHierarchy   hierarchy(std::move(parts));
      const NodePartition &partition = hierarchy.finest().matrix.partition();
      problem.free_motions           = rigid_motions(grid, partition);
      partition.reinit(problem.rhs);
      const double sideways = i % 4 ? 0. : .3, load = .01 / static_cast<double>(grid.owned.n_elements());
      const double push[2] = {sideways * uniform(-1., 1.), sideways * uniform(-1., 1.)};
      for (const NodeIndex p : grid.owned)
        {
          problem.rhs.local_element(dim * p + 2) = -load * uniform(.5, 1.5);
          for (unsigned int c = 0; c < 2; ++c)
            problem.rhs.local_element(dim * p + c) = load * push[c];
        }
      // Without side walls that can take it nothing must push sideways, not even a little.
      const Dense         d = dense(hierarchy.finest().matrix, problem);
      std::vector<double> rows, work;
      for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
        for (const Vector &motion : problem.free_motions)
          rows.push_back(problem.half_spaces.normal_part(p, motion));
      for (const Vector &motion : problem.free_motions)
        {
          const double w = motion * problem.rhs;
          work.push_back(std::abs(w) > 1e-10 * problem.rhs.l1_norm() ? w : 0.);
        }
      const RigidBalance balance = balance_rigid_motions(rows, problem.half_spaces.bounds, work);
      Vector             start;
      start.reinit(problem.rhs);
      if (!balance.is_held)
        {
          for (std::size_t m = 0; m < 6; ++m)
            start.add(balance.flight[m], problem.free_motions[m]);
          EXPECT_GT(start * problem.rhs, 0.) << "problem " << i;
          for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
            EXPECT_LE(problem.half_spaces.normal_part(p, start), 1e-7) << "problem " << i;
          continue;
        }
      ++n_held;
      for (std::size_t m = 0; m < 6; ++m)
        start.add(balance.settling[m], problem.free_motions[m]);
      Eigen::VectorXd from(d.rhs.size());
      for (Eigen::Index k = 0; k < from.size(); ++k)
        from[k] = start.local_element(k);
      const Eigen::VectorXd solution = solve_dense(d, from);
      const double          scale    = std::sqrt(solution.dot(d.matrix * solution));

      // The second time the safety net takes over at once.
      for (const bool is_slow : {false, true})
        {
          SolverParameters parameters;
          parameters.max_iterations = 100;
          if (is_slow)
            {
              parameters.net_rule.n_watched       = 2;
              parameters.net_rule.few_left        = -10.;
              parameters.net_rule.fewest_searched = 0;
            }
          Vector            v      = start;
          const auto        report = make_solver(hierarchy, parameters)->solve(v, problem);
          const std::string here   = "problem " + std::to_string(i) + (is_slow ? ", active-set steps" : "");
          Eigen::VectorXd   difference = solution;
          for (Eigen::Index k = 0; k < difference.size(); ++k)
            difference[k] -= v.local_element(k);
          most_iterations = std::max(most_iterations, report.iterations);
          n_ended += report.safety_net.n_steps > 0 && report.safety_net.n_failed == 0 ? 1 : 0;
          EXPECT_TRUE(report.converged) << here;
          EXPECT_LE(report.iterations, 40u) << here;
          EXPECT_LE(std::sqrt(std::max(0., difference.dot(d.matrix * difference))), 1e-8 * scale)
              << here << ", " << report.iterations << " iterations, energy " << report.energy << ", dense "
              << solution.dot(.5 * (d.matrix * solution) - d.rhs) << ", largest violation there "
              << (d.normals * solution - d.bounds).maxCoeff();
          for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
            EXPECT_LE(problem.half_spaces.normal_part(p, v), problem.half_spaces.bounds[p] + 1e-12) << here;
        }
    }
  std::cout << n << " problems, " << n_held << " held, at most " << most_iterations << " iterations, "
            << n_ended << " by active-set steps\n";
  EXPECT_GE(2 * n_ended, n_held);
  EXPECT_GE(2 * n_held, n / 2);
}



// A cube that rests on two corners tips until the next half-space, which a V-cycle need not find: it has no
// energy. Without one in its way it stays.
TEST(FreeBodies, DrivenMotionsGoToTheNextHalfSpace)
{
  constexpr unsigned int size = 2;
  const Grid             grid(size);
  FreeLevels             levels(size);
  HierarchyParts         parts = CubeProblem::finest_level(size);
  parts.fixed.assign(parts.fixed.size(), 0);
  parts.levels = &levels;
  MultigridHierarchy     hierarchy(std::move(parts));
  const NodeBlockMatrix &matrix    = hierarchy.finest().matrix;
  const NodePartition   &partition = matrix.partition();
  const auto             motions   = rigid_motions(grid, partition);
  Vector                 rhs, correction, product;
  partition.reinit(rhs);
  for (unsigned int i = 0; i < partition.n_owned(); ++i)
    rhs.local_element(dim * i + 2) = -.01;
  constexpr double gap = .1;
  for (const bool has_floor : {true, false})
    {
      HalfSpaces spaces;
      for (unsigned int i = 0; i < partition.n_owned(); ++i)
        if (const auto index = grid.index(partition.to_global(i));
            index[2] == 0 && index[0] != 1 && (index[1] == 0 || (index[1] == 2 && has_floor)))
          {
            spaces.nodes.push_back(i);
            spaces.normals.push_back(Vector3({0., 0., -1.}));
            spaces.bounds.push_back(index[1] == 0 ? 0. : gap);
          }
      ContactState contact(matrix, spaces);
      for (std::size_t p = 0; p < spaces.size(); ++p)
        contact.set_active(p, spaces.bounds[p] == 0.);
      FreeMotionCorrection correct(matrix, motions, rhs);
      correct.update(contact);
      EXPECT_TRUE(correct.is_driven());
      partition.reinit(correction);
      partition.reinit(product);
      const double work = correct.drive(correction, contact);
      matrix.vmult(product, correction);
      EXPECT_NEAR(work, correction * rhs, 1e-12);
      EXPECT_LE(std::abs(correction * product), 1e-15 * matrix.block(0)[0] * (correction * correction));
      // The middle of the cube goes down by half as much as the row that touches then.
      EXPECT_NEAR(work, has_floor ? 27 * .01 * .5 * gap : 0., 1e-12);
      double lowest = 0.;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        lowest = std::max(lowest, spaces.normal_part(p, correction));
      EXPECT_NEAR(dealii::Utilities::MPI::max(lowest, MPI_COMM_WORLD), has_floor ? gap : 0., 1e-12);
    }
}
