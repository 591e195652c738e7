// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_python_problem_run_h
#define signorini_python_problem_run_h

#include "result_arrays.h"

#include <functional>

namespace Signorini
{
  /// What is to be run, and what is wanted of it.
  struct RunRequest
  {
    /// A parameter file or a deck; or, if it has lines, the text in its place.
    std::string   file;
    ParameterText text;
    /// "Section/Name=value".
    std::vector<std::string> overrides;
    /// Where the program's files go, too; empty for none.
    std::string output;
    /// Whether the fields of each load step are kept.
    bool keeps_steps = true;
  };

  /// What a run gives.
  struct RunOutcome
  {
    /// Of the solver, on all meshes and for all steps.
    bool converged = false;
    /// Why the contact conditions do not hold; the folder with the files.
    std::vector<std::string> objections;
    std::string              folder;
    /// Texts of the program's files summary.json, pressure.csv, curve.csv (empty without load steps) and
    /// parameters.prm.
    std::string summary, pressure, curve, parameters;
    /// Of the last mesh and the last load.
    std::vector<BodyArrays> bodies;
    std::vector<PairArrays> pairs;
    std::vector<StepArrays> steps;
  };

  /// Collective. Runs a problem as the program does. Errors: InputError, and what `interrupt` throws, which
  /// is called in each iteration if there is a single rank. An error of one rank alone ends all processes.
  RunOutcome run_problem(const RunRequest &request, const MPI_Comm communicator,
                         const std::function<void()> &interrupt);
} // namespace Signorini

#endif
