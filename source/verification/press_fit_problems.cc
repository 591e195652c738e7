// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// A ring that is pressed into another, in plane strain: Lamé's solution u_r = A r + B / r in both.

#include "measurement.h"

namespace Signorini
{
  namespace
  {
    /// A quarter of both: shaft 25 < r < 50, hub 50 < r < 100, height 6, interference 0.05 (radial).
    const char *const rings = R"(
      set Bodies        = shaft, hub
      set Contact pairs = fit
      subsection Body shaft
        set Mesh          = quarter of tube
        set Inner radius  = 25
        set Radius        = 50
        set Height        = 6
        set Young modulus = 210000
        set Poisson ratio = 0.3
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); start: (*, *, 0); end: (*, *, 0)
      end
      subsection Body hub
        set Mesh          = quarter of tube
        set Inner radius  = 50
        set Radius        = 100
        set Height        = 6
        set Young modulus = 70000
        set Poisson ratio = 0.33
        set Dirichlet     = symmetry x: (0, *, *); symmetry y: (*, 0, *); start: (*, *, 0); end: (*, *, 0)
      end
      subsection Pair fit
        set First       = shaft: outer
        set Second      = hub: inner
        set Nonmortar   = second
        set Initial gap = -0.05
      end
    )";

    constexpr double shaft = 50., height = 6., interference = .05;

    /// A, B of the shaft, A, B of the hub, and the pressure between them.
    std::pair<std::vector<double>, double> solve_rings()
    {
      const double        a = 25., b = shaft, c = 100.;
      const LameConstants s(210000., .3), h(70000., .33);
      // sigma_rr = 2 (lambda + mu) A - 2 mu B / r^2; the surface of the hub ends up outside of that of the
      // shaft by the interference.
      const double ks = 2. * (s.lambda + s.mu), ms = 2. * s.mu, kh = 2. * (h.lambda + h.mu), mh = 2. * h.mu;
      const std::vector<double> x = solve_dense({{ks, -ms / (a * a), 0., 0.},
                                                 {0., 0., kh, -mh / (c * c)},
                                                 {ks, -ms / (b * b), -kh, mh / (b * b)},
                                                 {-b, -1. / b, b, 1. / b}},
                                                {0., 0., 0., interference});
      return {x, -(ks * x[0] - ms * x[1] / (b * b))};
    }

    /// Cells along the radius, around, along the axis.
    Settings divisions(const unsigned int mesh)
    {
      const unsigned int n = 12u << mesh, m = n * 4 / 3;
      const auto         text = [](const unsigned int size, const unsigned int slices) {
        return "/Round divisions=" + std::to_string(size / 2) + ", " + std::to_string(size) + ", " +
               std::to_string(slices);
      };
      return {"Body shaft" + text(n, n / 6), "Body hub" + text(m, m / 4)};
    }

    /// Largest error of a nodal pressure away from the ends and from the planes of symmetry.
    double error_inside(const std::vector<PressureRow> &rows, const double pressure)
    {
      double error = 0.;
      for (const PressureRow &row : rows)
        if (const double angle = std::atan2(row.position[1], row.position[0]), z = row.position[2] / height;
            .2 < z && z < .8 && .1 < angle && angle < 1.47)
          error = larger_error(error, relative_error(row.pressure, pressure));
      return error;
    }

    VerificationProblem ring_problem(const std::string &name, const std::string &what,
                                     const Settings &settings)
    {
      const auto [x, pressure] = solve_rings();
      Settings exact;
      for (unsigned int body = 0; body < 2; ++body)
        {
          const std::string field = "(" + number(x[2 * body]) + "+" + number(x[2 * body + 1]) + "/(x^2+y^2))";
          exact.push_back(std::string("Body ") + (body == 0 ? "shaft" : "hub") + "/Exact displacement=(x*" +
                          field + ", y*" + field + ", 0)");
        }
      VerificationProblem problem;
      problem.name       = name;
      problem.what       = what;
      problem.reference  = "Lamé's solution for both rings";
      problem.quantities = {
          {"L2", "displacement, L2 norm", {.005, .001, .0003}, 1.9},
          {"energy", "displacement, energy norm", {.13, .065, .033}, .95},
          {"pressure", "nodal pressures, L2 norm", {.045, .018, .008}, 1.},
          {"force", "contact force in x and in y", {.01, .005, .002}},
          {"inside", "largest error of a nodal pressure away from the ends", {.05, .012, .006}}};
      problem.meshes = {"12 cells around the shaft, 16 around the hub", "24 and 32", "48 and 64"};
      problem.run    = [=, pressure = pressure](const MPI_Comm communicator, const unsigned int mesh) {
        const Results            results = solve(communicator, rings, exact + settings + divisions(mesh));
        const DisplacementErrors u       = displacement_errors(results);
        const double             force   = pressure * shaft * height;
        const Vector3           &f       = results.pairs[0].force;
        return measured(
               results,
               {u.l2, u.energy,
             pressure_error(results.pressure, [&](const dealii::Point<3> &) { return pressure; }),
             larger_error(relative_error(std::abs(f[0]), force), relative_error(std::abs(f[1]), force)),
             error_inside(results.pressure, pressure)});
      };
      return problem;
    }

    /// Slabs of one layer of cells; the shaft is larger than the bore.
    const char *const tubes = R"(
      set Bodies        = shaft, hub
      set Contact pairs = fit
      subsection Body shaft
        set Mesh            = quarter of annulus
        set Inner radius    = 5
        set Radius          = 10.01
        set Height          = 0.5
        set Round divisions = 5, 16, 1
        set Young modulus   = 200000
        set Poisson ratio   = 0.3
        set Dirichlet       = symmetry x: (0, *, *); symmetry y: (*, 0, *); start: (*, *, 0); end: (*, *, 0)
      end
      subsection Body hub
        set Mesh            = quarter of annulus
        set Inner radius    = 10
        set Radius          = 16
        set Height          = 0.5
        set Round divisions = 6, 20, 1
        set Young modulus   = 100000
        set Poisson ratio   = 0.3
        set Dirichlet       = symmetry x: (0, *, *); symmetry y: (*, 0, *); start: (*, *, 0); end: (*, *, 0)
      end
      subsection Pair fit
        set First  = shaft: outer
        set Second = hub: inner
      end
    )";

    VerificationProblem tube_problem()
    {
      VerificationProblem problem;
      problem.name = "press-fit-oversize";
      problem.what =
          "A tube in another one whose bore is smaller by 0.1 %, one layer of cells in plane strain.";
      problem.reference  = "Lamé's formula; linear theory itself leaves 0.1 %";
      problem.quantities = {{"pressure", "largest error at any node", {.0125, .002, .001}}};
      problem.meshes     = {"16 cells around the shaft, 20 around the hub", "32 and 40", "64 and 80"};
      problem.run        = [](const MPI_Comm communicator, const unsigned int mesh) {
        // Radial displacement of the interface b of a tube with the other radius r under the pressure 1.
        const double b = 10., nu = .3;
        const auto   compliance = [&](const double young, const double r) {
          return b * (1. + nu) / young * ((1. - 2. * nu) * b * b + r * r) / std::abs(r * r - b * b);
        };
        const double  pressure = .01 / (compliance(2e5, 5.) + compliance(1e5, 16.));
        const Results results =
            solve(communicator, tubes, {"Refinement/Global cycles=" + std::to_string(mesh)});
        return measured(results, {constant_pressure_error(results, pressure)});
      };
      return problem;
    }
  } // namespace



  std::vector<VerificationProblem> press_fit_problems()
  {
    return {ring_problem(
                "press-fit-rings",
                "A ring pressed into another one, meshes that do not match, interference prescribed.", {}),
            ring_problem("press-fit-tetrahedra",
                         "A ring of tetrahedra pressed into another one, meshes that do not match, "
                         "interference prescribed.",
                         {"Body shaft/Convert to tetrahedra=true", "Body hub/Convert to tetrahedra=true"}),
            tube_problem()};
  }
} // namespace Signorini
