// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_spots_h
#define signorini_application_contact_spots_h

#include <signorini/application/discretization.h>
#include <signorini/mortar/geometric_penetration.h>

#include <vector>

namespace Signorini
{
  /// A part of a pair's contact that hangs together: nodes that carry forces, each in a face with another
  /// one. A block on two rollers touches them in two spots.
  struct ContactSpot
  {
    /// Integral of the pressure (force), area.
    double load = 0., area = 0.;
    /// The least gap of the faces with a node of it (length).
    LeastGap gap;
  };

  /// All of a pair.
  struct ContactSpots
  {
    /// In the order of their first nodes.
    std::vector<ContactSpot> spots;
    /// The least gap of the faces that are away from all of them: neither they nor faces beside them have a
    /// node that carries forces.
    LeastGap elsewhere;
  };

  /// Collective; the same on all ranks.
  /// @param pressure active by row of the coupling (pressure)
  /// @param is_active the latter per vertex of the nonmortar surface
  /// @param gaps least gaps by face of the nonmortar surface (length)
  ContactSpots find_contact_spots(const ContactPair &pair, const PairCoupling &coupling,
                                  const std::vector<double> &pressure, const std::vector<bool> &is_active,
                                  const std::vector<LeastGap> &gaps);
} // namespace Signorini

#endif
