// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_deck_bodies_h
#define signorini_source_application_deck_bodies_h

#include <signorini/application/deck_problem.h>
#include <signorini/mesh/deck_elements.h>

#include <memory>

namespace Signorini
{
  class DeckHistory;

  /// One connected part of a deck while it becomes a body.
  struct DeckBody
  {
    std::string                name;
    std::vector<unsigned int>  elements;
    std::unique_ptr<DeckCells> cells;
    BoundaryOfCells            boundary;
    NamedFaces                 named;
    /// Materials of its volumes.
    std::vector<unsigned int> materials;
    LoadDefinition            loads;
  };

  /// The connected parts with their cells and names. Errors: InputError for elements without material.
  std::vector<DeckBody> make_deck_bodies(const DeckModel &model);

  /// Names faces of a body for a surface, once; false if it has none of them.
  bool name_surface(DeckBody &body, const Deck &deck, const DeckSurface &surface);

  /// Makes boundaries rigid as RIGID BODY, couplings and equations say. Returns the reference nodes, whose
  /// conditions and forces have been taken with them. Errors: InputError for nodes that are no faces.
  std::set<unsigned int> add_rigid_faces(std::vector<DeckBody> &bodies, const DeckModel &model,
                                         const DeckHistory &history);

  /// Makes temperatures strains without stress, of the bodies whose materials expand.
  void add_temperatures(std::vector<DeckBody> &bodies, const DeckModel &model, const DeckHistory &history);

  /// Makes sections of bolts volumes with pretension. Returns their nodes, whose forces have been taken with
  /// them. Errors: InputError where the elements behind a section are no layer between two planes, and for
  /// sections without a force.
  std::set<unsigned int> add_bolts(std::vector<DeckBody> &bodies, const DeckModel &model,
                                   const DeckHistory &history);

  /// Moves nodes of the dependent surface of a pair onto the other one, as ADJUST says. Returns a remark, or
  /// nothing if none was moved.
  std::string adjust_nodes(DeckBody &first, const DeckBody &second, const DeckPair &pair);

  /// What can be a name of files and parameters, too.
  std::string plain_name(const std::string &name);

  /// Adds what acts on the bodies; appends remarks. Returns how many steps the loads are given for: all of
  /// the deck, or one.
  unsigned int add_deck_loads(std::vector<DeckBody> &bodies, const DeckModel &model,
                              std::vector<std::string> &remarks);
} // namespace Signorini

#endif
