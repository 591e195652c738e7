// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_cycle_words_h
#define signorini_source_application_cycle_words_h

#include <signorini/output/results.h>
#include <signorini/solvers/obstacle_solver.h>

#include <string>

namespace Signorini
{
  /// "1 iteration", "2 iterations".
  std::string count_iterations(const unsigned int n);

  /// What a cycle says on the terminal.
  /// @param has_estimate whether the error was estimated
  std::string describe(const CycleResult &result, const bool has_estimate);

  /// What took over from a slow iteration.
  std::string describe(const SafetyNetReport &net);

  /// After an iteration that did not converge.
  std::string what_may_help(const SolverParameters &solver);
} // namespace Signorini

#endif
