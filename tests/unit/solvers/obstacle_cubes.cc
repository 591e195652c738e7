// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/interface_correction.h>
#include <signorini/solvers/obstacle_solver.h>

#include <gtest/gtest.h>

#include "unit/solvers/cube_problem.h"

using namespace Signorini;

namespace
{
  struct Expected
  {
    SolverMethod method;
    unsigned int n, active, max_iterations;
    double       energy, force;
  };

  class PuncturedCube : public testing::TestWithParam<Expected>
  {
  };
} // namespace



// Problem S1 of doc/verification.md: J and the force to the digits given there.
TEST_P(PuncturedCube, ReachesTheKnownSolutionFromZero)
{
  const Expected          expected  = GetParam();
  MultigridHierarchy      hierarchy = CubeProblem::hierarchy(expected.n);
  const CubeProblem::Grid grid(expected.n);
  ObstacleProblem         problem;
  problem.half_spaces = CubeProblem::paraboloid(grid);
  hierarchy.finest().matrix.partition().reinit(problem.rhs);
  Vector v;
  v.reinit(problem.rhs);

  SolverParameters parameters;
  parameters.check_monotonicity = true;
  parameters.method             = expected.method;
  const auto report             = make_solver(hierarchy, parameters)->solve(v, problem);
  EXPECT_LE(report.largest_energy_rise, 1e-14);
  EXPECT_LE(report.largest_violation, 1e-14);
  EXPECT_GE(report.checked_substeps, 2 * report.iterations);
  EXPECT_TRUE(report.converged);
  // The smallest cube has 729 nodes: on several ranks a large part of them is at a border.
  const bool is_tiny = expected.n == 8 && dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
  EXPECT_LE(report.iterations, expected.max_iterations + (is_tiny ? 1 : 0));
  EXPECT_EQ(report.active_nodes.back(), expected.active);
  EXPECT_NEAR(report.energy / expected.energy, 1., 1e-11);

  Vector residual;
  residual.reinit(v);
  hierarchy.finest().matrix.vmult(residual, v);
  double force = 0.;
  for (const unsigned int p : problem.half_spaces.nodes)
    force += residual.local_element(3 * p + 2);
  EXPECT_NEAR(dealii::Utilities::MPI::sum(force, MPI_COMM_WORLD) / expected.force, 1., 1e-8);
}

namespace
{
  std::vector<Expected> sizes(const SolverMethod method, const std::array<unsigned int, 3> &iterations)
  {
    return {{method, 8, 9, iterations[0], 2.110394093511e-4, 1.14727827e-2},
            {method, 16, 21, iterations[1], 2.328860217949e-4, 1.17543487e-2},
            {method, 32, 89, iterations[2], 2.360079949137e-4, 1.18747437e-2}};
  }
} // namespace

INSTANTIATE_TEST_SUITE_P(Accelerated, PuncturedCube,
                         testing::ValuesIn(sizes(SolverMethod::accelerated, {{9, 10, 11}})));
INSTANTIATE_TEST_SUITE_P(TruncatedNewton, PuncturedCube,
                         testing::ValuesIn(sizes(SolverMethod::truncated_newton_multigrid, {{12, 12, 12}})));
INSTANTIATE_TEST_SUITE_P(Monotone, PuncturedCube,
                         testing::ValuesIn(sizes(SolverMethod::monotone_multigrid, {{12, 12, 12}})));



// Half-spaces on the coarser levels: their solutions are a better start than zero. A second solve finds the
// hierarchy as the first one left it, and takes the same way.
TEST(TruncatedNewtonMultigrid, StartsOnTheCoarserLevels)
{
  MultigridHierarchy hierarchy = CubeProblem::hierarchy(32);
  CubeProblem::set_coarse_half_spaces(hierarchy, CubeProblem::paraboloid);
  ObstacleProblem problem;
  problem.half_spaces = CubeProblem::paraboloid(CubeProblem::Grid(32));
  hierarchy.finest().matrix.partition().reinit(problem.rhs);
  std::vector<ConvergenceReport> reports;
  for (unsigned int run = 0; run < 2; ++run)
    {
      Vector v;
      v.reinit(problem.rhs);
      const auto report = make_solver(hierarchy, SolverParameters())->solve(v, problem);
      EXPECT_TRUE(report.converged);
      EXPECT_LE(report.iterations, 10u);
      EXPECT_LE(report.hierarchy_updates, 2u);
      ASSERT_EQ(report.start_iterations.size(), 3u);
      for (const unsigned int n : report.start_iterations)
        EXPECT_LE(n, 3u);
      EXPECT_EQ(report.active_nodes.back(), 89u);
      EXPECT_NEAR(report.energy / 2.360079949137e-4, 1., 1e-11);
      reports.push_back(report);
    }
  EXPECT_EQ(reports[1].iterations, reports[0].iterations);
  EXPECT_EQ(reports[1].start_iterations, reports[0].start_iterations);
  EXPECT_EQ(reports[1].hierarchy_updates, reports[0].hierarchy_updates);
}



// The energy must fall and the iterate stay admissible in every projected sweep, also across ranks.
TEST(ProjectedGaussSeidel, EnergyFallsInEverySweep)
{
  const CubeProblem::Grid grid(8);
  MultigridHierarchy      hierarchy   = CubeProblem::hierarchy(8);
  const auto              half_spaces = CubeProblem::paraboloid(grid);
  NodeBlockMatrix        &matrix      = hierarchy.finest().matrix;
  ProjectedGaussSeidel    sweeps(matrix);
  ContactState            contact(matrix, half_spaces);
  Vector                  v, rhs, product;
  matrix.partition().reinit(v);
  matrix.partition().reinit(rhs);
  matrix.partition().reinit(product);
  contact.project(v);
  double energy = std::numeric_limits<double>::max();
  for (unsigned int sweep = 0; sweep < 20; ++sweep)
    {
      sweeps.sweep(v, rhs, contact, sweep % 2 ? Direction::backward : Direction::forward);
      matrix.vmult(product, v);
      const double new_energy = .5 * (product * v);
      EXPECT_LT(new_energy, energy);
      energy = new_energy;
      for (std::size_t p = 0; p < half_spaces.size(); ++p)
        EXPECT_LE(-v.local_element(3 * half_spaces.nodes[p] + 2), half_spaces.bounds[p] + 1e-16);
    }
}



// After the correction the contact nodes are in equilibrium with each other: nothing pulls at free ones, and
// the active ones are pressed against their planes.
TEST(InterfaceCorrection, SolvesTheObstacleProblemOfTheContactNodes)
{
  const CubeProblem::Grid grid(8);
  const NodeBlockMatrix   matrix      = CubeProblem::stiffness(grid);
  const NodePartition    &nodes       = matrix.partition();
  const HalfSpaces        half_spaces = CubeProblem::paraboloid(grid);
  ContactState            contact(matrix, half_spaces);
  Vector                  v, rhs, residual;
  for (Vector *vector : {&v, &rhs, &residual})
    nodes.reinit(*vector);
  for (std::size_t p = 0; p < half_spaces.size(); ++p)
    {
      half_spaces.add_normal(v, p, std::min(0., half_spaces.bounds[p]));
      rhs.local_element(3 * half_spaces.nodes[p])     = .001;
      rhs.local_element(3 * half_spaces.nodes[p] + 2) = -.0005;
    }
  const auto energy = [&] {
    matrix.vmult(residual, v);
    return .5 * (residual * v) - rhs * v;
  };
  const double        before = energy();
  InterfaceCorrection correction(matrix, CubeProblem::contact_interface(grid).contact_nodes);
  correction.run(v, rhs, contact, Direction::forward);
  EXPECT_LT(energy(), before);

  residual.sadd(-1., 1., rhs);
  unsigned int n_active = 0;
  for (std::size_t p = 0; p < half_spaces.size(); ++p)
    {
      const auto row = half_spaces.nodes[p];
      n_active += contact.active()[p];
      EXPECT_NEAR(residual.local_element(3 * row), 0., 1e-14);
      EXPECT_NEAR(residual.local_element(3 * row + 1), 0., 1e-14);
      const double force = half_spaces.normal_part(p, residual);
      const double room  = half_spaces.bounds[p] - half_spaces.normal_part(p, v);
      EXPECT_GE(room, -1e-14);
      EXPECT_GE(force, -1e-14);
      EXPECT_NEAR(contact.active()[p] ? room : force, 0., 1e-14);
    }
  n_active = dealii::Utilities::MPI::sum(n_active, MPI_COMM_WORLD);
  EXPECT_EQ(n_active, 9u);
}



// Smoothing in single precision, and its residual, against sweeps in double precision: with half-spaces,
// interface sweeps and lines of flat cells. Where a half-space is, the right hand side is not rounded: v
// keeps it exactly, and a force that presses a node onto its plane, however large, leaves no trace.
TEST(StagedSmoother, SmoothingHandsOutItsResidual)
{
  for (const double height : {1., .05})
    {
      const CubeProblem::Grid grid(8);
      const NodeBlockMatrix   matrix      = CubeProblem::stiffness(grid, height);
      const NodePartition    &nodes       = matrix.partition();
      const HalfSpaces        half_spaces = CubeProblem::paraboloid(grid);
      StagedSmoother          smoother(matrix, CubeProblem::contact_interface(grid));
      // Each remembers its active nodes.
      ContactState contact(matrix, half_spaces), other(matrix, half_spaces);
      Vector       v, rhs, residual, plain, product;
      for (Vector *vector : {&v, &rhs, &residual, &plain, &product})
        nodes.reinit(*vector);
      for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
        rhs.local_element(i) = .01 * std::sin(1. + 3. * nodes.first_owned() + i);
      const auto expect = [&](const SmoothingParameters &p, const double residual_error) {
        std::ostringstream text;
        text << "height " << height << ", V(" << p.n_pre << "," << p.n_post << "), " << p.n_interface_sweeps
             << " interface sweeps";
        SCOPED_TRACE(text.str());
        matrix.vmult(product, v);
        product.sadd(-1., 1., rhs);
        product -= residual;
        EXPECT_LT(product.linfty_norm(), residual_error);
        product = v;
        product -= plain;
        EXPECT_LT(product.linfty_norm(), 1e-6 * plain.linfty_norm());
        for (std::size_t q = 0; q < half_spaces.size(); ++q)
          EXPECT_LT(half_spaces.normal_part(q, v) - half_spaces.bounds[q], 1e-15);
      };
      for (const SmoothingParameters &p :
           {SmoothingParameters{0, 0, 2}, {1, 1, 0}, {1, 1, 1}, {2, 2, 0}, {3, 3, 2}})
        {
          smoother.smooth_from_zero(v, rhs, contact, p, residual);
          plain = 0.;
          smoother.smooth(plain, rhs, other, p, Direction::forward);
          expect(p, 1e-6);
          smoother.smooth_to_residual(v, rhs, contact, p, &residual);
          smoother.smooth(plain, rhs, other, p, Direction::backward);
          expect(p, 1e-13);
        }

      // Enough to make all nodes active, and more than that.
      for (const double force : {1e3, 1e7})
        {
          Vector pressed = rhs;
          for (std::size_t q = 0; q < half_spaces.size(); ++q)
            for (unsigned int c = 0; c < 3; ++c)
              pressed.local_element(3 * half_spaces.nodes[q] + c) += force * half_spaces.normals[q][c];
          plain = v;
          smoother.smooth_from_zero(v, pressed, contact, {3, 3, 0}, residual);
          matrix.vmult(product, v);
          product.sadd(-1., 1., pressed);
          product -= residual;
          EXPECT_LT(product.linfty_norm(), 1e-6);
        }
      v -= plain;
      EXPECT_LT(v.linfty_norm(), 1e-6 * plain.linfty_norm());
    }
}



namespace
{
  std::vector<double> copy(const NodeBlockMatrix &matrix)
  {
    return std::vector<double>(matrix.block(0), matrix.block(matrix.n_stored_blocks()));
  }
} // namespace



// Truncating and releasing nodes must leave no trace in the coarse matrices.
TEST(MultigridHierarchy, TruncationIsUndone)
{
  const CubeProblem::Grid    grid(8);
  MultigridHierarchy         hierarchy   = CubeProblem::hierarchy(8);
  const auto                 half_spaces = CubeProblem::paraboloid(grid);
  const std::vector<double>  before      = copy(hierarchy.level(0).matrix);
  std::vector<unsigned char> active(half_spaces.size(), 1);
  EXPECT_TRUE(hierarchy.truncate(2, half_spaces, active));
  EXPECT_FALSE(hierarchy.truncate(2, half_spaces, active));
  const std::vector<double> truncated = copy(hierarchy.level(0).matrix);
  active.assign(half_spaces.size(), 0);
  EXPECT_TRUE(hierarchy.truncate(2, half_spaces, active));
  const std::vector<double> after      = copy(hierarchy.level(0).matrix);
  double                    difference = 0., change = 0., size = 0.;
  for (std::size_t k = 0; k < before.size(); ++k)
    {
      difference = std::max(difference, std::abs(before[k] - after[k]));
      change     = std::max(change, std::abs(before[k] - truncated[k]));
      size       = std::max(size, std::abs(before[k]));
    }
  EXPECT_LT(difference, 1e-14 * size);
  EXPECT_GT(dealii::Utilities::MPI::max(change, MPI_COMM_WORLD), .1 * size);
}



// Truncation at normals that are nearly the same leaves hardly any stiffness to a coarse function along their
// mean: too little for sweeps in single precision.
TEST(EmptyDirections, FillsThoseWithHardlyAnyStiffness)
{
  NodeBlockMatrix matrix = CubeProblem::stiffness(CubeProblem::Grid(2));
  const Vector3   normal = Vector3({.5, -.6, .7}) / std::sqrt(1.1);
  const auto      fill   = [&](const double weak) {
    Block block = 7. * dealii::unit_symmetric_tensor<3>();
    block -= 7. * (1. - weak) * outer_product(normal, normal);
    write_block(matrix.block(matrix.diagonal(0)), block);
    EmptyDirections empty;
    empty.fill(matrix, {0}, 7.);
    const double filled = normal * (read_block(matrix.block(matrix.diagonal(0))) * normal) / 7.;
    empty.restore(matrix);
    EXPECT_EQ((read_block(matrix.block(matrix.diagonal(0))) - block).norm(), 0.);
    return filled;
  };
  for (const double weak : {0., 1e-13, 1e-10, 1e-7})
    EXPECT_NEAR(fill(weak), 1., 1e-6) << weak;
  for (const double weak : {1e-5, 1e-3, 1.})
    EXPECT_NEAR(fill(weak), weak, 1e-12) << weak;
}



// The levels below know the matrix without what fills its empty directions. So the residual that they get is
// that of the matrix without.
TEST(EmptyDirections, AreLeftOutOfResiduals)
{
  NodeBlockMatrix matrix = CubeProblem::stiffness(CubeProblem::Grid(2));
  const Vector3   normal = Vector3({.5, -.6, .7}) / std::sqrt(1.1);
  write_block(matrix.block(matrix.diagonal(0)),
              7. * dealii::unit_symmetric_tensor<3>() - 7. * outer_product(normal, normal));
  Vector v, expected, residual;
  for (Vector *const vector : {&v, &expected, &residual})
    matrix.partition().reinit(*vector);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    v.local_element(i) = i < 3 ? normal[i] : std::sin(1. + i);
  matrix.vmult(expected, v);
  expected *= -1.;
  EmptyDirections empty;
  empty.fill(matrix, {0}, 7.);
  matrix.vmult(residual, v);
  residual *= -1.;
  EXPECT_GT(std::abs(residual.local_element(0) - expected.local_element(0)), .1);
  empty.leave_out(residual, matrix, v);
  residual -= expected;
  EXPECT_LT(residual.linfty_norm(), 1e-13 * expected.linfty_norm());
}



// Levels without contact, in which the function of a node in the middle of the second one has hardly any
// values.
class LevelsWithAnEmptyFunction : public LevelSource
{
public:
  std::optional<CoarserLevel> next(const NodePartition &finer) override
  {
    if (n == 2)
      return {};
    const CubeProblem::Grid fine(n), coarse(n / 2);
    NodeRows                rows = import_ghost_rows(finer, CubeProblem::interpolation(fine, coarse));
    if (n == 8)
      for (std::size_t k = 0; k < rows.columns.size(); ++k)
        if (rows.columns[k] == coarse.node(1, 2, 2))
          rows.weights[k] *= 1e-9;
    CoarserLevel result;
    result.transfer.reinit(rows, {}, finer.n_owned());
    result.owned = coarse.owned;
    result.fixed = coarse.fixed();
    n /= 2;
    return result;
  }

  LevelZero level_zero(const NodePartition &) override
  {
    return {};
  }

private:
  unsigned int n = 8;
};



// The energy of a coarse function is that of what it is on the finest mesh.
TEST(EmptyDirections, StayOutOfCoarserLevels)
{
  LevelsWithAnEmptyFunction levels;
  HierarchyParts            parts = CubeProblem::finest_level(8);
  parts.levels                    = &levels;
  MultigridHierarchy hierarchy(std::move(parts));
  const auto         n_filled =
      static_cast<unsigned int>(hierarchy.level(1).empty.restore(hierarchy.level(1).matrix).size());
  EXPECT_EQ(dealii::Utilities::MPI::sum(n_filled, MPI_COMM_WORLD), 1);
  Vector x, product;
  hierarchy.level(0).matrix.partition().reinit(x);
  hierarchy.level(0).matrix.partition().reinit(product);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    x.local_element(i) = std::sin(1. + static_cast<double>(x.get_partitioner()->local_to_global(i)));
  for (unsigned int i = 0; i < hierarchy.level(0).matrix.n_rows(); ++i)
    project_free(hierarchy.level(0).fixed[i], x, i);
  hierarchy.level(0).matrix.vmult(product, x);
  const double energy = x * product;
  for (unsigned int l = 0; l + 1 < hierarchy.n_levels(); ++l)
    {
      Vector finer;
      hierarchy.level(l + 1).matrix.partition().reinit(finer);
      hierarchy.level(l).to_finer.prolongate(finer, x);
      x.swap(finer);
    }
  hierarchy.finest().matrix.partition().reinit(product);
  hierarchy.finest().matrix.vmult(product, x);
  EXPECT_NEAR(energy / (x * product), 1., 1e-12);
}



// Built truncated or truncated afterwards: the same coarse matrices, and nothing left to do for the solver,
// which has the solution as its start.
TEST(MultigridHierarchy, IsBuiltTruncatedAtTheExpectedActiveSet)
{
  ObstacleProblem problem;
  problem.half_spaces          = CubeProblem::paraboloid(CubeProblem::Grid(8));
  MultigridHierarchy hierarchy = CubeProblem::hierarchy(8);
  hierarchy.finest().matrix.partition().reinit(problem.rhs);
  Vector v = problem.rhs;
  make_solver(hierarchy, SolverParameters())->solve(v, problem);

  MultigridHierarchy other = CubeProblem::hierarchy(8, CubeProblem::downwards, &problem, &v);
  for (unsigned int l = 0; l + 1 < hierarchy.n_levels(); ++l)
    {
      const std::vector<double> expected = copy(hierarchy.level(l).matrix),
                                built    = copy(other.level(l).matrix);
      ASSERT_EQ(built.size(), expected.size());
      double difference = 0., size = 0.;
      for (std::size_t k = 0; k < expected.size(); ++k)
        {
          difference = std::max(difference, std::abs(built[k] - expected[k]));
          size       = std::max(size, std::abs(expected[k]));
        }
      EXPECT_LT(difference, 1e-14 * size);
    }
  const auto report = make_solver(other, SolverParameters())->solve(v, problem);
  EXPECT_EQ(report.hierarchy_updates, 0u);
  EXPECT_EQ(report.active_nodes.front(), 9u);
}



namespace
{
  /// What someone else may hand in: damped Jacobi steps in the half-spaces.
  class Jacobi : public Smoother
  {
  public:
    using Smoother::Smoother;

    void smooth(Vector &v, const Vector &rhs, ContactState &contact, const SmoothingParameters &parameters,
                const Direction direction) override
    {
      Vector residual = v;
      for (unsigned int i = 0; i < (direction == Direction::forward ? parameters.n_pre : parameters.n_post);
           ++i)
        {
          matrix.symmetric_residual(residual, v, rhs);
          for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
            v.local_element(i) +=
                .4 * residual.local_element(i) / matrix.block(matrix.diagonal(i / 3))[4 * (i % 3)];
          contact.project(v);
        }
    }
  };

  /// A coarse solver of many such steps.
  class ManySteps : public CoarseSolver
  {
  public:
    void setup(const NodeBlockMatrix &new_matrix) override
    {
      matrix = &new_matrix;
    }

    void solve(Vector &solution, const Vector &rhs) const override
    {
      ContactState free(*matrix);
      solution = 0.;
      Jacobi(*matrix).smooth(solution, rhs, free, {200, 0, 0}, Direction::forward);
    }

  private:
    const NodeBlockMatrix *matrix = nullptr;
  };
} // namespace



TEST(MultigridHierarchy, TakesSmoothersAndCoarseSolversOfOthers)
{
  CubeProblem::Levels levels(16, CubeProblem::downwards);
  HierarchyParts      parts = CubeProblem::finest_level(16);
  parts.levels              = &levels;
  parts.coarse_solver       = std::make_unique<ManySteps>();
  parts.make_smoother       = [](const NodeBlockMatrix &matrix, const LevelInterface &) {
    return std::make_unique<Jacobi>(matrix);
  };
  MultigridHierarchy hierarchy(std::move(parts));
  ObstacleProblem    problem;
  problem.half_spaces = CubeProblem::paraboloid(CubeProblem::Grid(16));
  hierarchy.finest().matrix.partition().reinit(problem.rhs);
  Vector     v      = problem.rhs;
  const auto report = make_solver(hierarchy, SolverParameters())->solve(v, problem);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 60u);
  EXPECT_EQ(report.active_nodes.back(), 21u);
  EXPECT_NEAR(report.energy / 2.328860217949e-4, 1., 1e-10);
}
