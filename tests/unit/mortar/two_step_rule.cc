// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The dual basis in two steps, face by face and then over hanging vertices (doc/algorithm.md, (13) to (16)):
// a constant pressure gives the exact nodal forces on both sides; translations and rotations are free of
// stress.

#include "flat_surfaces.h"

#include <signorini/mortar/contact_forces.h>

#include <gtest/gtest.h>

#include <limits>
#include <map>

namespace
{
  using namespace FlatSurfaces;

  constexpr double infinity = std::numeric_limits<double>::infinity();

  struct Case
  {
    ContactSurface          non, mor;
    std::set<NodeIndex>     excluded = {};
    DroppingRule            rule     = {};
    Signorini::PairCoupling coupling = {};

    void run()
    {
      const auto overlay = make_overlay(non, mor);
      loads              = covered_loads(non, mor);
      incline(non, scale);
      incline(mor, scale);
      const auto moments = compute_face_moments(non, mor, overlay, {}, MPI_COMM_SELF);
      coupling           = couple(non, mor, moments, {excluded, {}, {}}, false, rule);
    }

    /// Error of the nodal forces of a unit pressure relative to the largest force.
    double force_error() const
    {
      const auto                  forces = compute_contact_forces(non, mor, coupling, coupling.normals);
      std::map<NodeIndex, double> found;
      double                      error = 0., largest = 0.;
      const Vector3               normal = non.mesh.vertex_normals[0];
      for (const auto &f : forces.nonmortar.nodes)
        found[f.node] = -(f.force * normal);
      for (const auto &f : forces.mortar.nodes)
        found[f.node] = f.force * normal;
      for (const auto &[node, load] : loads)
        {
          error   = std::max(error, std::abs(found[node] - scale * scale * load));
          largest = std::max(largest, scale * scale * load);
        }
      EXPECT_LT((forces.nonmortar.force + forces.mortar.force).norm(), 1e-14 * forces.mortar.force.norm());
      EXPECT_LT((forces.nonmortar.moment + forces.mortar.moment).norm(),
                1e-13 * scale * forces.mortar.force.norm());
      return error / largest;
    }

    /// Largest relative displacement û over all rows for a linear displacement field of the size of the
    /// surface.
    double linear_error() const
    {
      std::map<NodeIndex, Point<3>> x;
      for (const ContactSurface *s : {&non, &mor})
        for (unsigned int v = 0; v < s->vertex_node.size(); ++v)
          x[s->vertex_node[v]] = s->mesh.vertices[v];
      double      error = 0.;
      const auto &c     = coupling.coupling;
      for (std::size_t row = 0; row < c.n_rows(); ++row)
        {
          Tensor<1, 3> relative = x[c.rows[row]];
          for (const auto *entry = c.begin(row); entry != c.end(row); ++entry)
            relative -= entry->weight * x[entry->node];
          error = std::max(error, relative.norm() / scale);
        }
      return error;
    }

    void check(const double tolerance, const int n_dropped = -1)
    {
      run();
      const auto &c = coupling.coupling;
      ASSERT_GT(c.n_rows(), 0u);
      EXPECT_TRUE(std::is_sorted(c.rows.begin(), c.rows.end()));
      for (std::size_t row = 0; row < c.n_rows(); ++row)
        {
          double sum = 0.;
          for (const auto *entry = c.begin(row); entry != c.end(row); ++entry)
            {
              sum += entry->weight;
              EXPECT_LT(c.find(entry->node), 0);
            }
          EXPECT_NEAR(sum, 1., 10. * tolerance);
          EXPECT_GT(c.weight[row], 0.);
          EXPECT_NEAR(coupling.gaps[row], 0., tolerance * scale);
        }
      EXPECT_LT(force_error(), tolerance);
      EXPECT_LT(linear_error(), 10. * tolerance);
      if (n_dropped >= 0)
        {
          EXPECT_EQ(coupling.dropped.size(), static_cast<std::size_t>(n_dropped));
        }
      EXPECT_EQ(coupling.lost_area, 0.);
    }

    double                      scale = 1.;
    std::map<NodeIndex, double> loads = {};
  };

  Grid mortar_grid(Grid grid)
  {
    grid.first_node = 1000;
    grid.faces_up   = false;
    return grid;
  }

  const DroppingRule keep_all = {0., infinity};
} // namespace

TEST(TwoStepRule, FullCoverHangingNonmortar)
{
  Case c = {make_surface({3, 3, 0., 1., 0., 1., {{1, 1}}}), make_surface(mortar_grid({4, 5}))};
  c.check(1e-13, 0);
  EXPECT_EQ(c.coupling.coupling.n_rows(), 17u);
}

TEST(TwoStepRule, HangingOnBothSides)
{
  Case c = {make_surface({4, 4, 0., 1., 0., 1., {{0, 1}, {1, 1}, {3, 3}}}),
            make_surface(mortar_grid({3, 5, 0., 1., 0., 1., {{1, 1}, {2, 4}}}))};
  c.check(1e-13, 0);
}

TEST(TwoStepRule, Strips)
{
  for (const double over : {.5, .1, .01})
    for (const bool keep : {true, false})
      {
        SCOPED_TRACE(over);
        Case c = {make_surface({4, 4}), make_surface(mortar_grid({5, 4, 0., (2. + over) / 4.}))};
        if (keep)
          c.rule = keep_all;
        // The far nodes' own function is covered by over^2/2, the near ones' by .5 + over - over^2/2.
        c.check(1e-13, keep ? 0 : 5);
      }
}

TEST(TwoStepRule, StripsInBothDirections)
{
  for (const bool keep : {true, false})
    {
      Case c = {make_surface({4, 4}), make_surface(mortar_grid({5, 4, 0., 2.3 / 4., 0., 2.3 / 4.}))};
      if (keep)
        c.rule = keep_all;
      c.check(1e-13, keep ? 0 : 7);
    }
}

TEST(TwoStepRule, RotatedMortar)
{
  for (const bool keep : {true, false})
    {
      Case c = {make_surface({4, 4, 0., 1., 0., 1., {{1, 1}, {2, 2}}}),
                make_surface(mortar_grid({5, 4, .2, .8, .2, .8, {}, 0., .4}))};
      if (keep)
        c.rule = keep_all;
      c.check(1e-13);
    }
}

TEST(TwoStepRule, FixedBorder)
{
  Case c = {make_surface({4, 4, 0., 1., 0., 1., {{0, 1}}}), make_surface(mortar_grid({5, 3}))};
  fix(c.non, [](const Point<3> &x) { return x[0] < 1e-12; });
  c.check(1e-13, 6);
  for (const auto &node : c.coupling.dropped)
    EXPECT_EQ(node.reason, DroppedNode::fixed);
}

TEST(TwoStepRule, FixedBorderAndExcludedNodeAndNormal)
{
  Case c = {make_surface({5, 5, 0., 1., 0., 1., {{0, 1}, {2, 2}}}),
            make_surface(mortar_grid({4, 3, 0., .93, 0., 1., {{1, 1}}}))};
  fix(c.non, [](const Point<3> &x) { return x[1] < 1e-12; });
  for (unsigned int v = 0; v < c.non.vertex_node.size(); ++v)
    {
      if (c.non.mesh.vertices[v].distance(Point<3>(.4, .8, 0.)) < 1e-10)
        c.excluded.insert(c.non.vertex_node[v]);
      if (c.non.mesh.vertices[v].distance(Point<3>(.8, .4, 0.)) < 1e-10)
        c.non.vertex_fixed[v] = 1;
    }
  // Of the inclined normal this much is free there.
  c.rule.smallest_free_normal = .85;
  c.check(1e-13, 8);
  std::map<DroppedNode::Reason, unsigned int> reasons;
  for (const auto &node : c.coupling.dropped)
    ++reasons[node.reason];
  EXPECT_EQ(reasons[DroppedNode::fixed], 6u);
  EXPECT_EQ(reasons[DroppedNode::other_pair], 1u);
  EXPECT_EQ(reasons[DroppedNode::normal_fixed], 1u);
}

TEST(TwoStepRule, DoesNotDependOnUnits)
{
  for (const double scale : {1e-6, 1e6})
    {
      Case c         = {make_surface({4, 4, 0., 1., 0., 1., {{1, 1}, {2, 2}}, .4}),
                        make_surface(mortar_grid({5, 4, .2, .8, .2, .8, {}, 0., .4}))};
      Case reference = c;
      c.scale        = scale;
      c.run();
      reference.run();
      ASSERT_EQ(c.coupling.coupling.rows, reference.coupling.coupling.rows);
      ASSERT_EQ(c.coupling.coupling.entries.size(), reference.coupling.coupling.entries.size());
      for (std::size_t i = 0; i < c.coupling.coupling.entries.size(); ++i)
        EXPECT_NEAR(c.coupling.coupling.entries[i].weight, reference.coupling.coupling.entries[i].weight,
                    1e-10);
      EXPECT_LT(c.force_error(), 1e-9);
    }
}

TEST(TwoStepRule, DistortedFaces)
{
  Case c = {make_surface({5, 5, 0., 1., 0., 1., {{1, 1}, {3, 3}}, .4}),
            make_surface(mortar_grid({4, 6, 0., 1., 0., .9, {{2, 2}}, .4}))};
  c.check(1e-9);
}

// A sliver in the middle of a face: M_F is singular to rounding. What the solve loses is bounded by the
// sliver.
TEST(TwoStepRule, Slivers)
{
  for (const double width : {1e-3, 1e-5, 1e-7, 1e-8, 1e-9})
    {
      Case c = {make_surface({4, 4}), make_surface(mortar_grid({1, 3, .6, .6 + width}))};
      c.run();
      ASSERT_GT(c.coupling.coupling.n_rows(), 0u) << width;
      EXPECT_EQ(c.coupling.lost_area, 0.);
      for (const double weight : c.coupling.coupling.weight)
        EXPECT_GT(weight, 0.);
      for (std::size_t row = 0; row < c.coupling.coupling.n_rows(); ++row)
        {
          double sum = 0.;
          for (auto *e = c.coupling.coupling.begin(row); e != c.coupling.coupling.end(row); ++e)
            sum += e->weight;
          EXPECT_NEAR(sum, 1., 1e-12) << width;
        }
    }
}

// All nodes of a face are too thinly covered: the best one keeps its multiplier.
TEST(TwoStepRule, KeepsTheBestNode)
{
  Case c = {make_surface({3, 3}), make_surface(mortar_grid({1, 1, .4, .5, .42, .5}))};
  c.check(1e-11, 3);
  EXPECT_EQ(c.coupling.coupling.n_rows(), 1u);
}

// Only fixed nodes: the face cannot push, its area is reported.
TEST(TwoStepRule, ReportsLostArea)
{
  Case c = {make_surface({4, 4, 0., 1., 0., 1., {{0, 0}}}), make_surface(mortar_grid({3, 3}))};
  fix(c.non, [](const Point<3> &x) { return x[0] < .26; });
  c.run();
  EXPECT_NEAR(c.coupling.lost_area, .25, 1e-14);
  EXPECT_NEAR(c.coupling.covered_area, 1., 1e-14);
  EXPECT_NEAR(c.coupling.area, 1., 1e-14);
  EXPECT_LT(c.linear_error(), 1e-13);
}

// A hanging vertex whose parents are both thinly covered.
TEST(TwoStepRule, HangingVertexKeepsAParent)
{
  Case c = {make_surface({2, 2, 0., 1., 0., 1., {{0, 0}}}),
            make_surface(mortar_grid({2, 2, .4, .6, .2, .3}))};
  c.check(1e-11);
}

TEST(TwoStepRule, LargeRowsAreDropped)
{
  Case c = {make_surface({4, 4}), make_surface(mortar_grid({5, 4, 0., 2.1 / 4.}))};
  c.rule = {0., 5.};
  c.check(1e-12, 5);
  for (const auto &node : c.coupling.dropped)
    EXPECT_EQ(node.reason, DroppedNode::large_row);
}

namespace
{
  /// Makes the right of a surface go up from x = 1, on x = 2 it is level again.
  ContactSurface bent(Grid grid, const bool is_nonmortar)
  {
    grid.faces_up          = is_nonmortar;
    grid.first_node        = is_nonmortar ? 0 : 1000;
    ContactSurface surface = make_surface(grid);
    for (Point<3> &x : surface.mesh.vertices)
      x[2] += 3. * std::max(x[0] - 1., 0.) - 3. * std::max(x[0] - 2., 0.);
    return surface;
  }

  PairCoupling couple_bent(const Grid &nonmortar, const bool drops_sharp_edges)
  {
    const auto   non = bent(nonmortar, true), mor = bent({2 * nonmortar.nx, 4, 0., nonmortar.x1}, false);
    DroppingRule rule;
    rule.drops_sharp_edges = drops_sharp_edges;
    const auto moments     = compute_face_moments(non, mor, make_overlay(non, mor), {}, MPI_COMM_SELF);
    const auto pair        = couple(non, mor, moments, {}, false, rule);
    // With and without, constant pressures give the exact forces at all nodes.
    const std::vector<Vector3>  traction(pair.gaps.size(), Point<3>(.5, 0., 2.));
    const auto                  forces = compute_contact_forces(non, mor, pair, traction);
    std::map<NodeIndex, double> loads;
    for (const FaceMoments &m : moments)
      {
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int b = 0; b < 4; ++b)
            loads[non.vertex_node[non.faces[m.face].corners[a]]] += m.mass[4 * a + b];
        for (const auto &[q, values] : m.coupling)
          for (const double value : values)
            loads[mor.vertex_node[q]] += value;
      }
    for (const auto *const side : {&forces.nonmortar, &forces.mortar})
      for (const auto &node : side->nodes)
        EXPECT_NEAR(std::abs(node.force[2]), 2. * loads[node.node], 1e-13);
    return pair;
  }
} // namespace

// The normal of a node on an edge is that of neither face: it is dropped, unless a face needs it.
TEST(TwoStepRule, SharpEdges)
{
  const Grid one_edge{6, 3, 0., 2.};
  const auto pair = couple_bent(one_edge, true);
  EXPECT_EQ(pair.coupling.n_rows(), 24u);
  ASSERT_EQ(pair.dropped.size(), 4u);
  for (const DroppedNode &node : pair.dropped)
    {
      EXPECT_EQ(node.reason, DroppedNode::sharp_edge);
      EXPECT_EQ(node.position[0], 1.);
    }
  EXPECT_EQ(couple_bent(one_edge, false).coupling.n_rows(), 28u);
  // One face wide between the edges: some of their nodes come back.
  const auto narrow = couple_bent({3, 3, 0., 3.}, true);
  EXPECT_EQ(narrow.lost_area, 0.);
  EXPECT_GT(narrow.coupling.n_rows(), 8u);
  EXPECT_LT(narrow.coupling.n_rows(), 16u);
}

// Where a round edge goes over into an upright wall normals lie across those of the plane above: along them
// there is no gap whatever the distance.
TEST(TwoStepRule, FacingAcross)
{
  ContactSurface non = make_surface({4, 1, 0., 2.}), mor = make_surface(mortar_grid({7, 3, 0., 2.2}));
  const auto     overlay = make_overlay(non, mor);
  for (std::size_t v = 0; v < non.mesh.vertices.size(); ++v)
    {
      Point<3>    &x             = non.mesh.vertices[v];
      const double angle         = .5 * M_PI * std::max(0., x[0] - 1.);
      x                          = Point<3>(std::min(1., x[0]) + std::sin(angle), x[1], std::cos(angle) - 1.);
      non.mesh.vertex_normals[v] = Vector3({std::sin(angle), 0., std::cos(angle)});
    }
  for (Point<3> &x : mor.mesh.vertices)
    x = Point<3>(x[0] < 1. ? x[0] : 1. + std::sin(.5 * M_PI * std::min(1., x[0] - 1.)), x[1], .05);
  const auto moments = compute_face_moments(non, mor, overlay, {}, MPI_COMM_SELF);
  // The round edge is known by its two faces alone.
  DroppingRule rule;
  rule.drops_sharp_edges = false;
  const auto pair        = couple(non, mor, moments, {}, false, rule);
  ASSERT_EQ(pair.coupling.n_rows(), 10u);
  EXPECT_EQ(pair.lost_area, 0.);
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    EXPECT_GT(pair.gaps[row], pair.positions[row][0] > 1.99 ? 1. : .049) << pair.positions[row];
}
