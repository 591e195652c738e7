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

  /// Collective. Those of the problem with all couplings; zero at tied nodes.
  std::vector<Vector> motions_of_unknowns(const ContactModel &model, const Discretization &discretization,
                                          const NodePartition &unknowns);

  /// Collective. Adds to a start the motion that brings free parts into the contacts that hold them. Returns
  /// a motion (coefficients) that has to be held before: one by which round surfaces turn in each other, if
  /// the loads turn it no more than facets may; then the start is as it was. Errors: InputError for loads
  /// that no contact can hold.
  /// @param unknowns partition of v
  std::vector<double> settle_free_parts(Vector &v, const ContactModel &model,
                                        const Discretization &discretization, const NodePartition &unknowns,
                                        const ObstacleProblem &problem);

  /// Collective. Errors: InputError if ties oppose motions that only contact should hold: with a gap between
  /// tied surfaces the coupling has rotations only approximately.
  /// @param motions orthonormal, of the unknowns of the matrix
  void refuse_opposed_motions(const NodeBlockMatrix &matrix, const std::vector<Vector> &motions,
                              const ContactModel &model, const Discretization &discretization);

  /// What loads do on rigid motions.
  struct WorkOfLoads
  {
    /// By motion (force, as motions are of the size of 1).
    std::vector<double> work;
    /// Of the components of all nodal loads, with what prescribed displacements do (force): a measure of
    /// their size.
    double sum = 0.;
  };

  /// Ends the run for loads that no contact can hold. Errors: InputError, always.
  /// @param loads where they are known: the net load in the flight is told
  [[noreturn]] void refuse_flight(const ContactModel &model, const std::vector<FreeMotion> &motions,
                                  const std::vector<double> &flight, const WorkOfLoads &loads = {});
} // namespace Signorini

#endif
