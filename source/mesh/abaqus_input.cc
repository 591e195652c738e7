// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/abaqus_input.h>
#include <signorini/mesh/deck_elements.h>
#include <signorini/mesh/mesh_input.h>

namespace Signorini
{
  namespace
  {
    /// By element the index of its volume name: the last ELSET that contains it.
    std::vector<unsigned int> volumes(std::vector<std::string> &names, const Deck &deck,
                                      const std::vector<unsigned int> &elements)
    {
      std::vector<unsigned int> set_of(deck.elements().size(), Deck::none);
      for (unsigned int s = 0; s < deck.element_sets().size(); ++s)
        for (const unsigned int e : deck.element_sets()[s].members)
          set_of[e] = s;
      std::vector<unsigned int> result;
      for (const unsigned int e : elements)
        result.push_back(
            index_of(names, set_of[e] == Deck::none ? "unnamed" : deck.element_sets()[set_of[e]].name));
      return result;
    }

    /// Sets of face elements only.
    bool names_faces(const Deck &deck, const DeckSet &set)
    {
      return !set.members.empty() &&
             std::all_of(set.members.begin(), set.members.end(), [&](const unsigned int e) {
               return deck.elements()[e].type->shape == DeckElementType::face;
             });
    }

    NamedFaces name_all(const Deck &deck, const DeckCells &cells, const BoundaryOfCells &boundary)
    {
      NamedFaces            named;
      std::set<std::string> known;
      const auto            add = [&](const std::string &name, const std::set<VolumeMesh::Face> &faces) {
        if (!faces.empty() && known.insert(deck_upper(name)).second)
          named.emplace_back(name, faces);
      };
      for (const DeckSurface &surface : deck.surfaces())
        add(surface.name, faces_of_surface(deck, surface, cells, boundary));
      for (const DeckSet &set : deck.element_sets())
        if (names_faces(deck, set))
          {
            std::set<VolumeMesh::Face> faces;
            for (const unsigned int e : set.members)
              for (const VolumeMesh::Face &face : cells.face(deck.elements()[e]))
                faces.insert(face);
            add(set.name, faces);
          }
      for (const DeckSet &set : deck.node_sets())
        add(set.name, faces_within(set.members, cells, boundary));
      return named;
    }
  } // namespace



  VolumeMesh read_abaqus_mesh(const std::string &file)
  {
    const Deck                deck(file);
    std::vector<unsigned int> elements;
    for (unsigned int e = 0; e < deck.elements().size(); ++e)
      if (deck.elements()[e].type->is_solid())
        elements.push_back(e);
    if (elements.empty())
      throw InputError("Mesh file \"" + file + "\": it contains no solid elements (C3D4, C3D8, ...).");
    std::vector<std::string>        names;
    const std::vector<unsigned int> volume = volumes(names, deck, elements);
    DeckCells                       cells(deck, elements, volume, connected_deck_elements(deck));
    const BoundaryOfCells           boundary = find_boundary_faces(cells.mesh);
    const NamedFaces                named    = name_all(deck, cells, boundary);
    std::vector<std::pair<std::string, std::vector<unsigned int>>> node_sets;
    for (const DeckSet &set : deck.node_sets())
      node_sets.emplace_back(set.name, vertices_within(set.members, cells));
    VolumeMesh mesh   = std::move(cells.mesh);
    mesh.volume_names = names;
    mesh.node_sets    = std::move(node_sets);
    name_faces(mesh, boundary, named);
    for (const std::string &remark : deck.remarks())
      mesh.notes.push_back(remark);
    return mesh;
  }
} // namespace Signorini
