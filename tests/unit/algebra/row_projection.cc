// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/row_projection.h>

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
} // namespace

// The projection onto the free components that is the identity there and keeps the normal part.
TEST(RowProjection, KeepsNormalParts)
{
  const Vector3 n = unit(.5, -.7, .4);
  for (FixedMask mask = 0; mask < all_fixed; ++mask)
    {
      const RowProjection a(mask, n);
      const Block         block = a.block();
      EXPECT_EQ(a.is_identity(), mask == 0);
      EXPECT_LT((block * block - block).norm(), 1e-14);
      EXPECT_LT((n * block - n).norm(), 1e-14);
      for (unsigned int c = 0; c < dim; ++c)
        {
          Vector3 e;
          e[c] = 1.;
          EXPECT_LT((block * e - a.apply(e)).norm(), 1e-15);
          EXPECT_EQ(project_free(mask, a.apply(e)), a.apply(e));
          if (project_free(mask, e) == e)
            {
              EXPECT_LT((a.apply(e) - e).norm(), 1e-15);
            }
        }
      // n·(u - s) = |m| (m/|m|)·v with u = v + A s.
      const Vector3 v = project_free(mask, Point<3>(.3, .2, -.9)), s = Point<3>(.1, -.8, .4);
      EXPECT_NEAR(n * (v + a.apply(s) - s), a.share() * (a.direction() * v), 1e-15);
      EXPECT_NEAR(a.direction().norm(), 1., 1e-15);
    }
}

// Where no part of the normal is fixed the projection is E_p, and numbers stay as they are.
TEST(RowProjection, IsPlainWhereNormalIsFree)
{
  const Vector3       n = unit(0., .6, .8);
  const RowProjection a(1, n);
  EXPECT_EQ(a.apply(Point<3>(7., 3., 5.)), Vector3(Point<3>(0., 3., 5.)));
  EXPECT_EQ(a.direction(), n);
  EXPECT_EQ(a.share(), 1.);
  const RowProjection tied = RowProjection::tied(2, n);
  EXPECT_EQ(tied.apply(Point<3>(7., 3., 5.)), Vector3(Point<3>(7., 0., 5.)));
  EXPECT_EQ(tied.direction(), Vector3(Point<3>(0., 0., 1.)));
  EXPECT_EQ(tied.share(), 1.);
}

// Where next to nothing of the normal is free there is no lever.
TEST(RowProjection, IsPlainWhereNormalIsFixed)
{
  for (const double free : {0., 1e-9, .5 * RowProjection::smallest_share})
    {
      const RowProjection a(1, unit(1., free, 0.));
      EXPECT_EQ(a.apply(Point<3>(7., 3., 5.)), Vector3(Point<3>(0., 3., 5.)));
      EXPECT_NEAR(a.share(), free, free * free);
    }
  EXPECT_EQ(RowProjection(all_fixed, unit(1., 2., 3.)).block().norm(), 0.);
}
