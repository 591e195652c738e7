// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Face moments and weighted gaps, and the same result on any number of ranks.

#include "flat_surfaces.h"

#include <signorini/mortar/contact_forces.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

namespace
{
  using namespace FlatSurfaces;

  double parabola(const Point<3> &x)
  {
    return (x[0] - .5) * (x[0] - .5) + (x[1] - .5) * (x[1] - .5);
  }

  /// int psi_i (x - 1/2)^2 / int psi_i on n intervals of [0,1], psi in one dimension 2 - 3x and 3x - 1.
  std::vector<double> weighted_squares(const unsigned int n)
  {
    const dealii::QGauss<1> gauss(3);
    std::vector<double>     moment(n + 1, 0.), weight(n + 1, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int q = 0; q < 3; ++q)
        {
          const double s = gauss.point(q)[0], w = gauss.weight(q) / n, x = (i + s) / n - .5;
          moment[i] += w * (2. - 3. * s) * x * x;
          moment[i + 1] += w * (3. * s - 1.) * x * x;
          weight[i] += w * (2. - 3. * s);
          weight[i + 1] += w * (3. * s - 1.);
        }
    for (unsigned int i = 0; i <= n; ++i)
      moment[i] /= weight[i];
    return moment;
  }

  Grid mortar_grid(Grid grid)
  {
    grid.first_node = 1000;
    grid.faces_up   = false;
    return grid;
  }
} // namespace

// Problem M1 of doc/verification.md: prescribed parabolic gap, 3:2 grids.
TEST(WeightedGap, ParabolaAgainstTensorProduct)
{
  const unsigned int n   = 6;
  const auto         non = make_surface({n, n}), mor = make_surface(mortar_grid({4, 4}));
  const auto moments = compute_face_moments(non, mor, make_overlay(non, mor), parabola, MPI_COMM_SELF);
  const auto pair    = couple(non, mor, moments, {}, true);
  const auto squares = weighted_squares(n);
  ASSERT_EQ(pair.gaps.size(), (n + 1) * (n + 1));
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    {
      const Point<3> &x = pair.positions[row];
      EXPECT_NEAR(pair.gaps[row], squares[std::lround(n * x[0])] + squares[std::lround(n * x[1])], 1e-14);
    }
}

namespace
{
  /// Weighted gaps of an obstacle above a plane grid, at a height over each point.
  PairCoupling under(const Grid &grid, const std::function<double(const Point<3> &)> &height)
  {
    const auto non     = make_surface(grid);
    const auto moments = compute_face_moments(
        non,
        [&](Vector3 &gap, const Point<3> &x, const Vector3 &normal) {
          gap = height(x) * normal;
          return true;
        },
        MPI_COMM_SELF);
    return couple(non, non, moments, {}, false);
  }
} // namespace

// Linear elements cannot follow an obstacle that bends away within a face: its height counts at the nodes.
// With all of it they would touch h²/6 too early along each axis.
TEST(WeightedGap, SmoothObstacleIsTakenAtNodes)
{
  const auto height = [](const Point<3> &x) { return x[0] * x[0] - .3 * x[0] * x[1] + .5 * x[1] * x[1]; };
  const auto pair   = under({6, 6}, height);
  ASSERT_EQ(pair.gaps.size(), 49u);
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    EXPECT_NEAR(pair.gaps[row], height(pair.positions[row]), 1e-12);
}

// Waves within a face are no curvature that nodes stand for: what counts is still a mean.
TEST(WeightedGap, RoughObstacleIsWeighted)
{
  const unsigned int n    = 6;
  const auto         pair = under(
              {n, n}, [&](const Point<3> &x) { return 1. + .1 * std::cos(6. * dealii::numbers::PI * n * x[0]); });
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    EXPECT_NEAR(pair.gaps[row], 1., .03);
}

// A crease within a face: dual functions have negative parts, and the nodes where the surfaces touch would
// have to go into each other, those beside them would touch too late.
TEST(WeightedGap, CreaseIsTakenAtNodes)
{
  for (const double crease : {.4, .46, .5, .58, .63})
    {
      const auto height = [=](const Point<3> &x) { return std::max(0., x[0] - crease); };
      const auto pair   = under({6, 6}, height);
      ASSERT_EQ(pair.gaps.size(), 49u);
      for (std::size_t row = 0; row < pair.gaps.size(); ++row)
        {
          const Point<3> &x = pair.positions[row];
          EXPECT_GE(pair.gaps[row], -1e-14);
          // Of a face of width 1/6.
          EXPECT_NEAR(pair.gaps[row], height(x), .015) << crease << " at " << x;
          if (x[0] < crease - 1. / 6. - 1e-12)
            {
              EXPECT_NEAR(pair.gaps[row], 0., 1e-14);
            }
        }
    }
}

// A mortar surface at a linear height: Phi(x) - x is linear, and the weighted gap of a linear function is
// its value at the node.
TEST(WeightedGap, LinearGapIsExactAtNodes)
{
  for (const double distortion : {0., .4})
    {
      auto       non     = make_surface({4, 4, 0., 1., 0., 1., {{1, 2}}, distortion});
      auto       mor     = make_surface(mortar_grid({3, 5}));
      const auto overlay = make_overlay(non, mor);
      for (Point<3> &x : mor.mesh.vertices)
        x[2] = -.1 + .2 * x[0] + .05 * x[1];
      const auto pair =
          couple(non, mor, compute_face_moments(non, mor, overlay, {}, MPI_COMM_SELF), {}, false);
      for (std::size_t row = 0; row < pair.gaps.size(); ++row)
        EXPECT_NEAR(pair.gaps[row], -.1 + .2 * pair.positions[row][0] + .05 * pair.positions[row][1],
                    distortion == 0. ? 1e-14 : 1e-10);
    }
}

TEST(FaceMoments, Areas)
{
  const auto non     = make_surface({4, 3, 0., 1., 0., 1., {{1, 1}}, .3}),
             mor     = make_surface(mortar_grid({2, 2, .3}));
  double     covered = 0., area = 0., full = 0., sum = 0.;
  const auto moments = compute_face_moments(non, mor, make_overlay(non, mor), {}, MPI_COMM_SELF);
  ASSERT_EQ(moments.size(), non.faces.size());
  for (const FaceMoments &m : moments)
    {
      covered += m.covered;
      area += m.area;
      for (unsigned int a = 0; a < 4; ++a)
        full += m.full[a];
      for (const auto &[q, values] : m.coupling)
        for (const double value : values)
          sum += value;
    }
  EXPECT_NEAR(area, 1., 1e-14);
  EXPECT_NEAR(full, 1., 1e-14);
  EXPECT_NEAR(covered, .7, 1e-14);
  EXPECT_NEAR(sum, .7, 1e-14);
}

// Faces whose images lie beside them rather than before them, farther away than they are wide, are uncovered;
// so are those that the other side turns away from.
TEST(FaceMoments, ImagesFarAway)
{
  const unsigned int n   = 4;
  const auto         non = make_surface({n, n}), mor = make_surface(mortar_grid({n, n}));
  const auto         overlay = make_overlay(non, mor);
  const auto         covered = [&](const Vector3 &shift, const bool is_turned) {
    ContactSurface other = mor;
    for (Point<3> &x : other.mesh.vertices)
      x += shift;
    if (is_turned)
      for (auto &t : other.mesh.triangles)
        std::swap(t[0], t[1]);
    double sum = 0.;
    for (const FaceMoments &m : compute_face_moments(non, other, overlay, {}, MPI_COMM_SELF))
      sum += m.covered;
    return sum;
  };
  const double whole = covered(Vector3(), false);
  EXPECT_NEAR(whole, 1., 1e-12);
  // Within the width of a face, 0.25, anything goes.
  EXPECT_EQ(covered(Point<3>(.2, 0., .01), false), whole);
  EXPECT_EQ(covered(Point<3>(0., 0., 3.), false), whole);
  EXPECT_EQ(covered(Point<3>(3., 0., -2.), false), whole);
  EXPECT_EQ(covered(Point<3>(3., 0., 1.5), false), 0.);
  EXPECT_EQ(covered(Point<3>(3., 0., -1.5), false), 0.);
  EXPECT_EQ(covered(Point<3>(0., 0., 3.), true), 0.);
}

// Identical warped surfaces: Phi is the identity, S too, and there is no gap.
TEST(FaceMoments, IdenticalWarpedSurfaces)
{
  auto       non = make_surface({4, 4, 0., 1., 0., 1., {}, .3}), mor = non;
  const auto overlay = [&]() {
    std::vector<OverlayTriangle>               cells;
    const std::array<std::array<double, 3>, 3> unit = {{{{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}}};
    for (unsigned int t = 0; t < non.mesh.triangles.size(); ++t)
      cells.push_back({t, t, unit, unit});
    return cells;
  }();
  for (NodeIndex &node : mor.vertex_node)
    node += 1000;
  for (auto *surface : {&non, &mor})
    for (Point<3> &x : surface->mesh.vertices)
      x[2] = .2 * std::sin(3. * x[0]) * std::cos(4. * x[1]);
  const auto moments = compute_face_moments(non, mor, overlay, {}, MPI_COMM_SELF);
  const auto pair    = couple(non, mor, moments, {}, false);
  ASSERT_EQ(pair.coupling.n_rows(), 25u);
  EXPECT_TRUE(pair.dropped.empty());
  EXPECT_NEAR(pair.covered_area, pair.area, 1e-14);
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    {
      EXPECT_NEAR(pair.gaps[row], 0., 1e-15);
      EXPECT_NEAR(pair.shares[row], 1., 1e-9);
      for (const auto *entry = pair.coupling.begin(row); entry != pair.coupling.end(row); ++entry)
        EXPECT_NEAR(entry->weight, entry->node == pair.coupling.rows[row] + 1000 ? 1. : 0., 1e-12);
    }
}

// Bit by bit the same as on one rank.
TEST(FaceMoments, DoNotDependOnTheNumberOfRanks)
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const int          rank    = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  Grid               grid    = {5, 4, 0., 1., 0., 1., {{1, 1}, {3, 2}}, .3};
  const auto         serial  = make_surface(grid);
  grid.n_ranks               = n_ranks;
  const auto non             = make_surface(grid),
             mor             = make_surface(mortar_grid({3, 3, .2, .9, 0., 1., {{1, 1}}, .2, .1}));

  const auto one = compute_face_moments(serial, mor, make_overlay(serial, mor), {}, MPI_COMM_SELF);
  const auto all =
      SurfaceHalo(non, MPI_COMM_WORLD)
          .add_ghosts(compute_face_moments(non, mor, make_overlay(non, mor, rank), {}, MPI_COMM_WORLD));
  EXPECT_GE(all.size(), one.size() / n_ranks);
  for (const FaceMoments &m : all)
    {
      const FaceMoments &other = one.at(m.face);
      EXPECT_EQ(other.face, m.face);
      EXPECT_EQ(other.full, m.full);
      EXPECT_EQ(other.covered, m.covered);
      EXPECT_EQ(other.area, m.area);
      EXPECT_EQ(other.mass, m.mass);
      EXPECT_EQ(other.gap, m.gap);
      EXPECT_EQ(other.coupling, m.coupling);
    }
}
