// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The dual basis of a single face and the inverse of the bilinear map.

#include <signorini/mortar/dual_basis.h>
#include <signorini/mortar/face_map.h>

#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace Signorini;
using dealii::Point;

namespace
{
  /// Mass matrix of the corner functions over a rectangle of the unit square.
  std::array<double, 16> mass_matrix(const double s0, const double s1, const double t0, const double t1)
  {
    const FaceMap           face(std::array<Point<3>, 4>{
                  {Point<3>(0., 0., 0.), Point<3>(1., 0., 0.), Point<3>(1., 1., 0.), Point<3>(0., 1., 0.)}});
    const dealii::QGauss<1> gauss(3);
    std::array<double, 16>  mass = {};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const auto phi = face.shape(s0 + (s1 - s0) * gauss.point(i)[0], t0 + (t1 - t0) * gauss.point(j)[0]);
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int b = 0; b < 4; ++b)
              mass[4 * a + b] += (s1 - s0) * (t1 - t0) * gauss.weight(i) * gauss.weight(j) * phi[a] * phi[b];
        }
    return mass;
  }

  void check_basis(const std::array<double, 16> &mass, const unsigned int bits, const double tolerance)
  {
    std::array<bool, 4> in_v;
    for (unsigned int a = 0; a < 4; ++a)
      in_v[a] = (bits >> a) & 1u;
    const DualBasis basis = compute_dual_basis(mass, in_v);
    ASSERT_EQ(basis.n_functions, static_cast<unsigned int>(in_v[0] + in_v[1] + in_v[2] + in_v[3]));
    double largest = 0.;
    for (unsigned int i = 0; i < basis.n_functions; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        {
          if (!in_v[j])
            continue;
          double integral = 0., d = 0.;
          for (unsigned int a = 0; a < 4; ++a)
            {
              integral += basis.coefficients[i][a] * mass[4 * a + j];
              d += mass[4 * a + j];
              largest = std::max(largest, d);
            }
          EXPECT_NEAR(integral, basis.corner[i] == j ? d : 0., tolerance * largest);
        }
    for (unsigned int a = 0; a < 4 && basis.n_functions > 0; ++a)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < basis.n_functions; ++i)
          sum += basis.coefficients[i][a];
        EXPECT_NEAR(sum, 1., tolerance * largest / (mass[0] + mass[5]));
      }
  }
} // namespace

TEST(DualBasis, BiorthogonalAndPartitionOfUnity)
{
  for (unsigned int bits = 0; bits < 16; ++bits)
    {
      SCOPED_TRACE(bits);
      check_basis(mass_matrix(0., 1., 0., 1.), bits, 1e-14);
      check_basis(mass_matrix(.3, .8, .1, .9), bits, 1e-13);
      check_basis(mass_matrix(0., .1, 0., 1.), bits, 1e-13);
    }
}

// On a fully covered parallelogram: tensor products of 2 - 3x and 3x - 1.
TEST(DualBasis, FullFaceIsTensorProduct)
{
  const DualBasis basis        = compute_dual_basis(mass_matrix(0., 1., 0., 1.), {{true, true, true, true}});
  const double    one_d[2][2]  = {{2., -1.}, {-1., 2.}};
  const int       corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int a = 0; a < 4; ++a)
      EXPECT_NEAR(basis.coefficients[i][a],
                  one_d[corner[i][0]][corner[a][0]] * one_d[corner[i][1]][corner[a][1]], 1e-13);
}

TEST(FaceMap, InvertsParallelogramsAndOthers)
{
  for (const double scale : {1e-7, 1., 1e7})
    for (const double move : {0., .3})
      {
        const std::array<Point<3>, 4> x = {{Point<3>(5., 1., 2.) * scale, Point<3>(6.1, 1.2, 2.) * scale,
                                            Point<3>(6.4 + move, 2.1, 2.) * scale,
                                            Point<3>(5.3, 1.9, 2.) * scale}};
        const FaceMap                 face(x);
        EXPECT_EQ(face.is_parallelogram(), move == 0.);
        for (const double s : {0., .2, 1.})
          for (const double t : {0., .7, 1.})
            {
              Point<3>   p;
              const auto phi = face.shape(s, t);
              for (unsigned int a = 0; a < 4; ++a)
                p += phi[a] * x[a];
              double found_s = .5, found_t = .5;
              EXPECT_TRUE(face.invert(found_s, found_t, p));
              EXPECT_NEAR(found_s, s, 1e-14);
              EXPECT_NEAR(found_t, t, 1e-14);
            }
      }
}

// Off a warped face: the residual is normal to the face.
TEST(FaceMap, NearestPointOfWarpedFace)
{
  const std::array<Point<3>, 4> x = {
      {Point<3>(0., 0., 0.), Point<3>(1., 0., .2), Point<3>(1.1, 1., -.1), Point<3>(0., .9, .15)}};
  const FaceMap  face(x);
  double         s = .5, t = .5;
  const Point<3> p(.4, .3, .1);
  ASSERT_TRUE(face.invert(s, t, p));
  Point<3>             q;
  dealii::Tensor<1, 3> ds  = (1. - t) * (x[1] - x[0]) + t * (x[2] - x[3]);
  dealii::Tensor<1, 3> dt  = (1. - s) * (x[3] - x[0]) + s * (x[2] - x[1]);
  const auto           phi = face.shape(s, t);
  for (unsigned int a = 0; a < 4; ++a)
    q += phi[a] * x[a];
  EXPECT_NEAR((p - q) * ds, 0., 1e-14);
  EXPECT_NEAR((p - q) * dt, 0., 1e-14);
}

TEST(FaceMap, DegenerateFaceIsReported)
{
  const Point<3>                o(1., 1., 1.);
  const std::array<Point<3>, 4> corners = {{o, o, o, o}};
  const FaceMap                 point(corners);
  double                        s = .5, t = .5;
  EXPECT_FALSE(point.invert(s, t, o));
}
