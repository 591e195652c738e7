// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_point_holds_h
#define signorini_application_point_holds_h

#include <signorini/application/contact_solve.h>

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
  /// @param displacement of the solution that drifts; empty if there is none. Points are held where it would
  /// be without these motions: at zero, bodies would move by what they are deformed by at the points
  std::vector<PointHold> choose_point_holds(const ContactModel &model, const Discretization &discretization,
                                            const Drift &drift, const Vector &displacement);

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
