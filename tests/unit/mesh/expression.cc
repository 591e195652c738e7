// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/refinement.h>

#include <gtest/gtest.h>

using namespace dealii;
using namespace Signorini;

TEST(Expression, Evaluates)
{
  const Point<3> p(2., 3., 5.);
  EXPECT_EQ(Expression("7", "test")(p), 7.);
  EXPECT_EQ(Expression("-1e-3*x + y*z", "test")(p), -2e-3 + 15.);
  EXPECT_NEAR(Expression("2*sin(pi*x/4)", "test")(p), 2., 1e-15);
  EXPECT_EQ(Expression("5*(x > 1)", "test")(p), 5.);
}



TEST(Expression, NamesTheParameterInErrors)
{
  for (const char *text : {"bla(x)", "x +", "", "1 2", "w"})
    try
      {
        Expression(text, "Body first/Dirichlet")(Point<3>());
        ADD_FAILURE() << "\"" << text << "\" was taken";
      }
    catch (const InputError &e)
      {
        EXPECT_NE(std::string(e.what()).find("Body first/Dirichlet"), std::string::npos) << e.what();
      }
}



TEST(Expression, RefusesRandomNumbers)
{
  for (const char *text : {"rand()", "x + 0.1*rand()", "rand_seed(3)", "if(x > 0, rand(), 1)"})
    EXPECT_THROW(Expression(text, "Body first/Pressures"), InputError) << text;
}



TEST(Expression, RefusesValuesThatAreNotFinite)
{
  const Expression inverse("1/x", "Body first/Pressures");
  EXPECT_EQ(inverse(Point<3>(2., 0., 0.)), .5);
  EXPECT_THROW(inverse(Point<3>()), InputError);
}



// Nested ones, towers of powers and long ones are evaluated or refused, at once and in few words.
TEST(Expression, DoesNotRunAway)
{
  const auto repeated = [](const std::string &text, const unsigned int n) {
    std::string result;
    for (unsigned int i = 0; i < n; ++i)
      result += text;
    return result;
  };
  const Point<3> p(.5, 0., 0.);
  EXPECT_EQ(Expression(repeated("(", 4000) + "x" + repeated(")", 4000), "test")(p), .5);
  EXPECT_LT(Expression(repeated("sin(", 1500) + "x" + repeated(")", 1500), "test")(p), .5);
  for (const std::string &text :
       {repeated("(", 50000) + "x" + repeated(")", 50000), repeated("x+", 100000) + "x",
        repeated("9", 100000) + "*x", repeated("2^", 4000) + "2", repeated("(1+x)^", 1500) + "9",
        repeated("-", 9000) + "x", repeated("(", 9000), repeated("if(", 3000)})
    try
      {
        Expression(text, "Body first/Pressures")(p);
        ADD_FAILURE() << "\"" << text.substr(0, 20) << "\" was taken";
      }
    catch (const InputError &e)
      {
        EXPECT_LT(std::string(e.what()).size(), 600u) << e.what();
        EXPECT_EQ(std::string(e.what()).find("Body first/Pressures: "), 0u) << e.what();
      }
}



TEST(Lists, KeepParenthesesTogether)
{
  EXPECT_EQ(split_vector("(min(x, y), 2, *)", "test"), (std::vector<std::string>{"min(x, y)", "2", "*"}));
  const auto entries = split_named_entries("left: (0, *, *); top: (0, 0, max(x; 1))", "test");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].first, "left");
  EXPECT_EQ(entries[1].second, "(0, 0, max(x; 1))");
  EXPECT_THROW(split_vector("(1, 2", "test"), InputError);
  EXPECT_THROW(split_named_entries("left (0, 0, 0)", "test"), InputError);
}



TEST(Refinement, ReadsRegionsAndCountsCycles)
{
  RefinementParameters p;
  p.global_cycles       = 1;
  p.final_global_cycles = 2;
  p.regions             = parse_regions("ball: (0, 0, 0), 2, 3; box: (0, 0, 0), (1, 1, 1), 1");
  EXPECT_EQ(Refinement(p).n_cycles(), 1u + 3u + 2u);
  for (const char *bad : {"ball: (0, 0, 0), 2", "ball: (0, 0, 0), -1, 3", "cone: (0, 0, 0), 1, 1",
                          "box: (1, 0, 0), (0, 1, 1), 1", "ball: (0, 0, 0), 1, 1.5"})
    EXPECT_THROW(parse_regions(bad), InputError) << bad;
}



// Global cycles, then the regions one level a cycle, then the final global cycles.
TEST(Refinement, WorksThroughTheCycles)
{
  BodyParameters body;
  body.divisions = {2, 2, 2};
  Bodies               bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {body}, "."));
  RefinementParameters p;
  p.global_cycles       = 1;
  p.final_global_cycles = 1;
  p.regions             = parse_regions("ball: (0, 0, 0), 0.1, 2");
  const Refinement         refinement(p);
  std::vector<std::size_t> cells;
  for (unsigned int cycle = 1; cycle <= refinement.n_cycles(); ++cycle)
    {
      const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
      EXPECT_TRUE(bodies.refine(space, refinement.mark(bodies, space, cycle)));
      cells.push_back(bodies.triangulation().n_global_active_cells());
    }
  EXPECT_EQ(cells, (std::vector<std::size_t>{64, 71, 78, 624}));
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  EXPECT_FALSE(bodies.refine(space, refinement.mark(bodies, space, refinement.n_cycles() + 1)));
}



// A small body on a large one: regions and initial levels of one of them leave the other as it is.
TEST(Refinement, RegionsOfOneBodyLeaveTheOthers)
{
  BodyParameters small, large;
  small.name         = "small";
  large.name         = "large";
  large.lower_corner = Point<3>(-10., -10., -10.);
  large.upper_corner = Point<3>(10., 10., 0.);
  Bodies               bodies(MPI_COMM_WORLD, define_bodies(MPI_COMM_WORLD, {small, large}, "."));
  RefinementParameters p;
  p.initial_of_body = {1, 0};
  p.regions         = parse_regions("small: ball: (0, 0, 0), 0.1, 2; large: box: (0, 0, 0), (0, 0, 0), 1");
  EXPECT_EQ(p.regions[0].body, "small");
  EXPECT_FALSE(p.regions[1].is_ball);
  const Refinement refinement(p);
  const auto       count = [&] {
    const NodalSpace            space(MPI_COMM_WORLD, bodies.mesh());
    std::array<unsigned int, 2> n = {{0, 0}};
    for (const NodalSpace::Cell &cell : space.cells())
      if (cell.is_owned)
        ++n[bodies.body_of_material(cell.material)];
    return std::make_pair(Utilities::MPI::sum(n[0], MPI_COMM_WORLD),
                                Utilities::MPI::sum(n[1], MPI_COMM_WORLD));
  };
  const auto refine = [&](const auto &mark) {
    const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
    bodies.refine(space, mark(space));
  };
  refine([&](const NodalSpace &space) {
    std::vector<bool> marked;
    for (const NodalSpace::Cell &cell : space.cells())
      marked.push_back(bodies.body_of_material(cell.material) == 0);
    return marked;
  });
  EXPECT_EQ(count(), std::make_pair(8u, 1u));
  refine([&](const NodalSpace &space) { return refinement.mark(bodies, space, 1); });
  EXPECT_EQ(count(), std::make_pair(15u, 8u));
  refine([&](const NodalSpace &space) { return refinement.mark(bodies, space, 2); });
  EXPECT_EQ(count(), std::make_pair(22u, 8u));
}
