// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_rank_colour_h
#define signorini_algebra_rank_colour_h

#include <signorini/algebra/node_partition.h>

namespace Signorini
{
  /// Ranks that share ghost nodes have different colours.
  struct RankColour
  {
    /// Of this rank, from 0, and how many there are.
    unsigned int own, n_colours;
  };

  /// Collective. Greedy, in the order of the ranks.
  RankColour colour_rank(const NodePartition &partition);
} // namespace Signorini

#endif
