// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_random_matrix_h
#define signorini_tests_random_matrix_h

#include <signorini/algebra/node_block_matrix.h>

#include <Eigen/Core>

#include <random>

namespace RandomMatrix
{
  using namespace Signorini;

  inline unsigned int n_ranks()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  }

  inline unsigned int this_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  /// Contiguous ranges of different lengths; with more than two ranks the second one owns nothing.
  inline dealii::IndexSet owned_nodes(const NodeIndex n)
  {
    const auto begin_of = [&](const unsigned int rank) {
      const unsigned int r = n_ranks() > 2 && rank >= 2 ? rank - 1 : rank,
                         m = n_ranks() > 2 ? n_ranks() - 1 : n_ranks();
      return rank == n_ranks() ? n : (n_ranks() > 2 && rank == 1 ? n / m : n * r / m);
    };
    dealii::IndexSet owned(n);
    const NodeIndex  begin = begin_of(this_rank()),
                    end    = n_ranks() > 2 && this_rank() == 0 ? begin_of(1) : begin_of(this_rank() + 1);
    if (!(n_ranks() > 2 && this_rank() == 1))
      owned.add_range(begin, end);
    return owned;
  }

  /// A symmetric random matrix, every block the sum of contributions of several ranks; and the same densely.
  struct Case
  {
    NodeBlockMatrix matrix;
    Eigen::MatrixXd dense;
  };

  inline Case make(const NodeIndex n, const unsigned int seed)
  {
    Case                                     result;
    std::mt19937                             random(seed);
    std::uniform_real_distribution<double>   value(-1., 1.);
    std::uniform_int_distribution<NodeIndex> node(0, n - 1);
    result.dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);

    struct Contribution
    {
      NodeIndex             i, j;
      std::array<double, 9> block;
    };
    std::vector<Contribution>                mine;
    std::map<NodeIndex, std::set<NodeIndex>> columns;
    for (unsigned int k = 0; k < 6 * n; ++k)
      {
        const NodeIndex i = k < n ? k : node(random), j = node(random);
        Contribution    a{i, j, {}}, b{j, i, {}};
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d)
            a.block[3 * c + d] = b.block[3 * d + c] = value(random);
        for (const Contribution &x : {a, b})
          {
            for (unsigned int c = 0; c < 9; ++c)
              result.dense(3 * x.i + c / 3, 3 * x.j + c % 3) += x.block[c];
            if (k % n_ranks() == this_rank())
              {
                mine.push_back(x);
                columns[x.i].insert(x.j);
              }
          }
      }

    const dealii::IndexSet owned = owned_nodes(n);
    NodePattern            pattern;
    const auto             add_row = [&](const NodeIndex i) {
      if (const auto it = columns.find(i); it != columns.end())
        pattern.columns.insert(pattern.columns.end(), it->second.begin(), it->second.end());
      pattern.row_start.push_back(pattern.columns.size());
    };
    for (const NodeIndex i : owned)
      add_row(i);
    for (const auto &row : columns)
      if (!owned.is_element(row.first))
        {
          pattern.foreign_rows.push_back(row.first);
          add_row(row.first);
        }
    result.matrix.reinit(owned, pattern, dealii::IndexSet(n), MPI_COMM_WORLD);
    const NodePartition &nodes = result.matrix.partition();
    for (const Contribution &x : mine)
      {
        const unsigned int row = result.matrix.row_of(nodes.to_local(x.i)), column = nodes.to_local(x.j);
        if (result.matrix.stores(row, column))
          for (unsigned int c = 0; c < 9; ++c)
            result.matrix.block(result.matrix.find(row, column))[c] += x.block[c];
      }
    result.matrix.compress();
    return result;
  }

  /// Largest difference of the owned rows from the dense matrix, zeros included.
  inline double difference(const NodeBlockMatrix &matrix, const Eigen::MatrixXd &dense)
  {
    const NodePartition &nodes = matrix.partition();
    double               worst = 0.;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      {
        Eigen::MatrixXd rest = dense.middleRows(3 * nodes.to_global(row), 3);
        matrix.visit_row(row, [&](const RowEntry &entry) {
          for (unsigned int c = 0; c < 9; ++c)
            rest(c / 3, 3 * nodes.to_global(entry.column) + c % 3) -= entry.block()[c / 3][c % 3];
        });
        worst = std::max(worst, rest.cwiseAbs().maxCoeff());
      }
    return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
  }
} // namespace RandomMatrix

#endif
