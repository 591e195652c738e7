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

  /// Collective. Adds to a start the motion that brings free parts into the contacts that hold them. Returns
  /// a motion (coefficients) that has to be held before: one by which round surfaces turn in each other, if
  /// the loads turn it no more than facets may; then the start is as it was. Errors: InputError for loads
  /// that no contact can hold.
  /// @param unknowns partition of v
  std::vector<double> settle_free_parts(Vector &v, const ContactModel &model,
                                        const Discretization &discretization, const NodePartition &unknowns,
                                        const ObstacleProblem &problem);

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

  /// Collective. Those motions that the surfaces hardly oppose, wherever they touch, if a solution slides
  /// along hardly held ones by more than a tenth of a face; else none.
  /// @param loose of the solution
  /// @param v the solution; its values at contact nodes are relative displacements
  /// @param width of a face (length)
  std::vector<std::vector<double>> find_drift(const std::vector<FreeMotion> &motions,
                                              const std::vector<Vector>     &fields,
                                              const HalfSpaces &half_spaces, const LooseMotions &loose,
                                              const Vector &v, const double width);

  /// Ends the run for loads that no contact can hold. Errors: InputError, always.
  [[noreturn]] void refuse_flight(const ContactModel &model, const std::vector<FreeMotion> &motions,
                                  const std::vector<double> &flight);

  /// Warns of motions that only facets oppose.
  void warn_of_facets(const ContactModel &model, const std::vector<FreeMotion> &motions,
                      const std::vector<std::vector<double>> &hardly_held, Journal &journal);

  /// Collective. Takes motions out of a solution where that is admissible.
  /// @param motions coefficients of the fields
  void remove_motions(Vector &v, const std::vector<std::vector<double>> &motions,
                      const std::vector<Vector> &fields, const HalfSpaces &half_spaces);
} // namespace Signorini

#endif
