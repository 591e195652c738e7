// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_partner_sight_h
#define signorini_mortar_partner_sight_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/rigid_obstacle.h>

#include <functional>

namespace Signorini
{
  /// What is met along the normal of a facet.
  struct MetPartner
  {
    /// A unit vector, against the outward normal of the other side.
    Vector3 normal;
    /// Along the normal of the facet, negative if it lies behind (length).
    double distance = 0.;
    /// How far `normal` is from that of a facet that stands for a curved surface there.
    double doubt = 0.;
    /// Near an edge of the other side: the outward unit normal beyond it, else zero; and how far it is from
    /// what is met (length).
    Vector3 beyond_edge   = {};
    double  edge_distance = 0.;
  };

  /// Looks from a place along the unit normal of a facet of a width (length) there; false if nothing is met
  /// that faces it.
  using PartnerSight = std::function<bool(MetPartner &, const dealii::Point<3> &place, const Vector3 &normal,
                                          const double width)>;

  /// At an obstacle, which must outlive the function.
  /// @param size a length of the problem
  PartnerSight sight_of(const RigidObstacle &obstacle, const double size);

  /// At another whole surface, which must outlive the function. What lies behind is met to the width of the
  /// facet: farther back one would look through the body.
  PartnerSight sight_of(const ContactSurface &other);
} // namespace Signorini

#endif
