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

  /// Collective. Takes from the whole surfaces of pairs, by pair and side, what faces nothing of the other
  /// side beyond sharp edges (FacingParts), and what lies far from that but nearer to the other side of
  /// another pair: the shaft is between the seat of a key and the far side of the bore. Tied pairs keep that.
  void leave_out_blind_parts(std::vector<std::vector<ContactSide>> &sides,
                             const std::vector<PairModel> &pairs, const MPI_Comm communicator,
                             Journal &journal);

  /// Collective. By face of the nonmortar surface of a mapped pair: whether its image lies behind its own
  /// body. Normals of the upper half of a ball that lies on a ball meet the lower half of the other one,
  /// backward, through both bodies. Empty if there is no such face, or nothing else.
  std::vector<bool> faces_with_images_behind(const ContactPair &pair, const MPI_Comm communicator);

  /// Collective. Leaves what of the others has its image behind the body out of the mapping between the
  /// surfaces of a pair: slivers where normals near the tip of a tooth lead through it. Nothing if nothing
  /// else is there.
  void leave_out_images_behind(ContactMapping &mapping, const ContactPair &pair, const MPI_Comm communicator);

  /// Takes faces from a whole surface.
  void leave_out(ContactSurface &surface, const std::vector<bool> &faces);
} // namespace Signorini

#endif
