// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Several contact pairs: nodes in two of them, chains and cycles (doc/algorithm.md, chapter 3).

#include "flat_surfaces.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/pair_conflicts.h>

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

  /// Nodes are numbered that way.
  unsigned int body_of(const ContactSurface &surface)
  {
    return static_cast<unsigned int>(surface.vertex_node[0] / 1000);
  }

  /// @param has_one_body whether all mortar sides belong to one body
  /// @param part whether their bodies do not stay where they meet
  std::vector<PairCoupling> couple_together(const std::vector<Pair> &pairs, const DroppingRule &rule = {},
                                            const SharedRowRule     &shared_rule = {},
                                            const std::vector<bool> &is_tied     = {},
                                            const bool has_one_body = true, const bool part = false)
  {
    std::vector<SurfaceHalo> halos;
    for (const Pair &pair : pairs)
      halos.emplace_back(pair.non, MPI_COMM_SELF);
    std::vector<PairToCouple> several;
    // Along x: nodes are as open to the one as to the other.
    const std::vector<PartingPair> second(part ? 1 : 0, PartingPair{1, Vector3({1., 0., 0.})});
    for (std::size_t p = 0; p < pairs.size(); ++p)
      several.push_back({{pairs[p].non, pairs[p].mor, halos[p]},
                         pairs[p].moments,
                         false,
                         p < is_tied.size() && is_tied[p],
                         body_of(pairs[p].non),
                         has_one_body ? 1 : body_of(pairs[p].mor),
                         p == 0 ? second : std::vector<PartingPair>()});
    return couple_pairs(several, MPI_COMM_SELF, rule, shared_rule);
  }

  /// Each as if it were alone.
  std::vector<PairCoupling> couple_apart(const std::vector<Pair> &pairs)
  {
    std::vector<PairCoupling> couplings;
    for (const Pair &pair : pairs)
      couplings.push_back(couple(pair.non, pair.mor, pair.moments, {}, false));
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

  /// Both in one; they have no nodes in common.
  ContactSurface both(ContactSurface a, const ContactSurface &b)
  {
    const auto moved = [n = static_cast<unsigned int>(a.mesh.vertices.size())](auto corners) {
      for (unsigned int &v : corners)
        v += n;
      return corners;
    };
    const auto n_faces = static_cast<unsigned int>(a.faces.size());
    const auto append  = [](auto &list, const auto &other) {
      list.insert(list.end(), other.begin(), other.end());
    };
    append(a.mesh.vertices, b.mesh.vertices);
    append(a.mesh.vertex_normals, b.mesh.vertex_normals);
    append(a.vertex_node, b.vertex_node);
    append(a.vertex_fixed, b.vertex_fixed);
    append(a.hanging, b.hanging);
    for (const auto &triangle : b.mesh.triangles)
      a.mesh.triangles.push_back(moved(triangle));
    for (const unsigned int face : b.triangle_face)
      a.triangle_face.push_back(face + n_faces);
    for (ContactSurface::Face face : b.faces)
      {
        face.corners = moved(face.corners);
        a.faces.push_back(face);
      }
    return a;
  }

  /// A surface under two bodies, which meet at x = `border`.
  std::vector<Pair> under_two_bodies(const unsigned int nx, const double border)
  {
    const auto lower = surface({nx, 3, 0., 2.}, 0, true);
    return {Pair(lower, surface({2, 4, 0., border}, 1000, false)),
            Pair(lower, surface({4, 2, border, 2.}, 2000, false))};
  }

  /// By node.
  std::map<NodeIndex, Point<3>> positions(const std::vector<Pair> &pairs)
  {
    std::map<NodeIndex, Point<3>> result;
    for (const Pair &pair : pairs)
      for (const ContactSurface *const side : {&pair.non, &pair.mor})
        for (unsigned int v = 0; v < side->vertex_node.size(); ++v)
          result[side->vertex_node[v]] = side->mesh.vertices[v];
    return result;
  }

  /// Number of rows that are in the couplings of both of two pairs.
  std::size_t n_shared(const std::vector<PairCoupling> &couplings)
  {
    std::size_t n = 0;
    for (const NodeIndex node : couplings[0].coupling.rows)
      n += couplings[1].coupling.find(node) >= 0;
    return n;
  }
} // namespace

// Where the bodies meet between faces the two pairs are one with both bodies on its mortar side.
TEST(PairConflicts, SharedRowsAreThoseOfOnePair)
{
  const auto pairs     = under_two_bodies(6, 1.);
  const auto couplings = couple_together(pairs);
  EXPECT_EQ(n_shared(couplings), 4u);
  const auto  all    = join_couplings(couplings, {"left", "right"}, all_nodes());
  const auto &joined = all.coupling;
  const Pair  one(pairs[0].non, both(pairs[0].mor, pairs[1].mor));
  const auto  oracle = couple(one.non, one.mor, one.moments, {}, false);
  ASSERT_EQ(joined.rows, oracle.coupling.rows);
  for (std::size_t row = 0; row < joined.n_rows(); ++row)
    {
      EXPECT_NEAR(joined.weight[row], oracle.coupling.weight[row], 1e-14);
      EXPECT_NEAR(all.gaps[row], oracle.gaps[row], 1e-14);
      EXPECT_LT((all.normals[row] - oracle.normals[row]).norm(), 1e-14);
      std::map<NodeIndex, double> difference;
      for (const auto *entry = joined.begin(row); entry != joined.end(row); ++entry)
        difference[entry->node] += entry->weight;
      for (const auto *entry = oracle.coupling.begin(row); entry != oracle.coupling.end(row); ++entry)
        difference[entry->node] -= entry->weight;
      for (const auto &[node, value] : difference)
        EXPECT_NEAR(value, 0., 1e-13) << node;
    }
}

// Where they meet within faces, even so that one of the bodies covers a thin strip of them: linear
// displacements pass, a constant pressure gives the exact forces on all three bodies.
TEST(PairConflicts, SharedRowsPassPatchTests)
{
  for (const double border : {.9, 1.03, 1.19, 1.1999})
    {
      const auto pairs     = under_two_bodies(5, border);
      const auto couplings = couple_together(pairs);
      // The strip is thinner than what a row is dropped for; both columns of nodes around the border.
      EXPECT_EQ(n_shared(couplings), 8u) << border;
      const auto joined = join_couplings(couplings, {"left", "right"}, all_nodes()).coupling;
      const auto x      = positions(pairs);
      EXPECT_EQ(joined.n_rows(), pairs[0].non.vertex_node.size());
      for (std::size_t row = 0; row < joined.n_rows(); ++row)
        {
          Vector3 rest = x.at(joined.rows[row]) - Point<3>();
          double  sum = 1., size = 0.;
          for (const auto *entry = joined.begin(row); entry != joined.end(row); ++entry)
            {
              rest -= entry->weight * (x.at(entry->node) - Point<3>());
              sum -= entry->weight;
              size += std::abs(entry->weight);
            }
          EXPECT_NEAR(sum, 0., 1e-12) << border;
          EXPECT_LT(rest.norm(), 1e-11) << border;
          EXPECT_LE(size, DroppingRule().largest_row_sum) << border;
        }
      std::map<NodeIndex, double> forces, loads;
      for (std::size_t p = 0; p < 2; ++p)
        {
          const auto sides =
              compute_contact_forces(pairs[p].non, pairs[p].mor, couplings[p], couplings[p].normals);
          for (const auto &f : sides.nonmortar.nodes)
            forces[f.node] -= f.force[2];
          for (const auto &f : sides.mortar.nodes)
            forces[f.node] += f.force[2];
          for (const auto &[node, load] : covered_loads(pairs[p].non, pairs[p].mor))
            loads[node] += load;
        }
      for (const auto &[node, load] : loads)
        EXPECT_NEAR(forces[node], load, 1e-13) << border;
    }
}

// Surfaces that look different ways, or of which one is tied: both pairs lose the node, and still pass a
// constant pressure on.
TEST(PairConflicts, NodesOnEdgesLoseTheirMultiplier)
{
  for (const bool by_tie : {true, false})
    {
      auto pairs = under_two_bodies(6, 1.);
      if (!by_tie)
        {
          // The right half goes up.
          for (Pair &pair : pairs)
            for (ContactSurface *const side : {&pair.non, &pair.mor})
              for (Point<3> &x : side->mesh.vertices)
                x[2] += 3. * std::max(x[0] - 1., 0.);
          pairs = {Pair(pairs[0].non, pairs[0].mor), Pair(pairs[1].non, pairs[1].mor)};
        }
      const auto  couplings = couple_together(pairs, {}, {}, {by_tie, false});
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
          if (!by_tie)
            continue;
          // The shared nodes still take their part of the force.
          const auto forces =
              compute_contact_forces(pairs[p].non, pairs[p].mor, couplings[p], couplings[p].normals);
          auto loads = covered_loads(pairs[p].non, pairs[p].mor);
          EXPECT_EQ(forces.nonmortar.nodes.size(), 16u);
          for (const auto &f : forces.nonmortar.nodes)
            EXPECT_NEAR(-f.force[2], loads[f.node], 1e-14);
          for (const auto &f : forces.mortar.nodes)
            EXPECT_NEAR(f.force[2], loads[f.node], 1e-14);
        }
    }
  // Less than 60 degrees is no edge; another rule may see one.
  auto pairs = under_two_bodies(6, 1.);
  for (Point<3> &x : pairs[1].non.mesh.vertices)
    x[2] += .5 * std::max(x[0] - 1., 0.);
  EXPECT_EQ(n_shared(couple_together(pairs)), 4u);
  // But no seam that two bodies share.
  EXPECT_EQ(n_shared(couple_together(pairs, {}, {}, {}, false)), 0u);
  EXPECT_EQ(join_couplings(couple_together(pairs, {}, SharedRowRule{.95}), {}, all_nodes()).coupling.n_rows(),
            24u);
}

// Different mortar bodies beside each other share nodes as one body would: linear displacements pass, and one
// pressure holds all nodes, of the mortar sides too.
TEST(PairConflicts, NodesThatTwoBodiesCarry)
{
  for (const bool within_faces : {false, true})
    {
      const auto pairs     = within_faces ? under_two_bodies(5, 1.03) : under_two_bodies(6, 1.);
      const auto couplings = couple_together(pairs, {}, {}, {}, false);
      EXPECT_EQ(n_shared(couplings), within_faces ? 8u : 4u);
      const auto x      = positions(pairs);
      const auto joined = join_couplings(couplings, {"left", "right"}, all_nodes());
      EXPECT_EQ(joined.coupling.n_rows(), within_faces ? 24u : 28u);
      for (std::size_t row = 0; row < joined.coupling.n_rows(); ++row)
        {
          Vector3 rest = x.at(joined.coupling.rows[row]) - Point<3>();
          for (const auto *entry = joined.coupling.begin(row); entry != joined.coupling.end(row); ++entry)
            rest -= entry->weight * (x.at(entry->node) - Point<3>());
          EXPECT_LT(rest.norm(), 1e-12);
        }
      std::map<NodeIndex, double> rest;
      for (std::size_t p = 0; p < 2; ++p)
        {
          const auto forces =
              compute_contact_forces(pairs[p].non, pairs[p].mor, couplings[p], couplings[p].normals);
          for (const auto &f : forces.nonmortar.nodes)
            rest[f.node] -= f.force[2];
          for (const auto &f : forces.mortar.nodes)
            rest[f.node] += f.force[2];
          for (const auto &[node, load] : covered_loads(pairs[p].non, pairs[p].mor))
            rest[node] -= load;
        }
      for (const auto &[node, force] : rest)
        EXPECT_NEAR(force, 0., 1e-14) << node;
    }
}

// If they part, the pair that covers more around a node has it, or the first one. In the other one it is no
// column, and linear displacements pass.
TEST(PairConflicts, NodesBelongToOneOfTwoBodies)
{
  for (const bool within_faces : {false, true})
    {
      const auto pairs     = within_faces ? under_two_bodies(5, 1.03) : under_two_bodies(6, 1.);
      const auto couplings = couple_together(pairs, {}, {}, {}, false, true);
      EXPECT_EQ(n_shared(couplings), 0u);
      for (const PairCoupling &pair : couplings)
        {
          EXPECT_TRUE(pair.r_nodes.empty());
          for (const auto &node : pair.dropped)
            EXPECT_EQ(node.reason, DroppedNode::other_pair);
        }
      const auto x      = positions(pairs);
      const auto joined = join_couplings(couplings, {"left", "right"}, all_nodes());
      EXPECT_EQ(joined.coupling.n_rows(), within_faces ? 24u : 28u);
      for (std::size_t row = 0; row < joined.coupling.n_rows(); ++row)
        {
          const Point<3> &place = x.at(joined.coupling.rows[row]);
          Vector3         rest  = place - Point<3>();
          double          sum   = 1.;
          for (const auto *entry = joined.coupling.begin(row); entry != joined.coupling.end(row); ++entry)
            {
              rest -= entry->weight * (x.at(entry->node) - Point<3>());
              sum -= entry->weight;
            }
          EXPECT_NEAR(sum, 0., 1e-12);
          EXPECT_LT(rest.norm(), 1e-12);
          EXPECT_NEAR(joined.gaps[row], 0., 1e-12);
          EXPECT_EQ(joined.pairs[row], place[0] < 1.01 ? 0u : 1u);
        }
      // One pressure holds all nodes of the nonmortar side.
      std::map<NodeIndex, double> rest;
      for (std::size_t p = 0; p < 2; ++p)
        {
          const auto forces =
              compute_contact_forces(pairs[p].non, pairs[p].mor, couplings[p], couplings[p].normals);
          EXPECT_NEAR(forces.nonmortar.force[2] + forces.mortar.force[2], 0., 1e-14);
          for (const auto &f : forces.nonmortar.nodes)
            rest[f.node] -= f.force[2];
          for (const auto &[node, load] : covered_loads(pairs[p].non, pairs[p].mor))
            if (node < 1000)
              rest[node] -= load;
        }
      for (const auto &[node, force] : rest)
        EXPECT_NEAR(force, 0., 1e-14) << node;
    }
}

// A pair cedes a node to another one, which cannot have it: it is a column then. Tied to two bodies there is
// no reason to cede any.
TEST(PairConflicts, NodesThatTheirPairCannotHave)
{
  auto pairs = under_two_bodies(5, 1.03);
  fix(
      pairs[0].non, [](const Point<3> &x) { return std::abs(x[0] - .8) < 1e-9 && x[1] == 0.; }, FixedMask(4));
  for (const bool is_tied : {false, true})
    {
      const auto couplings = couple_together(pairs, {}, {}, {is_tied, is_tied}, false, true);
      EXPECT_EQ(n_shared(couplings), 0u);
      EXPECT_EQ(join_couplings(couplings, {}, all_nodes()).coupling.n_rows(), is_tied ? 16u : 23u);
      EXPECT_EQ(couplings[1].r_nodes.size(), is_tied ? 4u : 1u);
    }
}

// The same pair twice, or overlapping ones with the same mortar body: nodes of what is covered twice are rows
// in none.
TEST(PairConflicts, FacesCoveredTwice)
{
  const auto lower = surface({6, 3, 0., 2.}, 0, true);
  const Pair left(lower, surface({2, 4, 0., 1.}, 1000, false)),
      other_left(lower, surface({2, 4, 0., 1.}, 2000, false)),
      wide(lower, surface({4, 4, 0., 1.5}, 2000, false));
  const auto n_rows = [](const std::vector<Pair> &pairs, const bool has_one_body) {
    return join_couplings(couple_together(pairs, {}, {}, {}, has_one_body), {}, all_nodes())
        .coupling.n_rows();
  };
  EXPECT_EQ(n_rows({left, left}, true), 0u);
  EXPECT_EQ(n_rows({left, other_left}, false), 16u);
  // One body behind the other one is not beside it.
  EXPECT_EQ(n_shared(couple_together({left, other_left}, {}, {}, {}, false)), 0u);
  // Of seven columns four are lost; the next one is the wide pair's, the one after it thinly covered.
  EXPECT_EQ(n_rows({left, wide}, true), 4u);
  EXPECT_EQ(n_rows({left, wide}, false), 20u);
}

// Beside a hanging vertex the pair that cedes a node needs it as a column: then none has it.
TEST(PairConflicts, CededNodesBesideHangingOnes)
{
  const auto lower = surface({6, 3, 0., 2., 0., 1., {{3, 1}}}, 0, true);
  const auto pairs = {Pair(lower, surface({2, 4, 0., 1.}, 1000, false)),
                      Pair(lower, surface({4, 2, 1., 2.}, 2000, false))};
  // Both ends of the edge with the hanging vertex, of the four nodes between the bodies.
  for (const bool has_one_body : {true, false})
    {
      const auto couplings = couple_together(pairs, {}, {}, {}, has_one_body, !has_one_body);
      EXPECT_EQ(n_shared(couplings), has_one_body ? 4u : 0u);
      EXPECT_EQ(join_couplings(couplings, {}, all_nodes()).coupling.n_rows(), has_one_body ? 29u : 27u);
    }
}

// One that cannot be a row in one of the pairs is one in none. So far that is where its normal is fixed in
// one only.
TEST(PairConflicts, RowsThatOnePairCannotHave)
{
  auto pairs = under_two_bodies(6, 1.);
  fix(
      pairs[0].non, [](const Point<3> &x) { return x[0] == 1. && x[1] == 0.; }, FixedMask(4));
  const auto couplings = couple_together(pairs);
  EXPECT_EQ(n_shared(couplings), 3u);
  EXPECT_EQ(join_couplings(couplings, {}, all_nodes()).coupling.n_rows(), 27u);
}

TEST(PairConflicts, RowsOfOppositeSurfacesAreAnError)
{
  auto pairs = under_two_bodies(6, 1.);
  for (auto &normal : pairs[1].non.mesh.vertex_normals)
    normal *= -1.;
  try
    {
      join_couplings(couple_apart(pairs), {"left", "right"}, all_nodes());
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
  const auto couplings = couple_apart({Pair(below, above), Pair(above, below)});
  try
    {
      join_couplings(couplings, {"up", "down"}, all_nodes());
      FAIL();
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      EXPECT_NE(text.find("form a cycle"), std::string::npos) << text;
      EXPECT_NE(text.find("\"up\""), std::string::npos) << text;
      EXPECT_NE(text.find("\"down\""), std::string::npos) << text;
    }
}

// A plate between two blocks, nonmortar above and mortar below: no conflict, both pairs keep all rows. Nodes
// that belong to both of its sides (none here) would be excluded.
TEST(PairConflicts, ChainOfBodiesWithoutCommonNodes)
{
  const auto couplings = couple_together({Pair(surface({3, 3}, 0, true), surface({2, 2}, 100, false)),
                                          Pair(surface({4, 4}, 200, true), surface({3, 3}, 300, false))});
  EXPECT_EQ(join_couplings(couplings, {}, all_nodes()).coupling.n_rows(), 16u + 25u);
}

// A chain: a node that is mortar in another pair keeps its multiplier. T = I + S + S² undoes I - S.
TEST(PairConflicts, MortarElsewhere)
{
  const std::vector<Pair> pairs = {
      Pair(surface({3, 3}, 0, true), surface({2, 2}, 1000, false)),
      Pair(surface({5, 5, .4, 1., .4, 1.}, 2000, false), surface({3, 3}, 0, true))};
  const auto couplings = couple_together(pairs, {}, {}, {}, false);
  const auto joined    = join_couplings(couplings, {"a", "b"}, all_nodes());
  EXPECT_EQ(couplings[0].coupling.n_rows(), 16u);
  EXPECT_EQ(couplings[1].coupling.n_rows(), 36u);
  ASSERT_TRUE(joined.chained);
  EXPECT_EQ(joined.chained->rows, joined.coupling.rows);
  const auto product = [](const InterfaceCoupling &coupling, const std::map<NodeIndex, double> &v) {
    std::map<NodeIndex, double> result;
    for (std::size_t row = 0; row < coupling.n_rows(); ++row)
      for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
        result[coupling.rows[row]] += entry->weight * v.at(entry->node);
    return result;
  };
  std::map<NodeIndex, double> v;
  for (const auto &[node, x] : positions(pairs))
    v[node] = std::sin(static_cast<double>(node)) + x[0];
  std::map<NodeIndex, double> u = v;
  for (const auto &[node, value] : product(*joined.chained, v))
    u[node] += value;
  std::map<NodeIndex, double> back = u;
  for (const auto &[node, value] : product(joined.coupling, u))
    back[node] -= value;
  double largest_link = 0.;
  for (const auto &[node, value] : product(*joined.chained, v))
    largest_link = std::max(largest_link, std::abs(value - product(joined.coupling, v)[node]));
  EXPECT_GT(largest_link, .1);
  for (const auto &[node, value] : v)
    EXPECT_NEAR(back[node], value, 1e-14);
}

// What a pair drops for a reason of its own is no node of another pair for that.
TEST(PairConflicts, ReasonsInChains)
{
  // The last column of `lower` but one is thinly covered.
  const auto lower     = surface({4, 4}, 0, true);
  const auto couplings = couple_together({Pair(lower, surface({2, 2, 0., .53}, 1000, false)),
                                          Pair(surface({5, 5, .4, 1., .4, 1.}, 2000, false), lower)},
                                         {}, {}, {}, false);
  EXPECT_EQ(couplings[0].dropped.size(), 5u);
  for (const DroppedNode &node : couplings[0].dropped)
    EXPECT_NE(node.reason, DroppedNode::other_pair);
}

// Three links: T = I + S + S² + S³.
TEST(PairConflicts, LongChains)
{
  const auto              first = surface({3, 3}, 1000, true), second = surface({4, 4}, 2000, true);
  const std::vector<Pair> pairs  = {Pair(first, surface({2, 2}, 0, false)), Pair(second, first),
                                    Pair(surface({5, 5}, 3000, false), second)};
  const auto              joined = join_couplings(couple_together(pairs, {}, {}, {}, false), {}, all_nodes());
  ASSERT_TRUE(joined.chained);
  EXPECT_EQ(joined.coupling.n_rows(), 16u + 25u + 36u);
  // All lead to the columns that are no rows, with what reproduces linear functions.
  const auto x = positions(pairs);
  for (std::size_t row = 0; row < joined.chained->n_rows(); ++row)
    {
      double  sum  = 0.;
      Vector3 rest = x.at(joined.chained->rows[row]) - Point<3>();
      for (const auto *entry = joined.chained->begin(row); entry != joined.chained->end(row); ++entry)
        if (entry->node < 1000)
          {
            sum += entry->weight;
            rest -= entry->weight * (x.at(entry->node) - Point<3>());
          }
      EXPECT_NEAR(sum, 1., 1e-12);
      EXPECT_LT(rest.norm(), 1e-12);
    }
}

// Where the pairs are a cycle, the node is tied, or has prescribed components, it is a row in none.
TEST(PairConflicts, MortarElsewhereWithoutChain)
{
  // 9 of the 16 nodes of `lower` are corners of faces under `third`.
  const auto n_rows = [](const ContactSurface &lower, const NodeIndex third, const bool is_tied) {
    const auto couplings = couple_together({Pair(lower, surface({2, 2}, 1000, false)),
                                            Pair(surface({5, 5, .4, 1., .4, 1.}, third, false), lower)},
                                           {}, {}, {is_tied, false}, false);
    const auto joined    = join_couplings(couplings, {"a", "b"}, all_nodes());
    EXPECT_EQ(couplings[1].coupling.n_rows(), 36u);
    return couplings[0].coupling.n_rows();
  };
  auto lower = surface({3, 3}, 0, true);
  EXPECT_EQ(n_rows(lower, 2000, false), 16u);
  EXPECT_EQ(n_rows(lower, 2000, true), 7u);
  EXPECT_EQ(n_rows(lower, 1500, false), 7u);
  fix(
      lower, [](const Point<3> &x) { return x[0] == 1.; }, FixedMask(1));
  EXPECT_EQ(n_rows(lower, 2000, false), 13u);
}

// Chains in such nodes are an error where nobody has looked at all pairs at once.
TEST(PairConflicts, ChainsInFixedNodesAreAnError)
{
  auto lower = surface({3, 3}, 0, true);
  fix(
      lower, [](const Point<3> &x) { return x[0] == 1.; }, FixedMask(1));
  const auto couplings = couple_apart(
      {Pair(lower, surface({2, 2}, 1000, false)), Pair(surface({5, 5, .4, 1., .4, 1.}, 2000, false), lower)});
  try
    {
      join_couplings(couplings, {"up", "down"}, all_nodes());
      FAIL();
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("a chain in a node with prescribed displacements"),
                std::string::npos)
          << error.what();
    }
}
