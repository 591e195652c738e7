// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Sweeps of several ranks at once, as far as sixteen of them, where most nodes are seen by others.

#include "unit/solvers/cube_problem.h"

#include <signorini/solvers/strong_blocks.h>
#include <signorini/solvers/v_cycle.h>

#include <gtest/gtest.h>

// PETSc, which comes with deal.II, counts messages by macros of these names.
#undef MPI_Isend
#undef MPI_Allreduce

using namespace Signorini;

namespace
{
  unsigned long n_sends = 0, n_collectives = 0;
} // namespace

// Everybody's messages, deal.II's too, pass here.
extern "C" int
MPI_Isend(const void *data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  ++n_sends;
  return PMPI_Isend(data, n, type, to, tag, comm, request);
}

extern "C" int
MPI_Allreduce(const void *from, void *to, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  ++n_collectives;
  return PMPI_Allreduce(from, to, n, type, op, comm);
}

namespace
{
  bool is_alone()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1;
  }

  /// The cube with one face held, seven or eight cells an edge.
  struct Cube
  {
    explicit Cube(const unsigned int n, const double height = 1., const double nu = .3,
                  const unsigned int stride = 1)
      : grid(n, stride)
      , matrix(CubeProblem::stiffness(grid, height, nu))
    {
      const auto fixed = import_ghost_masks(matrix.partition(), grid.fixed());
      eliminate_fixed_components(matrix, fixed, all_rows(matrix), diagonal_scale(matrix));
      for (Vector *vector : {&v, &rhs, &product})
        matrix.partition().reinit(*vector);
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (unsigned int c = 0; c < 3; ++c)
          if (!(static_cast<FixedMask>(grid.fixed()[row].components()) & (1u << c)))
            rhs.local_element(3 * row + c) = random_number(3 * matrix.partition().to_global(row) + c);
    }

    static double random_number(const NodeIndex i)
    {
      return std::sin(12.9898 * static_cast<double>(i % 100003)) * 1e-3;
    }

    double energy()
    {
      matrix.vmult(product, v);
      return .5 * (product * v) - rhs * v;
    }

    CubeProblem::Grid grid;
    NodeBlockMatrix   matrix;
    Vector            v, rhs, product;
  };

  /// The scheme that is exact on any number of ranks: one rank after the other, as if there were but one.
  struct RankAfterRank
  {
    void sweep(Cube &cube, const ProjectedGaussSeidel &sweeps, const Direction direction) const
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                         me      = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      for (unsigned int k = 0; k < n_ranks; ++k)
        {
          cube.v.update_ghost_values();
          if ((direction == Direction::forward ? k : n_ranks - 1 - k) == me)
            for (unsigned int i = 0; i < cube.matrix.n_rows(); ++i)
              relax(cube, sweeps, direction == Direction::forward ? i : cube.matrix.n_rows() - 1 - i);
        }
      cube.v.update_ghost_values();
    }

    static void relax(Cube &cube, const ProjectedGaussSeidel &sweeps, const unsigned int row)
    {
      double product[3];
      cube.matrix.multiply_row(product, row, cube.v);
      const double *const d = sweeps.inverse_diagonal() + 9 * row;
      double              r[3];
      for (unsigned int c = 0; c < 3; ++c)
        r[c] = cube.rhs.local_element(3 * row + c) - product[c];
      for (unsigned int c = 0; c < 3; ++c)
        cube.v.local_element(3 * row + c) += d[3 * c] * r[0] + d[3 * c + 1] * r[1] + d[3 * c + 2] * r[2];
    }
  };

  struct Shape
  {
    double height, nu;
    /// Of the numbering: how the nodes are shared out.
    unsigned int stride = 1;

    Cube cube() const
    {
      return Cube(8, height, nu, stride);
    }
  };

  class Sweeps : public testing::TestWithParam<Shape>
  {
  };
} // namespace



// Of the whole problem after each sweep, also where nodes are scattered over the ranks: without damping it
// rises there.
TEST_P(Sweeps, LowerTheEnergy)
{
  Cube                       cube = GetParam().cube();
  const ProjectedGaussSeidel sweeps(cube.matrix);
  const HalfSpaces           half_spaces = CubeProblem::paraboloid(cube.grid);
  for (const bool has_contact : {false, true})
    {
      ContactState contact(cube.matrix, has_contact ? half_spaces : HalfSpaces());
      cube.v = 0.;
      contact.project(cube.v);
      cube.v.update_ghost_values();
      double before = cube.energy();
      for (unsigned int i = 0; i < 30; ++i)
        {
          sweeps.sweep(cube.v, cube.rhs, contact, i % 3 == 2 ? Direction::backward : Direction::forward);
          const double after = cube.energy();
          EXPECT_LE(after, before + 1e-14 * std::abs(before)) << "sweep " << i;
          before = after;
        }
    }
}



// Hardly slower than the exact scheme, by what is left of the energy after the same number of sweeps: on flat
// cells, where ranks meet along strong couplings, three quarters of its rate.
TEST_P(Sweeps, AreAsGoodAsRankAfterRank)
{
  Cube                       cube = GetParam().cube();
  const ProjectedGaussSeidel sweeps(cube.matrix);
  ContactState               free(cube.matrix);
  const auto                 energy_after = [&](const unsigned int n, const auto &sweep) {
    cube.v = 0.;
    cube.v.update_ghost_values();
    for (unsigned int i = 0; i < n; ++i)
      {
        sweep(Direction::forward);
        sweep(Direction::backward);
      }
    return cube.energy();
  };
  const RankAfterRank exact;
  const auto          in_turns = [&](const Direction direction) { exact.sweep(cube, sweeps, direction); };
  const auto   at_once = [&](const Direction direction) { sweeps.sweep(cube.v, cube.rhs, free, direction); };
  const double least   = energy_after(400, in_turns);
  const double rate_in_turns = std::log((energy_after(12, in_turns) - least) / -least),
               rate_at_once  = std::log((energy_after(12, at_once) - least) / -least);
  EXPECT_LE(rate_at_once, .7 * rate_in_turns);
}



// For conjugate gradients: the sweeps backward are the adjoint of those forward.
TEST(Sweeps, BackwardAreAdjointToForward)
{
  Cube                       cube(7);
  const ProjectedGaussSeidel sweeps(cube.matrix);
  ContactState               free(cube.matrix);
  Vector                     other, backward;
  for (Vector *vector : {&other, &backward})
    cube.matrix.partition().reinit(*vector);
  for (unsigned int i = 0; i < 3 * cube.matrix.n_rows(); ++i)
    other.local_element(i) = Cube::random_number(17 * (3 * cube.matrix.partition().first_owned() + i) + 5);
  sweeps.sweep(cube.v, cube.rhs, free, Direction::forward);
  sweeps.sweep(backward, other, free, Direction::backward);
  const double product = cube.v * other;
  EXPECT_NEAR(backward * cube.rhs, product, 1e-13 * cube.v.l2_norm() * other.l2_norm());
}



// Cycles smooth in single precision: the same sweeps, and the residual they hand out.
TEST(Sweeps, HandOutTheirResidual)
{
  for (const bool has_contact : {false, true})
    {
      Cube           cube(8);
      StagedSmoother smoother(cube.matrix,
                              has_contact ? CubeProblem::contact_interface(cube.grid) : LevelInterface());
      ContactState   contact(cube.matrix, has_contact ? CubeProblem::paraboloid(cube.grid) : HalfSpaces());
      if (has_contact)
        contact.set_bounds_from(
            [&] {
              HalfSpaces open = CubeProblem::paraboloid(cube.grid);
              for (double &bound : open.bounds)
                bound = 1e-3 * (bound + .05);
              return open;
            }(),
            cube.v);
      Vector residual, expected;
      for (Vector *vector : {&residual, &expected})
        cube.matrix.partition().reinit(*vector);
      const auto expect_residual = [&](const double tolerance) {
        cube.matrix.vmult(expected, cube.v);
        expected.sadd(-1., 1., cube.rhs);
        expected -= residual;
        EXPECT_LE(expected.linfty_norm(), tolerance * cube.rhs.linfty_norm());
      };
      smoother.smooth_from_zero(cube.v, cube.rhs, contact, {3, 3, 2}, residual);
      const double before = cube.energy();
      EXPECT_LT(before, 0.);
      expect_residual(2e-6);
      smoother.smooth_to_residual(cube.v, cube.rhs, contact, {3, 3, 2}, &residual);
      expect_residual(1e-13);
      EXPECT_LT(cube.energy(), before);
      // The same in double precision.
      Vector exact;
      exact.reinit(cube.v);
      exact.swap(cube.v);
      cube.v = 0.;
      smoother.smooth(cube.v, cube.rhs, contact, {3, 3, 2}, Direction::forward);
      smoother.smooth(cube.v, cube.rhs, contact, {3, 3, 2}, Direction::backward);
      exact -= cube.v;
      EXPECT_LE(exact.linfty_norm(), 1e-5 * cube.v.linfty_norm());
    }
}



// What a rank has of the right hand side may be rounding beside what others, or gaps, bring: in units of
// that, the range of single precision is too small.
TEST(Sweeps, LeaveTheRangeOfARanksOwnNumbers)
{
  for (const bool has_contact : {false, true})
    {
      Cube           cube(8);
      StagedSmoother smoother(cube.matrix,
                              has_contact ? CubeProblem::contact_interface(cube.grid) : LevelInterface());
      HalfSpaces     pressed = has_contact ? CubeProblem::paraboloid(cube.grid) : HalfSpaces();
      for (double &bound : pressed.bounds)
        bound -= 1.;
      ContactState contact(cube.matrix, pressed);
      const bool   is_loaded = !has_contact && dealii::Utilities::MPI::this_mpi_process(
                                                   cube.matrix.partition().communicator()) == 0;
      if (!is_loaded)
        cube.rhs *= 1e-42;
      Vector exact = cube.v, residual = cube.v;
      smoother.smooth_from_zero(cube.v, cube.rhs, contact, {3, 3, 2}, residual);
      exact = 0.;
      smoother.smooth(exact, cube.rhs, contact, {3, 3, 2}, Direction::forward);
      exact -= cube.v;
      EXPECT_GT(cube.v.linfty_norm(), 0.);
      EXPECT_LE(exact.linfty_norm(), 1e-5 * cube.v.linfty_norm());
    }
}



// Patches of several ranks overlap those of others' by way of couplings.
TEST_P(Sweeps, OverBlocksLowerTheEnergy)
{
  Cube                       cube = GetParam().cube();
  const ProjectedGaussSeidel sweeps(cube.matrix);
  for (const auto choice : {StrongBlocks::Choice::patches, StrongBlocks::Choice::stretched_cells})
    {
      StrongBlocks blocks(cube.matrix, sweeps, choice);
      EXPECT_TRUE(choice == StrongBlocks::Choice::stretched_cells || !blocks.empty());
      ContactState free(cube.matrix);
      cube.v = 0.;
      cube.v.update_ghost_values();
      double before = 0.;
      for (unsigned int i = 0; i < 20 && !blocks.empty(); ++i)
        {
          blocks.run(cube.v, cube.rhs, free, i % 2 ? Direction::backward : Direction::forward);
          const double after = cube.energy();
          EXPECT_LE(after, before + 1e-14 * std::abs(before)) << "run " << i;
          before = after;
        }
    }
}

// As those of background levels are. Here the cube is one patch, held nowhere, and the load has the rounding
// of single precision, of which there is no end along rigid motions.
TEST(StrongBlocks, PatchesOfDependentFunctionsReturnNoRounding)
{
  if (!is_alone())
    GTEST_SKIP() << "A cube of eight nodes.";
  const CubeProblem::Grid    grid(1);
  NodeBlockMatrix            matrix = CubeProblem::stiffness(grid, 1., .3);
  const ProjectedGaussSeidel sweeps(matrix);
  StrongBlocks               blocks(matrix, sweeps, StrongBlocks::Choice::patches);
  ContactState               free(matrix);
  Vector                     solution, rhs, v;
  for (Vector *vector : {&solution, &rhs, &v})
    matrix.partition().reinit(*vector);
  for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
    solution.local_element(i) = Cube::random_number(i);
  matrix.vmult(rhs, solution);
  for (unsigned int i = 0; i < rhs.locally_owned_size(); ++i)
    rhs.local_element(i) = static_cast<float>(rhs.local_element(i));
  blocks.run(v, rhs, free, Direction::forward);
  EXPECT_GT(v.linfty_norm(), .1 * solution.linfty_norm());
  EXPECT_LT(v.linfty_norm(), 3. * solution.linfty_norm());
  matrix.vmult(solution, v);
  solution -= rhs;
  EXPECT_LE(solution.linfty_norm(), 1e-5 * rhs.linfty_norm());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Sweeps,
                         testing::Values(Shape{1., .3}, Shape{1., .49}, Shape{.1, .3}, Shape{10., .3},
                                         Shape{1., .3, 274}, Shape{1., .49, 274}));



// A message a phase to each neighbour at most, whatever the number of ranks, and nobody waits for all.
TEST(SweepSchedule, SendsAMessageAPhaseToEachNeighbour)
{
  Cube                       cube(8);
  const ProjectedGaussSeidel sweeps(cube.matrix);
  ContactState               free(cube.matrix);
  const std::size_t          n_neighbours = cube.matrix.partition().viewers().size();
  const std::size_t          n_phases     = sweeps.schedule().phases().size();
  EXPECT_LE(n_phases, is_alone() ? 1u : 6u);
  for (const Direction direction : {Direction::forward, Direction::backward})
    {
      n_sends = n_collectives = 0;
      sweeps.sweep(cube.v, cube.rhs, free, direction);
      EXPECT_EQ(n_sends, sweeps.schedule().n_messages());
      EXPECT_LE(n_sends, n_phases * n_neighbours);
      EXPECT_EQ(n_collectives, 0u);
    }
}



// A cycle: as many messages to each neighbour as it has sweeps and transfers.
TEST(SweepSchedule, CyclesSendAFixedNumberOfMessages)
{
  MultigridHierarchy        hierarchy = CubeProblem::hierarchy(8);
  const SmoothingParameters smoothing;
  VCycle                    cycle(hierarchy, smoothing, hierarchy.n_levels() - 1);
  Vector                    defect, correction;
  std::size_t               n_neighbours = 0;
  for (unsigned int l = 0; l < hierarchy.n_levels(); ++l)
    n_neighbours += hierarchy.level(l).matrix.partition().viewers().size() +
                    hierarchy.level(l).matrix.partition().owners().size();
  for (Vector *vector : {&defect, &correction})
    hierarchy.finest().matrix.partition().reinit(*vector);
  for (unsigned int i = 0; i < 3 * hierarchy.finest().matrix.n_rows(); ++i)
    defect.local_element(i) = Cube::random_number(i);
  cycle.apply(correction, defect);
  n_sends = n_collectives = 0;
  cycle.apply(correction, defect);
  const unsigned int n_sweeps = smoothing.n_pre + smoothing.n_post + 2 * smoothing.n_interface_sweeps;
  EXPECT_LE(n_sends, (6 * n_sweeps + 6) * n_neighbours);
  EXPECT_LE(n_collectives, 2u);
}



// Every row once, and backward exactly the opposite.
TEST(SweepSchedule, VisitsEveryRowOnce)
{
  Cube                       cube(5);
  const ProjectedGaussSeidel sweeps(cube.matrix);
  std::vector<unsigned int>  order = sweeps.schedule().order(), forward, backward;
  sweeps.schedule().visit(
      cube.v, Direction::forward,
      [&](const std::size_t begin, const std::size_t end) {
        forward.insert(forward.end(), order.begin() + begin, order.begin() + end);
      },
      [](const unsigned int, const double *) {});
  sweeps.schedule().visit(
      cube.v, Direction::backward,
      [&](const std::size_t begin, const std::size_t end) {
        for (std::size_t k = end; k > begin; --k)
          backward.push_back(order[k - 1]);
      },
      [](const unsigned int, const double *) {});
  EXPECT_EQ(forward, order);
  std::reverse(backward.begin(), backward.end());
  EXPECT_EQ(backward, order);
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, all_rows(cube.matrix));
}
