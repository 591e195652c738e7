// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mortar/rigid_obstacle.h>

#include <gtest/gtest.h>

#include <random>

using namespace Signorini;
using dealii::Point;

namespace
{
  RigidObstacle obstacle(const std::string &text)
  {
    return RigidObstacle::parse(text, "test");
  }

  /// The gap, or infinity.
  double gap(const RigidObstacle &o, const Point<3> &x, const Point<3> &direction)
  {
    double        g;
    const Vector3 n = Vector3(direction) / direction.norm();
    return o.gap(g, x, n, 1.) ? g : std::numeric_limits<double>::infinity();
  }
} // namespace



TEST(RigidObstacle, KnownDistances)
{
  const Point<3> down(0., 0., -1.);
  EXPECT_NEAR(gap(obstacle("plane: (0, 0, 1), (0, 0, 2)"), {3., 4., 6.}, down), 5., 1e-14);
  EXPECT_NEAR(gap(obstacle("plane: (0, 0, 1), (0, 0, 2)"), {3., 4., 6.}, {1., 0., -1.}), 5. * std::sqrt(2.),
              1e-14);
  EXPECT_NEAR(gap(obstacle("plane: (0, 0, 1), (0, 0, 2)"), {3., 4., .75}, down), -.25, 1e-14);
  EXPECT_NEAR(gap(obstacle("sphere: (0, 0, 0), 2"), {0., 0., 5.}, down), 3., 1e-14);
  EXPECT_NEAR(gap(obstacle("sphere: (0, 0, 0), 2"), {0., 0., 1.5}, down), -.5, 1e-14);
  EXPECT_NEAR(gap(obstacle("hollow sphere: (0, 0, 0), 2"), {0., 0., -1.}, down), 1., 1e-14);
  EXPECT_NEAR(gap(obstacle("hollow sphere: (0, 0, 0), 2"), {0., 0., -2.5}, down), -.5, 1e-14);
  EXPECT_NEAR(gap(obstacle("cylinder: (0, 7, 0), (0, 1, 0), 1"), {0., 3., 2.}, down), 1., 1e-14);
  EXPECT_NEAR(gap(obstacle("hollow cylinder: (0, 7, 0), (0, 1, 0), 1"), {0., 3., 0.}, down), 1., 1e-14);
  EXPECT_NEAR(gap(obstacle("paraboloid: (0, 0, 0), (0, 0, 1), 0.5"), {.5, 0., 0.}, down), .25, 1e-14);
  EXPECT_NEAR(gap(obstacle("paraboloid: (0, 0, 0), (0, 0, 1), -0.5"), {.5, 0., 0.}, down), -.25, 1e-14);
}



TEST(RigidObstacle, LinesThatMiss)
{
  EXPECT_TRUE(std::isinf(gap(obstacle("plane: (0, 0, 0), (0, 0, 1)"), {0., 0., 1.}, {0., 0., 1.})));
  EXPECT_TRUE(std::isinf(gap(obstacle("plane: (0, 0, 0), (0, 0, 1)"), {0., 0., 1.}, {1., 0., 0.})));
  EXPECT_TRUE(std::isinf(gap(obstacle("sphere: (0, 0, 0), 1"), {2., 0., 5.}, {0., 0., -1.})));
  EXPECT_TRUE(std::isinf(gap(obstacle("cylinder: (0, 0, 0), (0, 1, 0), 1"), {0., 0., 2.}, {0., 1., 0.})));
  EXPECT_TRUE(std::isinf(gap(obstacle("function: z"), {0., 0., 2.}, {0., 0., 1.})));
}



// The closed forms against the same surfaces as functions, which go through Newton's method.
TEST(RigidObstacle, FunctionsGiveTheSame)
{
  const std::vector<std::pair<const char *, const char *>> pairs = {
      {"plane: (0.1, 0.2, -0.3), (1, 2, 3)", "function: 1*(x-0.1)+2*(y-0.2)+3*(z+0.3)"},
      {"sphere: (0.1, 0.2, -2.3), 2", "function: (x-0.1)^2+(y-0.2)^2+(z+2.3)^2-4"},
      {"hollow sphere: (0.1, 0.2, 1.5), 2", "function: 4-(x-0.1)^2-(y-0.2)^2-(z-1.5)^2"},
      {"cylinder: (0.1, 0, -2), (0, 3, 0), 2", "function: (x-0.1)^2+(z+2)^2-4"},
      {"paraboloid: (0.1, 0.2, 0.05), (0, 0, 1), 1.5", "function: z-0.05+((x-0.1)^2+(y-0.2)^2)/3"}};
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> noise(-.3, .3);
  for (const auto &[closed, function] : pairs)
    for (unsigned int i = 0; i < 100; ++i)
      {
        const Point<3> x(noise(random), noise(random), noise(random)), n(noise(random), noise(random), -1.);
        EXPECT_NEAR(gap(obstacle(closed), x, n), gap(obstacle(function), x, n), 1e-11) << closed;
      }
}



TEST(RigidObstacle, RefusesWhatItCannotRead)
{
  for (const char *text :
       {"wall", "cone: (0, 0, 0), 1", "plane: (0, 0, 0)", "plane: (0, 0, 0), (0, 0, 0)", "sphere: (0, 0), 1",
        "sphere: (0, 0, 0), -1", "paraboloid: (0, 0, 0), (0, 0, 1), 0", "hollow plane: (0, 0, 0), (0, 0, 1)",
        "function: x +"})
    EXPECT_THROW(obstacle(text), InputError) << text;
}
