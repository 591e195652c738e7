// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "random_matrix.h"

#include <signorini/algebra/replicated_data.h>

#include <gtest/gtest.h>

using namespace Signorini;

namespace
{
  constexpr NodeIndex n = 20;

  /// Every rank knows its own nodes and the two behind them.
  NodePartition partition()
  {
    const auto       owned = RandomMatrix::owned_nodes(n);
    dealii::IndexSet ghosts(n);
    for (const NodeIndex i : owned)
      for (const NodeIndex j : {i + 1, i + 2})
        ghosts.add_index(j % n);
    return NodePartition(owned, ghosts, MPI_COMM_WORLD);
  }
} // namespace

TEST(NodePartition, NumbersOwnedNodesFirst)
{
  const NodePartition nodes = partition();
  EXPECT_EQ(nodes.n_global(), n);
  for (unsigned int i = 0; i < nodes.n_local(); ++i)
    {
      EXPECT_EQ(nodes.to_local(nodes.to_global(i)), i);
      EXPECT_EQ(nodes.owns(nodes.to_global(i)), i < nodes.n_owned());
      EXPECT_EQ(nodes.owner(nodes.to_global(i)) == RandomMatrix::this_rank(), i < nodes.n_owned());
    }
}

namespace
{
  /// Axes of coordinates at most nodes, oblique directions at every ninth.
  FixedDirections fixed_at(const NodeIndex p)
  {
    if (p % 9 != 0)
      return static_cast<FixedMask>(p % 8);
    const Vector3 a = dealii::Point<3>(1., 2., 3. + p), b = dealii::Point<3>(-1., 0., .1 * p);
    return p % 2 == 0 ? FixedDirections::span({a / a.norm()})
                      : FixedDirections::span({a / a.norm(), b / b.norm()});
  }
} // namespace

TEST(ReplicatedData, ComesFromTheOwner)
{
  const NodePartition          nodes = partition();
  Vector                       field;
  NodeRows                     rows;
  std::vector<FixedDirections> masks;
  nodes.reinit(field);
  for (unsigned int i = 0; i < nodes.n_owned(); ++i)
    {
      const NodeIndex p = nodes.to_global(i);
      for (unsigned int c = 0; c < 3; ++c)
        field.local_element(3 * i + c) = 10. * p + c;
      for (NodeIndex k = 0; k < p % 4; ++k)
        rows.add((p + k) % n, 1. / (1. + p + k));
      rows.finish_row();
      masks.push_back(fixed_at(p));
    }
  const std::vector<NodeIndex> asked    = {0, 3, 4, 11, 19};
  const auto                   values   = replicate_values(nodes, field, asked);
  const auto                   of_nodes = replicate_rows(nodes, rows, asked);
  const auto                   fixed    = replicate_masks(nodes, masks, asked);
  ASSERT_EQ(values.size(), asked.size());
  ASSERT_EQ(of_nodes.n_rows(), asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i)
    {
      const NodeIndex p = asked[i];
      for (unsigned int c = 0; c < 3; ++c)
        EXPECT_EQ(values[i][c], 10. * p + c);
      EXPECT_EQ(fixed[i], fixed_at(p));
      ASSERT_EQ(of_nodes.start[i + 1] - of_nodes.start[i], p % 4);
      for (NodeIndex k = 0; k < p % 4; ++k)
        {
          EXPECT_EQ(of_nodes.columns[of_nodes.start[i] + k], (p + k) % n);
          EXPECT_EQ(of_nodes.weights[of_nodes.start[i] + k], 1. / (1. + p + k));
        }
    }

  const auto local_rows  = import_ghost_rows(nodes, rows);
  const auto local_masks = import_ghost_masks(nodes, masks);
  ASSERT_EQ(local_rows.n_rows(), nodes.n_local());
  for (unsigned int i = 0; i < nodes.n_local(); ++i)
    {
      EXPECT_EQ(local_masks[i], fixed_at(nodes.to_global(i)));
      EXPECT_EQ(local_rows.start[i + 1] - local_rows.start[i], nodes.to_global(i) % 4);
    }
}
