// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/types.h>
#include <signorini/discretization/hexahedron.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <random>

using namespace Signorini;
using dealii::Point;

namespace
{
  /// A cell without right angles and parallel faces.
  Hexahedron::Corners skew_cell()
  {
    Hexahedron::Corners x;
    for (unsigned int v = 0; v < 8; ++v)
      {
        const double a = v & 1, b = v >> 1 & 1, c = v >> 2 & 1;
        x[v] = Point<3>(2. * a + .3 * b * c, 1.5 * b - .2 * a * c, c + .25 * a * b);
      }
    return x;
  }

  /// Nodal forces of a displacement given at the corners.
  std::array<Vector3, 8> forces(const std::array<double, 576> &blocks, const std::array<Vector3, 8> &u)
  {
    std::array<Vector3, 8> f;
    for (unsigned int a = 0; a < 8; ++a)
      for (unsigned int b = 0; b < 8; ++b)
        for (unsigned int c = 0; c < 9; ++c)
          f[a][c / 3] += blocks[9 * (8 * a + b) + c] * u[b][c % 3];
    return f;
  }

  Point<3> image(const Hexahedron::Corners &x, const Point<3> &reference)
  {
    const auto phi = Hexahedron::shape_values(reference);
    Point<3>   p;
    for (unsigned int v = 0; v < 8; ++v)
      p += phi[v] * x[v];
    return p;
  }

  double determinant_at(const Hexahedron::Corners &x, const Point<3> &reference)
  {
    const auto g = Hexahedron::reference_gradients(reference);
    Block      j;
    for (unsigned int v = 0; v < 8; ++v)
      j += outer_product(Vector3(x[v]), g[v]);
    return determinant(j);
  }

  /// Corners of the unit cube moved by up to `amount` in each direction; cells that are turned inside out
  /// somewhere are left out.
  Hexahedron::Corners random_cell(std::mt19937 &random, const double amount)
  {
    std::uniform_real_distribution<double> move(-amount, amount);
    for (;;)
      {
        Hexahedron::Corners x;
        for (unsigned int v = 0; v < 8; ++v)
          for (unsigned int c = 0; c < 3; ++c)
            x[v][c] = (v >> c & 1) + move(random);
        double smallest = 1.;
        for (unsigned int i = 0; i < 125; ++i)
          smallest = std::min(smallest,
                              determinant_at(x, Point<3>(.25 * (i % 5), .25 * (i / 5 % 5), .25 * (i / 25))));
        if (smallest > .01)
          return x;
      }
  }
} // namespace

/// Without and with mean dilatation.
class HexahedronElement : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(Dilatation, HexahedronElement, testing::Bool());

TEST_P(HexahedronElement, RigidMotionsCauseNoForces)
{
  const auto              x = skew_cell();
  std::array<double, 576> blocks;
  ASSERT_TRUE(Hexahedron::stiffness(blocks, x, {7., .3}, GetParam()));
  for (unsigned int mode = 0; mode < 6; ++mode)
    {
      std::array<Vector3, 8> u;
      for (unsigned int v = 0; v < 8; ++v)
        if (mode < 3)
          u[v][mode] = 1.;
        else
          {
            Vector3 axis;
            axis[mode - 3] = 1.;
            u[v]           = cross_product_3d(axis, x[v]);
          }
      for (const Vector3 &f : forces(blocks, u))
        EXPECT_LT(f.norm(), 1e-13 * 7.) << mode;
    }
}

// A linear displacement: the energy is that of the constant stress.
TEST_P(HexahedronElement, EnergyOfAConstantStrain)
{
  const double young = 7., nu = .3, mu = young / (2. * (1. + nu)),
               lambda       = young * nu / ((1. + nu) * (1. - 2. * nu));
  const auto              x = skew_cell();
  std::array<double, 576> blocks;
  ASSERT_TRUE(Hexahedron::stiffness(blocks, x, {young, nu}, GetParam()));
  const double gradient[3][3] = {{.1, .2, -.3}, {.4, -.5, .6}, {-.7, .8, .9}};
  double       volume = 0., energy = 0., trace = 0., strain2 = 0.;
  for (unsigned int q = 0; q < 8; ++q)
    volume += Hexahedron::volume_element(x, q).first;
  std::array<Vector3, 8> u;
  for (unsigned int v = 0; v < 8; ++v)
    for (unsigned int c = 0; c < 9; ++c)
      u[v][c / 3] += gradient[c / 3][c % 3] * x[v][c % 3];
  const auto f = forces(blocks, u);
  for (unsigned int v = 0; v < 8; ++v)
    energy += .5 * (f[v] * u[v]);
  for (unsigned int c = 0; c < 9; ++c)
    {
      const double strain = .5 * (gradient[c / 3][c % 3] + gradient[c % 3][c / 3]);
      strain2 += strain * strain;
      trace += c / 3 == c % 3 ? strain : 0.;
    }
  EXPECT_NEAR(energy / (volume * (mu * strain2 + .5 * lambda * trace * trace)), 1., 1e-13);
}

TEST(Hexahedron, RefusesInvertedCells)
{
  auto x = skew_cell();
  std::swap(x[0], x[4]);
  std::array<double, 576> blocks;
  EXPECT_FALSE(Hexahedron::stiffness(blocks, x, {1., .3}));
}

TEST(Hexahedron, FindsThePointOfAReferencePoint)
{
  const auto x = skew_cell();
  for (const Point<3> &reference : {Point<3>(.1, .2, .9), Point<3>(.5, .5, .5), Point<3>(1., 0., 1.)})
    {
      const auto phi = Hexahedron::shape_values(reference);
      Point<3>   p;
      for (unsigned int v = 0; v < 8; ++v)
        p += phi[v] * x[v];
      Point<3> found;
      ASSERT_TRUE(Hexahedron::invert_map(found, x, p));
      EXPECT_LT(found.distance(reference), 1e-13);
    }
}

// Of the displacements of a nearly incompressible cell one changes its volume; the others cost no more than
// shear. With displacements alone those without divergence at all Gauss points are few.
TEST(Hexahedron, MeanDilatationCostsVolumeOnlyOnce)
{
  const double young = 3., poisson = .4999999, mu = .5 * young / (1. + poisson);
  for (const bool mean_dilatation : {false, true})
    {
      std::array<double, 576> blocks;
      ASSERT_TRUE(Hexahedron::stiffness(blocks, skew_cell(), {young, poisson}, mean_dilatation));
      Eigen::MatrixXd matrix(24, 24);
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < 8; ++b)
          for (unsigned int c = 0; c < 9; ++c)
            matrix(3 * a + c / 3, 3 * b + c % 3) = blocks[9 * (8 * a + b) + c];
      EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-14 * matrix.norm());
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
      unsigned int          n_zero = 0, n_large = 0;
      for (unsigned int i = 0; i < 24; ++i)
        {
          n_zero += std::abs(values(i)) < 1e-6 * mu;
          n_large += values(i) > 1e3 * mu;
        }
      EXPECT_EQ(n_zero, 6u);
      EXPECT_TRUE(mean_dilatation ? n_large == 1 : n_large >= 7) << n_large;
    }
}

// Distorted cells of any size, far from the origin too: a point inside is found there, and what is found
// outside leads back to the point.
TEST(Hexahedron, FindsPointsInDistortedCells)
{
  std::mt19937                           random(27);
  std::uniform_real_distribution<double> inside(0., 1.), around(-2., 3.);
  unsigned int                           n_found = 0;
  for (unsigned int trial = 0; trial < 3000; ++trial)
    {
      const double        size = std::pow(10., static_cast<int>(trial % 13) - 6);
      const Point<3>      shift(trial % 3 * 1e3, trial % 2 * -1e3, 0.);
      Hexahedron::Corners x = random_cell(random, .5);
      for (Point<3> &corner : x)
        corner = size * (corner + Vector3(shift));
      const double noise = 1e-15 * (1. + shift.norm());
      Point<3>     found;
      for (unsigned int i = 0; i < 8; ++i)
        {
          Point<3> reference(inside(random), inside(random), inside(random));
          // Also on faces, edges and corners.
          for (unsigned int c = 0; c < i / 2; ++c)
            reference[c] = i % 2;
          ASSERT_TRUE(Hexahedron::invert_map(found, x, image(x, reference))) << trial;
          EXPECT_LT(found.distance(reference), 1e3 * noise + 1e-10) << trial << ' ' << reference;
          const Point<3> point = size * (Point<3>(around(random), around(random), around(random)) + shift);
          if (!Hexahedron::invert_map(found, x, point))
            continue;
          ++n_found;
          EXPECT_LT(image(x, found).distance(point), (1e3 * noise + 1e-10) * size) << trial;
        }
    }
  // Most points nearby have reference coordinates.
  EXPECT_GT(n_found, 12000u);
}

// x = a (1 - c), y = b, z = c: an edge of the cell has no length, and in the plane z = 1 there is nothing but
// it.
TEST(Hexahedron, DoesNotFindWhatIsNotThere)
{
  Hexahedron::Corners x;
  for (unsigned int v = 0; v < 8; ++v)
    x[v] = Point<3>(v == 5 || v == 7 ? 0. : v & 1, v >> 1 & 1, v >> 2 & 1);
  Point<3> found;
  EXPECT_FALSE(Hexahedron::invert_map(found, x, Point<3>(.5, .5, 1.)));
  ASSERT_TRUE(Hexahedron::invert_map(found, x, Point<3>(.25, .5, .5)));
  EXPECT_LT(found.distance(Point<3>(.5, .5, .5)), 1e-12);
}
