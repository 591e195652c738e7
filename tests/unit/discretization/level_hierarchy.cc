// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/level_hierarchy.h>

#include <gtest/gtest.h>

using namespace Signorini;



// Small weights go to the largest one of their row, whatever its sign; the other rows stay as they are.
TEST(DropSmallWeights, KeepsSumsOfRows)
{
  InterfaceCoupling coupling;
  coupling.rows      = {3, 5, 8, 9};
  coupling.weight    = {1., 2., 3., 4.};
  coupling.row_start = {0, 4, 4, 6, 7};
  coupling.entries   = {{20, .05}, {21, .9}, {22, -.06}, {23, .11}, {20, -1e-6}, {24, 9e-8}, {25, 1e-9}};

  drop_small_weights(coupling);
  EXPECT_EQ(coupling.rows, (std::vector<NodeIndex>{3, 5, 8, 9}));
  EXPECT_EQ(coupling.weight, (std::vector<double>{1., 2., 3., 4.}));
  ASSERT_EQ(coupling.row_start, (std::vector<std::size_t>{0, 2, 2, 3, 4}));
  const std::vector<InterfaceCoupling::Entry> expected = {{21, .89}, {23, .11}, {20, -.91e-6}, {25, 1e-9}};
  for (std::size_t k = 0; k < expected.size(); ++k)
    {
      EXPECT_EQ(coupling.entries[k].node, expected[k].node);
      EXPECT_NEAR(coupling.entries[k].weight, expected[k].weight, 1e-15 * std::abs(expected[k].weight));
    }
}
