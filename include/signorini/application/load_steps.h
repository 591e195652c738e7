// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_load_steps_h
#define signorini_application_load_steps_h

#include <signorini/application/nested_iteration.h>

#include <functional>
#include <string>
#include <vector>

namespace Signorini
{
  /// "10" for that many equal steps to t = 1, or a list of times "0.2, 0.5, 1"; empty for one load. Returns
  /// the times, empty for one load. Errors: InputError unless they are positive and ascending.
  std::vector<double> parse_load_steps(const std::string &text, const std::string &where);

  /// Called after each step with its number (from 0), its discretization and its solution.
  using StepObserver =
      std::function<void(const unsigned int step, const Discretization &, const ContactSolution &)>;

  /// Collective. Solves for all load steps. The meshes are those of the last load, which
  /// run_nested_iteration() solves first; on the last of them, mapping, couplings, matrix and levels stay for
  /// the steps before, each of which begins with what the two before it foretell. (Frictionless contact of
  /// linear bodies does not depend on the path.) Errors: those of run_nested_iteration(); a step that is not
  /// solved ends the series with a note.
  /// @param checkpoints as in run_nested_iteration(), after each step, too
  /// @return the last step, with Results::steps of all
  NestedSolution run_load_steps(ContactModel &model, const NestedParameters &parameters,
                                const std::vector<double> &times, const StepObserver &observe,
                                Journal &journal, Checkpoints *const checkpoints = nullptr);
} // namespace Signorini

#endif
