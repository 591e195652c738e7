// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "random_matrix.h"

#include <signorini/algebra/rounded_sweep.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

using namespace Signorini;

namespace
{
  /// Rows of this rank that couple to owned nodes only, as a dense matrix times a factor, made dominant so
  /// that sweeps stay bounded.
  struct OwnedPart
  {
    OwnedPart(NodeBlockMatrix &matrix, const double factor)
      : dense(Eigen::MatrixXd::Zero(3 * matrix.n_rows(), 3 * matrix.n_rows()))
    {
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        {
          for (unsigned int c = 0; c < 3; ++c)
            matrix.block(matrix.diagonal(i))[4 * c] += 20.;
          for (const BlockRange &range : matrix.stored(i))
            for (std::size_t k = range.begin; k < range.end; ++k)
              for (unsigned int c = 0; c < 9; ++c)
                {
                  matrix.block(k)[c] *= factor;
                  if (const unsigned int j = matrix.column(k); j < matrix.n_rows())
                    dense(3 * i + c / 3, 3 * j + c % 3) = dense(3 * j + c % 3, 3 * i + c / 3) =
                        matrix.block(k)[c];
                }
          const Eigen::Matrix3d inverse = dense.block<3, 3>(3 * i, 3 * i).inverse();
          for (unsigned int c = 0; c < 9; ++c)
            inverse_diagonal.push_back(inverse(c / 3, c % 3));
        }
    }

    /// Row `half` takes half of its solution.
    void sweep(Eigen::VectorXd &v, const Eigen::VectorXd &rhs, const std::vector<unsigned int> &order,
               const bool backward, const Eigen::Index half) const
    {
      for (std::size_t k = 0; k < order.size(); ++k)
        {
          const Eigen::Index i = order[backward ? order.size() - 1 - k : k];
          v.segment<3>(3 * i) += dense.block<3, 3>(3 * i, 3 * i)
                                     .fullPivLu()
                                     .solve(rhs.segment<3>(3 * i) - dense.middleRows(3 * i, 3) * v);
          if (i == half)
            v.segment<3>(3 * i) *= .5;
        }
    }

    Eigen::MatrixXd     dense;
    std::vector<double> inverse_diagonal;
  };
} // namespace



// Against a dense Gauss-Seidel iteration in double precision: from zero and on, forward and backward, with
// the residual; rows of all lengths and in any order, in units at both ends of single precision.
TEST(RoundedSweep, FollowsGaussSeidel)
{
  for (const auto &[vectorized, factor, shuffled, is_split] :
       std::vector<std::tuple<bool, double, bool, bool>>{{true, 1., false, false},
                                                         {true, 1e-60, false, false},
                                                         {true, 1e60, true, false},
                                                         {true, 1., true, false},
                                                         {false, 1., false, false},
                                                         {false, 1e-60, true, false},
                                                         {false, 1e60, false, false},
                                                         {true, 1., false, true},
                                                         {true, 1., true, true},
                                                         {false, 1., false, true}})
    {
      use_avx2(vectorized);
      std::ostringstream text;
      text << (vectorized ? "vectorized, " : "plain, ") << factor << (shuffled ? ", shuffled" : "")
           << (is_split ? ", split" : "");
      SCOPED_TRACE(text.str());
      NodeBlockMatrix           matrix = RandomMatrix::make(43, 5).matrix;
      const OwnedPart           part(matrix, factor);
      std::vector<unsigned int> rows(matrix.n_rows());
      std::iota(rows.begin(), rows.end(), 0u);
      std::set<std::size_t> lengths;
      for (const unsigned int row : rows)
        lengths.insert(matrix.lower(row).size());
      for (std::size_t n = 0; n <= 5 && RandomMatrix::n_ranks() == 1; ++n)
        EXPECT_EQ(lengths.count(n), 1u);
      std::vector<unsigned int> order = rows;
      if (shuffled)
        std::shuffle(order.begin(), order.end(), std::mt19937(7));
      if (is_split)
        matrix.split();
      EXPECT_EQ(matrix.is_split(), is_split && RandomMatrix::n_ranks() == 1);
      RoundedSweep sweep(matrix, order);
      sweep.update(rows, part.inverse_diagonal.data());

      const double    load = 1e-40;
      Vector          v, rhs, residual;
      Eigen::VectorXd exact = Eigen::VectorXd::Zero(3 * matrix.n_rows()), exact_rhs = exact;
      for (Vector *vector : {&v, &rhs, &residual})
        matrix.partition().reinit(*vector);
      for (unsigned int i = 0; i < 3 * matrix.n_rows(); ++i)
        exact_rhs[i] = rhs.local_element(i) = factor * load * std::sin(1. + 7. * i);
      const auto expect = [&](const Eigen::VectorXd &expected, const Vector &actual, const double scale) {
        for (unsigned int i = 0; i < 3 * matrix.n_rows(); ++i)
          ASSERT_NEAR(actual.local_element(i), expected[i], 2e-6 * scale);
      };
      // One row is solved outside, with a right hand side that is not rounded.
      constexpr unsigned int apart = 5;
      double                 apart_residual[3];
      const auto             start = [&] {
        sweep.start(v, rhs);
        if (rows.size() > apart)
          sweep.leave_out_rhs(apart);
      };
      const auto relax_apart = [&](const RoundedSweep::Options &options) {
        Eigen::Map<Eigen::Vector3d> x(v.begin() + 3 * apart);
        const Eigen::Vector3d       old = x;
        Eigen::Vector3d             s(rhs.begin() + 3 * apart);
        sweep.subtract_product(s.data(), apart);
        const Eigen::Matrix3d block                    = part.dense.block<3, 3>(3 * apart, 3 * apart);
        x                                              = .5 * block.fullPivLu().solve(s);
        Eigen::Map<Eigen::Vector3d>(apart_residual, 3) = s - block * x;
        if (options.keeps_residual)
          sweep.leave_out_rhs(apart);
        const Eigen::Vector3d change = options.passes_all ? Eigen::Vector3d(x) : x - old;
        sweep.set(apart, x.data());
        sweep.pass_down(apart, change.data());
      };
      const auto relax = [&](const RoundedSweep::Options &options) {
        if (rows.size() <= apart)
          return sweep.relax(v, 0, rows.size(), options);
        const std::size_t place = std::find(order.begin(), order.end(), apart) - order.begin();
        const auto        below = [&] { sweep.relax(v, 0, place, options); };
        const auto        above = [&] { sweep.relax(v, place + 1, rows.size(), options); };
        options.backward ? above() : below();
        relax_apart(options);
        options.backward ? below() : above();
      };
      start();
      for (const bool is_last : {false, false, true})
        {
          relax({false, false, is_last});
          part.sweep(exact, exact_rhs, order, false, apart);
          expect(exact, v, .1 * load);
        }
      sweep.get_residual(residual);
      for (unsigned int c = 0; c < 3 && rows.size() > apart; ++c)
        residual.local_element(3 * apart + c) += apart_residual[c];
      expect(exact_rhs - part.dense * exact, residual, factor * load);

      // v changes at a node; the first sweep backward passes all on.
      if (matrix.n_rows() > 3)
        exact[10] = v.local_element(10) = load;
      start();
      for (const bool is_first : {true, false, false})
        {
          relax({true, is_first, false});
          part.sweep(exact, exact_rhs, order, true, apart);
          expect(exact, v, .1 * load);
          // Someone else changes v as well.
          if (matrix.n_rows() > 3)
            {
              const double change[3] = {.3 * load, -.2 * load, .1 * load};
              for (unsigned int c = 0; c < 3; ++c)
                exact[9 + c] = v.local_element(9 + c) += change[c];
              sweep.set(3, v.begin() + 9);
              sweep.pass_down(3, change);
            }
        }
    }
  use_avx2(true);
}



// A change of a ghost is what it does to the residual.
TEST(RoundedSweep, FollowsGhosts)
{
  NodeBlockMatrix           matrix = RandomMatrix::make(43, 5).matrix;
  const OwnedPart           part(matrix, 1.);
  std::vector<unsigned int> order(matrix.n_rows());
  std::iota(order.rbegin(), order.rend(), 0u);
  RoundedSweep sweep(matrix, order);
  sweep.update(order, part.inverse_diagonal.data());
  Vector v, rhs, product, residual;
  for (Vector *vector : {&v, &rhs, &product, &residual})
    matrix.partition().reinit(*vector);
  sweep.start(v, rhs);
  for (unsigned int i = 0; i < 3 * matrix.n_rows(); ++i)
    v.local_element(i) = std::sin(1. + 7. * (3 * matrix.partition().first_owned() + i));
  v.update_ghost_values();
  for (unsigned int ghost = 0; ghost < matrix.partition().ghosts().size(); ++ghost)
    sweep.pass_from_ghost(ghost, v.begin() + 3 * (matrix.n_rows() + ghost));
  sweep.get_residual(residual);
  for (unsigned int i = 0; i < 3 * matrix.n_rows(); ++i)
    v.local_element(i) = 0.;
  for (unsigned int row = 0; row < matrix.n_rows(); ++row)
    {
      double here[3];
      matrix.multiply_row(here, row, v);
      for (unsigned int c = 0; c < 3; ++c)
        EXPECT_NEAR(residual.local_element(3 * row + c), -here[c], 1e-5);
    }
}
