// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/foreign_levels.h>
#include <signorini/solvers/obstacle_solver.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::IndexSet;

namespace
{
  /// The five-point Laplacian on the unit square with zero boundary values: an interior of a grid of n x n
  /// cells with its border, each rank a strip of it.
  struct LaplaceGrid
  {
    unsigned int n;
    IndexSet     all, owned, border;

    LaplaceGrid(const unsigned int n, const MPI_Comm communicator)
      : n(n)
      , all(dealii::complete_index_set((n + 1) * (n + 1)))
      , owned(all.size())
      , border(all.size())
    {
      const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator),
                         n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      owned.add_range(all.size() * rank / n_ranks, all.size() * (rank + 1) / n_ranks);
      for (unsigned int i = 0; i < all.size(); ++i)
        if (i % (n + 1) == 0 || i % (n + 1) == n || i / (n + 1) == 0 || i / (n + 1) == n)
          border.add_index(i);
    }

    /// Calls set(row, column, value) for the entries of owned rows.
    template <typename Set>
    void laplacian(const Set &set) const
    {
      for (const auto i : owned)
        {
          set(i, i, 4.);
          for (const auto j : {i - n - 1, i - 1, i + 1, i + n + 1})
            if (!border.is_element(i) && !border.is_element(j))
              set(i, j, -1.);
        }
    }

    /// The same for the bilinear interpolation from the grid of half as many cells; the border stays zero.
    template <typename Set>
    void interpolation(const Set &set) const
    {
      for (const auto i : owned)
        for (unsigned int y = 0; y < 2; ++y)
          for (unsigned int x = 0; x < 2; ++x)
            {
              const auto column = i % (n + 1), row = i / (n + 1);
              if ((column % 2 == 1 || x == 0) && (row % 2 == 1 || y == 0))
                set(i, (row / 2 + y) * (n / 2 + 1) + column / 2 + x,
                    (column % 2 == 1 ? .5 : 1.) * (row % 2 == 1 ? .5 : 1.));
            }
    }
  };

  /// Matrices of Trilinos on all ranks.
  struct Trilinos
  {
    static constexpr bool is_parallel = true;

    template <typename Entries>
    static dealii::TrilinosWrappers::SparseMatrix make(const LaplaceGrid &rows, const LaplaceGrid &columns,
                                                       const Entries &entries)
    {
      dealii::TrilinosWrappers::SparseMatrix matrix(rows.owned, columns.owned, MPI_COMM_WORLD, 9);
      entries([&](const auto i, const auto j, const double value) { matrix.set(i, j, value); });
      matrix.compress(dealii::VectorOperation::insert);
      return matrix;
    }
  };

  /// Matrices of deal.II on each rank alone.
  struct Serial
  {
    static constexpr bool is_parallel = false;

    dealii::SparsityPattern      pattern;
    dealii::SparseMatrix<double> matrix;

    template <typename Entries>
    Serial(const LaplaceGrid &rows, const LaplaceGrid &columns, const Entries &entries)
    {
      dealii::DynamicSparsityPattern dynamic(rows.all.size(), columns.all.size());
      entries([&](const auto i, const auto j, const double) { dynamic.add(i, j); });
      pattern.copy_from(dynamic);
      matrix.reinit(pattern);
      entries([&](const auto i, const auto j, const double value) { matrix.set(i, j, value); });
    }
  };

  /// Calls use(matrix) with a matrix of one of the kinds.
  template <typename Kind, typename Entries, typename Use>
  auto with_matrix(const LaplaceGrid &rows, const LaplaceGrid &columns, const Entries &entries,
                   const Use &use)
  {
    if constexpr (Kind::is_parallel)
      return use(Trilinos::make(rows, columns, entries));
    else
      return use(Serial(rows, columns, entries).matrix);
  }

  template <typename Kind>
  MPI_Comm communicator()
  {
    return Kind::is_parallel ? MPI_COMM_WORLD : MPI_COMM_SELF;
  }

  template <typename Kind>
  MultigridHierarchy make_hierarchy(const unsigned int n, const HalfSpaces &half_spaces = HalfSpaces())
  {
    const MPI_Comm                    comm = communicator<Kind>();
    const ForeignNumbering            scalar;
    const LaplaceGrid                 finest(n, comm);
    std::vector<ForeignLevels::Level> levels;
    for (unsigned int m = n; m > 4; m /= 2)
      {
        const LaplaceGrid fine(m, comm), coarse(m / 2, comm);
        levels.push_back(
            {with_matrix<Kind>(
                 fine, coarse, [&](const auto &set) { fine.interpolation(set); },
                 [&](const auto &matrix) { return read_prolongation(matrix, scalar, fine.owned); }),
             scalar.nodes(coarse.owned), scalar.fixed(coarse.owned, coarse.border)});
      }
    ForeignLevels  source(std::move(levels), half_spaces);
    HierarchyParts parts;
    parts.matrix = with_matrix<Kind>(
        finest, finest, [&](const auto &set) { finest.laplacian(set); },
        [&](const auto &matrix) { return read_matrix(matrix, scalar, finest.owned, comm); });
    parts.fixed  = scalar.fixed(finest.owned, finest.border);
    parts.levels = &source;
    return MultigridHierarchy(std::move(parts));
  }

  /// A membrane under its weight on a hill.
  template <typename Kind>
  ConvergenceReport solve_membrane(const unsigned int n)
  {
    const LaplaceGrid grid(n, communicator<Kind>());
    ObstacleProblem   problem;
    Vector3           down;
    down[0] = -1.;
    for (const auto i : grid.owned)
      if (!grid.border.is_element(i))
        {
          const double x = double(i % (n + 1)) / n - .4, y = double(i / (n + 1)) / n - .5;
          problem.half_spaces.nodes.push_back(static_cast<unsigned int>(grid.owned.index_within_set(i)));
          problem.half_spaces.normals.push_back(down);
          problem.half_spaces.bounds.push_back(.05 + x * x + 2. * y * y);
        }
    MultigridHierarchy hierarchy = make_hierarchy<Kind>(n, problem.half_spaces);
    hierarchy.finest().matrix.partition().reinit(problem.rhs);
    for (unsigned int i = 0; dim * i < problem.rhs.locally_owned_size(); ++i)
      if (!grid.border.is_element(grid.owned.nth_index_in_set(i)))
        problem.rhs.local_element(dim * i) = -8. / (n * n);
    Vector v = problem.rhs;
    v        = 0.;
    return make_solver(hierarchy, SolverParameters())->solve(v, problem);
  }
} // namespace



// Whatever the matrices are and on however many ranks: the same contact as from deal.II's on one.
TEST(ForeignLevels, MembraneOfTrilinosMatricesOnAllRanks)
{
  for (const unsigned int n : {16, 32, 64})
    {
      const ConvergenceReport one = solve_membrane<Serial>(n), all = solve_membrane<Trilinos>(n);
      EXPECT_TRUE(one.converged && all.converged);
      EXPECT_GT(one.active_nodes.back(), 5u);
      EXPECT_EQ(all.active_nodes.back(), one.active_nodes.back());
      EXPECT_NEAR(all.energy / one.energy, 1., 1e-12);
      EXPECT_LE(one.iterations, 12u);
      EXPECT_LE(all.iterations, one.iterations + 2);
    }
}



namespace
{
  /// Products by a matrix of Trilinos. Those of deal.II's class are templates whose symbols gcc, which
  /// Debian's library is compiled with, and clang call by different names.
  struct TrilinosProduct
  {
    const dealii::TrilinosWrappers::SparseMatrix &matrix;

    template <typename V>
    void vmult(V &y, const V &x) const
    {
      const Epetra_CrsMatrix &m = matrix.trilinos_matrix();
      const Epetra_Vector     from(View, m.DomainMap(), const_cast<double *>(x.begin()));
      Epetra_Vector           to(View, m.RangeMap(), y.begin());
      EXPECT_EQ(m.Multiply(false, from, to), 0);
    }
  };
} // namespace



TEST(ForeignLevels, PreconditionsConjugateGradientsOfTrilinosVectors)
{
  for (const unsigned int n : {16, 64})
    {
      const LaplaceGrid  grid(n, MPI_COMM_WORLD);
      MultigridHierarchy hierarchy = make_hierarchy<Trilinos>(n);
      const auto         matrix = Trilinos::make(grid, grid, [&](const auto &set) { grid.laplacian(set); });
      const auto         solve  = [&](auto &u, auto &b) {
        for (const auto i : grid.owned)
          b(i) = grid.border.is_element(i) ? 0. : std::sin(1. + 3. * static_cast<double>(i));
        b.compress(dealii::VectorOperation::insert);
        dealii::SolverControl control(20, 1e-10 * b.l2_norm());
        dealii::SolverCG<std::remove_reference_t<decltype(u)>>(control).solve(
                     TrilinosProduct{matrix}, u, b, VCyclePreconditioner(hierarchy, ForeignNumbering()));
        return control.last_step();
      };
      dealii::TrilinosWrappers::MPI::Vector u(grid.owned, MPI_COMM_WORLD), b(grid.owned, MPI_COMM_WORLD);
      EXPECT_LE(solve(u, b), 9u);
      dealii::LinearAlgebra::distributed::Vector<double> w(grid.owned, MPI_COMM_WORLD), c(w);
      EXPECT_LE(solve(w, c), 9u);
      for (const auto i : grid.owned)
        EXPECT_NEAR(u(i), w(i), 1e-9);
    }
}
