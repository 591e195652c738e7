// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_unseen_penetration_h
#define signorini_application_unseen_penetration_h

#include <signorini/application/discretization.h>

#include <string>
#include <vector>

namespace Signorini
{
  /// A node of a body that lies in another one after deformation, where no pair of surfaces looks.
  struct UnseenPenetration
  {
    /// Connected parts of bodies (Bodies::part()): that of the node, and that in which it lies.
    unsigned int part = 0, other = 0;
    /// Distance from the boundary of the other part (BoundaryDepth; length).
    double depth = -1.;
    /// Of the node before it is deformed (length).
    dealii::Point<3> place;
    /// Whether there is a contact pair (not tied) between these two bodies.
    bool has_pair = false;
  };

  /// Collective. By two parts the deepest of these, sorted by the parts; the same on all ranks. The whole
  /// boundaries of all bodies are looked at, those that belong to no pair as well: what a pair is certified
  /// by ends where its mapping does. Not found is what a body does to itself or to an obstacle, and where
  /// only edges cross, with no node in the other body.
  std::vector<UnseenPenetration> find_unseen_penetrations(const ContactModel   &model,
                                                          const Discretization &discretization,
                                                          const Vector         &displacement);

  /// What it is, and what to do, in words.
  std::string describe_unseen(const ContactModel &model, const UnseenPenetration &one);
} // namespace Signorini

#endif
