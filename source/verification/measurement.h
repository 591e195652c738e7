// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_verification_measurement_h
#define signorini_source_verification_measurement_h

#include <signorini/output/results.h>
#include <signorini/verification/verification_problem.h>

namespace Signorini
{
  /// "Section/Name=value", as on the command line.
  using Settings = std::vector<std::string>;

  /// Settings one after the other.
  Settings operator+(Settings first, const Settings &second);

  /// A number with all digits, in brackets, as expressions take it.
  std::string number(const double value);

  /// Collective. Solves the problem of a parameter file with this text, as the program does.
  Results solve(const MPI_Comm communicator, const std::string &text, const Settings &settings);

  /// The errors with the rest of what is reported about a run; objections are those of its certificate.
  VerificationRun certified(const Results &results, const std::vector<double> &errors);

  /// The same where bodies touch: the numbers of the certificate are those of a converged iteration, far
  /// below what a certificate allows.
  VerificationRun measured(const Results &results, const std::vector<double> &errors);

  /// |value / expected - 1|.
  double relative_error(const double value, const double expected);

  /// The larger of two errors; one that is no number (NaN) stays.
  double larger_error(const double a, const double b);

  /// Relative errors of the displacement of all bodies together on the last mesh, L2 norm and energy norm;
  /// the problem has Exact displacements.
  struct DisplacementErrors
  {
    double l2, energy;
  };
  DisplacementErrors displacement_errors(const Results &results);

  /// Relative L2 error of nodal pressures, with the areas of the nodes as weights.
  double pressure_error(const std::vector<PressureRow>                        &rows,
                        const std::function<double(const dealii::Point<3> &)> &exact);

  /// Largest relative error of the pressure at the nodes of all pairs, where it is the same everywhere.
  double constant_pressure_error(const Results &results, const double exact);

  /// Mean of a function of the place over the nodes, weighted with their forces.
  double mean_over_force(const std::vector<PressureRow>                        &rows,
                         const std::function<double(const dealii::Point<3> &)> &f);

  /// The distance of a place from the z axis.
  double radius(const dealii::Point<3> &x);

  /// Lamé's constants of a material.
  struct LameConstants
  {
    LameConstants(const double young, const double poisson)
      : lambda(young * poisson / ((1. + poisson) * (1. - 2. * poisson)))
      , mu(young / (2. * (1. + poisson)))
    {
    }

    double lambda, mu;
  };

  /// A block of a manufactured problem: all but its solution.
  struct ManufacturedBlock
  {
    /// Corners and divisions as parameter files have them.
    std::string name, low, high, divisions;
    double      young, poisson;
    /// The boundaries where the displacement is prescribed.
    std::vector<std::string> held;
  };

  /// Its section of a parameter file: the displacement as condition and as exact solution, and the volume
  /// force that belongs to it.
  std::string block_section(const ManufacturedBlock &block, const std::string &displacement,
                            const std::string &force);

  /// The solution of a small system of linear equations.
  std::vector<double> solve_dense(const std::vector<std::vector<double>> &matrix,
                                  const std::vector<double>              &right);

  /// The integral of a function that may have square roots at both ends.
  double integral(const std::function<double(double)> &f, const double low, const double high);

  /// The families.
  std::vector<VerificationProblem> patch_problems();
  std::vector<VerificationProblem> obstacle_problems();
  std::vector<VerificationProblem> shell_problems();
  std::vector<VerificationProblem> press_fit_problems();
  std::vector<VerificationProblem> manufactured_problems();
  std::vector<VerificationProblem> corner_problems();
  std::vector<VerificationProblem> indenter_problems();
  std::vector<VerificationProblem> hertz_problems();
  std::vector<VerificationProblem> mapping_problems();
} // namespace Signorini

#endif
