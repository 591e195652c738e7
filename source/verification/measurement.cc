// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "measurement.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/run_problem.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <iomanip>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  Settings operator+(Settings first, const Settings &second)
  {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }



  std::string number(const double value)
  {
    std::ostringstream text;
    text << '(' << std::setprecision(17) << value << ')';
    return text.str();
  }



  Results solve(const MPI_Comm communicator, const std::string &text, const Settings &settings)
  {
    const ParameterFile file(ParameterText{text, "verification problem", ""},
                             settings + Settings{"Output/Measure sweeps=false"});
    Journal             journal;
    ContactModel        model  = make_model(file, communicator, journal);
    NestedSolution      nested = solve_problem(
             model, file, [](const unsigned int, const Discretization &, const ContactSolution &) {}, journal);
    nested.results.notes = journal.notes();
    // All ranks measure. The problems are small.
    nested.results.pressure = gather_lists(std::move(nested.results.pressure), communicator, Receivers::all);
    return std::move(nested.results);
  }



  namespace
  {
    void object_above(std::vector<std::string> &objections, const std::string &name, const double value,
                      const double most)
    {
      if (std::abs(value) <= most)
        return;
      std::ostringstream text;
      text << "certificate: " << name << " " << value << ", at most " << most << " is expected";
      objections.push_back(text.str());
    }
  } // namespace



  VerificationRun certified(const Results &results, const std::vector<double> &errors)
  {
    VerificationRun run;
    run.errors     = errors;
    run.unknowns   = results.cycles.back().dofs;
    run.iterations = results.cycles.back().nonlinear.iterations;
    run.objections = results.certificate.objections;
    if (!results.converged)
      run.objections.push_back("the iteration did not converge");
    return run;
  }



  VerificationRun measured(const Results &results, const std::vector<double> &errors)
  {
    VerificationRun    run         = certified(results, errors);
    const Certificate &certificate = results.certificate;
    object_above(run.objections, "penetration", certificate.penetration, 1e-12);
    object_above(run.objections, "tension", certificate.tension, 1e-9);
    object_above(run.objections, "complementarity", certificate.complementarity, 1e-9);
    object_above(run.objections, "force balance", certificate.force_balance, 1e-12);
    object_above(run.objections, "equilibrium", certificate.equilibrium, 1e-8);
    return run;
  }



  double relative_error(const double value, const double expected)
  {
    return std::abs(value / expected - 1.);
  }



  double larger_error(const double a, const double b)
  {
    return std::isnan(a) || b <= a ? a : b;
  }



  DisplacementErrors displacement_errors(const Results &results)
  {
    double l2 = 0., l2_norm = 0., energy = 0., energy_norm = 0.;
    for (const auto &body : results.cycles.back().exact_errors)
      {
        const ExactError &e = body.second;
        l2 += e.l2 * e.l2;
        l2_norm += e.l2_norm * e.l2_norm;
        energy += e.energy * e.energy;
        energy_norm += e.energy_norm * e.energy_norm;
      }
    return {std::sqrt(l2 / l2_norm), std::sqrt(energy / energy_norm)};
  }



  double pressure_error(const std::vector<PressureRow>                &rows,
                        const std::function<double(const Point<3> &)> &exact)
  {
    double error = 0., norm = 0.;
    for (const PressureRow &row : rows)
      {
        const double p = exact(row.position);
        error += row.area * (row.pressure - p) * (row.pressure - p);
        norm += row.area * p * p;
      }
    return std::sqrt(error / norm);
  }



  double constant_pressure_error(const Results &results, const double exact)
  {
    double error = 0.;
    for (const PairResult &pair : results.pairs)
      for (const double pressure : {pair.min_pressure, pair.max_pressure})
        error = larger_error(error, relative_error(pressure, exact));
    return error;
  }



  double mean_over_force(const std::vector<PressureRow>                &rows,
                         const std::function<double(const Point<3> &)> &f)
  {
    double sum = 0., force = 0.;
    for (const PressureRow &row : rows)
      {
        sum += row.area * row.pressure * f(row.position);
        force += row.area * row.pressure;
      }
    return sum / force;
  }



  double radius(const Point<3> &x)
  {
    return std::hypot(x[0], x[1]);
  }



  std::string block_section(const ManufacturedBlock &block, const std::string &displacement,
                            const std::string &force)
  {
    std::string held;
    for (const std::string &side : block.held)
      held += side + ": " + displacement + "; ";
    return "subsection Body " + block.name + "\n set Mesh = block\n set Lower corner = " + block.low +
           "\n set Upper corner = " + block.high + "\n set Divisions = " + block.divisions +
           "\n set Young modulus = " + std::to_string(block.young) +
           "\n set Poisson ratio = " + std::to_string(block.poisson) + "\n set Dirichlet = " + held +
           "\n set Volume force = " + force + "\n set Exact displacement = " + displacement + "\nend\n";
  }



  std::vector<double> solve_dense(const std::vector<std::vector<double>> &matrix,
                                  const std::vector<double>              &right)
  {
    const unsigned int     n = static_cast<unsigned int>(right.size());
    FullMatrix<double>     a(n, n);
    dealii::Vector<double> b(right.begin(), right.end()), x(n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        a(i, j) = matrix[i][j];
    a.gauss_jordan();
    a.vmult(x, b);
    return {x.begin(), x.end()};
  }



  double integral(const std::function<double(double)> &f, const double low, const double high)
  {
    // With x = middle - half cos t what is a square root at the ends is smooth: midpoints in t.
    constexpr unsigned int n      = 400;
    const double           middle = .5 * (low + high), half = .5 * (high - low);
    double                 sum = 0.;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double t = numbers::PI * (i + .5) / n;
        sum += f(middle - half * std::cos(t)) * half * std::sin(t);
      }
    return sum * numbers::PI / n;
  }
} // namespace Signorini
