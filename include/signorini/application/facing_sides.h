// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_facing_sides_h
#define signorini_application_facing_sides_h

#include <signorini/application/contact_model.h>
#include <signorini/application/discretization.h>

#include <functional>
#include <memory>
#include <vector>

namespace Signorini
{
  class Journal;

  /// Collective. Takes from the whole surfaces of pairs, by pair and side, what faces nothing of the other
  /// side beyond edges (FacingParts), and what lies far from that but nearer to the other side of
  /// another pair: the shaft is between the seat of a key and the far side of the bore. Tied pairs keep that.
  void leave_out_blind_parts(std::vector<std::vector<ContactSide>> &sides,
                             const std::vector<PairModel> &pairs, const MPI_Comm communicator,
                             Journal &journal);

  /// Collective. Maps a pair without what has its image behind the nonmortar body: faces for the most part of
  /// which that is so are left out of the surface, which is mapped again, and what is left of such polygons
  /// out of the mapping. Normals of the upper half of a ball that lies on a ball meet the lower half of the
  /// other one, backward, through both bodies; near the tip of a tooth they lead through it. Nothing is left
  /// out where nothing else would be left.
  /// @param map makes the mapping of the pair as it is
  /// @param boundary_of_body the whole boundary of the nonmortar body, with what does not belong to the pair:
  /// collective, asked for where images lie far behind
  void leave_out_images_behind(ContactPair &pair, const std::function<std::shared_ptr<ContactMapping>()> &map,
                               const std::function<SurfaceMesh()> &boundary_of_body,
                               const MPI_Comm                      communicator);
} // namespace Signorini

#endif
