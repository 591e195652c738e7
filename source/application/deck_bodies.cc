// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "deck_bodies.h"

#include <signorini/algebra/input_error.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  std::string plain_name(const std::string &name)
  {
    std::string result = name;
    for (char &c : result)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-' && c != '.')
        c = '_';
    return result.empty() ? "body" : result;
  }



  namespace
  {
    /// The sets that SOLID SECTIONs name, in capitals.
    std::set<std::string> names_of_sections(const Deck &deck)
    {
      std::set<std::string> names;
      for (const Deck::Other &other : deck.others())
        if (other.keyword->name == "SOLID SECTION")
          names.insert(deck_upper(other.keyword->get("ELSET")));
      return names;
    }

    /// The name of the smallest set that contains all elements, of several with the same elements that of a
    /// section, else of the first (mesh generators number theirs); empty if there is none.
    std::string smallest_set(const Deck &deck, const std::vector<unsigned int> &elements,
                             const std::set<std::string> &sections)
    {
      const DeckSet *best = nullptr;
      const auto     rank = [&](const DeckSet &set) {
        return std::make_pair(set.members.size(), sections.count(deck_upper(set.name)) == 0);
      };
      for (const DeckSet &set : deck.element_sets())
        if (set.members.size() >= elements.size() && (best == nullptr || rank(set) < rank(*best)) &&
            std::includes(set.members.begin(), set.members.end(), elements.begin(), elements.end()))
          best = &set;
      return best == nullptr ? "" : best->name;
    }

    void name_bodies(std::vector<DeckBody> &bodies, const Deck &deck)
    {
      const std::set<std::string>         sections = names_of_sections(deck);
      std::map<std::string, unsigned int> n_of_instance, n_of_name;
      for (const DeckBody &body : bodies)
        ++n_of_instance[deck.instance_of_element(body.elements[0])];
      for (DeckBody &body : bodies)
        {
          const std::string &instance = deck.instance_of_element(body.elements[0]);
          std::string        name     = instance;
          if (instance.empty() || n_of_instance[instance] > 1)
            name = smallest_set(deck, body.elements, sections);
          name = plain_name(name);
          // Several parts of one set are numbered.
          const unsigned int n = ++n_of_name[deck_upper(name)];
          body.name            = n == 1 ? name : name + "-" + std::to_string(n);
        }
    }

    void make_cells(DeckBody &body, const DeckModel &model, const std::vector<unsigned int> &part)
    {
      const Deck               &deck = model.deck();
      std::vector<unsigned int> volumes;
      for (const unsigned int e : body.elements)
        {
          const unsigned int m = model.material_of_element()[e];
          if (m == Deck::none)
            deck.text().fail(deck.elements()[e].place, "element " + std::to_string(deck.elements()[e].label) +
                                                           " has no SOLID SECTION.");
          const DeckMaterial &material = model.materials()[m];
          if (!material.elastic)
            deck.text().fail(material.place, "MATERIAL \"" + material.name + "\" has no ELASTIC.");
          const auto it = std::find(body.materials.begin(), body.materials.end(), m);
          volumes.push_back(static_cast<unsigned int>(it - body.materials.begin()));
          if (it == body.materials.end())
            body.materials.push_back(m);
        }
      body.cells = std::make_unique<DeckCells>(deck, body.elements, volumes, part);
      for (const unsigned int m : body.materials)
        body.cells->mesh.volume_names.push_back(model.materials()[m].name);
      body.boundary = find_boundary_faces(body.cells->mesh);
    }
  } // namespace



  std::vector<DeckBody> make_deck_bodies(const DeckModel &model)
  {
    const Deck                     &deck = model.deck();
    const std::vector<unsigned int> part = connected_deck_elements(deck);
    std::vector<DeckBody>           bodies;
    for (unsigned int e = 0; e < part.size(); ++e)
      if (part[e] != Deck::none)
        {
          if (part[e] >= bodies.size())
            bodies.resize(part[e] + 1);
          bodies[part[e]].elements.push_back(e);
        }
    if (bodies.empty())
      throw InputError(deck.text().files()[0] + ": there are no solid elements (C3D4, C3D8, ...).");
    name_bodies(bodies, deck);
    for (DeckBody &body : bodies)
      make_cells(body, model, part);
    return bodies;
  }



  bool name_surface(DeckBody &body, const Deck &deck, const DeckSurface &surface)
  {
    for (const auto &[name, faces] : body.named)
      if (name == surface.name)
        return !faces.empty();
    // Only what is on the boundary counts.
    const std::set<VolumeMesh::Face> all = faces_of_surface(deck, surface, *body.cells, body.boundary);
    std::set<VolumeMesh::Face>       outer;
    for (const auto &[face, cell] : body.boundary)
      if (all.count(face_key(face)) > 0)
        outer.insert(face_key(face));
    const bool is_there = !outer.empty();
    body.named.emplace_back(surface.name, std::move(outer));
    return is_there;
  }
} // namespace Signorini
