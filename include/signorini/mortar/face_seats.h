// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_seats_h
#define signorini_mortar_face_seats_h

#include <signorini/mesh/contact_surface.h>
#include <signorini/mortar/surface_halo.h>
#include <signorini/surface/overlay.h>

#include <vector>

namespace Signorini
{
  /// What lies over the faces of a nonmortar surface, without the flanks of seats: where a face lies along
  /// the other side (seat) and sees over the rest of it what stands away from there (flank: the chamfer at
  /// the edge of a sole), it touches with the seat alone. In the means over a face or around a node the
  /// opening gap of the flank would keep nodes from touching that lie under the edge, and bodies would
  /// stand on less than their soles.
  struct SeatedOverlay
  {
    /// The triangles that count, in the order of the overlay.
    std::vector<OverlayTriangle> overlay;
    /// By face of the surface, those that the overlay has.
    std::vector<FaceLie> lies;
  };

  /// @param overlay that of this rank's own faces, ordered by nonmortar triangle
  SeatedOverlay without_flanks(const ContactSurface &nonmortar, const ContactSurface &mortar,
                               const std::vector<OverlayTriangle> &overlay);

  /// Vertices that have a seat on some of their faces leave those that see flanks only
  /// (ContactSurface::Face::left_corners, flank_corners). Collective.
  /// @param halo of the surface
  /// @param moments of own and ghost faces
  void leave_flanks(ContactSurface &nonmortar, const SurfaceHalo &halo,
                    const std::vector<FaceMoments> &moments);
} // namespace Signorini

#endif
