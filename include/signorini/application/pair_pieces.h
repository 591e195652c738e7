// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_pair_pieces_h
#define signorini_application_pair_pieces_h

#include <signorini/application/discretization.h>

namespace Signorini
{
  /// Collective. Cuts a mapped and coupled pair down to what this rank needs of it from then on: the faces on
  /// which it works and those around them, ghost faces, what the mapping finds opposite, and the faces of its
  /// own cells. Numbers of faces, triangles and vertices in the pair and its coupling change; their order,
  /// and so all sums, stay.
  void keep_piece(ContactPair &pair, PairCoupling &coupling, const MPI_Comm communicator);

  /// Bytes of a pair on this rank: surfaces, mapping, halo, moments, coupling.
  std::size_t memory_consumption(const ContactPair &pair, const PairCoupling &coupling);
} // namespace Signorini

#endif
