// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_verification_verification_problem_h
#define signorini_verification_verification_problem_h

#include <mpi.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace Signorini
{
  /// A number whose error is measured on each mesh of a problem.
  struct VerifiedQuantity
  {
    /// A bar that is always met.
    static constexpr double any_order = -std::numeric_limits<double>::infinity();

    /// One or two words, and what they stand for.
    std::string name, what;
    /// The largest error that passes, by mesh; the last entry counts for all meshes after it. Empty for any.
    std::vector<double> most;
    /// The least order log2(error on a mesh / error on the next) between the last two meshes, or any_order.
    double least_order = any_order;
  };

  /// What a problem gave on one mesh.
  struct VerificationRun
  {
    /// By quantity: pure numbers, relative to the reference where nothing else is said.
    std::vector<double> errors;
    /// Of the contact problem; zero where nothing is solved.
    std::size_t  unknowns   = 0;
    unsigned int iterations = 0;
    /// What else is wrong: the certificate of the result, in words. Empty where all is well.
    std::vector<std::string> objections;
  };

  /// A problem whose solution is known.
  struct VerificationProblem
  {
    /// Without spaces; begins with its family.
    std::string name;
    /// What it is, in one sentence, and where the reference comes from.
    std::string what, reference;
    /// What is measured.
    std::vector<VerifiedQuantity> quantities;
    /// The meshes, in words; cells are halved from one to the next.
    std::vector<std::string> meshes;
    /// How many of them, from the first on, are enough for a quick look.
    unsigned int n_quick = 2;
    /// Collective. Solves on one of the meshes.
    std::function<VerificationRun(const MPI_Comm, const unsigned int mesh)> run;
  };

  /// All problems, family by family.
  std::vector<VerificationProblem> verification_problems();
} // namespace Signorini

#endif
