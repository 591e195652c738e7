// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The discrete obstacle problem itself: energies and active nodes that independent programs found for the
// same elements and meshes (doc/verification.md, reference problems). They have ten digits or more.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    /// S1: a cube on a rigid paraboloid.
    const char *const one_body = R"(
      set Bodies        = cube
      set Contact pairs = bottom
      subsection Body cube
        set Mesh          = block
        set Divisions     = 2, 2, 2
        set Young modulus = 1
        set Poisson ratio = 0.3
        set Dirichlet     = top: (0, 0, 0)
      end
      subsection Pair bottom
        set First    = cube: bottom
        set Obstacle = paraboloid: (0.5, 0.5, 0.05), (0, 0, 1), 0.5
        set Gap      = nodal
        set Initial penetration = resolve
      end
    )";

    /// M1: two cubes with a prescribed gap.
    const char *const two_bodies = R"(
      set Bodies        = upper, lower
      set Contact pairs = interface
      subsection Body upper
        set Mesh          = block
        set Divisions     = 3, 3, 3
        set Young modulus = 7e3
        set Poisson ratio = 0.3
        set Dirichlet     = top: (0, 0, -0.05)
      end
      subsection Body lower
        set Mesh          = block
        set Lower corner  = 0, 0, -1
        set Upper corner  = 1, 1, 0
        set Divisions     = 2, 2, 2
        set Young modulus = 6.896e5
        set Poisson ratio = 0.45
        set Element       = standard
        set Dirichlet     = bottom: (0, 0, 0)
      end
      subsection Pair interface
        set First       = upper: bottom
        set Second      = lower: top
        set Nonmortar   = first
        set Initial gap = (x-0.5)^2 + (y-0.5)^2
      end
    )";

    /// What independent programs found on a mesh.
    struct Found
    {
      double energy;
      int    active_nodes;
    };

    VerificationProblem discrete_problem(const std::string &text, const std::vector<Found> &found,
                                         const double digits)
    {
      VerificationProblem problem;
      problem.reference  = "independent programs on the same elements and meshes (doc/verification.md)";
      problem.quantities = {{"energy", "of the solution", {digits}},
                            {"active nodes", "difference of their number", {0.}}};
      problem.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        const Results results =
            solve(communicator, text, {"Refinement/Global cycles=" + std::to_string(mesh + 2)});
        const CycleResult &cycle = results.cycles.back();
        return measured(results,
                               {relative_error(cycle.nonlinear.energy, found[mesh].energy),
                         std::abs(static_cast<double>(cycle.active_nodes) - found[mesh].active_nodes)});
      };
      return problem;
    }
  } // namespace



  std::vector<VerificationProblem> obstacle_problems()
  {
    VerificationProblem s1 = discrete_problem(
        one_body, {{2.110394093511e-4, 9}, {2.328860217949e-4, 21}, {2.360079949137e-4, 89}}, 1e-10);
    s1.name   = "obstacle-paraboloid";
    s1.what   = "A cube pressed on a rigid paraboloid: the Signorini problem (S1).";
    s1.meshes = {"8^3 cells", "16^3 cells", "32^3 cells"};

    VerificationProblem m1 =
        discrete_problem(two_bodies, {{-1.395805179203e2, 13}, {-2.810125018392e2, 49}}, 2e-10);
    m1.name = "obstacle-cubes";
    m1.what = "Two cubes of a hundredfold stiffness, meshes 3 to 2, with a parabolic gap between them (M1).";
    m1.meshes = {"12^3 on 8^3 cells", "24^3 on 16^3 cells"};
    return {s1, m1};
  }
} // namespace Signorini
