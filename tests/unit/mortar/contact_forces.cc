// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Forces of a contact stress, and the pointwise penetration of deformed surfaces.

#include "flat_surfaces.h"

#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/geometric_penetration.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <limits>

namespace
{
  using namespace FlatSurfaces;

  struct Surfaces
  {
    explicit Surfaces(const unsigned int n_ranks = 1)
    {
      Grid grid       = {4, 4, 0., 1., 0., 1., {{1, 1}}};
      grid.n_ranks    = n_ranks;
      non             = make_surface(grid);
      grid            = {3, 5, 0., .8, 0., 1., {{2, 2}}};
      grid.first_node = 1000;
      grid.faces_up   = false;
      mor             = make_surface(grid);
    }

    ContactSurface non, mor;
  };
} // namespace

// Phi shifts sideways by t: the moments differ by sum_k lambda_k int psi_k (x - Phi(x)) x n_k.
TEST(ContactForces, BalanceOfForcesAndMoments)
{
  Surfaces   s;
  const auto overlay = make_overlay(s.non, s.mor);
  fix(s.non, [](const Point<3> &x) { return x[1] > 1. - 1e-12; });
  const Tensor<1, 3> shift = Point<3>(.1, -.2, .05);
  for (Point<3> &x : s.mor.mesh.vertices)
    x += shift;
  const auto           moments = compute_face_moments(s.non, s.mor, overlay, {}, MPI_COMM_SELF);
  const auto           pair    = couple(s.non, s.mor, moments, {}, false);
  std::vector<double>  pressure;
  std::vector<Vector3> traction;
  double               total = 0., covered = 0.;
  for (std::size_t row = 0; row < pair.gaps.size(); ++row)
    {
      EXPECT_NEAR(pair.gaps[row], .05 * pair.areas[row] / pair.coupling.weight[row], 1e-14);
      pressure.push_back(1. + pair.positions[row][0] * pair.positions[row][1]);
      traction.push_back(pressure.back() * pair.normals[row]);
      total += pressure.back() * pair.areas[row];
      covered += pair.areas[row];
    }
  EXPECT_NEAR(covered, pair.covered_area, 1e-14);
  const auto forces = compute_contact_forces(s.non, s.mor, pair, traction);
  EXPECT_NEAR(forces.mortar.force[2], total, 1e-14);
  EXPECT_LT((forces.mortar.force + forces.nonmortar.force).norm(), 1e-14);
  const Vector3 normal  = s.non.mesh.vertex_normals[0];
  const Vector3 missing = total * cross_product_3d(shift, normal);
  EXPECT_LT((forces.mortar.moment + forces.nonmortar.moment - missing).norm(), 1e-13);
  // Nodes of R carry forces on the nonmortar side.
  for (const NodeIndex node : pair.r_nodes)
    EXPECT_TRUE(std::any_of(forces.nonmortar.nodes.begin(), forces.nonmortar.nodes.end(),
                            [&](const auto &f) { return f.node == node; }));
}

TEST(ContactForces, RecoveredPressureKeepsConstantsAndForceAndHidesNoSliver)
{
  Surfaces s;
  // The mortar surface ends just beyond a line of nonmortar vertices: the next line is covered by slivers.
  const double beyond = .5 + 1e-4;
  for (Point<3> &x : s.mor.mesh.vertices)
    x[0] *= beyond / .8;
  const auto moments = compute_face_moments(s.non, s.mor, make_overlay(s.non, s.mor), {}, MPI_COMM_SELF);
  const auto pair    = couple(s.non, s.mor, moments, {}, false, DroppingRule{1e-12, 1e12});
  std::vector<double> pressure(pair.gaps.size(), 3.);
  for (const double p : recover_pressure(s.non, SurfaceHalo(s.non, MPI_COMM_SELF), moments, pair, pressure))
    EXPECT_TRUE(std::abs(p - 3.) < 1e-12 || p == 0.) << p;
  double force = 0., peak = 0.;
  for (std::size_t row = 0; row < pressure.size(); ++row)
    {
      const bool is_sliver = pair.positions[row][0] > beyond;
      pressure[row]        = is_sliver ? 500. : 2. + pair.positions[row][1];
      force += pressure[row] * pair.areas[row];
    }
  const auto recovered = recover_pressure(s.non, SurfaceHalo(s.non, MPI_COMM_SELF), moments, pair, pressure);
  double     sum       = 0.;
  for (const FaceMoments &m : moments)
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int b = 0; b < 4; ++b)
        sum += m.mass[4 * a + b] * recovered[s.non.faces[m.face].corners[a]];
  for (const double p : recovered)
    peak = std::max(peak, p);
  EXPECT_LT(peak, 4.);
  EXPECT_NEAR(sum, force, .05 * force);
}

TEST(ContactForces, StressOnTheMortarSide)
{
  Surfaces   s;
  const auto moments = compute_face_moments(s.non, s.mor, make_overlay(s.non, s.mor), {}, MPI_COMM_SELF);
  const auto pair    = couple(s.non, s.mor, moments, {}, false);
  std::vector<Vector3> traction(pair.gaps.size(), Point<3>(.5, 0., 2.));
  const NodePartition  nodes(dealii::complete_index_set(2000), dealii::complete_index_set(2000),
                             MPI_COMM_SELF);
  for (const Vector3 &t : mortar_means(s.mor, pair, traction, nodes))
    EXPECT_LT((t - Point<3>(.5, 0., 2.)).norm(), 1e-12);
  for (const double p : mortar_means(s.mor, pair, std::vector<double>(pair.gaps.size(), 3.), nodes))
    EXPECT_NEAR(p, 3., 1e-12);
}

TEST(GeometricPenetration, ConstantAndBilinearDisplacements)
{
  const int  rank = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  Surfaces   s(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  const auto overlay = make_overlay(s.non, s.mor, rank);
  for (Point<3> &x : s.mor.mesh.vertices)
    x[2] += .3;
  std::vector<Vector3>    u_non(s.non.vertex_node.size(), Point<3>(.1, .2, .5));
  std::vector<Vector3>    u_mor(s.mor.vertex_node.size(), Point<3>(7., 0., .1));
  std::vector<double>     pressure(u_non.size(), 2.);
  const std::vector<bool> active(u_non.size(), true);
  auto result = sample_geometric_penetration({s.non, s.mor, overlay}, u_non, u_mor, {pressure, active}, {},
                                             MPI_COMM_WORLD);
  EXPECT_NEAR(result.min_initial_gap, .3, 1e-15);
  EXPECT_NEAR(result.max_penetration(), .1, 1e-15);

  // xy is in the space of each side: no difference although the grids do not match.
  const auto bilinear = [](const ContactSurface &surface) {
    std::vector<Vector3> u;
    for (const Point<3> &x : surface.mesh.vertices)
      u.push_back(Point<3>(0., 0., x[0] * x[1]));
    return u;
  };
  u_non  = bilinear(s.non);
  u_mor  = bilinear(s.mor);
  result = sample_geometric_penetration({s.non, s.mor, overlay}, u_non, u_mor, {pressure, active}, {},
                                        MPI_COMM_WORLD);
  EXPECT_NEAR(result.min_gap, .3, 1e-14);

  result = sample_geometric_penetration(
      {s.non, s.mor, overlay}, u_non, u_mor, {pressure, active}, [](const Point<3> &x) { return x[0] - 1.; },
      MPI_COMM_WORLD);
  EXPECT_NEAR(result.min_initial_gap, -1., 1e-15);
  EXPECT_NEAR(result.max_penetration(), 1., 1e-14);
}

// A corner that the surfaces fit into, flush on the floor, .3 from the wall: what slides by .1 toward the
// wall penetrates nothing, although the normals at the edge say so.
TEST(GeometricPenetration, SharpEdges)
{
  const auto bend = [](ContactSurface surface) {
    for (Point<3> &x : surface.mesh.vertices)
      x[2] += 3. * std::max(x[0] - 1., 0.);
    return surface;
  };
  auto              non     = bend(make_surface({4, 2, 0., 2.}));
  const auto        mor     = bend(make_surface({2, 3, 0., 2., 0., 1., {}, 0., 0., 1000, false}));
  const auto        overlay = make_overlay(non, mor);
  const Vector3     wall    = Vector3({-3., 0., 1.}) / std::sqrt(10.), floor({0., 0., 1.});
  std::vector<bool> on_edge;
  for (unsigned int v = 0; v < non.vertex_node.size(); ++v)
    {
      const double x = non.mesh.vertices[v][0];
      on_edge.push_back(x == 1.);
      const Vector3 sum          = (x <= 1. ? floor : Vector3()) + (x >= 1. ? wall : Vector3());
      non.mesh.vertex_normals[v] = sum / sum.norm();
    }
  const std::vector<Vector3> u(non.vertex_node.size(), Vector3({-.1, 0., 0.})),
      nothing(mor.vertex_node.size(), Vector3());
  const std::vector<double> pressure(u.size(), 1.);
  const std::vector<bool>   active(u.size(), true);
  const auto                gap = [](const Point<3> &x) { return x[0] > 1. - 1e-9 ? .3 : 0.; };
  EXPECT_NEAR(sample_geometric_penetration({non, mor, overlay, on_edge}, u, nothing, {pressure, active}, gap,
                                           MPI_COMM_SELF)
                  .max_penetration(),
              0., 1e-14);
  const auto wrong =
      sample_geometric_penetration({non, mor, overlay}, u, nothing, {pressure, active}, gap, MPI_COMM_SELF);
  EXPECT_GT(wrong.max_penetration(), .03);
  EXPECT_LT(wrong.min_gap_at[0], 1.);
}

// What is far apart has no doubt that matters; the rest counts with its share of a triangle.
TEST(GeometricPenetration, DoubtOfGaps)
{
  const Surfaces s;
  DoubtOfGaps    doubts(s.non);
  EXPECT_EQ(doubts.largest(MPI_COMM_SELF).first, 0.);
  doubts.add(3, .25, .1, 0.);
  doubts.add(3, .5, .1, 1.1);
  doubts.add(3, .25, .2, 1.1);
  EXPECT_NEAR(doubts.largest(MPI_COMM_SELF).first, .075, 1e-15);
  doubts.add(1, .1, .3, -1.);
  const auto [largest, where] = doubts.largest(MPI_COMM_SELF);
  EXPECT_NEAR(largest, .3, 1e-15);
  EXPECT_EQ(where, Signorini::evaluate(s.non.mesh, 1, {{1. / 3., 1. / 3., 1. / 3.}}));
}

TEST(GeometricPenetration, NothingCovered)
{
  Surfaces                   s;
  const std::vector<Vector3> u_non(s.non.vertex_node.size()), u_mor(s.mor.vertex_node.size());
  const std::vector<double>  pressure(u_non.size(), 1.);
  const std::vector<bool>    active(u_non.size(), true);
  const auto                 result =
      sample_geometric_penetration({s.non, s.mor, {}}, u_non, u_mor, {pressure, active}, {}, MPI_COMM_WORLD);
  EXPECT_EQ(result.min_gap, std::numeric_limits<double>::infinity());
}
