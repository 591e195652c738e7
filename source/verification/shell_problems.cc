// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Spherical shells inside of each other, without friction: curved surfaces that slide, whose gap is that of
// the true spheres.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    /// Radii of the two shells, (E, nu) of the inner and of the outer one.
    constexpr std::array<double, 3> radii       = {{.5, .75, 1.}};
    constexpr double                young_of[2] = {1000., 2000.}, poisson_of[2] = {.3, .2};
    /// The outside is under the pressure load[0] + load[1] P2(cos t), t the angle from the z axis.
    constexpr double load[2] = {10., 4.};

    /// A solution without body forces: u_r = U r^power P_n, u_t = V r^power dP_n/dt.
    struct Mode
    {
      double u, v;
      int    power;
    };

    /// Those of n = 0 and n = 2.
    std::vector<Mode> modes(const unsigned int n, const double nu)
    {
      if (n == 0)
        return {{1., 0., 1}, {1., 0., -2}};
      return {
          {12. * nu, 7. - 4. * nu, 3}, {2., 1., 1}, {2. * (5. - 4. * nu), 2. - 4. * nu, -2}, {-3., 1., -4}};
    }

    /// u_r, u_t and the stresses rr, rt of a mode at r, without the angular functions.
    std::array<double, 4> values(const Mode &m, const unsigned int n, const unsigned int body, const double r)
    {
      const LameConstants material(young_of[body], poisson_of[body]);
      const double        slope = std::pow(r, m.power - 1);
      return {
          {m.u * std::pow(r, m.power), m.v * std::pow(r, m.power),
           (material.lambda * ((m.power + 2) * m.u - n * (n + 1.) * m.v) + 2. * material.mu * m.power * m.u) *
               slope,
           material.mu * (m.u + (m.power - 1) * m.v) * slope}};
    }

    /// The coefficients of the modes of n = 0 or n = 2 in both bodies, and the contact pressure's share.
    struct Solution
    {
      std::array<std::vector<double>, 2> coefficients;
      double                             pressure;
    };

    Solution solve_shells(const unsigned int n)
    {
      const double                     a = radii[0], b = radii[1], c = radii[2];
      const std::vector<Mode>          inner = modes(n, poisson_of[0]), outer = modes(n, poisson_of[1]);
      std::vector<std::vector<double>> matrix;
      std::vector<double>              right;
      // Value k at r in the inner shell (factor in), less that in the outer one (factor out).
      const auto require = [&](const double in, const double out, const double r, const unsigned int k,
                               const double value) {
        matrix.emplace_back();
        for (const Mode &m : inner)
          matrix.back().push_back(in * values(m, n, 0, r)[k]);
        for (const Mode &m : outer)
          matrix.back().push_back(-out * values(m, n, 1, r)[k]);
        right.push_back(value);
      };
      require(1., 0., a, 2, 0.);
      require(0., -1., c, 2, -load[n == 0 ? 0 : 1]);
      require(1., 1., b, 0, 0.);
      require(1., 1., b, 2, 0.);
      if (n > 0)
        {
          require(1., 0., a, 3, 0.);
          require(1., 0., b, 3, 0.);
          require(0., -1., b, 3, 0.);
          require(0., -1., c, 3, 0.);
        }
      const std::vector<double> x      = solve_dense(matrix, right);
      const auto                middle = x.begin() + static_cast<std::ptrdiff_t>(inner.size());
      Solution                  solution{{{{x.begin(), middle}, {middle, x.end()}}}, 0.};
      for (unsigned int i = 0; i < inner.size(); ++i)
        solution.pressure -= x[i] * values(inner[i], n, 0, b)[2];
      return solution;
    }

    /// The displacement of one of the bodies, as a vector of expressions.
    std::string displacement(const Solution &constant, const Solution &curved, const unsigned int body)
    {
      const std::string r = "sqrt(x^2+y^2+z^2)", p2 = "(1.5*z^2/(x^2+y^2+z^2)-0.5)";
      const auto        series = [&](const Solution &s, const unsigned int n, const bool radial) {
        const std::vector<Mode> m = modes(n, poisson_of[body]);
        std::string             text;
        for (unsigned int i = 0; i < m.size(); ++i)
          text += (i == 0 ? "" : "+") + number(s.coefficients[body][i] * (radial ? m[i].u : m[i].v)) + "*" +
                  r + "^(" + std::to_string(m[i].power) + ")";
        return "(" + text + ")";
      };
      const std::string radial =
                            "(" + series(constant, 0, true) + "+" + series(curved, 2, true) + "*" + p2 + ")",
                        along = series(curved, 2, false);
      // dP2/dt = -3 sin t cos t, in the direction (cos t x / rho, cos t y / rho, -sin t).
      const std::string side = "(" + radial + "-3*" + along + "*z^2/(x^2+y^2+z^2))/" + r;
      return "(x*" + side + ", y*" + side + ", z*(" + radial + "+3*" + along + "*(x^2+y^2)/(x^2+y^2+z^2))/" +
             r + ")";
    }

    /// Two whole shells, displacements prescribed on the free surfaces, the inner mesh turned in the outer
    /// one.
    std::string shells(const Solution &constant, const Solution &curved)
    {
      std::string text = "set Bodies = inner, outer\nset Contact pairs = contact\n";
      for (unsigned int body = 0; body < 2; ++body)
        {
          const std::string name = body == 0 ? "inner" : "outer", u = displacement(constant, curved, body);
          text += "subsection Body " + name +
                  "\n set Mesh = spherical shell\n set Inner radius = " + std::to_string(radii[body]) +
                  "\n set Radius = " + std::to_string(radii[body + 1]) +
                  "\n set Young modulus = " + std::to_string(young_of[body]) +
                  "\n set Poisson ratio = " + std::to_string(poisson_of[body]) +
                  "\n set Dirichlet = " + name + ": " + u + "\n set Exact displacement = " + u + "\nend\n";
        }
      return text + R"(
        subsection Body inner
          set Rotation axis  = 1, 2, 3
          set Rotation angle = 25
        end
        subsection Pair contact
          set First     = inner: outer
          set Second    = outer: inner
          set Nonmortar = first
        end
      )";
    }

    VerificationProblem turned_shells(const std::string &name, const std::string &what,
                                      const Settings &settings, const unsigned int n_quick)
    {
      const Solution      constant = solve_shells(0), curved = solve_shells(2);
      const std::string   text = shells(constant, curved);
      VerificationProblem problem;
      problem.name       = name;
      problem.what       = what;
      problem.reference  = "closed solution: polynomials in r for the angular modes P0 and P2 of both shells";
      problem.quantities = {{"L2", "displacement, L2 norm", {.06, .015, .0037}, 1.9},
                            {"energy", "displacement, energy norm", {.22, .11, .055}, .95},
                            {"pressure", "nodal pressures, L2 norm", {.2, .07, .028}, 1.},
                            {"open nodes", "contact nodes that are not active", {0.}}};
      problem.meshes     = {"once refined", "twice", "three times"};
      problem.n_quick    = n_quick;
      problem.run        = [=](const MPI_Comm communicator, const unsigned int mesh) {
        const Results results = solve(
                   communicator, text, settings + Settings{"Refinement/Global cycles=" + std::to_string(mesh + 1)});
        const DisplacementErrors u        = displacement_errors(results);
        const auto               pressure = [&](const dealii::Point<3> &x) {
          return constant.pressure + curved.pressure * (1.5 * x[2] * x[2] / x.square() - .5);
        };
        const CycleResult &cycle = results.cycles.back();
        return measured(results, {u.l2, u.energy, pressure_error(results.pressure, pressure),
                                  static_cast<double>(cycle.contact_nodes - cycle.active_nodes)});
      };
      return problem;
    }

    /// Octants 1 < r < 1.5 < r < 2.5 under the pressure 10 inside: u_r = A r + B / r^2.
    const char *const lame_shells = R"(
      set Bodies        = inner, outer
      set Contact pairs = contact
      subsection Body inner
        set Mesh          = eighth of spherical shell
        set Inner radius  = 1
        set Radius        = 1.5
        set Young modulus = 1000
        set Poisson ratio = 0.3
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); symmetry z: (*, *, 0)
        set Pressures     = inner: 10
      end
      subsection Body outer
        set Mesh          = eighth of spherical shell
        set Inner radius  = 1.5
        set Radius        = 2.5
        set Young modulus = 2000
        set Poisson ratio = 0.25
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); symmetry z: (*, *, 0)
      end
      subsection Pair contact
        set First     = inner: outer
        set Second    = outer: inner
        set Nonmortar = first
      end
    )";

    /// A and B of both shells, and the contact pressure.
    std::pair<std::vector<double>, double> solve_lame()
    {
      const double a = 1., b = 1.5, c = 2.5;
      // sigma_rr = E / (1 - 2 nu) A - 4 mu B / r^3.
      const double              k1 = 1000. / .4, m1 = 500. / 1.3, k2 = 2000. / .5, m2 = 1000. / 1.25;
      const std::vector<double> x =
          solve_dense({{k1, -4. * m1 / std::pow(a, 3), 0., 0.},
                       {0., 0., k2, -4. * m2 / std::pow(c, 3)},
                       {k1, -4. * m1 / std::pow(b, 3), -k2, 4. * m2 / std::pow(b, 3)},
                       {b, 1. / (b * b), -b, -1. / (b * b)}},
                      {-10., 0., 0., 0.});
      return {x, -(k1 * x[0] - 4. * m1 * x[1] / std::pow(b, 3))};
    }

    VerificationProblem lame()
    {
      const auto [x, pressure] = solve_lame();
      Settings exact;
      for (unsigned int body = 0; body < 2; ++body)
        {
          const std::string field =
              "(" + number(x[2 * body]) + "+" + number(x[2 * body + 1]) + "*(x^2+y^2+z^2)^(-1.5))";
          exact.push_back(std::string("Body ") + (body == 0 ? "inner" : "outer") + "/Exact displacement=(" +
                          field + "*x, " + field + "*y, " + field + "*z)");
        }
      VerificationProblem problem;
      problem.name       = "shells-lame";
      problem.what       = "Octants of two shells, the inner one under a pressure from inside.";
      problem.reference  = "Lamé's solution for both shells";
      problem.quantities = {{"L2", "displacement, L2 norm", {.115, .03, .0076}, 1.9},
                            {"energy", "displacement, energy norm", {.31, .16, .08}, .9},
                            {"mean pressure", "of the contact, from the force", {.115, .03, .0075}, 1.9},
                            {"pressure", "largest error of a nodal pressure", {.085, .03, .01}}};
      problem.meshes     = {"once refined", "twice", "three times"};
      problem.n_quick    = 3;
      problem.run        = [exact = exact, pressure = pressure](const MPI_Comm     communicator,
                                                         const unsigned int mesh) {
        const Results results =
            solve(communicator, lame_shells,
                         exact + Settings{"Refinement/Global cycles=" + std::to_string(mesh + 1)});
        const DisplacementErrors u = displacement_errors(results);
        // An eighth of the sphere is pi r^2 / 4 in the projection along z.
        const double mean = std::abs(results.pairs[0].force[2]) / (dealii::numbers::PI * 1.5 * 1.5 / 4.);
        return measured(results, {u.l2, u.energy, relative_error(mean, pressure),
                                  constant_pressure_error(results, pressure)});
      };
      return problem;
    }
  } // namespace



  std::vector<VerificationProblem> shell_problems()
  {
    return {
        lame(),
        turned_shells(
            "shells-turned",
            "Two whole shells under a pressure that varies, one mesh turned in the other; the gap is that "
            "between the spheres.",
            {}, 3),
        turned_shells("shells-prescribed",
                      "Two whole shells, one mesh turned in the other; the gap 0 is prescribed.",
                      {"Pair contact/Initial gap=0"}, 2),
        turned_shells(
            "shells-tetrahedra",
            "Two whole shells, the inner one of tetrahedra and turned; the gap is that between the spheres.",
            {"Body inner/Convert to tetrahedra=true"}, 2)};
  }
} // namespace Signorini
