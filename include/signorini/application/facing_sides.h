// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_facing_sides_h
#define signorini_application_facing_sides_h

#include <signorini/application/contact_model.h>
#include <signorini/application/discretization.h>

#include <vector>

namespace Signorini
{
  class Journal;

  /// Collective. Takes from the whole surfaces of a pair what faces nothing of the other side beyond sharp
  /// edges (FacingParts), with a note.
  void leave_out_blind_parts(std::vector<ContactSide> &sides, const PairModel &pair,
                             const MPI_Comm communicator, Journal &journal);

  /// Collective. By face of the nonmortar surface of a mapped pair: whether its image lies behind its own
  /// body. Normals of the upper half of a ball that lies on a ball meet the lower half of the other one,
  /// backward, through both bodies. Empty if there is no such face, or nothing else.
  std::vector<bool> faces_with_images_behind(const ContactPair &pair, const MPI_Comm communicator);

  /// Takes faces from a whole surface.
  void leave_out(ContactSurface &surface, const std::vector<bool> &faces);
} // namespace Signorini

#endif
