// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// A smooth contact problem with a free boundary. With s = x^2 + y^2 - r0^2 the pressure on the plane z = 0 is
// -s^3 inside of the circle s = 0, and outside of it the gap opens by a s^3. Body forces make that the
// solution of linear elasticity; displacements are prescribed on all other sides.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    constexpr double free_radius = .6, opening = 2e-3;

    const std::string s  = "(x^2+y^2-" + number(free_radius * free_radius) + ")";
    const std::string r2 = "(x^2+y^2)";

    /// Displacement and volume force that belong together, as vectors of expressions.
    struct Field
    {
      std::array<std::string, 3> displacement, force;
    };

    /// u = (0, 0, z s^3 / (lambda + 2 mu)): the stress sigma_z = s^3 at z = 0, no shear stress there.
    Field pressed(const LameConstants &m)
    {
      const double      wave = m.lambda + 2. * m.mu;
      const std::string side = number(-6. * (m.lambda + m.mu) / wave);
      return {{{"0", "0", number(1. / wave) + "*z*" + s + "^3"}},
              {{side + "*x*" + s + "^2", side + "*y*" + s + "^2",
                number(-12. * m.mu / wave) + "*z*" + s + "*(3*" + r2 + "-" +
                    number(free_radius * free_radius) + ")"}}};
    }

    /// u = a (-6 x z s^2, -6 y z s^2, s^3): no stress on z = 0 in the direction z, no shear stress there.
    Field lifted(const LameConstants &m, const double a)
    {
      const double      wave = m.lambda + 2. * m.mu, square = free_radius * free_radius;
      const std::string side = number(-6. * a), pull = number(48. * a * wave),
                        bracket = "(3*" + r2 + "-" + number(2. * square) + ")";
      return {{{side + "*x*z*" + s + "^2", side + "*y*z*" + s + "^2", number(a) + "*" + s + "^3"}},
              {{pull + "*x*z*" + bracket, pull + "*y*z*" + bracket,
                number(12. * a * m.lambda) + "*" + s + "*(3*" + r2 + "-" + number(square) + ")"}}};
    }

    /// One inside of the circle, the other outside.
    std::string piecewise(const std::array<std::string, 3> &inside, const std::array<std::string, 3> &outside)
    {
      std::string text;
      for (unsigned int c = 0; c < 3; ++c)
        text += std::string(c == 0 ? "(" : ", ") + "if(" + s + " < 0, " + inside[c] + ", " + outside[c] + ")";
      return text + ")";
    }

    /// A block 2 x 2 x 0.5 above or below the plane z = 0.
    std::string body(const std::string &name, const double young, const double poisson, const bool is_above,
                     const std::string &divisions)
    {
      const LameConstants material(young, poisson);
      // The lower one rests where the gap is open.
      const Field             in = pressed(material), out = lifted(material, is_above ? opening : 0.);
      const ManufacturedBlock block = {name,
                                       is_above ? "-1, -1, 0" : "-1, -1, -0.5",
                                       is_above ? "1, 1, 0.5" : "1, 1, 0",
                                       divisions,
                                       young,
                                       poisson,
                                       {"left", "right", "front", "back", is_above ? "top" : "bottom"}};
      return block_section(block, piecewise(in.displacement, out.displacement),
                           piecewise(in.force, out.force));
    }

    VerificationRun run(const MPI_Comm communicator, const std::string &text, const Settings &settings,
                        const unsigned int mesh)
    {
      const Results results = solve(
          communicator, text, settings + Settings{"Refinement/Global cycles=" + std::to_string(mesh + 1)});
      const DisplacementErrors u        = displacement_errors(results);
      const auto               pressure = [](const dealii::Point<3> &x) {
        return std::pow(std::max(0., free_radius * free_radius - radius(x) * radius(x)), 3);
      };
      const auto square = [](const dealii::Point<3> &x) { return radius(x) * radius(x); };
      // The integral of the pressure is pi r0^8 / 4, its mean square of the radius r0^2 / 5.
      const double force = dealii::numbers::PI * std::pow(free_radius, 8) / 4.,
                   r     = std::sqrt(5. * mean_over_force(results.pressure, square));
      return measured(results, {u.l2, u.energy, pressure_error(results.pressure, pressure),
                                relative_error(std::abs(results.pairs[0].force[2]), force),
                                std::abs(r - free_radius)});
    }

    VerificationProblem problem(const std::string &name, const std::string &what, const std::string &text,
                                const Settings &settings)
    {
      VerificationProblem p;
      p.name       = name;
      p.what       = what;
      p.reference  = "manufactured: pressure (r0^2 - r^2)^3 in a circle, a gap of third power outside";
      p.quantities = {{"L2", "displacement, L2 norm", {.3, .075, .018}, 1.9},
                      {"energy", "displacement, energy norm", {.6, .3, .14}, .95},
                      {"pressure", "nodal pressures, L2 norm", {.4, .12, .034}, 1.5},
                      {"force", "contact force", {.045, .017, .004}, 1.9},
                      {"radius",
                       "radius of the contact area (length), from the moments of the pressure",
                       {.26, .09, .022},
                       1.8}};
      p.meshes     = {"once refined", "twice", "three times"};
      p.n_quick    = 3;
      p.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        return run(communicator, text, settings, mesh);
      };
      return p;
    }
  } // namespace



  std::vector<VerificationProblem> manufactured_problems()
  {
    const std::string obstacle = "set Bodies = body\nset Contact pairs = plane\n" +
                                 body("body", 1., .3, true, "5, 4, 1") +
                                 "subsection Pair plane\n set First = body: bottom\n"
                                 " set Obstacle = plane: (0, 0, 0), (0, 0, 1)\nend\n";
    const std::string two = "set Bodies = upper, lower\nset Contact pairs = plane\n" +
                            body("upper", 1., .3, true, "4, 3, 1") + body("lower", 4., .2, false, "3, 4, 1") +
                            "subsection Pair plane\n set First = upper: bottom\n set Second = lower: top\n"
                            " set Nonmortar = first\nend\n";
    return {
        problem("manufactured-obstacle",
                "A block on a rigid plane, in contact inside of a circle that is to be found.", obstacle, {}),
        problem(
            "manufactured-two",
            "Two blocks of different materials, meshes that do not match, in contact inside of a circle that "
            "is to be found.",
            two, {}),
        problem(
            "manufactured-stiff",
            "Two blocks in contact inside of a circle that is to be found, multipliers on the stiffer one.",
            two, {"Pair plane/Nonmortar=second"}),
        problem(
            "manufactured-tetrahedra",
            "A block of tetrahedra on one of hexahedra, in contact inside of a circle that is to be found.",
            two, {"Body upper/Convert to tetrahedra=true"})};
  }
} // namespace Signorini
