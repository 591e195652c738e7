// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/algebra/node_block_matrix.h>
#include <signorini/algebra/sent_lists.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <functional>

namespace Signorini
{
  using namespace dealii;

  void NodeBlockMatrix::reinit(const IndexSet &owned, const NodePattern &pattern,
                               const IndexSet &extra_ghosts, const MPI_Comm communicator)
  {
    make_structure(owned, pattern, extra_ghosts, communicator);
    values.reinit(n_positions());
  }



  void NodeBlockMatrix::clear_row(const unsigned int row)
  {
    for (const BlockRange &range : stored(row))
      std::fill_n(values.exact(range.begin), 9 * range.size(), 0.);
  }



  void NodeBlockMatrix::split()
  {
    // Factors of 1e12 on both sides for the other numbers of a matrix and for what they are multiplied with.
    constexpr double largest_unit = 1e12;
    const double     scale        = diagonal_scale(*this);
    if (partition().n_ranks() == 1 && scale < largest_unit && scale > 1. / largest_unit)
      values.split(n_rows());
  }



  void NodeBlockMatrix::compress()
  {
    if (partition().n_ranks() == 1)
      return;
    ListsByRank<double> packets;
    for (const auto &[rank, rows] : send_rows)
      {
        double *const begin = values.exact(outer(rows.first).begin);
        double *const end   = values.exact(outer(rows.second - 1).end);
        packets[rank].assign(begin, end);
        std::fill(begin, end, 0.);
      }
    std::vector<unsigned int> senders;
    for (const auto &[rank, positions] : receive_positions)
      senders.push_back(rank);
    const ListsByRank<double> received = answer_lists(packets, senders, partition().communicator());
    for (const auto &[rank, positions] : receive_positions)
      {
        const std::vector<double> &data = received.at(rank);
        AssertDimension(data.size(), 9 * positions.size());
        for (std::size_t k = 0; k < positions.size(); ++k)
          for (unsigned int c = 0; c < 9; ++c)
            values.exact(positions[k])[c] += data[9 * k + c];
      }
  }



  void NodeBlockMatrix::multiply_row(double *const product, const unsigned int row, const Vector &src) const
  {
    const auto here = stored(row);
    double     sums[9], mirrored_sums[dim];
    multiply_block_ranges(sums, block_data(), column_data(), here.data(), here.size(), src.begin());
    multiply_mirrored_blocks(mirrored_sums, mirrored_blocks(row), src.begin());
    for (unsigned int c = 0; c < dim; ++c)
      product[c] = sums[c] + sums[3 + c] + mirrored_sums[c] + sums[6 + c];
  }



  void NodeBlockMatrix::vmult(Vector &dst, const Vector &src) const
  {
    double *const     y = dst.begin();
    const std::size_t n = dim * static_cast<std::size_t>(n_rows());
    std::fill_n(y, n, 0.);
    subtract_product(dst, src);
    std::transform(y, y + n, y, std::negate<double>());
  }



  void NodeBlockMatrix::subtract_product(Vector &dst, const Vector &src) const
  {
    const BlockNumbers blocks = block_data();
    src.update_ghost_values();
    for (unsigned int i = 0; i < n_rows(); ++i)
      {
        const auto       here       = stored(i);
        const BlockRange one_way[2] = {here[0], here[2]};
        double *const    y          = dst.begin() + dim * static_cast<std::size_t>(i);
        double           sums[6];
        multiply_block_ranges(sums, blocks, column_data(), one_way, 2, src.begin());
        for (unsigned int c = 0; c < dim; ++c)
          y[c] -= sums[c] + sums[3 + c];
        subtract_both_ways(dst.begin(), i, blocks, column_data(), here[1], src.begin());
      }
  }



  void NodeBlockMatrix::symmetric_residual(Vector &residual, const Vector &src, const Vector &rhs) const
  {
    residual.copy_locally_owned_data_from(rhs);
    subtract_product(residual, src);
  }



  double diagonal_scale(const NodeBlockMatrix &matrix)
  {
    double scale = 0.;
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        scale = std::max(scale, matrix.block(matrix.diagonal(i))[(dim + 1) * c]);
    return Utilities::MPI::max(scale, matrix.partition().communicator());
  }
} // namespace Signorini
