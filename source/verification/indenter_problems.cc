// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Rigid axisymmetric indenters f(r) on an elastic half-space (Sneddon 1965). With
// g(x) = x int_0^x f'(r) (x^2 - r^2)^(-1/2) dr and the contact radius a, the depth is g(a), the force
// 2 E* int_0^a (g(a) - g) dx, and the pressure (E* / pi) int_r^a g'(x) (x^2 - r^2)^(-1/2) dx.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    constexpr double young = 1000., poisson = .3, modulus = young / (1. - poisson * poisson);

    struct Indenter
    {
      /// f as an expression, g and g', the contact radius; g vanishes up to `flat`; the pressure is looked at
      /// from `apex` on, where it is not singular.
      std::string                   shape;
      std::function<double(double)> g, slope;
      double                        a, flat = 0., apex = 0.;

      double depth() const
      {
        return g(a);
      }

      double force() const
      {
        return 2. * modulus * (a * depth() - integral(g, flat, a));
      }

      double pressure(const double r) const
      {
        if (r >= a)
          return 0.;
        // x^2 = r^2 + u^2.
        const auto f = [&](const double u) { return slope(std::hypot(r, u)) / std::hypot(r, u); };
        return modulus / dealii::numbers::PI *
               integral(f, std::sqrt(std::max(0., flat * flat - r * r)), std::sqrt(a * a - r * r));
      }

      /// The mean of the squared radius, weighted with the pressure.
      double mean_square() const
      {
        return 2. * dealii::numbers::PI *
               integral([&](const double r) { return pressure(r) * r * r * r; }, 0., a) / force();
      }
    };

    /// A quarter of a block 0 < x, y < size, -size < z < 0; far away the displacement is that of the force at
    /// the origin (Boussinesq), which costs 0.1 %.
    std::string block_under(const Indenter &indenter)
    {
      const double      size = 8. * indenter.a;
      const std::string r = "sqrt(x^2+y^2+z^2)", n = std::to_string(size),
                        factor =
                            number(indenter.force() * (1. + poisson) / (2. * dealii::numbers::PI * young)),
                        side =
                            "((-z)/" + r + "^3-" + number(1. - 2. * poisson) + "/(" + r + "*(" + r + "-z)))",
                        far = "(" + factor + "*x*" + side + ", " + factor + "*y*" + side + ", -" + factor +
                              "*(z^2/" + r + "^3+" + number(2. * (1. - poisson)) + "/" + r + "))";
      std::string regions;
      for (const auto &[share, level] : {std::pair(.5, 1), {.25, 2}, {.19, 3}})
        regions += (level > 1 ? "; " : "") + std::string("ball: (0, 0, 0), ") + std::to_string(share * size) +
                   ", " + std::to_string(level);
      return "set Bodies = block\nset Contact pairs = top\nsubsection Body block\n set Mesh = block\n"
             " set Lower corner = 0, 0, -" +
             n + "\n set Upper corner = " + n + ", " + n +
             ", 0\n"
             " set Divisions = 4, 4, 4\n set Young modulus = " +
             std::to_string(young) + "\n set Poisson ratio = " + std::to_string(poisson) +
             "\n set Dirichlet = right: " + far + "; back: " + far + "; bottom: " + far +
             "; left: (0, *, *); front: (*, 0, *)\nend\n"
             "subsection Pair top\n set First = block: top\n set Obstacle = function: " +
             indenter.shape + " - " + number(indenter.depth()) +
             " - z\n"
             "set Initial penetration = resolve\nend\n"
             "subsection Refinement\n set Regions = " +
             regions + "\nend\n";
    }

    VerificationRun run(const MPI_Comm communicator, const Indenter &indenter, const Settings &settings,
                        const unsigned int mesh)
    {
      const Results results =
          solve(communicator, block_under(indenter),
                settings + Settings{"Refinement/Final global cycles=" + std::to_string(mesh)});
      std::vector<PressureRow> outside;
      double                   closed = 0.;
      for (const PressureRow &row : results.pressure)
        {
          if (radius(row.position) >= indenter.apex)
            outside.push_back(row);
          if (row.active)
            closed = std::max(closed, radius(row.position));
        }
      const double square =
          mean_over_force(results.pressure, [](const dealii::Point<3> &x) { return radius(x) * radius(x); });
      const double h = 8. * indenter.a / 32. / (1u << mesh);
      return measured(
          results,
          {relative_error(4. * std::abs(results.pairs[0].force[2]), indenter.force()),
           std::abs(std::sqrt(square / indenter.mean_square()) - 1.),
           pressure_error(outside, [&](const dealii::Point<3> &x) { return indenter.pressure(radius(x)); }),
           std::abs(closed - indenter.a) / h});
    }

    /// The least orders of force, radius and pressure.
    struct Orders
    {
      double force = 1.8, radius = 1.1, pressure = 1.;
    };

    /// What is far away costs 0.1 %: no order is asked for where the last error is about that.
    VerificationProblem problem(const std::string &name, const std::string &what, const Indenter &indenter,
                                const Orders &orders, const Settings &settings = {})
    {
      VerificationProblem p;
      p.name       = name;
      p.what       = what;
      p.reference  = "Sneddon's solution for the half-space";
      p.quantities = {{"force", "at the depth of the exact solution", {.02, .006, 1.5e-3}, orders.force},
                      {"radius", "of the second moment of the pressure", {.02, .005, 1e-3}, orders.radius},
                      {"pressure", "nodal pressures, L2 norm", {.4, .18, .065}, orders.pressure},
                      {"edge", "distance of the last active node from the contact radius, in cells", {1.}}};
      p.meshes     = {"4 cells on the contact radius", "8 cells", "16 cells"};
      p.n_quick    = 3;
      p.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        return run(communicator, indenter, settings, mesh);
      };
      return p;
    }
  } // namespace



  std::vector<VerificationProblem> indenter_problems()
  {
    const Indenter paraboloid = {"(x^2+y^2)/2", [](const double x) { return x * x; },
                                 [](const double x) { return 2. * x; }, .2};
    const Indenter cone       = {"0.05*sqrt(x^2+y^2)",
                                 [](const double x) { return .025 * dealii::numbers::PI * x; },
                                 [](const double) { return .025 * dealii::numbers::PI; },
                                 .2,
                                 0.,
                                 .05};
    const Indenter quartic    = {"(x^2+y^2)^2", [](const double x) { return 8. / 3. * std::pow(x, 4); },
                                 [](const double x) { return 32. / 3. * std::pow(x, 3); }, .2};
    // A flat of the radius 0.1 with a rounded edge of the radius 0.5.
    const auto       root  = [](const double x) { return std::sqrt(std::max(0., x * x - .01)); };
    const auto       arc   = [](const double x) { return .1 * std::acos(std::min(1., .1 / x)); };
    const Indenter   punch = {"max(sqrt(x^2+y^2)-0.1, 0)^2",
                              [=](const double x) { return 2. * x * (root(x) - arc(x)); },
                              [=](const double x) { return 2. * (2. * root(x) - arc(x)); }, .13, .1};
    constexpr double any   = VerifiedQuantity::any_order;
    return {
        problem("hertz-half-space", "A rigid paraboloid on a half-space: Hertz' sphere on a plane.",
                paraboloid, {}),
        problem("indenter-cone", "A rigid cone on a half-space.", cone, {}),
        problem(
            "indenter-quartic",
            "A rigid indenter of fourth power on a half-space; the largest pressure is not in the centre.",
            quartic, {}),
        problem("indenter-tetrahedra", "A rigid indenter of fourth power on a half-space of tetrahedra.",
                quartic, {1.8, any, .85}, {"Body block/Convert to tetrahedra=true"}),
        problem("indenter-punch", "A rigid flat punch with a rounded edge on a half-space.", punch,
                {any, any, 1.})};
  }
} // namespace Signorini
