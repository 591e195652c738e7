// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_body_edges_h
#define signorini_source_mortar_body_edges_h

#include <signorini/mesh/contact_surface.h>

#include <array>
#include <map>

namespace Signorini
{
  /// The edges of a whole surface that are edges of its body, of more than 60 degrees, and stick out: also
  /// where the surface ends at them, if no plane in which the body slides cuts it there. It must outlive
  /// this.
  class BodyEdges
  {
  public:
    explicit BodyEdges(const ContactSurface &surface);

    /// One near a place.
    struct Nearest
    {
      /// How far it is (length).
      double distance;
      /// The outward unit normal of the face beyond it; zero if there is no edge.
      Vector3 beyond;
    };

    /// Of the edges at a triangle and its neighbours the nearest to a point on that, if it is not farther
    /// than some distance (length).
    Nearest find(const unsigned int triangle, const dealii::Point<3> &x, const double at_most) const;

  private:
    double length(const unsigned int edge) const;
    double distance(const dealii::Point<3> &p, const unsigned int edge) const;
    void   add_inner(const unsigned int edge);
    void   add_border(const unsigned int edge);

    const ContactSurface &surface;
    const SurfaceTopology topology;
    /// By edge, the outward normals of both sides.
    std::map<unsigned int, std::array<Vector3, 2>> faces;
  };
} // namespace Signorini

#endif
