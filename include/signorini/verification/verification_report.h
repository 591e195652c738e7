// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_verification_verification_report_h
#define signorini_verification_verification_report_h

#include <signorini/verification/verification_problem.h>

#include <iosfwd>

namespace Signorini
{
  /// A problem with what it gave on its meshes, and what is wrong with that.
  struct VerifiedProblem
  {
    /// The problem, and its results by mesh.
    VerificationProblem          problem;
    std::vector<VerificationRun> runs;
    /// Why it does not pass, in words; empty if it does.
    std::vector<std::string> failures;
    /// What it took.
    double seconds = 0.;

    /// Whether every bar was met and every certificate holds.
    bool passes() const
    {
      return failures.empty();
    }

    /// The errors of one quantity, by mesh.
    std::vector<double> errors(const std::size_t quantity) const;
  };

  /// log2 of the quotients of errors on meshes whose cells are halved from one to the next.
  std::vector<double> observed_orders(const std::vector<double> &errors);

  /// Collective. Solves a problem on its first meshes and judges what it gave. On one rank whatever ends a
  /// run is a failure of the problem; errors on several ranks are thrown.
  /// @param n_meshes at least one
  /// @param show is called with the number of each mesh (from 0) before it is solved
  VerifiedProblem verify(const VerificationProblem &problem, const unsigned int n_meshes,
                         const MPI_Comm                                 communicator,
                         const std::function<void(const unsigned int)> &show = {});

  /// Verdict, name, errors on the last mesh with orders: one line.
  std::string verdict_line(const VerifiedProblem &problem);

  /// The problem in words, errors by mesh with orders and bars, what is wrong.
  void print_details(std::ostream &out, const VerifiedProblem &problem);

  /// What was run and how.
  struct VerificationSettings
  {
    /// The program; how many ranks; whether only the first meshes were taken.
    std::string  version;
    unsigned int ranks = 1;
    bool         quick = false;
  };

  /// Everything in numbers, as JSON.
  void write_json(std::ostream &out, const std::vector<VerifiedProblem> &problems,
                  const VerificationSettings &settings);
} // namespace Signorini

#endif
