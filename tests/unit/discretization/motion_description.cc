// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Rigid motions in words.

#include <signorini/discretization/motion_description.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

namespace
{
  class MotionDescription : public testing::Test
  {
  protected:
    /// All six motions of a block around (1, 2, 3) with a half diagonal of 5.
    MotionDescription()
      : bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {block()}, "."))
    {
      for (unsigned int c = 0; c < 2 * dim; ++c)
        {
          FreeMotion motion{{0}, {0}, Point<3>(1, 2, 3), 5., Vector3(), Vector3()};
          (c < dim ? motion.translation : motion.rotation)[c % dim] = 1.;
          motions.push_back(motion);
        }
    }

    static BodyParameters block()
    {
      BodyParameters p;
      p.name         = "cube";
      p.mesh         = "block";
      p.upper_corner = Point<3>(1, 1, 1);
      p.divisions    = {1, 1, 1};
      p.young        = 1.;
      p.poisson      = .3;
      return p;
    }

    std::string text(const std::vector<double> &coefficients) const
    {
      return describe_motion(motions, coefficients, bodies);
    }

    Bodies                  bodies;
    std::vector<FreeMotion> motions;
  };
} // namespace

TEST_F(MotionDescription, SaysWhatMovesAndWhatTurns)
{
  EXPECT_EQ(text({0, 0, -1, 0, 0, 0}), "body cube, translation (0, 0, 1)");
  EXPECT_EQ(describe_flight(motions, {0, 0, -1, 0, 0, 0}, bodies), "body cube, translation (0, 0, -1)");
  // omega = e_z / 5, so that a translation by 1 along y moves the axis by 5 along -x.
  EXPECT_EQ(text({0, 0, 0, 0, 0, 1}), "body cube, rotation about the axis through (1, 2, 3) along (0, 0, 1)");
  EXPECT_EQ(text({0, 1, 0, 0, 0, 1}),
            "body cube, rotation about the axis through (-4, 2, 3) along (0, 0, 1)");
  EXPECT_EQ(
      text({0, 0, 1, 0, 0, 1}),
      "body cube, translation (0, 0, 1) with rotation about the axis through (1, 2, 3) along (0, 0, 1)");
}

TEST_F(MotionDescription, AnAxisFarAwayIsATranslation)
{
  EXPECT_EQ(text({0, -1, 0, 0, 0, .01}),
            "body cube, translation (0, 1, 0), turning a little about (0, 0, -1)");
  EXPECT_EQ(text({0, 1, 0, 0, 0, 1e-5}), "body cube, translation (0, 1, 0)");
}

// What flies away as one is named whole, what moves otherwise beside it, and what stays not at all.
TEST(FlightDescription, NamesAllThatMoves)
{
  std::vector<BodyParameters> blocks(4);
  for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      blocks[b].name         = std::string(1, static_cast<char>('a' + b));
      blocks[b].mesh         = "block";
      blocks[b].lower_corner = Point<3>(2. * b, 0, 0);
      blocks[b].upper_corner = Point<3>(2. * b + 1., 1, 1);
      blocks[b].divisions    = {1, 1, 1};
      blocks[b].young        = 1.;
    }
  const Bodies            bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, blocks, "."));
  std::vector<FreeMotion> motions;
  for (unsigned int b = 0; b < blocks.size(); ++b)
    for (unsigned int c = 0; c < 2 * dim; ++c)
      {
        FreeMotion motion{{b}, {b}, Point<3>(2. * b + .5, .5, .5), .5 + b, Vector3(), Vector3()};
        (c < dim ? motion.translation : motion.rotation)[c % dim] = 1.;
        motions.push_back(motion);
      }
  std::vector<double> flight(motions.size(), 0.);
  flight[2] = flight[8] = -2.;
  EXPECT_EQ(describe_flight(motions, flight, bodies), "body a and body b, translation (0, 0, -1)");
  // A motion by 2 does twice the work of the net force.
  EXPECT_DOUBLE_EQ(load_of_flight(motions, flight, 6., bodies).force, 3.);
  EXPECT_EQ(load_of_flight(motions, flight, 6., bodies).moment, 0.);
  flight[14] = -2.;
  flight[18] = 1.;
  EXPECT_EQ(describe_flight(motions, flight, bodies),
            "body a, body b and body c, translation (0, 0, -1) (body d moves, too)");
  // All about the z axis through the middle of the first, of which the angle is 2: the others move along y.
  flight.assign(motions.size(), 0.);
  for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      flight[6 * b + 5] = 2. * motions[6 * b].length;
      flight[6 * b + 1] = 2. * 2. * b;
    }
  EXPECT_EQ(
      describe_flight(motions, flight, bodies),
      "body a, body b, body c and body d, rotation about the axis through (0.5, 0.5, 0.5) along (0, 0, 1)");
  EXPECT_DOUBLE_EQ(load_of_flight(motions, flight, 10., bodies).moment, 5.);
}
