// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_gathered_blocks_h
#define signorini_solvers_gathered_blocks_h

#include <signorini/solvers/gathered_obstacle_problem.h>

#include <Eigen/SparseCore>

namespace Signorini
{
  /// A symmetric matrix of 3 x 3 blocks, whole on rank 0 and empty elsewhere.
  class GatheredBlocks
  {
  public:
    /// CHOLMOD reorders and transposes the other half one more time.
    using UpperHalf = Eigen::SparseMatrix<double>;
    using Blocks    = GatheredObstacleProblem::Blocks;

    /// Collective.
    /// @param mine the rows of this rank, one after the other in ascending order; ranks in order, too
    void gather(Blocks mine, const std::size_t n_nodes, const MPI_Comm communicator);

    std::size_t n_rows() const
    {
      return start.size() - 1;
    }

    std::size_t n_blocks() const
    {
      return columns.size();
    }

    /// The block on the diagonal of a row.
    Block diagonal_block(const std::size_t row) const
    {
      const auto place =
          std::lower_bound(columns.begin() + start[row], columns.begin() + start[row + 1], row);
      return read_block(values.data() + dim * dim * (place - columns.begin()));
    }

    /// A x.
    Eigen::VectorXd operator*(const Eigen::VectorXd &x) const;

    /// Rows and columns of what is on and above the diagonal, without values.
    UpperHalf upper_structure() const;

    /// Its values.
    /// @param block (row, column, nine numbers of the matrix) -> Block, for column <= row
    template <typename BlockOf>
    void fill_upper(UpperHalf &upper, const BlockOf &block) const;

  private:
    /// By rows, columns ascending.
    std::vector<std::size_t> start = {0}, columns;
    std::vector<double>      values;
  };



  template <typename BlockOf>
  void GatheredBlocks::fill_upper(UpperHalf &upper, const BlockOf &block_of) const
  {
    for (std::size_t row = 0; row < n_rows(); ++row)
      {
        // A row left of the diagonal is a column above it.
        std::array<double *, dim> next;
        for (unsigned int c = 0; c < dim; ++c)
          next[c] = upper.valuePtr() + upper.outerIndexPtr()[dim * row + c];
        for (std::size_t k = start[row]; k < start[row + 1] && columns[k] <= row; ++k)
          {
            const Block block = block_of(row, columns[k], values.data() + dim * dim * k);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < (columns[k] == row ? c + 1 : dim); ++d)
                *next[c]++ = block[c][d];
          }
      }
  }
} // namespace Signorini

#endif
