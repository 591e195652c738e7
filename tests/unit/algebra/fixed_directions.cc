// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/fixed_directions.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

namespace
{
  Vector3 unit(const double x, const double y, const double z)
  {
    const Vector3 v = Point<3>(x, y, z);
    return v / v.norm();
  }

  const Vector3 some_vector = Point<3>(.3, -.8, .5);
} // namespace

TEST(FixedDirections, AxesOfCoordinatesStayExact)
{
  const FixedDirections f = FixedDirections::span({unit(0, 2, 0), unit(0, 0, -1)});
  EXPECT_TRUE(f.is_along_axes());
  EXPECT_EQ(f.components(), 6);
  EXPECT_EQ(f, FixedDirections(FixedMask(6)));
  const Vector3 free = f.project_free(some_vector);
  EXPECT_EQ(free[0], some_vector[0]);
  EXPECT_EQ(free[1], 0.);
  EXPECT_EQ(free[2], 0.);
  // A plane of two oblique vectors that has an axis as its normal.
  EXPECT_EQ(FixedDirections::span({unit(1, 1, 0), unit(1, -2, 0)}).components(), 3);
}



TEST(FixedDirections, SpanIsWhatIsFixed)
{
  const Vector3 a = unit(1, 2, 3), b = unit(-1, .5, .2), c = unit(0, 1, -1);
  for (const std::vector<Vector3> &directions : {std::vector<Vector3>{a}, {a, b}, {a, b, c}})
    {
      const FixedDirections f = FixedDirections::span(directions);
      EXPECT_EQ(f.basis().size(), directions.size());
      EXPECT_EQ(f.all(), directions.size() == dim);
      for (const Vector3 &d : directions)
        {
          EXPECT_LT(f.project_free(d).norm(), 1e-15);
          EXPECT_TRUE(f.contains(d));
        }
      const Vector3 free = f.project_free(some_vector);
      EXPECT_LT((f.project_free(free) - free).norm(), 1e-15);
      EXPECT_LT((f.free_block() * some_vector - free).norm(), 1e-15);
      for (const Vector3 &d : f.basis())
        EXPECT_LT(std::abs(d * free), 1e-15);
    }
}



TEST(FixedDirections, NormalsOfOnePlaneHoldOneDirection)
{
  const Vector3 a = unit(1, 2, 3);
  EXPECT_EQ(FixedDirections::span({a, unit(1. + 1e-12, 2., 3.), unit(1.01, 2., 3.)}).basis().size(), 1u);
  EXPECT_EQ(FixedDirections::span({a, unit(1.2, 2., 3.)}).basis().size(), 2u);
}



TEST(FixedDirections, CommonPart)
{
  const Vector3         a = unit(1, 2, 3), b = unit(-1, .5, .2);
  const FixedDirections line = FixedDirections::span({a}), plane = FixedDirections::span({a, b}),
                        all = all_fixed, x = FixedMask(1), none;
  EXPECT_EQ(line.common(plane), line);
  EXPECT_EQ(plane.common(line), line);
  EXPECT_EQ(plane.common(all), plane);
  EXPECT_EQ(all.common(line), line);
  EXPECT_EQ(line.common(none), none);
  EXPECT_EQ(line.common(FixedDirections::span({b})), none);
  EXPECT_EQ(FixedDirections(FixedMask(3)).common(x), x);
  EXPECT_EQ(plane.common(x), none);
}
