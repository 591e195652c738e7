// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Problems that are set up in C++.

#include <signorini/algebra/input_error.h>
#include <signorini/application/certificate.h>
#include <signorini/application/error_estimate.h>
#include <signorini/application/journal.h>
#include <signorini/application/nested_iteration.h>
#include <signorini/application/parameters.h>
#include <signorini/discretization/level_hierarchy.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

using namespace Signorini;
using dealii::Point;
using dealii::Triangulation;

namespace
{
  const ScalarField zero = [](const Point<3> &) { return 0.; };
  const ScalarField free_component;

  BodyDefinition block(const std::string &name, const Point<3> &low, const Point<3> &high,
                       const unsigned int n)
  {
    Triangulation<3> mesh;
    dealii::GridGenerator::subdivided_hyper_rectangle(mesh, {n, n, n}, low, high, true);
    BodyDefinition body = make_body(
        name, mesh, {{0, "left"}, {1, "right"}, {2, "front"}, {3, "back"}, {4, "bottom"}, {5, "top"}});
    body.material = {1000., .3};
    return body;
  }

  /// The patch test of prm/patch_test: nonmatching blocks, pressed together by a displacement of the top.
  ProblemDefinition patch_test()
  {
    const ScalarField down = [](const Point<3> &) { return -.01; };
    ProblemDefinition problem;
    problem.bodies.resize(2);
    problem.bodies[0].body                = block("upper", Point<3>(0, 0, 0), Point<3>(1, 1, 1), 3);
    problem.bodies[0].loads.displacements = {{"left", {{zero, free_component, free_component}}},
                                             {"front", {{free_component, zero, free_component}}},
                                             {"top", {{free_component, free_component, down}}}};
    problem.bodies[1].body                = block("lower", Point<3>(0, 0, -1), Point<3>(1, 1, 0), 4);
    problem.bodies[1].loads.displacements = {{"left", {{zero, free_component, free_component}}},
                                             {"front", {{free_component, zero, free_component}}},
                                             {"bottom", {{free_component, free_component, zero}}}};
    PairDefinition pair;
    pair.name   = "interface";
    pair.first  = {"upper", "bottom", {}};
    pair.second = {"lower", "top", {}};
    problem.pairs.push_back(pair);
    return problem;
  }
} // namespace



TEST(ProblemDefinition, IsThatOfTheParameterFile)
{
  Journal             journal;
  const ParameterFile file(std::string(SIGNORINI_SOURCE_DIR) + "/prm/patch_test/patch_test.prm", {});
  ContactModel        from_file(MPI_COMM_WORLD, file.problem(MPI_COMM_WORLD)),
      from_program(MPI_COMM_WORLD, patch_test());
  const NestedSolution a = run_nested_iteration(from_file, file.nested(), journal);
  NestedParameters     parameters;
  parameters.refinement.global_cycles = 1;
  const NestedSolution b              = run_nested_iteration(from_program, parameters, journal);
  ASSERT_EQ(a.results.cycles.size(), b.results.cycles.size());
  for (std::size_t c = 0; c < 2; ++c)
    {
      EXPECT_EQ(a.results.cycles[c].dofs, b.results.cycles[c].dofs);
      EXPECT_EQ(a.results.cycles[c].active_nodes, b.results.cycles[c].active_nodes);
    }
  EXPECT_NEAR(a.results.certificate.potential_energy, b.results.certificate.potential_energy, 1e-12);
  EXPECT_NEAR(b.results.pairs[0].min_pressure, 5., 1e-9);
  EXPECT_NEAR(b.results.pairs[0].max_pressure, 5., 1e-9);
  EXPECT_TRUE(b.results.certificate.objections.empty());
}



// Parameters from text are those of the file; messages name the text and the line.
TEST(ProblemDefinition, IsThatOfTheText)
{
  const std::string   folder = std::string(SIGNORINI_SOURCE_DIR) + "/prm/hertz";
  const ParameterFile file(folder + "/hertz.prm", {"Solver/Tolerance=1e-10"});
  std::ifstream       in(file.path());
  std::ostringstream  lines, a, b;
  lines << in.rdbuf();
  ParameterText problem;
  problem.text   = lines.str();
  problem.name   = "a dictionary";
  problem.folder = folder;
  const ParameterFile text(problem, {"Solver/Tolerance=1e-10"});
  file.print(a, true);
  text.print(b, true);
  EXPECT_EQ(a.str(), b.str());
  EXPECT_EQ(text.path(), "a dictionary");
  EXPECT_EQ(text.problem(MPI_COMM_WORLD).bodies.size(), 2u);
  try
    {
      problem.text = "set Bodies = a\nsubsection Body a\n  set Radius = wide\nend\n";
      ParameterFile(problem, {});
      FAIL() << "a radius that is no number";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("Line <3> of file <a dictionary>"), std::string::npos)
          << error.what();
    }
}



// A loop of one's own, with local refinement, has the constant pressure on every mesh.
TEST(ProblemDefinition, LoopOfOnesOwn)
{
  Journal                 journal;
  ContactModel            model(MPI_COMM_WORLD, patch_test());
  CoarserSpaces           coarser;
  NestedStart             start;
  std::vector<PairChoice> choices;
  auto                    space = std::make_shared<const ConstrainedSpace>(model, true);
  for (unsigned int cycle = 0; cycle < 3; ++cycle)
    {
      const auto            d = discretize(model, space, choices, cycle, journal);
      const ContactSolution solution =
          solve_contact(model, *d, coarser, cycle > 0 ? &start : nullptr, {}, journal);
      EXPECT_TRUE(solution.report.converged);
      for (const double pressure : solution.stress.pressure)
        EXPECT_NEAR(pressure, 5., 1e-8);
      // Nothing but rounding is left to estimate.
      EXPECT_LT(total_indicator(space->nodal(), estimate_error(model, *d, solution)), 1e-6);
      std::vector<bool> marked;
      for (const NodalSpace::Cell &cell : space->nodal().cells())
        marked.push_back(space->nodal().position(space->nodal().nodes(cell)[0]).norm() < .4);
      ASSERT_TRUE(model.refine(space->nodal(), marked));
      const auto next = std::make_shared<const ConstrainedSpace>(model, true);
      const auto rows = interpolation_rows(next->nodal(), space->nodal(), model.bodies().tetrahedra());
      start           = {next->interpolate(solution.displacement, *space, rows),
                         solution.report.needed_interface_sweeps};
      choices         = d->choices;
      space           = next;
    }
}



// The finer side of the first mesh is the nonmortar one on all of them, whatever is refined.
TEST(ProblemDefinition, NonmortarSideStays)
{
  Journal      journal;
  ContactModel model(MPI_COMM_WORLD, patch_test());
  const auto   space = std::make_shared<const ConstrainedSpace>(model, true);
  const auto   first = discretize(model, space, {}, 0, journal);
  ASSERT_TRUE(first->choices[0].is_second);
  std::vector<bool> marked;
  for (const NodalSpace::Cell &cell : space->nodal().cells())
    marked.push_back(space->nodal().position(space->nodal().nodes(cell)[0])[2] > -1e-9);
  ASSERT_TRUE(model.refine(space->nodal(), marked));
  const auto second =
      discretize(model, std::make_shared<const ConstrainedSpace>(model, true), first->choices, 1, journal);
  EXPECT_GT(second->pairs[0].mortar.surface.faces.size(), first->pairs[0].mortar.surface.faces.size());
  EXPECT_TRUE(second->choices[0].is_second);
  EXPECT_EQ(second->pairs[0].nonmortar.body, first->pairs[0].nonmortar.body);
}



// Who writes a loop is told of bodies that nothing can hold, too.
TEST(ProblemDefinition, FreeBodyWithoutContact)
{
  ProblemDefinition problem = patch_test();
  problem.bodies.resize(3);
  problem.bodies[2].body = block("third", Point<3>(3, 0, 0), Point<3>(4, 1, 1), 1);
  Journal       journal;
  ContactModel  model(MPI_COMM_WORLD, problem);
  const auto    d = discretize(model, std::make_shared<const ConstrainedSpace>(model), {}, 0, journal);
  CoarserSpaces coarser;
  EXPECT_THROW(solve_contact(model, *d, coarser, nullptr, {}, journal), InputError);
}



// Boundaries, volumes and manifolds of a triangulation; new vertices lie on the manifold.
TEST(BodyDefinition, FromTriangulation)
{
  Triangulation<3> mesh;
  dealii::GridGenerator::hyper_ball_balanced(mesh, Point<3>(), 2.);
  for (const auto &cell : mesh.active_cell_iterators())
    cell->set_material_id(cell->center()[2] > 0. ? 7 : 3);
  BodyDefinition body = make_body("ball", mesh, {{0, "surface"}}, {{7, "upper half"}});
  EXPECT_EQ(body.mesh.cells.size(), mesh.n_active_cells());
  EXPECT_EQ(body.mesh.boundary_names, std::vector<std::string>{"surface"});
  std::set<std::string> volumes(body.mesh.volume_names.begin(), body.mesh.volume_names.end());
  EXPECT_EQ(volumes, (std::set<std::string>{"upper half", "3"}));
  body.volume_materials = {{"upper half", {5., .2}}};
  Bodies bodies(MPI_COMM_WORLD, {body});
  for (const auto &cell : bodies.triangulation().active_cell_iterators())
    if (!cell->is_artificial())
      {
        EXPECT_EQ(bodies.material(cell->material_id()).young, cell->center()[2] > 0. ? 5. : 1.);
      }
  bodies.triangulation().refine_global(2);
  for (const auto &cell : bodies.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            for (unsigned int v = 0; v < 4; ++v)
              EXPECT_NEAR(face->vertex(v).norm(), 2., 1e-13);
          }
}



TEST(BodyDefinition, FromTetrahedra)
{
  Triangulation<3> cubes, mesh;
  dealii::GridGenerator::subdivided_hyper_cube(cubes, 2);
  dealii::GridGenerator::convert_hypercube_to_simplex_mesh(cubes, mesh);
  const BodyDefinition body = make_body("block", mesh);
  EXPECT_EQ(body.mesh.boundary_names, std::vector<std::string>{"0"});
  const Bodies     bodies(MPI_COMM_WORLD, {body});
  const NodalSpace space(MPI_COMM_WORLD, bodies.mesh());
  EXPECT_EQ(space.n_global_cells(), mesh.n_active_cells());
}



TEST(BodyDefinition, RefusesWhatItCannotUse)
{
  Triangulation<3> mesh;
  dealii::GridGenerator::hyper_cube(mesh);
  BodyDefinition body = make_body("cube", mesh);
  body.material       = {1., .5};
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, {body}), InputError);
  body.material         = {1., .3};
  body.volume_materials = {{"rubber", {1., .3}}};
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, {body}), InputError);
  EXPECT_THROW(Bodies(MPI_COMM_WORLD, {BodyDefinition()}), InputError);
  EXPECT_THROW(ContactModel(MPI_COMM_WORLD, ProblemDefinition()), InputError);
  mesh.refine_global(1);
  mesh.begin_active()->set_refine_flag();
  mesh.execute_coarsening_and_refinement();
  EXPECT_THROW(make_body("cube", mesh), InputError);
  Triangulation<3> wedge;
  dealii::GridGenerator::reference_cell(wedge, dealii::ReferenceCells::Wedge);
  EXPECT_THROW(make_body("wedge", wedge), InputError);
}



// Loads that only a program can hand over: parameter files are refused before.
TEST(ProblemDefinition, RefusesLoadsWithoutNumbers)
{
  const auto error = [](const std::function<void(LoadDefinition &)> &change) -> std::string {
    ProblemDefinition problem = patch_test();
    change(problem.bodies[0].loads);
    try
      {
        const ContactModel model(MPI_COMM_WORLD, std::move(problem));
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "none";
  };
  const std::string strain = error([](LoadDefinition &loads) {
    loads.initial_strains.push_back({"", zero, std::numeric_limits<double>::quiet_NaN()});
  });
  EXPECT_NE(strain.find("the coefficient is not a finite number"), std::string::npos) << strain;
  const std::string bolt = error([](LoadDefinition &loads) {
    loads.pretensions.push_back({"shank", Vector3({0., 0., 1.}), ScalarField()});
  });
  EXPECT_NE(bolt.find("there is no force"), std::string::npos) << bolt;
  const std::string normal = error([](LoadDefinition &loads) {
    loads.displacements.push_back({"top", {{zero, zero, free_component}}, ConditionFrame::normal()});
  });
  EXPECT_NE(normal.find("along a normal there is one component"), std::string::npos) << normal;
}
