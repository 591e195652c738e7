// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_free_bodies_h
#define signorini_application_free_bodies_h

#include <signorini/application/discretization.h>
#include <signorini/solvers/obstacle_problem.h>
#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  // Bodies, or parts of them, that nothing but contact holds.

  /// Notes the parts that contact must hold. Errors: InputError for those that have no contact, or that the
  /// method cannot deal with.
  void check_free_parts(const ContactModel &model, const FreeParts &parts, const SolverMethod method,
                        Journal &journal);

  /// Collective. The displacements of free motions as unknowns of a transformed problem.
  std::vector<Vector> motions_of_unknowns(const ContactModel &model, const ConstrainedSpace &constrained,
                                          const NodePartition       &unknowns,
                                          const BasisTransformation &transformation);

  /// Collective. Adds to a start the motion that brings free parts into the contacts that hold them. Errors:
  /// InputError for loads that no contact can hold.
  /// @param unknowns partition of v
  void settle_free_parts(Vector &v, const ContactModel &model, const Discretization &discretization,
                         const NodePartition &unknowns, const ObstacleProblem &problem);

  /// Motions that slide along active contacts, as coefficients of the free motions.
  struct LooseMotions
  {
    /// No active contact opposes them.
    std::vector<std::vector<double>> undetermined;
    /// Next to nothing does: facets of round surfaces.
    std::vector<std::vector<double>> hardly_held;
  };

  /// Collective. Those of a solution.
  /// @param fields of motions_of_unknowns(); at least one
  LooseMotions find_loose_motions(const std::vector<FreeMotion> &motions, const std::vector<Vector> &fields,
                                  const HalfSpaces &half_spaces, const std::vector<unsigned char> &active);

  /// Collective. Takes motions out of a solution where that is admissible.
  /// @param motions coefficients of the fields
  void remove_motions(Vector &v, const std::vector<std::vector<double>> &motions,
                      const std::vector<Vector> &fields, const HalfSpaces &half_spaces);
} // namespace Signorini

#endif
