// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_solvers_block_cholesky_h
#define signorini_source_solvers_block_cholesky_h

#include <signorini/algebra/types.h>

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Cholesky factors of a matrix of node blocks: dense ones of a few nodes, sparse ones (CHOLMOD) of many.
  class BlockCholesky
  {
  public:
    /// The lower half of a matrix, block by block.
    class Matrix
    {
    public:
      explicit Matrix(const std::size_t n_nodes);

      /// Sets a block of the lower half; of a diagonal one the lower half counts.
      void set(const std::size_t row, const std::size_t column, const Block &block);

    private:
      friend BlockCholesky;
      std::size_t                         n_nodes;
      Eigen::MatrixXd                     full;
      std::vector<Eigen::Triplet<double>> entries;
    };

    /// Replaces the factors; the ordering of sparse ones stays, so the structure must. Returns whether the
    /// matrix is definite.
    bool factorize(const Matrix &matrix);

    /// A^-1 b.
    Eigen::VectorXd solve(const Eigen::VectorXd &b) const;

  private:
    using Sparse = Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Upper>;

    Eigen::LLT<Eigen::MatrixXd> dense;
    std::unique_ptr<Sparse>     sparse;
  };
} // namespace Signorini

#endif
