// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Sets and surfaces of decks, once all of their names are known.

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck.h>

#include <algorithm>
#include <array>
#include <set>

namespace Signorini
{
  template <typename Index>
  std::string Deck::key_of(const Index &index, const std::string &name, const unsigned int instance) const
  {
    if (instance != none)
      if (const std::string key = deck_upper(full_name(name, instance)); index.count(key) > 0)
        return key;
    if (const std::string key = deck_upper(name); index.count(key) > 0)
      return key;
    std::string found;
    for (unsigned int i = 0; i < instances.size(); ++i)
      if (const std::string key = deck_upper(full_name(name, i)); index.count(key) > 0)
        {
          if (!found.empty())
            return "";
          found = key;
        }
    return found;
  }



  void Deck::resolve_sets()
  {
    node_set_list.resize(raw_node_sets.list.size());
    element_set_list.resize(raw_element_sets.list.size());
    // Sets of nodes may be those of elements.
    for (unsigned int s = 0; s < element_set_list.size(); ++s)
      resolve(raw_element_sets, s, element_set_list, element_index, false);
    for (unsigned int s = 0; s < node_set_list.size(); ++s)
      resolve(raw_node_sets, s, node_set_list, node_index, true);
  }



  unsigned int Deck::member_with(const long label, const unsigned int instance,
                                 const std::unordered_map<long, unsigned int> &number,
                                 const bool                                    of_nodes) const
  {
    auto it = number.find(label + offset(instance, of_nodes));
    // The numbers of the only instance also stand for themselves.
    if (it == number.end() && instance == none && instances.size() == 1)
      it = number.find(label + offset(0, of_nodes));
    return it == number.end() ? none : it->second;
  }



  void Deck::resolve(RawSets &sets, const unsigned int s, std::vector<DeckSet> &result,
                     const std::unordered_map<long, unsigned int> &number, const bool of_nodes)
  {
    enum
    {
      untouched,
      working,
      done
    };
    // Each is a call of this function.
    constexpr unsigned int deepest = 1000;
    RawSet                &raw     = sets.list[s];
    if (raw.state == done)
      return;
    if (raw.state == working)
      source.fail(raw.entries[0].place, "the set \"" + raw.name + "\" contains itself.");
    if (++sets.n_open > deepest)
      source.fail(raw.entries[0].place, "the set \"" + raw.name + "\" is the last of " +
                                            std::to_string(sets.n_open) +
                                            " that contain each other; write its numbers.");
    raw.state                           = working;
    std::size_t               n_missing = 0;
    long                      missing   = 0;
    std::vector<unsigned int> members;
    for (const Entry &entry : raw.entries)
      {
        if (!entry.set.empty())
          {
            const std::string key = key_of(sets.index, entry.set, entry.instance);
            if (key.empty())
              source.fail(entry.place, "there is no set \"" + entry.set + "\" (that only one instance has).");
            const unsigned int other = sets.index.at(key);
            resolve(sets, other, result, number, of_nodes);
            members.insert(members.end(), result[other].members.begin(), result[other].members.end());
            continue;
          }
        // Ranges may be far longer than the list of what there is: then this is looked through.
        if (const auto n = static_cast<std::size_t>(std::max(0l, (entry.last - entry.first) / entry.step));
            n > 10 * number.size() + 1000)
          {
            for (const auto &[key, member] : number)
              for (const unsigned int i : {entry.instance, instances.size() == 1 ? 0u : entry.instance})
                if (const long label = key - offset(i, of_nodes);
                    label >= entry.first && label <= entry.last && (label - entry.first) % entry.step == 0 &&
                    member_with(label, entry.instance, number, of_nodes) == member)
                  members.push_back(member);
            continue;
          }
        for (long label = entry.first; label <= entry.last; label += entry.step)
          if (const unsigned int member = member_with(label, entry.instance, number, of_nodes);
              member != none)
            members.push_back(member);
          else
            {
              ++n_missing;
              missing = label;
            }
      }
    for (const Entry &entry : raw.of_elements)
      for (const unsigned int element : elements_of(entry.set, entry.place, entry.instance))
        members.insert(members.end(), element_list[element].nodes.begin(), element_list[element].nodes.end());
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    const bool is_range =
        std::all_of(raw.entries.begin(), raw.entries.end(), [](const Entry &e) { return e.last > e.first; });
    if (n_missing > 0 && !is_range)
      remark_list.push_back(source.where(raw.entries[0].place) + ": " + std::to_string(n_missing) +
                            " numbers in the set \"" + raw.name + "\" (" + std::to_string(missing) +
                            " for one) belong to no " + (of_nodes ? "node." : "element."));
    result[s] = {raw.name, std::move(members)};
    raw.state = done;
    --sets.n_open;
  }



  const DeckSet *Deck::find_node_set(const std::string &name, const unsigned int instance) const
  {
    const std::string key = key_of(raw_node_sets.index, name, instance);
    return key.empty() ? nullptr : &node_set_list[raw_node_sets.index.at(key)];
  }



  const DeckSet *Deck::find_element_set(const std::string &name, const unsigned int instance) const
  {
    const std::string key = key_of(raw_element_sets.index, name, instance);
    return key.empty() ? nullptr : &element_set_list[raw_element_sets.index.at(key)];
  }



  std::vector<unsigned int> Deck::nodes_of(const std::string &word, const DeckPlace &place,
                                           const unsigned int instance) const
  {
    const Entry entry = entry_of(word, place, instance);
    if (entry.set.empty())
      {
        const unsigned int node = member_with(entry.first, entry.instance, node_index, true);
        if (node == none)
          source.fail(place, "there is no node " + word + ".");
        return {node};
      }
    if (const DeckSet *set = find_node_set(word, instance))
      return set->members;
    source.fail(place, "there is no NSET \"" + word + "\"." +
                           (find_element_set(word, instance) == nullptr
                                ? ""
                                : " There is an ELSET of that name: its nodes are *NSET, NSET=" + word +
                                      ", ELSET=" + word + "."));
  }



  std::vector<unsigned int> Deck::elements_of(const std::string &word, const DeckPlace &place,
                                              const unsigned int instance) const
  {
    const Entry entry = entry_of(word, place, instance);
    if (entry.set.empty())
      {
        const unsigned int element = member_with(entry.first, entry.instance, element_index, false);
        if (element == none)
          source.fail(place, "there is no element " + word + ".");
        return {element};
      }
    if (const DeckSet *set = find_element_set(word, instance))
      return set->members;
    source.fail(place, "there is no ELSET \"" + word + "\".");
  }



  const DeckSurface &Deck::surface(const std::string &name, const DeckPlace &place,
                                   const unsigned int instance) const
  {
    const std::string key = key_of(surface_index, name, instance);
    if (key.empty())
      source.fail(place, "there is no SURFACE \"" + name + "\".");
    return surface_list[surface_index.at(key)];
  }



  namespace
  {
    /// Without what is there: a line of the file, of one instance, is in a surface once. (Else surfaces of
    /// twice the one before would grow beyond all memory.)
    void add_to_union(DeckSurface &surface, const DeckSurface &part)
    {
      const auto key = [](const DeckSurface::Faces &faces) {
        return std::array<unsigned int, 3>{
            {faces.place.file, faces.place.line, faces.elements.empty() ? Deck::none : faces.elements[0]}};
      };
      std::set<std::array<unsigned int, 3>> known;
      for (const DeckSurface::Faces &faces : surface.faces)
        known.insert(key(faces));
      std::set<unsigned int> known_nodes(surface.nodes.begin(), surface.nodes.end());
      // A surface may be a part of itself.
      for (std::size_t i = 0, n = part.faces.size(); i < n; ++i)
        if (known.insert(key(part.faces[i])).second)
          surface.faces.push_back(part.faces[i]);
      for (std::size_t i = 0, n = part.nodes.size(); i < n; ++i)
        if (known_nodes.insert(part.nodes[i]).second)
          surface.nodes.push_back(part.nodes[i]);
      surface.is_of_nodes = surface.is_of_nodes || part.is_of_nodes;
    }
  } // namespace



  void Deck::resolve_surfaces()
  {
    for (const auto &[s, other] : surface_keywords)
      {
        const DeckKeyword &keyword  = *other.keyword;
        const unsigned int instance = other.instance;
        DeckSurface       &surface  = surface_list[s];
        const std::string  type     = deck_upper(keyword.get("TYPE"));
        const std::string  combine  = deck_upper(keyword.get("COMBINE"));
        if (!type.empty() && type != "ELEMENT" && type != "NODE")
          source.fail(keyword.place, "surfaces of TYPE=" + type + " are not supported; use ELEMENT or NODE.");
        if (!combine.empty() && combine != "UNION")
          source.fail(keyword.place, "of surfaces that combine others only COMBINE=UNION is supported.");
        surface.is_of_nodes = surface.is_of_nodes || type == "NODE";
        for (const DeckLine &line : keyword.lines)
          {
            const std::vector<std::string> words = deck_words(line.text);
            if (words.empty())
              continue;
            if (!combine.empty())
              for (const std::string &name : words)
                add_to_union(surface, this->surface(name, line.place, instance));
            else if (type == "NODE")
              for (const unsigned int node : nodes_of(words[0], line.place, instance))
                surface.nodes.push_back(node);
            else
              surface.faces.push_back({elements_of(words[0], line.place, instance),
                                       words.size() > 1 ? deck_upper(words[1]) : "", line.place});
          }
      }
  }



  const std::string &Deck::instance_of_element(const unsigned int element) const
  {
    static const std::string no_name;
    for (const Instance &instance : instances)
      if (element >= instance.first_element && element < instance.end_element)
        return instance.name;
    return no_name;
  }
} // namespace Signorini
