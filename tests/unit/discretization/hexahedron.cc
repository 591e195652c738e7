// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/types.h>
#include <signorini/discretization/hexahedron.h>

#include <gtest/gtest.h>

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
} // namespace

TEST(Hexahedron, RigidMotionsCauseNoForces)
{
  const auto              x = skew_cell();
  std::array<double, 576> blocks;
  ASSERT_TRUE(Hexahedron::stiffness(blocks, x, 7., .3));
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
TEST(Hexahedron, EnergyOfAConstantStrain)
{
  const double young = 7., nu = .3, mu = young / (2. * (1. + nu)),
               lambda       = young * nu / ((1. + nu) * (1. - 2. * nu));
  const auto              x = skew_cell();
  std::array<double, 576> blocks;
  ASSERT_TRUE(Hexahedron::stiffness(blocks, x, young, nu));
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
  EXPECT_FALSE(Hexahedron::stiffness(blocks, x, 1., .3));
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
