// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gathered_blocks.h"
#include "single_threaded.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/solvers/coarse_cholesky.h>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>

namespace Signorini
{
  using namespace dealii;

  struct CoarseCholesky::Factorization
  {
    using Matrix = Eigen::SparseMatrix<double>;

    using Supernodal = Eigen::CholmodSupernodalLLT<Matrix, Eigen::Upper>;

    Eigen::SimplicialLDLT<Matrix, Eigen::Upper> simplicial;
    std::unique_ptr<Supernodal>                 supernodal;
    bool                                        analyzed = false;
    std::size_t                                 n_blocks = 0;
    MPI_Comm                                    communicator;

    /// Eigen does not see that there may be no memory for it, or too few bits.
    static bool has_ordering(Supernodal &solver)
    {
      return solver.cholmod().status == CHOLMOD_OK && solver.cholmod().fl >= 0.;
    }

    static bool has_ordering(Eigen::SimplicialLDLT<Matrix, Eigen::Upper> &)
    {
      return true;
    }

    template <typename Solver>
    bool analyze(Solver &solver, const Matrix &upper, const std::size_t n)
    {
      if (!analyzed || n_blocks != n)
        {
          solver.analyzePattern(upper);
          analyzed = has_ordering(solver);
        }
      n_blocks = n;
      return analyzed;
    }

    /// Multiplications of a factorization; infinite if the structure cannot be analyzed.
    double cost(const GatheredBlocks &blocks)
    {
      const SingleThreaded single_threaded;
      // CHOLMOD counts an addition and a multiplication as two.
      return analyze(*supernodal, blocks.upper_structure(), blocks.n_blocks())
                 ? .5 * supernodal->cholmod().fl
                 : std::numeric_limits<double>::infinity();
    }

    template <typename Solver>
    bool factorize(Solver &solver, const Matrix &upper, const std::size_t n)
    {
      if (!analyze(solver, upper, n))
        return false;
      solver.factorize(upper);
      return solver.info() == Eigen::Success;
    }

    bool factorize(const Matrix &upper, const std::size_t n)
    {
      const SingleThreaded single_threaded;
      return supernodal ? factorize(*supernodal, upper, n) : factorize(simplicial, upper, n);
    }

    Eigen::VectorXd solve(const Eigen::Map<const Eigen::VectorXd> &b) const
    {
      return supernodal ? Eigen::VectorXd(supernodal->solve(b)) : Eigen::VectorXd(simplicial.solve(b));
    }
  };

  namespace
  {
    GatheredBlocks::Blocks pack(const NodeBlockMatrix &matrix)
    {
      GatheredBlocks::Blocks packed;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        matrix.visit_row(i, [&](const RowEntry &entry) {
          packed.add(matrix.partition().to_global(i), matrix.partition().to_global(entry.column),
                     entry.block());
        });
      return packed;
    }

    /// On rank 0.
    GatheredBlocks gather(const NodeBlockMatrix &matrix)
    {
      GatheredBlocks result;
      result.gather(pack(matrix), matrix.partition().n_global(), matrix.partition().communicator());
      return result;
    }

    /// What keeps factors of a singular matrix with a consistent right hand side finite.
    struct SingularRule
    {
      /// Added to each diagonal entry: of itself, and of the largest one. Background levels of a lug and a
      /// bone: the same iterations from 1e-11 to 1e-6 and from 1e-15 to 1e-10; without, no convergence.
      double of_entry = 1e-9, of_largest = 1e-13;
    };

    void make_definite(Eigen::SparseMatrix<double> &matrix)
    {
      const SingularRule rule;
      const double       largest = matrix.diagonal().maxCoeff();
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        matrix.coeffRef(i, i) += rule.of_entry * matrix.coeff(i, i) + rule.of_largest * largest;
    }
  } // namespace



  CoarseCholesky::CoarseCholesky(const Kind kind)
    : factorization(std::make_unique<Factorization>())
  {
    if (kind == Kind::supernodal)
      {
        factorization->supernodal                  = std::make_unique<Factorization::Supernodal>();
        factorization->supernodal->cholmod().print = 0;
      }
  }



  CoarseCholesky::CoarseCholesky(CoarseCholesky &&) noexcept = default;



  CoarseCholesky::~CoarseCholesky() = default;



  double CoarseCholesky::cost(const NodeBlockMatrix &matrix)
  {
    AssertThrow(factorization->supernodal, ExcInternalError());
    const MPI_Comm       comm   = matrix.partition().communicator();
    const GatheredBlocks blocks = gather(matrix);
    double               cost   = 0.;
    // The other ranks wait for what this one finds.
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          cost = factorization->cost(blocks);
        }
      catch (const std::bad_alloc &)
        {
          cost = std::numeric_limits<double>::infinity();
        }
    return Utilities::MPI::broadcast(comm, cost);
  }



  void CoarseCholesky::factorize(const NodeBlockMatrix &matrix, const bool is_nearly_singular)
  {
    const MPI_Comm comm         = matrix.partition().communicator();
    factorization->communicator = comm;
    bool                 ok     = true;
    const GatheredBlocks blocks = gather(matrix);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        GatheredBlocks::UpperHalf upper = blocks.upper_structure();
        blocks.fill_upper(upper, [](const std::size_t, const std::size_t, const double *const block) {
          return read_block(block);
        });
        if (is_nearly_singular)
          make_definite(upper);
        ok = factorization->factorize(upper, blocks.n_blocks());
      }
    AssertThrow(Utilities::MPI::min(static_cast<int>(ok), comm) == 1,
                ExcMessage("The sparse factorization failed: the matrix is singular."));
  }



  void CoarseCholesky::solve(Vector &solution, const Vector &rhs) const
  {
    const MPI_Comm      comm = factorization->communicator;
    std::vector<double> mine(rhs.begin(), rhs.begin() + rhs.locally_owned_size());
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      {
        const Eigen::Map<const Eigen::VectorXd> b(mine.data(), mine.size());
        Eigen::Map<Eigen::VectorXd>(solution.begin(), mine.size()) = factorization->solve(b);
        return;
      }
    std::vector<double> all = gather_lists(std::move(mine), comm, Receivers::rank_zero);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const Eigen::VectorXd x =
            factorization->solve(Eigen::Map<const Eigen::VectorXd>(all.data(), all.size()));
        std::copy(x.data(), x.data() + x.size(), all.begin());
      }
    all = scatter_list(std::move(all), rhs.locally_owned_size(), comm);
    std::copy(all.begin(), all.end(), solution.begin());
  }
} // namespace Signorini
