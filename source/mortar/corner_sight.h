// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_corner_sight_h
#define signorini_source_mortar_corner_sight_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/partner_sight.h>

#include <optional>
#include <vector>

namespace Signorini
{
  /// Pure numbers.
  struct CornerSightRule
  {
    /// Cosine between normals of one wall.
    double one_wall = .9;
    /// What of the way from the centre of a facet to the vertex is looked from: where two walls meet, too,
    /// each facet sees its own.
    double toward_vertex = .9;
  };

  /// Looks at the other side from around the vertices of a surface, where they have no normal of their own to
  /// look along. Both must outlive the object.
  class CornerSight
  {
  public:
    CornerSight(const ContactSurface &surface, const PartnerSight &partner)
      : surface(surface)
      , partner(partner)
    {
    }

    /// What is met, the place on the facet from which it is, and the width of that (lengths).
    struct Seen
    {
      MetPartner       partner;
      dealii::Point<3> place;
      double           width;
    };

    /// Along a unit normal of a facet, from the place on it that belongs to one of its vertices. Nothing
    /// where nothing is met.
    std::optional<Seen> look(const unsigned int triangle, const unsigned int vertex,
                             const Vector3 &normal) const;

  private:
    const ContactSurface &surface;
    const PartnerSight   &partner;
  };

  /// The mean of unit normals, a unit vector; zero if they are not those of one wall, or none.
  Vector3 normal_of_wall(const std::vector<Vector3> &normals);
} // namespace Signorini

#endif
