// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// step-2: a contact problem set up in C++. A crowned roller with a polymer tyre is pressed on a steel plate:
// own geometry, meshes from deal.II with a manifold, materials by cell, a pair, a refinement loop of one's
// own, and what one wants to know of the solution. README.md has the introduction and the results.

#include <signorini/algebra/input_error.h>
#include <signorini/application/certificate.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/contact_solve.h>
#include <signorini/application/error_estimate.h>
#include <signorini/application/journal.h>
#include <signorini/application/write_results.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/discretization/level_hierarchy.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <iomanip>
#include <iostream>

namespace Step2
{
  using namespace dealii;
  using namespace Signorini;

  // Lengths in millimetres, forces in newtons: moduli and pressures are in N/mm² (MPa).
  constexpr double bore = 8., rim = 14., radius = 20., length = 15., crown = 100.;



  // The first thing that is ours: a geometry that no library has. The tread is a surface of revolution about
  // the z axis, whose radius falls to both sides like the sagitta of a circle of radius `crown`:
  //   r(z) = radius - z² / (2 crown).
  // A BoundaryShape says which point of the true surface belongs to a point near it, and the normal there.
  // New nodes of refined meshes move to it, and gaps are measured on it and not on the facets of the mesh.
  class Tread : public BoundaryShape
  {
  public:
    Point<3> project(const Point<3> &p) const override
    {
      const double factor = (radius - p[2] * p[2] / (2. * crown)) / std::hypot(p[0], p[1]);
      return Point<3>(factor * p[0], factor * p[1], p[2]);
    }

    Tensor<1, 3> normal(const Point<3> &p, const Tensor<1, 3> &facing) const override
    {
      const double       r = std::hypot(p[0], p[1]);
      const Tensor<1, 3> n({p[0] / r, p[1] / r, p[2] / crown});
      return (n * facing > 0. ? 1. : -1.) / n.norm() * n;
    }
  };



  // The mesh of the roller: any deal.II triangulation of hexahedra (or tetrahedra) without hanging nodes will
  // do. We give names to its boundaries and to its volumes, which are the material ids. There is a plane of
  // symmetry at z = 0, so half of the roller is enough.
  BodyDefinition make_roller()
  {
    Triangulation<3> mesh;
    GridGenerator::cylinder_shell(mesh, length, bore, radius, 16, 2);
    mesh.refine_global(1);
    for (const auto &cell : mesh.active_cell_iterators())
      {
        const Point<3> middle = cell->center();
        cell->set_material_id(std::hypot(middle[0], middle[1]) < rim ? 0 : 1);
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const Point<3> x = face->center();
              face->set_boundary_id(x[2] < 1e-6 * length           ? 0
                                    : x[2] > (1. - 1e-6) * length  ? 1
                                    : std::hypot(x[0], x[1]) < rim ? 2
                                                                   : 3);
            }
      }
    // The manifold that GridGenerator attached, a cylinder about the z axis, comes along for the bore.
    BodyDefinition roller = make_body(
        "roller", mesh, {{0, "symmetry"}, {1, "end"}, {2, "bore"}, {3, "tread"}}, {{0, "core"}, {1, "tyre"}});
    // The tread has its own shape, which takes over from the cylinder. The vertices of the mesh lie on a
    // cylinder, too: snap moves them.
    roller.geometry.push_back({"tread", std::make_shared<const Tread>(), nullptr});
    roller.snap = true;
    // Steel, and polyurethane for the cells of the volume "tyre".
    roller.material         = {210e3, .3};
    roller.volume_materials = {{"tyre", {500., .4}}};
    return roller;
  }



  BodyDefinition make_plate()
  {
    Triangulation<3> mesh;
    GridGenerator::subdivided_hyper_rectangle(mesh, {6, 3, 4}, Point<3>(-15., -35., 0.),
                                              Point<3>(15., -radius, 20.),
                                              /* colorize = */ true);
    BodyDefinition plate = make_body(
        "plate", mesh, {{0, "left"}, {1, "right"}, {2, "bottom"}, {3, "top"}, {4, "symmetry"}, {5, "end"}});
    plate.material = {210e3, .3};
    return plate;
  }



  // Loads are functions of the place; a component that is left empty is free.
  ProblemDefinition make_problem()
  {
    const ScalarField zero = [](const Point<3> &) { return 0.; }, down = [](const Point<3> &) { return -.4; };
    const ScalarField free;
    ProblemDefinition problem;
    problem.bodies.resize(2);
    problem.bodies[0].body                = make_roller();
    problem.bodies[0].loads.displacements = {{"symmetry", {{free, free, zero}}},
                                             {"bore", {{zero, down, free}}}};
    problem.bodies[1].body                = make_plate();
    problem.bodies[1].loads.displacements = {{"symmetry", {{free, free, zero}}},
                                             {"bottom", {{zero, zero, zero}}}};

    PairDefinition pair;
    pair.name   = "contact";
    pair.first  = {"roller", "tread", {}};
    pair.second = {"plate", "top", {}};
    // Only the lowest part of the tread can touch. The library finds the contact zone itself; this only keeps
    // the rest of the tread from being looked at: a face belongs to the surface where the function is
    // positive.
    pair.first.region = [](const Point<3> &x) { return -x[1] - .75 * radius; };
    problem.pairs.push_back(pair);
    return problem;
  }



  // One line for each mesh.
  void print(std::ostream &out, const ConstrainedSpace &space, const ContactSolution &solution,
             const PairResult &pair, const double indicator)
  {
    out << std::setw(8) << space.nodal().n_global_cells() << std::setw(9)
        << dim * space.nodal().n_conforming_nodes() << std::setw(8) << solution.report.iterations
        << std::setw(8) << solution.n_active << std::fixed << std::setprecision(2) << std::setw(10)
        << std::abs(pair.force[1]) << std::setw(8) << pair.max_pressure << std::setw(8) << pair.contact_area
        << std::setprecision(3) << std::setw(11) << indicator << std::defaultfloat << std::endl;
  }



  // The refinement loop. Everything in it is a value with one owner: the model is the problem on its present
  // mesh, a space is that mesh with its conditions, the discretization has the pairs mapped and coupled and
  // does not change any more, the solution is a displacement with multipliers.
  void run(std::ostream &out, const unsigned int n_meshes)
  {
    ContactModel    model(MPI_COMM_WORLD, make_problem());
    Journal         journal;
    SolveParameters parameters;
    // What is kept from mesh to mesh: the levels below, the start, what has been decided about pairs. (With
    // several bodies beside each other on one, part_bodies() looks whether they stay so in a solution.)
    CoarserSpaces           coarser;
    NestedStart             start;
    std::vector<PairChoice> choices;
    auto space = std::make_shared<const ConstrainedSpace>(model, /* with_inner_faces = */ true);
    out << "   cells     dofs   iter.  active     force   p_max    area  indicator\n";
    for (unsigned int cycle = 0; cycle < n_meshes; ++cycle)
      {
        const auto            discretization = discretize(model, space, choices, cycle, journal);
        const ContactSolution solution =
            solve_contact(model, *discretization, coarser, cycle > 0 ? &start : nullptr, parameters, journal);
        AssertThrow(solution.report.converged, ExcMessage(solution.report.note));
        const std::vector<double> indicator = estimate_error(model, *discretization, solution);
        print(out, *space, solution, evaluate_pair(*discretization, solution, 0),
              total_indicator(space->nodal(), indicator));

        if (cycle + 1 == n_meshes)
          {
            // Whether one may believe it: forces and moments balance, nothing penetrates, ...
            const ContactEvaluation evaluation = evaluate_contact(model, *discretization, solution);
            const auto unseen = find_unseen_penetrations(model, *discretization, solution.displacement);
            const Certificate certificate =
                certify(model, *discretization, solution, evaluation, unseen,
                        {parameters.solver.tolerance, /* has_converged = */ true});
            for (const BoundaryResult &boundary : evaluation.equilibrium.reactions)
              out << "reaction of " << boundary.body << ", " << boundary.name << ": " << boundary.reaction
                  << '\n';
            for (const std::string &objection : certificate.objections)
              out << "objection: " << objection << '\n';
            for (const std::string &note : journal.notes())
              out << "note: " << note << '\n';
            OutputFolder folder("step-2-results", MPI_COMM_WORLD);
            write_fields(model, *discretization, solution, OutputParameters(), folder);
            folder.commit();
            return;
          }

        // Any marking will do here: a vector<bool> over the cells of the space. Doerfler's takes the cells
        // that have half of the squared indicators together.
        model.refine(space->nodal(), mark_share_of_error(space->nodal(), indicator, .5));
        const auto next = std::make_shared<const ConstrainedSpace>(model, true);
        const auto rows = interpolation_rows(next->nodal(), space->nodal(), model.bodies().tetrahedra());
        start           = {next->interpolate(solution.displacement, *space, rows),
                           solution.report.needed_interface_sweeps};
        choices         = discretization->choices;
        space           = next;
      }
  }
} // namespace Step2



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool   is_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  std::ostream nowhere(nullptr);
  try
    {
      Step2::run(is_root ? std::cout : nowhere, argc > 1 ? std::stoi(argv[1]) : 8);
    }
  catch (const Signorini::InputError &e)
    {
      if (is_root)
        std::cerr << e.what() << std::endl;
      return 1;
    }
  return 0;
}
