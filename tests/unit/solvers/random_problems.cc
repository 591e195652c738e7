// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Small random obstacle problems, solved by all solvers and by a dense method that has nothing in common with
// them: the dual problem by principal pivoting.

#include <signorini/solvers/active_set_solver.h>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <random>

#include "unit/solvers/cube_problem.h"

using namespace Signorini;

namespace
{
  struct Dense
  {
    Eigen::MatrixXd matrix, normals;
    Eigen::VectorXd rhs, bounds;
  };

  Dense dense(const NodeBlockMatrix &matrix, const ObstacleProblem &problem)
  {
    const auto n = dim * matrix.n_rows();
    const auto m = static_cast<Eigen::Index>(problem.half_spaces.size());
    Dense d{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(m, n), Eigen::VectorXd(n), Eigen::VectorXd(m)};
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      matrix.visit_row(i, [&](const RowEntry &entry) {
        for (unsigned int c = 0; c < 9; ++c)
          d.matrix(dim * i + c / 3, dim * entry.column + c % 3) = entry.block()[c / 3][c % 3];
      });
    for (unsigned int i = 0; i < n; ++i)
      d.rhs[i] = problem.rhs.local_element(i);
    for (Eigen::Index p = 0; p < m; ++p)
      {
        for (unsigned int c = 0; c < dim; ++c)
          d.normals(p, dim * problem.half_spaces.nodes[p] + c) = problem.half_spaces.normals[p][c];
        d.bounds[p] = problem.half_spaces.bounds[p];
      }
    return d;
  }

  /// w = C lambda + q >= 0, lambda >= 0, w lambda = 0 with C = N A^-1 N^T, q = g - N A^-1 b: the pivots of
  /// Murty (least index), which end for every positive definite C.
  Eigen::VectorXd solve_by_pivoting(const Dense &d)
  {
    const Eigen::LLT<Eigen::MatrixXd> factors(d.matrix);
    const Eigen::MatrixXd             c = d.normals * factors.solve(d.normals.transpose());
    const Eigen::VectorXd             q = d.bounds - d.normals * factors.solve(d.rhs);
    const Eigen::Index                m = q.size();
    std::vector<bool>                 in_contact(m, false);
    Eigen::VectorXd                   lambda;
    for (bool done = false; !done;)
      {
        std::vector<Eigen::Index> set;
        for (Eigen::Index p = 0; p < m; ++p)
          if (in_contact[p])
            set.push_back(p);
        Eigen::MatrixXd reduced(set.size(), set.size());
        Eigen::VectorXd rhs(set.size());
        for (std::size_t i = 0; i < set.size(); ++i)
          {
            rhs[i] = -q[set[i]];
            for (std::size_t j = 0; j < set.size(); ++j)
              reduced(i, j) = c(set[i], set[j]);
          }
        lambda = Eigen::VectorXd::Zero(m);
        if (!set.empty())
          {
            const Eigen::VectorXd part = reduced.ldlt().solve(rhs);
            for (std::size_t i = 0; i < set.size(); ++i)
              lambda[set[i]] = part[i];
          }
        const Eigen::VectorXd w = c * lambda + q;
        done                    = true;
        for (Eigen::Index p = 0; p < m && done; ++p)
          if (in_contact[p] ? lambda[p] < 0. : w[p] < 0.)
            {
              in_contact[p] = !in_contact[p];
              done          = false;
            }
      }
    return factors.solve(d.rhs - d.normals.transpose() * lambda);
  }

  double energy(const Dense &d, const Eigen::VectorXd &v)
  {
    return .5 * v.dot(d.matrix * v) - d.rhs.dot(v);
  }

  /// How far a substep may end above the one before. Sweeps in single precision know what is left of the
  /// residual only up to a rounding of each product in A x, e; a step of the best length for a residual that
  /// is wrong by e ends at most e^T A^-1 e / 2 above. It is seen where nothing but rounding is left after the
  /// first sweep, as patches of nodes have it on tiny grids.
  double rounding_of_energy(const Dense &d, const Eigen::VectorXd &x)
  {
    const double          unit  = .5 * std::numeric_limits<float>::epsilon();
    const Eigen::VectorXd error = unit * (d.matrix.cwiseAbs() * x.cwiseAbs());
    return .5 * error.dot(Eigen::LLT<Eigen::MatrixXd>(d.matrix).solve(error));
  }

  /// Whether active-set steps from the projection of zero end; if so, at the solution, and if not, without
  /// having raised the energy or left the half-spaces.
  bool check_active_set_steps(MultigridHierarchy &hierarchy, PlaneSolver &planes,
                              const ObstacleProblem &problem, const Dense &d, const Eigen::VectorXd &solution,
                              const std::string &name)
  {
    const auto values = [](const Vector &v) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.begin(), v.locally_owned_size()));
    };
    Vector v;
    v.reinit(problem.rhs);
    ContactState(hierarchy.finest().matrix, problem.half_spaces).project(v);
    const double    start = energy(d, values(v)), scale = std::sqrt(solution.dot(d.matrix * solution));
    ActiveSetSolver solver(hierarchy, SolverParameters(), hierarchy.n_levels() - 1, planes);
    const auto      report = solver.solve(v, problem);
    EXPECT_LE((d.normals * values(v) - d.bounds).maxCoeff(), 1e-13) << name;
    if (report.converged)
      {
        const Eigen::VectorXd difference = values(v) - solution;
        EXPECT_LE(std::sqrt(difference.dot(d.matrix * difference)), 1e-9 * scale) << name;
      }
    else
      EXPECT_LE(energy(d, values(v)), start + 1e-13 * scale * scale) << name;
    return report.converged;
  }
} // namespace



TEST(RandomProblems, AllSolversGiveTheDenseSolution)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    GTEST_SKIP() << "the dense solver has one rank";
  const char        *wanted = std::getenv("SIGNORINI_RANDOM_PROBLEMS");
  const unsigned int n      = wanted ? static_cast<unsigned int>(std::stoul(wanted)) : 100;
  // Those before are drawn, but not solved.
  const char        *begin = std::getenv("SIGNORINI_RANDOM_PROBLEMS_FROM");
  const unsigned int first = begin ? static_cast<unsigned int>(std::stoul(begin)) : 0;
  std::mt19937       random(1);
  const auto         uniform = [&](const double low, const double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const std::map<SolverMethod, const char *> methods = {
      {SolverMethod::accelerated, "accelerated"},
      {SolverMethod::truncated_newton_multigrid, "truncated newton multigrid"},
      {SolverMethod::monotone_multigrid, "monotone multigrid"},
      {SolverMethod::active_set_amg, "active set amg"},
      {SolverMethod::projected_gauss_seidel, "projected gauss seidel"}};
  std::array<unsigned int, 2> n_ended = {{0, 0}};
  for (unsigned int i = 0; i < n; ++i)
    {
      // One to three levels; flat or bent; loads that press, pull or do anything; bounds of both signs.
      const unsigned int      size = i % 20 == 3 ? 8 : i % 4 == 0 ? 2 : 4;
      const CubeProblem::Grid grid(size);
      const double            bend = i % 2 ? uniform(0., 1.) : 0., phase = uniform(0., 6.);
      const auto              normals = [&](const double x, const double y) {
        Vector3 normal;
        normal[0] = bend * std::sin(phase + 5. * x);
        normal[1] = bend * std::sin(phase + 4. * y);
        normal[2] = -1.;
        return normal / normal.norm();
      };
      ObstacleProblem problem;
      problem.half_spaces = CubeProblem::paraboloid(grid);
      const double shift = uniform(-.1, .1), load = uniform(-.02, .02), noise = i % 3 ? .002 : .2;
      for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
        {
          const auto index               = grid.index(problem.half_spaces.nodes[p]);
          problem.half_spaces.normals[p] = normals(index[0] / double(size), index[1] / double(size));
          problem.half_spaces.bounds[p] += shift + uniform(-noise, noise);
        }
      std::vector<double> loads, deviations;
      for (const NodeIndex p : grid.owned)
        for (unsigned int c = 0; c < dim; ++c)
          loads.push_back(grid.index(p)[2] < size ? load * (c == 2) + uniform(-.002, .002) : 0.);
      const double distance = std::pow(10., uniform(-6., 0.));
      for (const NodeIndex p : grid.owned)
        for (unsigned int c = 0; c < dim; ++c)
          deviations.push_back(grid.index(p)[2] < size ? distance * uniform(-1., 1.) : 0.);
      if (i < first)
        continue;
      MultigridHierarchy hierarchy = CubeProblem::hierarchy(size, normals);
      CubeProblem::set_coarse_half_spaces(hierarchy, [&](const CubeProblem::Grid &coarse) {
        HalfSpaces         result = CubeProblem::paraboloid(coarse);
        const unsigned int ratio  = size / coarse.n;
        for (std::size_t p = 0; p < result.size(); ++p)
          {
            const auto      index = coarse.index(result.nodes[p]);
            const NodeIndex node  = grid.node(ratio * index[0], ratio * index[1], 0);
            const auto     &nodes = problem.half_spaces.nodes;
            const auto      fine  = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
            result.normals[p]     = problem.half_spaces.normals[fine];
            result.bounds[p]      = problem.half_spaces.bounds[fine];
          }
        return result;
      });
      hierarchy.finest().matrix.partition().reinit(problem.rhs);
      std::copy(loads.begin(), loads.end(), problem.rhs.begin());
      const Dense           d        = dense(hierarchy.finest().matrix, problem);
      const Eigen::VectorXd solution = solve_by_pivoting(d);
      const double          scale    = std::sqrt(solution.dot(d.matrix * solution));
      const auto            check    = [&](MultigridHierarchy &levels, const SolverParameters &parameters,
                             const std::string &name, Vector v, const double most_rise = 1e-13) {
        const auto      report     = make_solver(levels, parameters)->solve(v, problem);
        Eigen::VectorXd difference = solution;
        for (Eigen::Index k = 0; k < difference.size(); ++k)
          difference[k] -= v.local_element(k);
        EXPECT_TRUE(report.converged) << "problem " << i << ", " << name;
        EXPECT_LE(std::sqrt(difference.dot(d.matrix * difference)), 1e-9 * scale)
            << "problem " << i << ", " << name;
        EXPECT_LE(report.largest_energy_rise, most_rise) << "problem " << i << ", " << name;
        EXPECT_LE(report.largest_violation, 1e-12) << "problem " << i << ", " << name;
      };
      Vector start;
      start.reinit(problem.rhs);
      for (const auto &[method, name] : methods)
        {
          SolverParameters parameters;
          parameters.method             = method;
          parameters.check_monotonicity = method != SolverMethod::active_set_amg;
          parameters.max_iterations     = method == SolverMethod::projected_gauss_seidel ? 5000 : 60;
          check(hierarchy, parameters, name, start);
        }
      FactoredPlanes    factored(hierarchy.finest().matrix);
      CycledPlanes      cycled(hierarchy, hierarchy.n_levels() - 1, SmoothingParameters());
      const std::string here = "problem " + std::to_string(i);
      n_ended[0] += check_active_set_steps(hierarchy, factored, problem, d, solution, here + ", factors");
      n_ended[1] += check_active_set_steps(hierarchy, cycled, problem, d, solution, here + ", V-cycles");
      hierarchy.strengthen_smoothers();
      SolverParameters with_patches;
      with_patches.check_monotonicity = true;
      with_patches.max_iterations     = 60;
      check(hierarchy, with_patches, "patches of nodes", start,
            std::max(1e-13, rounding_of_energy(d, solution) / (scale * scale)));
      // From good starts, and from some that only claim to be.
      for (Eigen::Index k = 0; k < solution.size(); ++k)
        start.local_element(k) = solution[k] * (1. + deviations[k]);
      SolverParameters parameters;
      parameters.check_monotonicity = true;
      parameters.max_iterations     = 60;
      if (i % 3 == 1)
        parameters.smoothing = {1, 1, i % 2};
      MultigridHierarchy expecting = CubeProblem::hierarchy(size, normals, &problem, &start);
      check(expecting, parameters, "accelerated from a start at " + std::to_string(distance), start);
    }
  // Active sets may go round in a circle, but hardly do.
  for (const unsigned int ended : n_ended)
    EXPECT_GE(ended, .95 * (n - std::min(n, first)));
}
