// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_shares_h
#define signorini_mortar_face_shares_h

#include <signorini/mesh/contact_surface.h>

namespace Signorini
{
  /// Shares the faces of a nonmortar surface among the ranks (ContactSurface::Face::worker), whichever of
  /// them own the cells: mapping and integrals cost about as much as there are triangles of both sides. The
  /// faces of both lie along one space-filling curve, which is cut into equally long pieces. The order does
  /// not depend on the ranks.
  /// @param mortar without faces where the partner is an obstacle
  void share_faces(ContactSurface &nonmortar, const ContactSurface &mortar, const unsigned int n_ranks);
} // namespace Signorini

#endif
