// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_edge_normals_h
#define signorini_mortar_edge_normals_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/partner_sight.h>

namespace Signorini
{
  /// Where edges of a whole surface press on the other side, gives them and the faces beside them the normal
  /// of that, and marks them (ContactSurface::has_partner_normal).
  ///
  /// Inside of smooth surfaces that touch both have one normal there. An edge has none of its own: along that
  /// of the faces beside it, it would enter the other body as it slides, and contact forces would have a part
  /// along the surface that they act on. Edges are those of the boundary of the body, of more than 60
  /// degrees, that stick out (ContactSurface::beyond; at symmetry planes with its mirror image). One presses
  /// where the other side comes nearer towards it over all facets beside it (or is as far, where these are
  /// parallel to it). Where it presses on an edge of the other side, as rims of disc springs do, the normal
  /// is the one between the faces of both. From there the new normals spread over the faces as long as they
  /// rise and the turn is much the same, and to vertices of these under which the other side has ended.
  /// Vertices keep their normal where it differs from the new one by no more than facets do from the surfaces
  /// that they stand for, or than the new one from those of the neighbours, and where the facets around them
  /// meet walls that differ by more than 25 degrees (a corner between floor and wall).
  void turn_edges(ContactSurface &surface, const PartnerSight &partner);

  /// Gives vertices whose normal is less than 60 degrees from the opposite of a direction, the unit normal of
  /// a plane, the opposite of that, and marks them as turn_edges(). Along it the distance from a plane is
  /// linear in the displacement, however far bodies slide; along their own normals, which differ from vertex
  /// to vertex beside the place where a round body touches, the plane would push sideways. (But forces along
  /// the own normals of a sphere go through its centre, and do not turn it.)
  void face_plane(ContactSurface &surface, const Vector3 &plane_normal);
} // namespace Signorini

#endif
