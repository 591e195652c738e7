// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_deck_joined_sets_h
#define signorini_source_application_deck_joined_sets_h

#include "deck_bodies.h"
#include "deck_series.h"

#include <string>
#include <vector>

namespace Signorini
{
  /// Values of the directions of a condition, where it holds them.
  using DeckValues = std::array<std::optional<DeckSeries>, 3>;

  /// Nodes that a condition of a deck holds along some axes.
  struct HeldSet
  {
    std::string               name;
    std::vector<unsigned int> nodes;
    DeckValues                values;
    /// Index of the frame of the axes, Deck::none for those of space.
    unsigned int frame;
  };

  /// A part of the boundary of a body that several sets hold in one direction, each of them some nodes.
  struct JoinedSet
  {
    std::string               name;
    std::vector<unsigned int> vertices;
    /// The direction, along the axes of a frame.
    unsigned int component, frame;
    ScalarField  value;
  };

  /// Where faces of a body have nodes of several sets that hold the same direction, new nodes of refined
  /// meshes between these belong to none of them (an edge that is held alone, a surface in two halves, values
  /// node by node). Such faces are joined, with those of them that they hang together with, if a node of them
  /// lies in no other smooth part of the boundary, or if a face of one set lies smoothly beside one of them
  /// and the rest of its nodes is of another set. So the side of a plate of one layer that is held on both
  /// faces stays free.
  std::vector<JoinedSet> join_held_sets(const DeckBody &body, const std::vector<HeldSet> &sets);

  /// A function by its values at the vertices of a body.
  ScalarField nodal_field(const DeckBody &body, const std::vector<DeckSeries> &at_vertices);
} // namespace Signorini

#endif
