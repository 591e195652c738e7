// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_edge_corner_h
#define signorini_source_mortar_edge_corner_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/partner_sight.h>

#include <vector>

namespace Signorini
{
  /// The facets around a vertex, and what they meet.
  class EdgeCorner
  {
  public:
    using Facet = ContactSurface::Facet;

    /// @param facets of the surface
    /// @param others the rest of the boundary of the body
    /// @param fixed what is prescribed
    EdgeCorner(std::vector<Facet> facets, std::vector<Facet> others, const FixedDirections &fixed,
               const Vector3 &vertex_normal);

    /// What is met along the normal of a facet.
    void add(const MetPartner &met, const Vector3 &facet);

    /// Whether it is on an edge of the body that sticks out.
    bool is_edge() const
    {
      return is_on_edge;
    }

    bool meets_anything() const
    {
      return !normals.empty();
    }

    /// Mean along the facets (length).
    double distance() const
    {
      return sum_of_distances / n_met;
    }

    /// Whether its normal is that of a face beside it, or it is on an edge that sticks out: not in a groove.
    bool may_turn() const
    {
      return own.norm() > 0. || is_on_edge;
    }

    /// The normal of what is met; zero if that is not one wall.
    Vector3 met_normal() const;

    /// Whether it is an edge that meets an edge along it: the normals of the other one, from that of the face
    /// that is met to that beyond, go through the one between both faces.
    bool meets_edge() const;

    /// The normal of what is met where it is not the one that the vertex has already, between these where
    /// edges meet; else zero.
    Vector3 normal() const;

    /// From the own normal; from nothing where there is none.
    Vector3 turn() const
    {
      return own.norm() > 0. ? Vector3(met_normal() - own) : Vector3();
    }

  private:
    /// Zero where it is that of no face.
    Vector3              own;
    bool                 is_on_edge = false;
    std::vector<Vector3> planes, normals, edges;
    double               sum_of_distances = 0., n_met = 0., doubt = 0.;
  };
} // namespace Signorini

#endif
