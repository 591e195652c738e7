// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Two pairs that meet in the edge of a block that lies on a floor and against a wall.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    const std::vector<ManufacturedBlock> corner_bodies = {
        {"block", "0, 0, 0", "1, 1, 1", "3, 3, 3", 1000., .3, {"right", "front", "back", "top"}},
        {"floor", "0, 0, -1", "1, 1, 0", "4, 4, 4", 3000., .2, {"left", "right", "front", "back", "bottom"}},
        {"wall", "-1, 0, 0", "0, 1, 1", "2, 4, 5", 2000., .35, {"left", "bottom", "front", "back", "top"}}};

    constexpr double strain = 1e-3;

    /// lambda + mu of the block: the pressure is 2 e (lambda + mu) cos x cos y cos z in all bodies.
    double stiffness(const ManufacturedBlock &body)
    {
      const LameConstants m(body.young, body.poisson);
      return m.lambda + m.mu;
    }

    /// u = -e (sin x cos y cos z, 0, cos x cos y sin z) has no shear stress and no normal displacement on x =
    /// 0 and on z = 0: the bodies slide on each other.
    std::string section(const ManufacturedBlock &body)
    {
      const LameConstants m(body.young, body.poisson);
      const double        e = strain * stiffness(corner_bodies[0]) / stiffness(body);
      const std::string   u = "(" + number(-e) + "*sin(x)*cos(y)*cos(z), 0, " + number(-e) +
                            "*cos(x)*cos(y)*sin(z))",
                        f = number(-e * (2. * m.lambda + 5. * m.mu));
      return block_section(body, u,
                           "(" + f + "*sin(x)*cos(y)*cos(z), " + number(-2. * e * (m.lambda + m.mu)) +
                               "*cos(x)*sin(y)*cos(z), " + f + "*cos(x)*cos(y)*sin(z))");
    }

    std::string corner()
    {
      std::string text = "set Bodies = block, floor, wall\nset Contact pairs = below, beside\n";
      for (const ManufacturedBlock &body : corner_bodies)
        text += section(body);
      return text + R"(
        subsection Pair below
          set First     = block: bottom
          set Second    = floor: top
          set Nonmortar = first
        end
        subsection Pair beside
          set First     = block: left
          set Second    = wall: right
          set Nonmortar = first
        end
      )";
    }

    VerificationRun run(const MPI_Comm communicator, const Settings &settings, const unsigned int mesh)
    {
      const Results            results = solve(communicator, corner(),
                                               settings + Settings{"Refinement/Global cycles=" + std::to_string(mesh)});
      const DisplacementErrors u       = displacement_errors(results);
      const double             scale   = 2. * strain * stiffness(corner_bodies[0]),
                   force               = scale * std::pow(std::sin(1.), 2);
      const auto pressure              = [&](const dealii::Point<3> &x) {
        return scale * std::cos(x[0]) * std::cos(x[1]) * std::cos(x[2]);
      };
      return measured(results, {u.l2, u.energy, pressure_error(results.pressure, pressure),
                                larger_error(relative_error(std::abs(results.pairs[0].force[2]), force),
                                             relative_error(std::abs(results.pairs[1].force[0]), force))});
    }

    VerificationProblem problem(const std::string &name, const std::string &what, const Settings &settings)
    {
      VerificationProblem p;
      p.name       = name;
      p.what       = what;
      p.reference  = "manufactured: trigonometric functions that slide along both planes";
      p.quantities = {{"L2", "displacement, L2 norm", {.033, .0082, .002}, 1.9},
                      {"energy", "displacement, energy norm", {.08, .038, .018}, .95},
                      {"pressure", "nodal pressures, L2 norm", {.04, .0125, .0035}, 1.},
                      {"force", "of either pair", {.036, .0135, .004}, 1.}};
      p.meshes     = {"as described", "once refined", "twice"};
      p.n_quick    = 3;
      p.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        return run(communicator, settings, mesh);
      };
      return p;
    }
  } // namespace



  std::vector<VerificationProblem> corner_problems()
  {
    return {problem("corner-nonmortar",
                    "A block of 3^3 cells in the corner of a floor and a wall: two contact pairs that meet "
                    "in an edge "
                    "of the block.",
                    {}),
            problem("corner-mixed",
                    "A block in the corner of a floor and a wall, multipliers on the block in one pair and "
                    "on the wall in the other.",
                    {"Pair beside/Nonmortar=second"})};
  }
} // namespace Signorini
