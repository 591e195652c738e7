// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_claims_h
#define signorini_mortar_face_claims_h

#include <signorini/mortar/face_moments.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// The nodes of a face, sorted: the same in all pairs and on all ranks.
  using FaceName = std::array<NodeIndex, 4>;
  FaceName name_of(const ContactSurface &surface, const unsigned int face);

  /// What a pair covers of its nonmortar surface.
  struct ClaimedFaces
  {
    /// The surface and the moments of own and ghost faces; both must outlive this.
    const ContactSurface     &nonmortar;
    std::vector<FaceMoments> &moments;
    /// Whether it loses no faces.
    bool is_tied;
  };

  /// Whether the surfaces are farther apart over a face, in the mean, than the face is wide: small
  /// displacements do not close that.
  bool is_far(const FaceMoments &moments);

  /// Collective. A face that several pairs cover as a nonmortar one (a roller between two races) belongs to
  /// the nearest of them; those from which it is far (is_far()) lose it: it counts as uncovered there. Tied
  /// pairs keep what they have, and so does a pair that would be left with nothing. Returns how many faces
  /// pairs have lost, over all ranks.
  std::size_t leave_faces_to_nearest(const std::vector<ClaimedFaces> &pairs, const MPI_Comm communicator);
} // namespace Signorini

#endif
