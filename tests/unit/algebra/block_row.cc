// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_storage.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace Signorini;

namespace
{
  /// Blocks anywhere that are in memory transposed.
  void test_mirrored(const BlockStorage &storage, const std::vector<double> &blocks,
                     const std::vector<unsigned int> &columns, const std::size_t n,
                     const std::vector<double> &x)
  {
    std::vector<unsigned int> positions;
    for (std::size_t m = 0; m < n; ++m)
      positions.push_back(29 - 3 * m);
    const MirroredBlocks row{storage.numbers(), positions.data(), columns.data() + 21, n};
    const double         change[3] = {.3, -.2, .5};
    double               sums[3], expected[3] = {};
    std::vector<double>  values = x, changed = x;
    multiply_mirrored_blocks(sums, row, x.data());
    subtract_mirrored_blocks(values.data(), row, change);
    for (std::size_t m = 0; m < n; ++m)
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          {
            const double *const a = blocks.data() + 9 * positions[m];
            expected[c] += a[3 * d + c] * x[3 * row.columns[m] + d];
            changed[3 * row.columns[m] + c] -= a[3 * c + d] * change[d];
          }
    for (unsigned int c = 0; c < 3; ++c)
      EXPECT_NEAR(sums[c], expected[c], 1e-14) << n << " blocks";
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(values[i], changed[i], 1e-14) << n << " blocks";
  }
} // namespace

// The kernels, vectorized and plain, against the definition: rows of all lengths, empty ones too, and nothing
// written beside the nodes.
TEST(BlockRow, KernelsFollowTheirDefinition)
{
  constexpr unsigned int                 n_nodes = 40;
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(-1., 1.);
  std::vector<double>                    blocks(9 * 30 + 1), x(3 * n_nodes);
  std::vector<unsigned int>              columns;
  for (double &value : blocks)
    value = number(random);
  // What is read behind the last block must not matter.
  blocks.back() = std::numeric_limits<double>::quiet_NaN();
  for (double &value : x)
    value = number(random);
  // The last node is the first and the last column.
  for (unsigned int k = 0; k < 30; ++k)
    columns.push_back(k == 29 ? n_nodes - 1 : (7 * k + 39) % n_nodes);
  for (const auto &[vectorized, first_split] : std::vector<std::pair<bool, std::size_t>>{
           {true, 30}, {true, 15}, {true, 0}, {false, 30}, {false, 15}, {false, 0}})
    {
      use_avx2(vectorized);
      BlockStorage storage;
      storage.reinit(30);
      std::copy(blocks.begin(), blocks.end(), storage.exact(0));
      storage.split(first_split);
      EXPECT_EQ(storage.is_split(), first_split < 30);
      if (first_split != 15)
        for (std::size_t n = 0; n <= 9; ++n)
          test_mirrored(storage, blocks, columns, n, x);
      for (std::size_t n = 0; n <= 9; ++n)
        for (const bool backward : {false, true})
          {
            const BlockRange ranges[2] = {{1, 1 + n}, {30 - n, 30}};
            double           sums[6];
            (backward ? multiply_block_ranges_backward
                      : multiply_block_ranges)(sums, storage.numbers(), columns.data(), ranges, 2, x.data());
            for (unsigned int r = 0; r < 2; ++r)
              for (unsigned int c = 0; c < 3; ++c)
                {
                  double expected = 0.;
                  for (std::size_t k = ranges[r].begin; k < ranges[r].end; ++k)
                    for (unsigned int d = 0; d < 3; ++d)
                      expected += blocks[9 * k + 3 * c + d] * x[3 * columns[k] + d];
                  EXPECT_NEAR(sums[3 * r + c], expected, 1e-14) << n << " blocks";
                }
            const double        change[3] = {.3, -.2, .5};
            std::vector<double> values = x, expected = x;
            subtract_transposed_blocks(values.data(), storage.numbers(), columns.data(), ranges[1], change);
            // Of a row whose node is no column.
            std::vector<double> x_with_row = x, both = x;
            for (unsigned int c = 0; c < 3; ++c)
              {
                x_with_row.push_back(change[c]);
                both.push_back(0.);
              }
            subtract_both_ways(both.data(), n_nodes, storage.numbers(), columns.data(), ranges[1],
                               x_with_row.data());
            for (unsigned int c = 0; c < 3; ++c)
              EXPECT_NEAR(both[3 * n_nodes + c], -sums[3 + c], 1e-14) << n << " blocks";
            for (std::size_t k = ranges[1].begin; k < ranges[1].end; ++k)
              for (unsigned int c = 0; c < 3; ++c)
                for (unsigned int d = 0; d < 3; ++d)
                  expected[3 * columns[k] + d] -= blocks[9 * k + 3 * c + d] * change[c];
            for (std::size_t i = 0; i < values.size(); ++i)
              {
                EXPECT_NEAR(values[i], expected[i], 1e-14) << n << " blocks";
                EXPECT_NEAR(both[i], expected[i], 1e-14) << n << " blocks";
              }
          }
    }
  use_avx2(true);
}

// Numbers of all sizes that single precision has, in copies too, and as they were where they are not split.
TEST(BlockStorage, SplitsNumbersAndPutsThemTogether)
{
  std::mt19937                           random(2);
  std::uniform_real_distribution<double> number(-1., 1.), exponent(-20., 20.);
  constexpr std::size_t                  n_blocks = 20000, first = 7000;
  std::vector<double>                    numbers;
  BlockStorage                           storage;
  storage.reinit(n_blocks);
  for (std::size_t i = 0; i < 9 * n_blocks; ++i)
    {
      EXPECT_EQ(storage.exact(0)[i], 0.);
      numbers.push_back(i % 100 == 0   ? 0.
                        : i % 100 == 1 ? 1e-60
                                       : number(random) * std::pow(10., exponent(random)));
    }
  std::copy(numbers.begin(), numbers.end(), storage.exact(0));
  storage.split(first);
  EXPECT_EQ(storage.n_bytes(), (9 * n_blocks + 1) * sizeof(double) + 2 * 8 * sizeof(float));
  BlockStorage copy = storage, joined;
  joined            = storage;
  storage.reinit(1);
  joined.join();
  EXPECT_TRUE(copy.is_split());
  EXPECT_FALSE(joined.is_split());
  for (std::size_t k = 0; k < n_blocks; ++k)
    {
      double here[9];
      copy.numbers().read(here, k);
      for (unsigned int c = 0; c < 9; ++c)
        {
          const double exact = numbers[9 * k + c];
          EXPECT_LE(std::abs(here[c] - exact), k < first || std::abs(exact) > 2e-38 ? 0. : std::abs(exact));
          EXPECT_EQ(joined.exact(k)[c], here[c]);
        }
      EXPECT_EQ(copy.numbers().trace(k), here[0] + here[4] + here[8]);
    }
}
