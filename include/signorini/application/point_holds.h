// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_point_holds_h
#define signorini_application_point_holds_h

#include <signorini/application/contact_solve.h>

#include <optional>
#include <vector>

namespace Signorini
{
  class Journal;

  // A ball in a socket turns freely. On facets, normals and pressures are not those of a sphere: contact has
  // a small moment, and next to nothing opposes it, so that the discrete solution turns by any angle. Such
  // motions are held at single points, as many as there are motions: what these carry is the error of the
  // moment, and it says whether the loads turn the body.

  /// Collective. The nodes and directions that hold some motions best: of the start meshes, away from
  /// contact, conditions and loads, where the motions are largest. Fewer than motions where there are no such
  /// nodes.
  /// @param drift with linearly independent motions
  std::vector<PointHold> choose_point_holds(const ContactModel &model, const Discretization &discretization,
                                            const Drift &drift);

  /// Collective. Holds the points of a model where a solution would be without the motions that they hold,
  /// if any was held elsewhere by a part of the displacements that is seen. Returns that solution then, to
  /// start from, for the problem has to be solved again. (A body that loads move turns about a point that
  /// stays at zero, and moves by what it is deformed by there.)
  std::optional<Vector> settle_point_holds(ContactModel &model, const Discretization &discretization,
                                           const Vector &displacement);

  /// Collective. The largest force that a point hold carries, as a share of what it may carry at most; points
  /// of motions that contact opposes after all carry more where they are settled. Infinite for a solution
  /// that is a flight, without displacements.
  double strain_of_point_holds(const ContactModel &model, const Discretization &discretization,
                               const ContactSolution &solution);

  /// Up to which share of what they may carry points are settled.
  constexpr double small_strain = .5;

  /// Goes on with a solution that drifts: warns. Errors: InputError where the loads have nothing against
  /// them.
  void leave_drift(const ContactModel &model, const Discretization &discretization,
                   const ContactSolution &solution, Journal &journal);

  /// Collective. What the point holds of a model carry, as remarks for the results. Errors: InputError where
  /// that is no error of the facets: then the loads move the body.
  std::vector<std::string> check_point_holds(const ContactModel &model, const Discretization &discretization,
                                             const ContactSolution &solution);
} // namespace Signorini

#endif
