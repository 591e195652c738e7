// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gathered_blocks.h"

#include <signorini/algebra/gathered_lists.h>

namespace Signorini
{
  void GatheredBlocks::gather(Blocks mine, const std::size_t n_nodes, const MPI_Comm communicator)
  {
    const auto rows  = gather_lists(std::move(mine.rows), communicator, Receivers::rank_zero);
    const auto nodes = gather_lists(std::move(mine.columns), communicator, Receivers::rank_zero);
    const auto given = gather_lists(std::move(mine.values), communicator, Receivers::rank_zero);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    start.assign(n_nodes + 1, 0);
    for (const std::size_t row : rows)
      ++start[row + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    columns.resize(rows.size());
    values.resize(given.size());
    std::vector<std::size_t> order;
    for (std::size_t row = 0; row < n_nodes; ++row)
      {
        order.resize(start[row + 1] - start[row]);
        std::iota(order.begin(), order.end(), start[row]);
        std::sort(order.begin(), order.end(),
                  [&](const std::size_t i, const std::size_t k) { return nodes[i] < nodes[k]; });
        for (std::size_t k = 0; k < order.size(); ++k)
          {
            columns[start[row] + k] = nodes[order[k]];
            std::copy_n(given.begin() + dim * dim * order[k], dim * dim,
                        values.begin() + dim * dim * (start[row] + k));
          }
      }
  }



  Eigen::VectorXd GatheredBlocks::operator*(const Eigen::VectorXd &x) const
  {
    Eigen::VectorXd result(x.size());
    for (std::size_t row = 0; row < n_rows(); ++row)
      {
        double sum[dim] = {};
        for (std::size_t k = start[row]; k < start[row + 1]; ++k)
          {
            const double *const block = values.data() + dim * dim * k;
            const double *const at    = x.data() + dim * columns[k];
            for (unsigned int c = 0; c < dim; ++c)
              sum[c] += block[dim * c] * at[0] + block[dim * c + 1] * at[1] + block[dim * c + 2] * at[2];
          }
        std::copy_n(sum, dim, result.data() + dim * row);
      }
    return result;
  }



  GatheredBlocks::UpperHalf GatheredBlocks::upper_structure() const
  {
    const auto n = static_cast<Eigen::Index>(dim * n_rows());
    checked_count(dim * dim * columns.size(), "numbers of a matrix that is factorized");
    UpperHalf  upper(n, n);
    int *const outer = upper.outerIndexPtr();
    outer[0]         = 0;
    for (std::size_t row = 0; row < n_rows(); ++row)
      {
        const auto first    = columns.begin() + start[row];
        const auto n_before = std::lower_bound(first, columns.begin() + start[row + 1], row) - first;
        for (unsigned int c = 0; c < dim; ++c)
          outer[dim * row + c + 1] = outer[dim * row + c] + static_cast<int>(dim * n_before + c + 1);
      }
    upper.resizeNonZeros(outer[n]);
    int *next = upper.innerIndexPtr();
    for (std::size_t row = 0; row < n_rows(); ++row)
      for (unsigned int c = 0; c < dim; ++c)
        for (std::size_t k = start[row]; k < start[row + 1] && columns[k] <= row; ++k)
          for (unsigned int d = 0; d < (columns[k] == row ? c + 1 : dim); ++d)
            *next++ = static_cast<int>(dim * columns[k] + d);
    return upper;
  }
} // namespace Signorini
