// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Decks as contact problems.

#include "unit/mesh/mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/deck_problem.h>

#include <gtest/gtest.h>

using namespace Signorini;
using dealii::Point;

namespace
{
  /// Two cubes on top of each other; `model` comes before the step, `step` into it.
  std::string cubes(const std::string &model, const std::string &step)
  {
    std::string text = "*HEADING\ntwo cubes\n*NODE\n";
    for (unsigned int b = 0; b < 2; ++b)
      for (unsigned int v = 0; v < 8; ++v)
        {
          const Point<3> x = cube(b)[v];
          text += std::to_string(10 * b + v + 1) + ", " + std::to_string(x[0]) + ", " + std::to_string(x[1]) +
                  ", " + std::to_string(x[2]) + "\n";
        }
    text += "*ELEMENT, TYPE=C3D8, ELSET=low\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*ELEMENT, TYPE=C3D8, ELSET=high\n2, "
            "11, 12, "
            "13, 14, 15, 16, 17, 18\n*MATERIAL, NAME=soft\n*ELASTIC\n10., .2\n*DENSITY\n2.\n*MATERIAL, "
            "NAME=hard\n"
            "*ELASTIC\n20., .25\n*SOLID SECTION, ELSET=low, MATERIAL=HARD\n*SOLID SECTION, ELSET=high, "
            "MATERIAL=soft\n*SURFACE, NAME=up\nlow, S2\n*SURFACE, NAME=down\nhigh, S1\n*SURFACE INTERACTION, "
            "NAME=i\n*NSET, NSET=top\n15, 16, 17, 18\n*NSET, NSET=base\n1, 2, 3, 4\n";
    return text + model + "*STEP\n*STATIC\n1., 2.\n" + step + "*END STEP\n";
  }

  DeckProblem problem_of(const std::string &text, const DeckOptions &options = DeckOptions())
  {
    const TemporaryFile file(text, ".inp");
    const DeckModel     model(file.path, options);
    return make_deck_problem(model);
  }

  const std::string contact = "*CONTACT PAIR, INTERACTION=i\ndown, up\n";
} // namespace



TEST(DeckProblem, HasBodiesPairsAndLoads)
{
  const DeckProblem deck =
      problem_of(cubes(contact + "*BOUNDARY\nbase, ENCASTRE\n",
                       "*BOUNDARY\ntop, 1, 2\n*CLOAD\n15, 3, -1.\n15, 1, 2.\n16, 3, -3.\n*DLOAD\n"
                       "high, P2, 4.\nhigh, GRAV, 10., 0., 0., -2.\n"),
                 {false, {}});
  ASSERT_EQ(deck.problem.bodies.size(), 2u);
  const BodyProblem &low = deck.problem.bodies[0], &high = deck.problem.bodies[1];
  EXPECT_EQ(low.body.name, "low");
  EXPECT_EQ(high.body.name, "high");
  EXPECT_EQ(low.body.material.young, 20.);
  EXPECT_EQ(high.body.material.poisson, .2);
  ASSERT_EQ(deck.problem.pairs.size(), 1u);
  const PairDefinition &pair = deck.problem.pairs[0];
  EXPECT_EQ(pair.name, "down-up");
  EXPECT_EQ(pair.first.body, "high");
  EXPECT_EQ(pair.first.boundary, "down");
  EXPECT_EQ(pair.second.body, "low");
  EXPECT_EQ(pair.nonmortar, NonmortarChoice::first);
  ASSERT_EQ(low.loads.displacements.size(), 1u);
  EXPECT_EQ(low.loads.displacements[0].boundary, "base");
  for (unsigned int c = 0; c < 3; ++c)
    EXPECT_TRUE(low.loads.displacements[0].components[c]);
  ASSERT_EQ(high.loads.displacements.size(), 1u);
  EXPECT_FALSE(high.loads.displacements[0].components[2]);
  ASSERT_EQ(high.loads.surface_forces.size(), 1u);
  EXPECT_EQ(high.loads.surface_forces[0].pressure(Point<3>()), 4.);
  Vector3 sum;
  for (const auto &force : high.loads.nodal_forces)
    sum += force.force(Point<3>());
  EXPECT_EQ(sum, Vector3({2., 0., -4.}));
  EXPECT_EQ(high.loads.volume_force(Point<3>()), Vector3({0., 0., -20.}));
}



// As gmsh writes it: ELEMENT has a set of its own, the group that the section names has the same elements.
TEST(DeckProblem, BodiesHaveTheNamesOfTheirSections)
{
  std::string       text    = cubes(contact + "*ELSET, ELSET=Block\n1\n", "");
  const std::string section = "*SOLID SECTION, ELSET=low", named = "*SOLID SECTION, ELSET=BLOCK";
  text.replace(text.find(section), section.size(), named);
  const DeckProblem deck = problem_of(text);
  EXPECT_EQ(deck.problem.bodies[0].body.name, "Block");
  EXPECT_EQ(deck.problem.bodies[1].body.name, "high");
}



TEST(DeckProblem, GravityNeedsDensity)
{
  EXPECT_THROW(problem_of(cubes("", "*DLOAD\nlow, GRAV, 10., 0., 0., -1.\n")), InputError);
}



TEST(DeckProblem, LaterStepsReplaceAndAdd)
{
  const auto state = [](const std::string &steps) {
    const TemporaryFile file(
        cubes("*AMPLITUDE, NAME=a\n0., 0., 1., 0.5, 4., 2.\n*AMPLITUDE, NAME=b, TIME=TOTAL "
              "TIME\n0., 0., 10., 10.\n",
              steps),
        ".inp");
    return DeckModel(file.path, {}).steps().back();
  };
  const std::string next  = "*END STEP\n*STEP\n*STATIC\n1., 3.\n";
  const auto        force = [](const DeckState &s) { return s.forces.at({12, 2}).value; };
  // In the same step forces add up, in a later one they are replaced; amplitudes at the end of the step.
  EXPECT_EQ(force(state("*CLOAD\n15, 3, 1.\n15, 3, 2.\n")), 3.);
  EXPECT_EQ(force(state("*CLOAD\n15, 3, 1.\n" + next + "*CLOAD\n15, 3, 5.\n")), 5.);
  EXPECT_EQ(force(state("*CLOAD\n15, 3, 1.\n" + next)), 1.);
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=a\n15, 3, 1.\n")), 1.);
  EXPECT_EQ(force(state(next + "*CLOAD, AMPLITUDE=b\n15, 3, 1.\n")), 5.);
  // What is not named again keeps its value, but for what follows the total time.
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=a\n15, 3, 1.\n" + next)), 1.);
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=b\n15, 3, 1.\n" + next)), 5.);
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=b\n15, 3, 1.\n" + next + next)), 8.);
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=b\n15, 3, 1.\n*CLOAD\n15, 3, 2.\n" + next)), 7.);
  EXPECT_EQ(force(state("*CLOAD, AMPLITUDE=b\n15, 3, 1.\n" + next + "*CLOAD\n15, 3, 2.\n")), 2.);
  EXPECT_EQ(state("*BOUNDARY, AMPLITUDE=b\ntop, 3, 3, 1.\n*DLOAD, AMPLITUDE=b\nhigh, P2, 1.\n" + next)
                .boundaries[0]
                .values[2],
            5.);
  EXPECT_TRUE(state("*CLOAD, AMPLITUDE=b\n15, 3, 1.\n" + next + "*CLOAD, OP=NEW\n").forces.empty());
  EXPECT_TRUE(state("*CLOAD\n15, 3, 1.\n" + next + "*CLOAD, OP=NEW\n").forces.empty());
  EXPECT_EQ(state("*BOUNDARY\ntop, 3, 3, 1.\n" + next + "*BOUNDARY\ntop, 3, 3, 2.\n").boundaries[0].values[2],
            2.);
  EXPECT_TRUE(state("*BOUNDARY\ntop, 3, 3, 1.\n" + next + "*BOUNDARY, OP=NEW\n").boundaries.empty());
  EXPECT_EQ(state(next).time, 5.);
  // Single nodes with the same values are one condition.
  EXPECT_EQ(state("*BOUNDARY\n1,1\n1,2\n2,1\n2,2\n3,1\n3,2\n").boundaries.size(), 1u);
}



TEST(DeckProblem, SaysWhatItTakesDifferently)
{
  const std::string text =
      cubes("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n1., 2.\n" + contact, "*NODE FILE\nU\n");
  const DeckProblem deck = problem_of(text);
  ASSERT_EQ(deck.remarks.size(), 2u);
  EXPECT_NE(deck.remarks[0].find("EXPONENTIAL"), std::string::npos);
  EXPECT_NE(deck.remarks[0].find("line "), std::string::npos);
  EXPECT_NE(deck.remarks[1].find("passed over: NODE FILE"), std::string::npos);
  EXPECT_THROW(problem_of(text, {true, {}}), InputError);
  const std::string rubbing = cubes("*FRICTION\n.3\n" + contact, "");
  EXPECT_THROW(problem_of(rubbing), InputError);
  EXPECT_EQ(problem_of(rubbing, {false, {"FRICTION"}}).remarks.size(), 1u);
  EXPECT_TRUE(problem_of(cubes("*FRICTION\n0.\n" + contact, "")).remarks.empty());
}
