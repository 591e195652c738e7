// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/rigid_support.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/nodal_space.h>

#include <gtest/gtest.h>

#include <numeric>
#include <random>

using namespace Signorini;
using dealii::Point;
namespace Utilities = dealii::Utilities;

namespace
{
  /// A block of 1 x 2 x 3 with a refined corner, so that there are hanging nodes.
  struct Block123
  {
    Bodies bodies;

    Block123()
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {parameters()}, "."))
    {
      for (const auto &cell : bodies.triangulation().active_cell_iterators())
        if (cell->is_locally_owned() && cell->center().norm() < 1.5)
          cell->set_refine_flag();
      bodies.triangulation().execute_coarsening_and_refinement();
    }

    static BodyParameters parameters()
    {
      BodyParameters p;
      p.name         = "body";
      p.mesh         = "block";
      p.upper_corner = Point<3>(1, 2, 3);
      p.divisions    = {2, 3, 4};
      p.young        = 7.;
      p.poisson      = .3;
      return p;
    }
  };

  NodePartition partition_of(const NodalSpace &space)
  {
    return NodePartition(space.owned(), space.relevant(), MPI_COMM_WORLD);
  }

  Vector3 total(const Vector &forces, const NodePartition &partition)
  {
    Vector3 sum;
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        sum[c] += forces.local_element(3 * i + c);
    for (unsigned int c = 0; c < dim; ++c)
      sum[c] = Utilities::MPI::sum(sum[c], MPI_COMM_WORLD);
    return sum;
  }
} // namespace

// With no displacement what is left are the loads, with the opposite sign.
TEST(Elasticity, LoadsAddUpToForces)
{
  Block123         block;
  const NodalSpace space(MPI_COMM_WORLD, block.bodies.mesh());
  const auto       partition = partition_of(space);
  Vector           u;
  partition.reinit(u);
  u.update_ghost_values();
  const auto force_of = [&](const LoadParameters &parameters) {
    Loads loads;
    loads.add(block.bodies, 0, parameters.definition(""));
    return -1. * total(physical_residual(block.bodies, space, partition, loads, u), partition);
  };
  LoadParameters p;
  p.tractions = "top: (1, 0, 2)";
  EXPECT_LT((force_of(p) - Point<3>(2., 0., 4.)).norm(), 1e-13);
  p           = {};
  p.pressures = "right: 3";
  EXPECT_LT((force_of(p) - Point<3>(-18., 0., 0.)).norm(), 1e-13);
  p              = {};
  p.volume_force = "(0, x, -2)";
  EXPECT_LT((force_of(p) - Point<3>(0., 3., -12.)).norm(), 1e-12);
}

// A linear displacement prescribed on the whole border is a solution without loads: no force inside.
TEST(Elasticity, PatchTestWithHangingNodes)
{
  Block123         block;
  const NodalSpace space(MPI_COMM_WORLD, block.bodies.mesh());
  const auto       partition = partition_of(space);
  EXPECT_LT(space.n_conforming_nodes(), space.n_nodes());
  Vector u;
  partition.reinit(u);
  std::set<NodeIndex> inner;
  for (const NodeIndex node : space.owned())
    {
      const Point<3> x         = space.position(node);
      const Vector3  value     = Point<3>(.1 * x[0] - .2 * x[1], .3 * x[2], .4 * x[0] + .5 * x[2]);
      bool           at_border = false;
      for (unsigned int c = 0; c < dim; ++c)
        {
          u.local_element(3 * partition.to_local(node) + c) = value[c];
          at_border                                         = at_border || x[c] < 1e-9 || x[c] > c + 1 - 1e-9;
        }
      if (!at_border)
        inner.insert(node);
    }
  u.update_ghost_values();
  Loads no_loads;
  no_loads.add(block.bodies, 0, {});
  const Vector forces = physical_residual(block.bodies, space, partition, no_loads, u);
  for (const NodeIndex node : inner)
    for (unsigned int c = 0; c < dim; ++c)
      EXPECT_NEAR(forces.local_element(3 * partition.to_local(node) + c), 0., 1e-13);
  EXPECT_LT(total(forces, partition).norm(), 1e-12);
}

TEST(Elasticity, FreeMotions)
{
  Block123         block;
  const NodalSpace space(MPI_COMM_WORLD, block.bodies.mesh());
  const auto       n_free = [&](const std::string &conditions) {
    Loads          loads;
    LoadParameters p;
    p.dirichlet = conditions;
    loads.add(block.bodies, 0, p.definition(""));
    return free_motions(block.bodies, space, evaluate_dirichlet(space, loads, false),
                              separate_parts(block.bodies))
        .size();
  };
  EXPECT_EQ(n_free("bottom: (0, 0, 0)"), 0u);
  EXPECT_EQ(n_free("bottom: (*, *, 0); left: (0, *, *); front: (*, 0, *)"), 0u);
  EXPECT_EQ(n_free("bottom: (*, *, 0); left: (0, *, *)"), 1u);
  EXPECT_EQ(n_free("bottom: (*, *, 0)"), 3u);
  EXPECT_EQ(n_free(""), 6u);
}

// A body on three points: held by loads that go through the triangle, else it tips over, slides or lifts off.
TEST(Elasticity, BalanceOfRigidMotions)
{
  // Motions: translations in z and x, rotation about y (z moves by -x).
  const std::vector<double> rows    = {-1., 0., -1., -1., 0., 1., -1., 0., 0.};
  const std::vector<double> gaps    = {.1, .1, .1};
  const auto                balance = [&](const double z, const double x, const double turn) {
    return balance_rigid_motions(rows, gaps, {z, x, turn});
  };
  const RigidBalance held = balance(-3., 0., 1.);
  EXPECT_TRUE(held.is_held);
  EXPECT_NEAR(held.settling[0], -.1, 1e-14);
  EXPECT_NEAR(held.settling[2], 0., 1e-14);
  EXPECT_TRUE(balance(0., 0., 0.).is_held);
  for (const auto &[z, x, turn] :
       std::vector<std::array<double, 3>>{{{-1., 0., 2.}}, {{-1., .1, 0.}}, {{1., 0., 0.}}})
    {
      const RigidBalance lost = balance(z, x, turn);
      EXPECT_FALSE(lost.is_held);
      // A motion that all contacts allow and the load likes.
      EXPECT_GT(lost.flight[0] * z + lost.flight[1] * x + lost.flight[2] * turn, 0.);
      for (unsigned int p = 0; p < 3; ++p)
        EXPECT_LE(rows[3 * p] * lost.flight[0] + rows[3 * p + 1] * lost.flight[1] +
                      rows[3 * p + 2] * lost.flight[2],
                  1e-12);
    }
}

// The nearest point of a polyhedron: no admissible point lies on the side of the target.
TEST(Elasticity, NearestAdmissibleMotion)
{
  std::mt19937                           generator(5);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  unsigned int                           n_restricted = 0;
  for (unsigned int i = 0; i < 200; ++i)
    {
      const std::size_t   n = 1 + i % 7, m = i % 23;
      std::vector<double> rows(n * m), bounds(m), target(n);
      const double        scale = std::pow(10., 6. * uniform(generator));
      for (double &x : rows)
        x = uniform(generator);
      for (double &x : bounds)
        x = scale * std::max(0., uniform(generator));
      for (double &x : target)
        x = scale * uniform(generator);
      const auto product = [&](const std::size_t p, const std::vector<double> &x) {
        return std::inner_product(x.begin(), x.end(), rows.begin() + n * p, 0.);
      };
      const std::vector<double> nearest = nearest_admissible(rows, bounds, target);
      for (std::size_t p = 0; p < m; ++p)
        EXPECT_LE(product(p, nearest), bounds[p] + 1e-11 * scale) << "problem " << i;
      n_restricted += nearest != target;
      for (unsigned int j = 0; j < 100; ++j)
        {
          std::vector<double> other(n);
          for (double &x : other)
            x = scale * uniform(generator);
          double share = 1.;
          for (std::size_t p = 0; p < m; ++p)
            if (product(p, other) > bounds[p])
              share = std::min(share, bounds[p] / product(p, other));
          double towards = 0.;
          for (std::size_t k = 0; k < n; ++k)
            towards += (target[k] - nearest[k]) * (share * other[k] - nearest[k]);
          EXPECT_LE(towards, 1e-10 * scale * scale) << "problem " << i;
        }
    }
  EXPECT_GT(n_restricted, 100u);
}
