// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/coarse_cholesky.h>

#include <deal.II/base/mpi.h>

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCholesky>

namespace Signorini
{
  using namespace dealii;

  struct CoarseCholesky::Factorization
  {
    using Matrix = Eigen::SparseMatrix<double>;

    Eigen::SimplicialLDLT<Matrix>                        simplicial;
    std::unique_ptr<Eigen::CholmodSupernodalLLT<Matrix>> supernodal;
    bool                                                 analyzed = false;
    std::size_t                                          n_blocks = 0;
    MPI_Comm                                             communicator;

    template <typename Solver>
    bool factorize(Solver &solver, const Matrix &lower, const std::size_t n)
    {
      if (!analyzed || n_blocks != n)
        solver.analyzePattern(lower);
      analyzed = true;
      n_blocks = n;
      solver.factorize(lower);
      return solver.info() == Eigen::Success;
    }

    bool factorize(const Matrix &lower, const std::size_t n)
    {
      return supernodal ? factorize(*supernodal, lower, n) : factorize(simplicial, lower, n);
    }

    Eigen::VectorXd solve(const Eigen::Map<const Eigen::VectorXd> &b) const
    {
      return supernodal ? Eigen::VectorXd(supernodal->solve(b)) : Eigen::VectorXd(simplicial.solve(b));
    }
  };

  namespace
  {
    struct PackedMatrix
    {
      std::vector<NodeIndex> rows, columns;
      std::vector<double>    values;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &rows &columns &values;
      }
    };

    PackedMatrix pack(const NodeBlockMatrix &matrix)
    {
      PackedMatrix packed;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        for (const BlockRange &range : matrix.ranges(i))
          for (std::size_t k = range.begin; k < range.end; ++k)
            {
              packed.rows.push_back(matrix.partition().to_global(i));
              packed.columns.push_back(matrix.partition().to_global(matrix.column(k)));
              packed.values.insert(packed.values.end(), matrix.block(k), matrix.block(k) + 9);
            }
      return packed;
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
        factorization->supernodal = std::make_unique<Eigen::CholmodSupernodalLLT<Factorization::Matrix>>();
        factorization->supernodal->cholmod().print = 0;
      }
  }



  CoarseCholesky::CoarseCholesky(CoarseCholesky &&) noexcept = default;



  CoarseCholesky::~CoarseCholesky() = default;



  void CoarseCholesky::factorize(const NodeBlockMatrix &matrix, const bool is_nearly_singular)
  {
    const MPI_Comm comm         = matrix.partition().communicator();
    factorization->communicator = comm;
    const auto pieces           = Utilities::MPI::gather(comm, pack(matrix), 0);
    bool       ok               = true;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::vector<Eigen::Triplet<double>> triplets;
        std::size_t                         n_blocks = 0;
        for (const PackedMatrix &piece : pieces)
          {
            n_blocks += piece.rows.size();
            for (std::size_t k = 0; k < piece.rows.size(); ++k)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  if (piece.rows[k] >= piece.columns[k])
                    triplets.emplace_back(dim * piece.rows[k] + c, dim * piece.columns[k] + d,
                                          piece.values[9 * k + dim * c + d]);
          }
        const auto                  n = static_cast<Eigen::Index>(dim * matrix.partition().n_global());
        Eigen::SparseMatrix<double> lower(n, n);
        lower.setFromTriplets(triplets.begin(), triplets.end());
        if (is_nearly_singular)
          make_definite(lower);
        ok = factorization->factorize(lower, n_blocks);
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
    const auto          pieces = Utilities::MPI::gather(comm, mine, 0);
    std::vector<double> all;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        for (const auto &piece : pieces)
          all.insert(all.end(), piece.begin(), piece.end());
        const Eigen::VectorXd x =
            factorization->solve(Eigen::Map<const Eigen::VectorXd>(all.data(), all.size()));
        std::copy(x.data(), x.data() + x.size(), all.begin());
      }
    all                     = Utilities::MPI::broadcast(comm, all, 0);
    const std::size_t begin = solution.get_partitioner()->local_range().first;
    std::copy_n(all.begin() + begin, mine.size(), solution.begin());
  }
} // namespace Signorini
