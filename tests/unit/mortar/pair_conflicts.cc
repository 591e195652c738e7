// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Several contact pairs: nodes in two of them, chains and cycles (doc/algorithm.md, chapter 3).

#include "flat_surfaces.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mortar/contact_forces.h>

#include <gtest/gtest.h>

namespace
{
  using namespace FlatSurfaces;

  struct Pair
  {
    ContactSurface           non, mor;
    std::vector<FaceMoments> moments;

    Pair(const ContactSurface &nonmortar, const ContactSurface &mortar)
      : non(nonmortar)
      , mor(mortar)
      , moments(compute_face_moments(non, mor, make_overlay(non, mor), {}, MPI_COMM_SELF))
    {
    }
  };

  std::vector<PairCoupling> couple_all(const std::vector<Pair> &pairs, const bool exclude)
  {
    std::vector<std::set<NodeIndex>> nonmortar, mortar;
    for (const Pair &pair : pairs)
      {
        nonmortar.push_back(touched_nonmortar_nodes(pair.non, pair.moments));
        mortar.push_back(touched_mortar_nodes(pair.mor, pair.moments));
      }
    const auto                excluded = excluded_nodes(nonmortar, mortar, MPI_COMM_SELF);
    std::vector<PairCoupling> couplings;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      couplings.push_back(couple(pairs[p].non, pairs[p].mor, pairs[p].moments,
                                 exclude ? excluded[p] : std::set<NodeIndex>(), false));
    return couplings;
  }

  ContactSurface surface(Grid grid, const NodeIndex first_node, const bool faces_up)
  {
    grid.first_node = first_node;
    grid.faces_up   = faces_up;
    return make_surface(grid);
  }

  /// All on this rank.
  NodePartition all_nodes()
  {
    const dealii::IndexSet all = dealii::complete_index_set(10000);
    return NodePartition(all, all, MPI_COMM_SELF);
  }

  /// Two nonmortar surfaces of one body that share the nodes on x = 1.
  std::vector<Pair> neighbours()
  {
    const auto left  = surface({3, 3}, 0, true);
    auto       right = surface({3, 3, 1., 2.}, 100, true);
    for (unsigned int v = 0; v < right.vertex_node.size(); ++v)
      for (unsigned int w = 0; w < left.vertex_node.size(); ++w)
        if (right.mesh.vertices[v].distance(left.mesh.vertices[w]) < 1e-10)
          right.vertex_node[v] = left.vertex_node[w];
    return {Pair(left, surface({2, 4}, 1000, false)), Pair(right, surface({4, 2, 1., 2.}, 2000, false))};
  }
} // namespace

TEST(PairConflicts, SharedNodesLoseTheirMultiplier)
{
  const auto  pairs     = neighbours();
  const auto  couplings = couple_all(pairs, true);
  const auto  all       = join_couplings(couplings, {"left", "right"}, all_nodes());
  const auto &joined    = all.coupling;
  ASSERT_EQ(joined.n_rows(), 24u);
  for (std::size_t row = 0; row < joined.n_rows(); ++row)
    {
      const auto          &pair = couplings[all.pairs[row]];
      const std::ptrdiff_t i    = pair.coupling.find(joined.rows[row]);
      ASSERT_GE(i, 0);
      EXPECT_EQ(joined.weight[row], pair.coupling.weight[i]);
      EXPECT_EQ(all.gaps[row], pair.gaps[i]);
      EXPECT_EQ(joined.end(row) - joined.begin(row), pair.coupling.end(i) - pair.coupling.begin(i));
    }
  for (std::size_t p = 0; p < 2; ++p)
    {
      EXPECT_EQ(couplings[p].dropped.size(), 4u);
      for (const auto &node : couplings[p].dropped)
        EXPECT_EQ(node.reason, DroppedNode::other_pair);
      // The shared nodes still take their part of the force.
      const std::vector<Vector3> &traction = couplings[p].normals;
      const auto forces = compute_contact_forces(pairs[p].non, pairs[p].mor, couplings[p], traction);
      auto       loads  = covered_loads(pairs[p].non, pairs[p].mor);
      EXPECT_EQ(forces.nonmortar.nodes.size(), 16u);
      for (const auto &f : forces.nonmortar.nodes)
        EXPECT_NEAR(-f.force[2], loads[f.node], 1e-14);
      for (const auto &f : forces.mortar.nodes)
        EXPECT_NEAR(f.force[2], loads[f.node], 1e-14);
    }
}

TEST(PairConflicts, SharedRowsAreAnError)
{
  try
    {
      join_couplings(couple_all(neighbours(), false), {"left", "right"}, all_nodes());
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("\"left\""), std::string::npos) << text;
      EXPECT_NE(text.find("\"right\""), std::string::npos) << text;
    }
}

TEST(PairConflicts, CyclesAreAnError)
{
  const auto below = surface({3, 3}, 0, true), above = surface({2, 2}, 1000, false);
  const auto couplings = couple_all({Pair(below, above), Pair(above, below)}, false);
  try
    {
      join_couplings(couplings, {"up", "down"}, all_nodes());
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("\"up\""), std::string::npos) << text;
      EXPECT_NE(text.find("\"down\""), std::string::npos) << text;
    }
}

// A plate between two blocks, nonmortar above and mortar below: no conflict, both pairs keep all rows. Nodes
// that belong to both of its sides (none here) would be excluded.
TEST(PairConflicts, ChainOfBodiesWithoutCommonNodes)
{
  const auto couplings = couple_all({Pair(surface({3, 3}, 0, true), surface({2, 2}, 100, false)),
                                     Pair(surface({4, 4}, 200, true), surface({3, 3}, 300, false))},
                                    true);
  EXPECT_EQ(join_couplings(couplings, {}, all_nodes()).coupling.n_rows(), 16u + 25u);
}

// A node that is mortar in another pair loses its multiplier.
TEST(PairConflicts, MortarElsewhere)
{
  const auto lower     = surface({3, 3}, 0, true);
  const auto upper     = surface({2, 2}, 1000, false);
  const auto third     = surface({5, 5, .4, 1., .4, 1.}, 2000, false);
  const auto couplings = couple_all({Pair(lower, upper), Pair(third, lower)}, true);
  join_couplings(couplings, {"a", "b"}, all_nodes());
  // 9 of the 16 nodes of `lower` are corners of faces under `third`.
  EXPECT_EQ(couplings[0].coupling.n_rows(), 7u);
  EXPECT_EQ(couplings[1].coupling.n_rows(), 36u);
}
