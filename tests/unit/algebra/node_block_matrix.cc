// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "random_matrix.h"

#include <signorini/algebra/galerkin_product.h>

#include <gtest/gtest.h>

using namespace Signorini;

namespace
{
  double entry(const unsigned int i)
  {
    return std::sin(1. + 7. * i);
  }

  /// Random interpolation from n_coarse to n nodes: up to three parents a node, some rows with 3x3 blocks,
  /// full or diagonal.
  struct RandomTransfer
  {
    NodalTransfer   transfer;
    Eigen::MatrixXd dense;

    RandomTransfer(const NodePartition &fine, const NodeIndex n_coarse, const unsigned int seed)
      : dense(Eigen::MatrixXd::Zero(3 * fine.n_global(), 3 * n_coarse))
    {
      std::mt19937                             random(seed);
      std::uniform_real_distribution<double>   value(-1., 1.);
      std::uniform_int_distribution<NodeIndex> node(0, n_coarse - 1);
      std::vector<std::map<NodeIndex, double>> rows(fine.n_global());
      std::map<NodeIndex, std::vector<Block>>  blocks;
      for (NodeIndex i = 0; i < fine.n_global(); ++i)
        {
          for (unsigned int k = 0; k < 3; ++k)
            rows[i][node(random)] = value(random);
          for (const auto &[j, weight] : rows[i])
            {
              Block block;
              for (unsigned int c = 0; c < 3; ++c)
                for (unsigned int d = 0; d < 3; ++d)
                  block[c][d] = i % 8 == 0   ? value(random)
                                : c != d     ? 0.
                                : i % 8 == 4 ? value(random)
                                             : weight;
              // Some of the rows with blocks are scalar ones in disguise.
              if (i % 4 < 2)
                blocks[i].push_back(block);
              for (unsigned int c = 0; c < 9; ++c)
                dense(3 * i + c / 3, 3 * j + c % 3) = block[c / 3][c % 3];
            }
        }
      NodeRows                             local;
      std::vector<NodalTransfer::BlockRow> block_rows;
      for (unsigned int i = 0; i < fine.n_local(); ++i)
        {
          const NodeIndex         global = fine.to_global(i);
          NodalTransfer::BlockRow block_row{i, {}, {}, {}};
          for (const auto &[j, weight] : rows[global])
            {
              local.add(j, weight);
              block_row.columns.push_back(j);
            }
          local.finish_row();
          if (blocks.count(global) > 0)
            {
              // Weights say the same where all blocks are multiples of the identity.
              if (global % 8 == 1)
                for (const Block &block : blocks[global])
                  block_row.weights.push_back(block[0][0]);
              else
                block_row.blocks = blocks[global];
              block_rows.push_back(block_row);
            }
        }
      transfer.reinit(local, block_rows, fine.n_owned());
    }

    void truncate(const NodePartition &fine, const NodeIndex row, const Vector3 &normal)
    {
      if (const unsigned int local = fine.to_local(row); local != dealii::numbers::invalid_unsigned_int)
        transfer.set_plane(local, normal);
      const Eigen::Map<const Eigen::Vector3d> n(&normal[0]);
      dense.middleRows(3 * row, 3) -= n * (n.transpose() * dense.middleRows(3 * row, 3));
    }
  };
} // namespace

TEST(NodeBlockMatrix, AddsTheContributionsOfAllRanks)
{
  const auto c = RandomMatrix::make(23, 1);
  EXPECT_LT(RandomMatrix::difference(c.matrix, c.dense), 1e-13);
  for (unsigned int row = 0; row < c.matrix.n_rows(); ++row)
    {
      EXPECT_EQ(c.matrix.column(c.matrix.diagonal(row)), row);
      const BlockRange lower = c.matrix.lower(row), outer = c.matrix.outer(row);
      for (std::size_t k = lower.begin; k < lower.end; ++k)
        EXPECT_LT(c.matrix.column(k), k + 1 < lower.end ? c.matrix.column(k + 1) : row);
      for (std::size_t k = outer.begin; k < outer.end; ++k)
        EXPECT_GE(c.matrix.column(k), k > outer.begin ? c.matrix.column(k - 1) + 1 : c.matrix.n_rows());
      const MirroredBlocks above = c.matrix.mirrored_blocks(row);
      for (std::size_t m = 0; m < above.n; ++m)
        {
          EXPECT_GT(above.columns[m], m > 0 ? above.columns[m - 1] : row);
          EXPECT_FALSE(c.matrix.stores(row, above.columns[m]));
          EXPECT_EQ(above.positions[m], c.matrix.find(above.columns[m], row));
        }
      EXPECT_EQ(c.matrix.row_length(row), 1 + lower.size() + above.n + outer.size());
    }
}

TEST(NodeBlockMatrix, MultipliesLikeTheDenseMatrix)
{
  const auto           c     = RandomMatrix::make(23, 2);
  const NodePartition &nodes = c.matrix.partition();
  Eigen::VectorXd      x(3 * 23);
  for (unsigned int i = 0; i < x.size(); ++i)
    x[i] = entry(i);
  Vector src, dst;
  nodes.reinit(src);
  nodes.reinit(dst);
  for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
    src.local_element(i) = x[3 * nodes.first_owned() + i];
  c.matrix.vmult(dst, src);
  const Eigen::VectorXd y = c.dense * x;
  for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
    EXPECT_NEAR(dst.local_element(i), y[3 * nodes.first_owned() + i], 1e-13);
}

// The matrix, what is computed of it, and its copies are the same to rounding; numbers at the ends of single
// precision stay in double precision, as they do where there are ghosts.
TEST(NodeBlockMatrix, IsTheSameSplit)
{
  auto                   c     = RandomMatrix::make(23, 2);
  const NodePartition   &nodes = c.matrix.partition();
  RandomTransfer         p(nodes, 9, 4), p_of_split(nodes, 9, 4);
  const dealii::IndexSet owned = RandomMatrix::owned_nodes(9);
  NodeBlockMatrix        split = c.matrix, coarse, coarse_of_split;
  split.split();
  EXPECT_EQ(split.is_split(), RandomMatrix::n_ranks() == 1);
  for (const double factor : {1e20, 1e-20})
    {
      NodeBlockMatrix far = c.matrix;
      for (std::size_t k = 0; k < far.n_stored_blocks(); ++k)
        for (unsigned int i = 0; i < 9; ++i)
          far.block(k)[i] *= factor;
      far.split();
      EXPECT_FALSE(far.is_split());
    }
  const auto expect_same = [](const NodeBlockMatrix &a, const NodeBlockMatrix &b, const double tolerance) {
    for (unsigned int row = 0; row < a.n_rows(); ++row)
      {
        std::vector<Block> expected;
        a.visit_row(row, [&](const RowEntry &entry) { expected.push_back(entry.block()); });
        std::size_t next = 0;
        b.visit_row(row, [&](const RowEntry &entry) {
          EXPECT_LE((entry.block() - expected[next]).norm(), tolerance);
          EXPECT_NEAR(entry.trace(), trace(expected[next]), tolerance);
          ++next;
        });
        EXPECT_EQ(next, expected.size());
      }
  };
  expect_same(c.matrix, split, 0.);
  reinit_galerkin(coarse, c.matrix, p.transfer, owned);
  compute_galerkin(coarse, c.matrix, p.transfer);
  reinit_galerkin(coarse_of_split, split, p_of_split.transfer, owned);
  compute_galerkin(coarse_of_split, split, p_of_split.transfer);
  expect_same(coarse, coarse_of_split, 1e-13);
  Vector src, expected, actual;
  for (Vector *vector : {&src, &expected, &actual})
    nodes.reinit(*vector);
  for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
    src.local_element(i) = entry(3 * nodes.first_owned() + i);
  c.matrix.vmult(expected, src);
  split.vmult(actual, src);
  for (unsigned int i = 0; i < nodes.n_owned(); ++i)
    {
      double product[3];
      split.multiply_row(product, i, src);
      for (unsigned int d = 0; d < 3; ++d)
        {
          EXPECT_NEAR(actual.local_element(3 * i + d), expected.local_element(3 * i + d), 1e-13);
          EXPECT_NEAR(product[d], expected.local_element(3 * i + d), 1e-13);
        }
    }
  split.join();
  EXPECT_FALSE(split.is_split());
  expect_same(c.matrix, split, 0.);
}

TEST(NodalTransfer, ProlongatesAndRestrictsLikeTheDenseMatrix)
{
  auto                   c = RandomMatrix::make(23, 3);
  RandomTransfer         p(c.matrix.partition(), 9, 4);
  NodeBlockMatrix        coarse;
  const dealii::IndexSet owned = RandomMatrix::owned_nodes(9);
  reinit_galerkin(coarse, c.matrix, p.transfer, owned);
  const NodePartition &fine_nodes = c.matrix.partition(), &coarse_nodes = coarse.partition();
  p.truncate(fine_nodes, 4, Vector3({.6, 0., .8}));
  p.truncate(fine_nodes, 6, Vector3({0., 1., 0.}));
  Vector fine, small;
  fine_nodes.reinit(fine);
  coarse_nodes.reinit(small);
  Eigen::VectorXd x(27);
  for (unsigned int i = 0; i < x.size(); ++i)
    x[i] = entry(i);
  for (unsigned int i = 0; i < 3 * coarse_nodes.n_owned(); ++i)
    small.local_element(i) = x[3 * coarse_nodes.first_owned() + i];
  p.transfer.prolongate(fine, small);
  const Eigen::VectorXd y = p.dense * x, z = p.dense.transpose() * y + x;
  for (unsigned int i = 0; i < 3 * fine_nodes.n_owned(); ++i)
    EXPECT_NEAR(fine.local_element(i), y[3 * fine_nodes.first_owned() + i], 1e-13);
  p.transfer.restrict_and_add(small, fine);
  for (unsigned int i = 0; i < 3 * coarse_nodes.n_owned(); ++i)
    EXPECT_NEAR(small.local_element(i), z[3 * coarse_nodes.first_owned() + i], 1e-13);
}

TEST(NodalTransfer, GalerkinProductIsThatOfTheDenseMatrices)
{
  auto            c = RandomMatrix::make(23, 5);
  RandomTransfer  p(c.matrix.partition(), 9, 6);
  NodeBlockMatrix coarse;
  reinit_galerkin(coarse, c.matrix, p.transfer, RandomMatrix::owned_nodes(9));
  compute_galerkin(coarse, c.matrix, p.transfer);
  EXPECT_LT(RandomMatrix::difference(coarse, p.dense.transpose() * c.dense * p.dense), 1e-12);
}

// After a change of rows of P the marked coarse rows are all that have to be computed again.
TEST(NodalTransfer, MarkedRowsAreAllThatDependOnTruncatedRows)
{
  auto                 c = RandomMatrix::make(23, 7);
  RandomTransfer       p(c.matrix.partition(), 9, 8);
  NodeBlockMatrix      coarse;
  const NodePartition &nodes = c.matrix.partition();
  reinit_galerkin(coarse, c.matrix, p.transfer, RandomMatrix::owned_nodes(9));
  compute_galerkin(coarse, c.matrix, p.transfer);
  const Eigen::MatrixXd untruncated = p.dense;
  const auto            update      = [&](const std::set<NodeIndex> &changed) {
    const std::vector<unsigned int> rows = c.matrix.rows_with_column(
        [&](const unsigned int column) { return changed.count(nodes.to_global(column)) > 0; });
    compute_galerkin(coarse, c.matrix, p.transfer, mark_coarse_nodes(p.transfer, rows));
    const Eigen::MatrixXd expected = p.dense.transpose() * c.dense * p.dense;
    EXPECT_LT(RandomMatrix::difference(coarse, expected), 1e-12);
  };
  // A row with blocks, with diagonal ones, a scalar row given as blocks, a scalar row.
  const Vector3 normal({.6, 0., .8});
  for (const NodeIndex row : {8, 12, 13, 18})
    p.truncate(nodes, row, normal);
  update({8, 12, 13, 18});
  // And back.
  for (const NodeIndex row : {8, 13})
    {
      if (const unsigned int local = nodes.to_local(row); local != dealii::numbers::invalid_unsigned_int)
        p.transfer.set_plane(local, Vector3());
      p.dense.middleRows(3 * row, 3) = untruncated.middleRows(3 * row, 3);
    }
  update({8, 13});
}



// Columns of other ranks too.
TEST(NodeBlockMatrix, FindsRowsByTheirColumns)
{
  for (const NodeIndex n : {1u, 7u, 60u})
    {
      const RandomMatrix::Case c        = RandomMatrix::make(n, 3 + n);
      const auto               property = [&](const unsigned int column) {
        return c.matrix.partition().to_global(column) % 13 == 5;
      };
      std::vector<unsigned int> expected;
      for (unsigned int row = 0; row < c.matrix.n_rows(); ++row)
        {
          bool found = false;
          c.matrix.visit_row(row, [&](const RowEntry &entry) { found = found || property(entry.column); });
          if (found)
            expected.push_back(row);
        }
      EXPECT_EQ(c.matrix.rows_with_column(property), expected);
    }
}



// Residuals over all ranks, which read each block once, and the rows alone.
TEST(NodeBlockMatrix, ResidualsAreThoseOfTheDenseMatrix)
{
  for (const NodeIndex n : {1u, 7u, 60u})
    {
      const RandomMatrix::Case c = RandomMatrix::make(n, 11 + n);
      Vector                   x, y;
      const NodePartition     &nodes = c.matrix.partition();
      Eigen::VectorXd          dense_x(3 * n);
      nodes.reinit(x);
      nodes.reinit(y);
      for (unsigned int i = 0; i < 3 * n; ++i)
        dense_x[i] = std::sin(1. + 7. * i);
      for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
        {
          x.local_element(i) = dense_x[3 * nodes.first_owned() + i];
          y.local_element(i) = 1.;
        }
      Vector residual;
      nodes.reinit(residual);
      c.matrix.symmetric_residual(residual, x, y);
      c.matrix.subtract_product(y, x);
      const Eigen::VectorXd expected = Eigen::VectorXd::Ones(3 * n) - c.dense * dense_x;
      for (unsigned int i = 0; i < 3 * nodes.n_owned(); ++i)
        {
          EXPECT_NEAR(y.local_element(i), expected[3 * nodes.first_owned() + i], 1e-12);
          EXPECT_EQ(residual.local_element(i), y.local_element(i));
        }
      for (unsigned int row = 0; row < c.matrix.n_rows(); ++row)
        {
          double product[3];
          c.matrix.multiply_row(product, row, x);
          for (unsigned int d = 0; d < 3; ++d)
            EXPECT_NEAR(1. - product[d], expected[3 * (nodes.first_owned() + row) + d], 1e-12);
        }
    }
}



// Half of what is above the diagonal would be lost.
TEST(NodeBlockMatrix, RefusesAStructureWithOneSide)
{
  if (RandomMatrix::n_ranks() > 1)
    GTEST_SKIP() << "on one rank";
  NodePattern pattern;
  pattern.columns   = {0, 1, 1};
  pattern.row_start = {0, 2, 3};
  NodeBlockMatrix matrix;
  EXPECT_THROW(matrix.reinit(dealii::complete_index_set(2), pattern, dealii::IndexSet(2), MPI_COMM_WORLD),
               dealii::ExceptionBase);
}
