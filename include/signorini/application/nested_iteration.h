// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_nested_iteration_h
#define signorini_application_nested_iteration_h

#include <signorini/application/checkpoints.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/mesh/refinement.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// How the meshes come about, how each of them is solved, and what is asked of the solutions.
  struct NestedParameters
  {
    /// The meshes.
    RefinementParameters refinement;
    /// Sweeps are measured on the last mesh only.
    SolveParameters solve;
    /// Where the last displacement is reported.
    std::vector<Probe> probes;
    /// Per body a known displacement to compare with; may be empty.
    std::vector<VectorField> exact_displacements;
  };

  /// The last mesh with its solution, and the results of all.
  struct NestedSolution
  {
    /// Of the last mesh.
    std::unique_ptr<const Discretization> discretization;
    ContactSolution                       solution;
    /// Squared error indicators (energy) of its cells; empty where they were not computed.
    std::vector<double> indicator;
    /// Of all meshes; the same on all ranks.
    Results results;
  };

  /// Collective. Solves on one mesh after the other; each begins with the solution of the one before. The
  /// model is left with the last mesh.
  /// @param checkpoints saved after each mesh; goes on from where it has a state; null for none
  /// Errors: RunStopped, between two meshes; InputError for a state that does not fit to the model.
  NestedSolution run_nested_iteration(ContactModel &model, const NestedParameters &parameters,
                                      Journal &journal, Checkpoints *const checkpoints = nullptr);

  /// Collective. Builds the meshes of all cycles that need no solutions and the contact mapping of the last,
  /// and solves nothing.
  NestedSolution build_meshes(ContactModel &model, const NestedParameters &parameters, Journal &journal);
} // namespace Signorini

#endif
