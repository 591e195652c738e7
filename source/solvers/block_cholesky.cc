// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "block_cholesky.h"
#include "single_threaded.h"

#include <deal.II/base/exceptions.h>

namespace Signorini
{
  namespace
  {
    /// Up to so many nodes factors are dense.
    constexpr std::size_t largest_dense = 24;
  } // namespace



  BlockCholesky::Matrix::Matrix(const std::size_t n_nodes)
    : n_nodes(n_nodes)
  {
    if (n_nodes <= largest_dense)
      full = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(dim * n_nodes),
                                   static_cast<Eigen::Index>(dim * n_nodes));
    else
      // A node of a plane, with half of its neighbours.
      entries.reserve(5 * dim * dim * n_nodes);
  }



  void BlockCholesky::Matrix::set(const std::size_t row, const std::size_t column, const Block &block)
  {
    Assert(column <= row, dealii::ExcInternalError());
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        if (n_nodes <= largest_dense)
          full(dim * row + c, dim * column + d) = block[c][d];
        else if (column < row || d <= c)
          // CHOLMOD reorders and transposes the lower half one more time.
          entries.emplace_back(dim * column + d, dim * row + c, block[c][d]);
  }



  bool BlockCholesky::factorize(const Matrix &matrix)
  {
    if (matrix.n_nodes <= largest_dense)
      return dense.compute(matrix.full).info() == Eigen::Success;
    const auto                  size = static_cast<Eigen::Index>(dim * matrix.n_nodes);
    Eigen::SparseMatrix<double> upper(size, size);
    upper.setFromTriplets(matrix.entries.begin(), matrix.entries.end());
    if (!sparse)
      {
        sparse                  = std::make_unique<Sparse>();
        sparse->cholmod().print = 0;
        sparse->analyzePattern(upper);
      }
    const SingleThreaded single_threaded;
    sparse->factorize(upper);
    return sparse->info() == Eigen::Success;
  }



  Eigen::VectorXd BlockCholesky::solve(const Eigen::VectorXd &b) const
  {
    return sparse ? Eigen::VectorXd(sparse->solve(b)) : Eigen::VectorXd(dense.solve(b));
  }
} // namespace Signorini
