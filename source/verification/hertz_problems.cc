// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Elastic bodies of finite size: Hertz' formulas hold for them as far as the contact is small.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    /// 1 / (sum of (1 - nu^2) / E).
    double contact_modulus(const double young1, const double poisson1, const double young2,
                           const double poisson2)
    {
      return 1. / ((1. - poisson1 * poisson1) / young1 + (1. - poisson2 * poisson2) / young2);
    }

    /// For a quarter of a round contact: the radius, with the mean of r = 3 pi a / 16.
    double radius_from_moment(const std::vector<PressureRow> &rows)
    {
      return 16. / (3. * dealii::numbers::PI) * mean_over_force(rows, radius);
    }

    /// H1: a half-ball in a quarter model, pressed into a cylinder whose size counts.
    const char *const ball_on_block = R"(
      set Bodies        = ball, block
      set Contact pairs = contact
      subsection Body ball
        set Mesh          = quarter of half ball
        set Radius        = 8
        set Translation   = 0, 0, 8
        set Young modulus = 7e3
        set Poisson ratio = 0.3
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); top: (0, 0, -0.02)
      end
      subsection Body block
        set Mesh          = quarter of cylinder
        set Radius        = 8
        set Height        = 8
        set Element       = standard
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); bottom: (0, 0, 0)
      end
      subsection Pair contact
        set First         = ball: sphere
        set Second        = block: top
        set Nonmortar     = first
        set First region  = 4 - x^2 - y^2
        set Second region = 9 - x^2 - y^2
      end
      subsection Refinement
        set Initial global levels = 1
        set Global cycles         = 1
        set Regions               = ball: (0, 0, 0), 3, 1; ball: (0, 0, 0), 1.5, 2; ball: (0, 0, 0), 0.7, 3; ball: (0, 0, 0), 0.45, 4
      end
    )";

    VerificationProblem on_plane(const std::string &name, const std::string &what, const Settings &materials,
                                 const double force, const double a, const double p0)
    {
      VerificationProblem problem;
      problem.name       = name;
      problem.what       = what;
      problem.reference  = "an axisymmetric solution of this geometry (H1, doc/verification.md)";
      problem.quantities = {
          {"force", "contact force", {.035, .01, .003}, 1.},
          {"radius", "of the contact area, from the moment of the pressure", {.03, .01, .007}, 1.},
          {"largest pressure", "from force and radius", {.03, .01, .01}, 0.}};
      problem.meshes = {"2 cells on the contact radius", "4 cells", "8 cells"};
      problem.run    = [=](const MPI_Comm communicator, const unsigned int mesh) {
        const Results results =
            solve(communicator, ball_on_block,
                     materials + Settings{"Refinement/Final global cycles=" + std::to_string(mesh)});
        const double f = std::abs(results.pairs[0].force[2]), r = radius_from_moment(results.pressure);
        return measured(results, {relative_error(f, force), relative_error(r, a),
                                  relative_error(6. * f / (dealii::numbers::PI * r * r), p0)});
      };
      return problem;
    }

    const char *const two_balls = R"(
      set Bodies        = upper, lower
      set Contact pairs = contact
      subsection Body upper
        set Mesh          = quarter of half ball
        set Radius        = 8
        set Translation   = 0, 0, 8
        set Young modulus = 7e3
        set Poisson ratio = 0.3
        set Dirichlet     = -x: (0, *, *); -y: (*, 0, *); +z: (0, 0, -0.02)
      end
      subsection Body lower
        set Mesh           = quarter of half ball
        set Radius         = 12
        set Rotation axis  = 1, 1, 0
        set Rotation angle = 180
        set Translation    = 0, 0, -12
        set Young modulus  = 2e4
        set Poisson ratio  = 0.25
        set Dirichlet      = -x: (0, *, *); -y: (*, 0, *); -z: (0, 0, 0)
      end
      subsection Pair contact
        set First         = upper: sphere
        set Second        = lower: sphere
        set First region  = 4 - x^2 - y^2
        set Second region = 9 - x^2 - y^2
      end
      subsection Refinement
        set Initial global levels = 1
        set Global cycles         = 1
        set Regions               = ball: (0, 0, 0), 3, 1; ball: (0, 0, 0), 1.5, 2; ball: (0, 0, 0), 0.7, 3; ball: (0, 0, 0), 0.4, 4
      end
    )";

    VerificationRun run_balls(const MPI_Comm communicator, const unsigned int mesh)
    {
      const Results results =
          solve(communicator, two_balls, {"Refinement/Final global cycles=" + std::to_string(mesh)});
      const double force = 4. * std::abs(results.pairs[0].force[2]), relative_radius = 8. * 12. / (8. + 12.),
                   modulus = contact_modulus(7e3, .3, 2e4, .25),
                   a       = std::cbrt(3. * force * relative_radius / (4. * modulus)),
                   p0      = 3. * force / (2. * dealii::numbers::PI * a * a);
      const auto pressure  = [&](const dealii::Point<3> &x) {
        return p0 * std::sqrt(std::max(0., 1. - std::pow(radius(x) / a, 2)));
      };
      std::vector<PressureRow> inside;
      for (const PressureRow &row : results.pressure)
        if (radius(row.position) < .9 * a)
          inside.push_back(row);
      return measured(results,
                      {relative_error(radius_from_moment(results.pressure), a),
                       relative_error(results.pairs[0].max_pressure, p0), pressure_error(inside, pressure),
                       pressure_error(results.pressure, pressure)});
    }

    VerificationProblem spheres()
    {
      VerificationProblem problem;
      problem.name       = "hertz-spheres";
      problem.what       = "Two half-balls of different radii and materials, a quarter model.";
      problem.reference  = "Hertz' formulas for the computed force";
      problem.quantities = {
          {"radius", "of the contact area, from the moment of the pressure", {.02, .01, .007}},
          {"largest pressure", "at a node", {.05, .025, .015}},
          {"inside", "nodal pressures up to 0.9 of the radius, L2 norm", {.055, .016, .007}, 1.},
          {"pressure", "all nodal pressures, L2 norm", {.08, .07, .03}}};
      problem.meshes = {"3 cells on the contact radius", "6 cells", "12 cells"};
      problem.run    = run_balls;
      return problem;
    }

    /// A half cylinder on a block in plane strain, the halves x >= 0, a slab.
    const char *const cylinder_on_block = R"(
      set Bodies        = cylinder, block
      set Contact pairs = line
      subsection Body cylinder
        set Mesh            = half of half cylinder
        set Radius          = 10
        set Height          = 0.2
        set Grading         = (0, -10, 0), 12
        set Rotation axis   = 1, 0, 0
        set Rotation angle  = 90
        set Translation     = 0, 0.2, 10
        set Young modulus   = 1000
        set Poisson ratio   = 0.3
        set Dirichlet       = symmetry x: (0, *, *); start: (*, 0, *); end: (*, 0, *); flat: (*, *, -0.1)
      end
      subsection Body block
        set Mesh            = block
        set Lower corner    = 0, 0, -10
        set Upper corner    = 10, 0.2, 0
        set Grading         = (0, 0, 0), 12
        set Young modulus   = 1000
        set Poisson ratio   = 0.3
        set Dirichlet       = -x: (0, *, *); -y: (*, 0, *); +y: (*, 0, *); -z: (*, *, 0)
      end
      subsection Pair line
        set First  = cylinder: outer
        set Second = block: top
      end
    )";

    VerificationRun run_cylinder(const MPI_Comm communicator, const unsigned int mesh)
    {
      const auto    n = [mesh](const unsigned int cells) { return std::to_string(cells << mesh); };
      const Results results =
          solve(communicator, cylinder_on_block,
                {"Body cylinder/Round divisions=" + n(12) + ", " + n(40) + ", 1",
                 "Body block/Divisions=" + n(20) + ", 1, " + n(12), "Refinement/Global cycles=1"});
      const double r = 10., depth = .2, modulus = contact_modulus(1000., .3, 1000., .3),
                   // Both halves, by depth.
          force               = 2. * results.pairs[0].load / depth,
                   half_width = std::sqrt(4. * force * r / (dealii::numbers::PI * modulus)),
                   p0         = std::sqrt(force * modulus / (dealii::numbers::PI * r));
      // For p0 sqrt(1 - (x / b)^2) the mean of x^2 is (b / 2)^2.
      const double square =
          mean_over_force(results.pressure, [](const dealii::Point<3> &x) { return x[0] * x[0]; });
      return measured(results, {relative_error(2. * std::sqrt(square), half_width),
                                relative_error(results.pairs[0].max_pressure, p0)});
    }

    VerificationProblem cylinders()
    {
      VerificationProblem problem;
      problem.name       = "hertz-cylinder";
      problem.what       = "A half cylinder on a block in plane strain: line contact.";
      problem.reference  = "Hertz' formulas for the computed force";
      problem.quantities = {{"half width", "from the second moment of the pressure", {.025, .01}},
                            {"largest pressure", "at a node", {.02, .01}}};
      problem.meshes     = {"80 cells around the quarter, graded", "160 cells"};
      problem.n_quick    = 1;
      problem.run        = run_cylinder;
      return problem;
    }
  } // namespace



  std::vector<VerificationProblem> hertz_problems()
  {
    return {on_plane("hertz-stiff", "A half-ball pressed into a block of a hundredfold stiffness.",
                     {"Body block/Young modulus=6.896e5", "Body block/Poisson ratio=0.45"}, 20.820, .4031,
                     244.63),
            on_plane("hertz-same", "A half-ball pressed into a block of the same material.",
                     {"Body block/Young modulus=7e3", "Body block/Poisson ratio=0.3"}, 10.638, .4047, 124.01),
            spheres(), cylinders()};
  }
} // namespace Signorini
