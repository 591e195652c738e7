// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Solutions that the elements have exactly: constant stress, and no stress. Errors are rounding.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    /// Two blocks on top of each other, E = 1000, nu = 0.3, three cells on four. Pushed by 0.01 on a height
    /// of 2 they are under the stress -1000 * 0.005 = -5.
    const char *const blocks = R"(
      set Bodies        = upper, lower
      set Contact pairs = interface
      subsection Body upper
        set Mesh          = block
        set Lower corner  = 0, 0, 0
        set Upper corner  = 1, 1, 1
        set Divisions     = 3, 3, 3
        set Young modulus = 1000
        set Poisson ratio = 0.3
        set Dirichlet     = left: (0, *, *); front: (*, 0, *); top: (*, *, -0.01)
        set Exact displacement = (0.0015*x, 0.0015*y, -0.005*(z+1))
      end
      subsection Body lower
        set Mesh          = block
        set Lower corner  = 0, 0, -1
        set Upper corner  = 1, 1, 0
        set Divisions     = 4, 4, 4
        set Young modulus = 1000
        set Poisson ratio = 0.3
        set Dirichlet     = left: (0, *, *); front: (*, 0, *); bottom: (*, *, 0)
        set Exact displacement = (0.0015*x, 0.0015*y, -0.005*(z+1))
      end
      subsection Pair interface
        set First  = upper: bottom
        set Second = lower: top
      end
    )";

    /// u = -0.001 x, the pressure 0.001 E / (1 - 2 nu) = 2.5 on every plane.
    const char *const shrinking = "(-1e-3*x, -1e-3*y, -1e-3*z)";

    const double shrinking_pressure = 2.5;

    Settings both(const std::string &name, const std::string &value)
    {
      return {"Body upper/" + name + "=" + value, "Body lower/" + name + "=" + value};
    }

    const Settings turned = both("Rotation axis", "1, 2, 3") + both("Rotation angle", "25");

    /// Boundaries with the displacement u = -0.001 x.
    std::string held(const std::vector<std::string> &boundaries)
    {
      std::string text;
      for (const std::string &boundary : boundaries)
        text += boundary + ": " + shrinking + "; ";
      return text;
    }

    Settings cycles(const unsigned int n)
    {
      return {"Refinement/Global cycles=" + std::to_string(n)};
    }

    /// Pressure and displacement of a problem that the elements solve exactly.
    VerificationProblem exact_problem(const std::string &name, const std::string &what,
                                      const std::string &text, const Settings &settings,
                                      const double pressure)
    {
      VerificationProblem problem;
      problem.name       = name;
      problem.what       = what;
      problem.reference  = "constant stress, which the elements have exactly";
      problem.meshes     = {"as described", "once refined"};
      problem.quantities = {{"pressure", "largest error of a nodal pressure", {1e-10}},
                            {"displacement", "L2 norm", {1e-10}}};
      problem.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        const Results results = solve(communicator, text, settings + cycles(mesh));
        return measured(results,
                               {constant_pressure_error(results, pressure), displacement_errors(results).l2});
      };
      return problem;
    }

    VerificationProblem overhang()
    {
      const Settings settings = {"Body lower/Divisions=4, 5, 4", "Body lower/Pressures=top: 5*(x > 0.75)",
                                 "Body upper/Upper corner=0.75, 1, 1", "Body upper/Divisions=2, 3, 3"};
      return exact_problem(
          "patch-overhang",
          "Two blocks pressed together; the lower one sticks out, and that strip is under the pressure "
          "of the contact.",
          blocks, settings, 5.);
    }

    /// No contact at all.
    VerificationProblem separation()
    {
      VerificationProblem problem;
      problem.name       = "separation";
      problem.what       = "Two blocks that touch are pulled apart by a displacement of the upper one.";
      problem.reference  = "no force, no stress; the upper block moves, the lower one rests";
      problem.meshes     = {"3^3 on 4^3 cells", "6^3 on 8^3 cells"};
      problem.quantities = {
          {"force", "contact force, relative to E times area times displacement / height", {1e-11}},
          {"active nodes", "nodes in contact", {0.}},
          {"displacement", "L2 norm", {1e-10}}};
      problem.run = [](const MPI_Comm communicator, const unsigned int mesh) {
        const Settings settings = {
            "Body upper/Dirichlet=left: (0, *, *); front: (*, 0, *); top: (*, *, 0.01)",
            "Body upper/Exact displacement=(0, 0, 0.01)", "Body lower/Exact displacement=(0, 0, 0)"};
        const Results results = solve(communicator, blocks, settings + cycles(mesh));
        // There is no force that the equilibrium could be compared with.
        return certified(results, {results.pairs[0].force.norm() / 10.,
                                   static_cast<double>(results.cycles.back().active_nodes),
                                   displacement_errors(results).l2});
      };
      return problem;
    }
  } // namespace



  std::vector<VerificationProblem> patch_problems()
  {
    const Settings shrinks = both("Exact displacement", shrinking) + turned;
    const Settings all_held =
        Settings{"Body upper/Dirichlet=" + held({"left", "right", "front", "back", "top"}),
                 "Body lower/Dirichlet=" + held({"left", "right", "front", "back", "bottom"})} +
        shrinks;
    const Settings partly_loaded = Settings{"Body upper/Dirichlet=" + held({"left", "top"}),
                                            "Body lower/Dirichlet=" + held({"left", "bottom"})} +
                                   both("Pressures", "right: 2.5; front: 2.5; back: 2.5") + shrinks;
    const Settings hanging = {
        "Refinement/Regions=ball: (0.4, 0.5, 0.3), 0.31, 1; ball: (0.6, 0.5, -0.3), 0.31, 2"};
    return {
        exact_problem("patch-blocks",
                      "Two blocks, 3^3 cells on 4^3, pressed together by a prescribed displacement.", blocks,
                      {}, 5.),
        exact_problem(
            "patch-turned",
            "Two blocks, turned away from the axes of coordinates, under the same pressure from all sides.",
            blocks, all_held, shrinking_pressure),
        exact_problem("patch-hanging",
                      "Two turned blocks, sides loaded instead of held, with hanging nodes on both sides of "
                      "the contact.",
                      blocks, partly_loaded + hanging, shrinking_pressure),
        exact_problem("patch-tetrahedra",
                      "A turned block of tetrahedra on one of hexahedra, refined in part, sides loaded.",
                      blocks, partly_loaded + hanging + Settings{"Body upper/Convert to tetrahedra=true"},
                      shrinking_pressure),
        overhang(),
        separation()};
  }
} // namespace Signorini
