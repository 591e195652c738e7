// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_run_problem_h
#define signorini_application_run_problem_h

#include <signorini/application/journal.h>
#include <signorini/application/parameters.h>

namespace Signorini
{
  /// Collective. The model of a parameter file on its first mesh. Errors: InputError for problems that make
  /// no sense.
  ContactModel make_model(const ParameterFile &file, const MPI_Comm communicator, Journal &journal);

  /// Collective. Solves the problem of a parameter file on all meshes and for all load steps. Errors: those
  /// of run_load_steps().
  /// @param model of make_model(), left with the last mesh
  NestedSolution solve_problem(ContactModel &model, const ParameterFile &file, const StepObserver &observe,
                               Journal &journal, Checkpoints *const checkpoints = nullptr);

  /// Whether all ranks come here within two seconds: bad input is mostly found by all of them together, but
  /// some of it (the value of an expression, say) by one rank while the others wait for it elsewhere.
  bool all_ranks_come(const MPI_Comm communicator);
} // namespace Signorini

#endif
