// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck.h>
#include <signorini/mesh/deck_elements.h>

#include <deal.II/base/numbers.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Keywords that only say what belongs together.
    bool is_bracket(const std::string &name)
    {
      return name == "ASSEMBLY" || name == "END ASSEMBLY" || name == "END PART" || name == "END INSTANCE";
    }
  } // namespace



  Deck::Deck(const std::string &file)
    : source(file)
  {
    read_keywords();
    for (const auto &[keyword, instance] : element_keywords)
      {
        if (instance != none && instances[instance].end_element == 0)
          {
            instances[instance].element_offset = largest_element;
            instances[instance].first_element  = static_cast<unsigned int>(element_list.size());
          }
        read_elements(*keyword, instance);
        if (instance != none)
          instances[instance].end_element = static_cast<unsigned int>(element_list.size());
      }
    resolve_sets();
    resolve_surfaces();
  }



  void Deck::read_keywords()
  {
    const auto &keywords = source.keywords();
    for (std::size_t i = 0; i < keywords.size(); ++i)
      if (keywords[i].name == "PART")
        {
          std::size_t end = i + 1;
          while (end < keywords.size() && keywords[end].name != "END PART" && keywords[end].name != "PART" &&
                 keywords[end].name != "ASSEMBLY")
            ++end;
          parts[deck_upper(keywords[i].get("NAME"))] = {i + 1, end};
          i = end - (end < keywords.size() && keywords[end].name == "END PART" ? 0 : 1);
        }
    const bool has_instances = std::any_of(keywords.begin(), keywords.end(),
                                           [](const DeckKeyword &k) { return k.name == "INSTANCE"; });
    for (std::size_t i = 0; i < keywords.size(); ++i)
      if (keywords[i].name == "PART")
        {
          const auto [begin, end] = parts.at(deck_upper(keywords[i].get("NAME")));
          if (!has_instances)
            {
              Instance instance;
              instance.name        = keywords[i].get("NAME");
              instance.node_offset = largest_node;
              instances.push_back(instance);
              instance_index[deck_upper(instance.name)] = static_cast<unsigned int>(instances.size() - 1);
              for (std::size_t k = begin; k < end; ++k)
                read_keyword(keywords[k], static_cast<unsigned int>(instances.size() - 1));
            }
          i = end - 1;
        }
      else if (keywords[i].name == "INSTANCE")
        {
          std::size_t end = i + 1;
          while (end < keywords.size() && keywords[end].name != "END INSTANCE")
            ++end;
          if (end == keywords.size())
            source.fail(keywords[i].place, "this INSTANCE has no END INSTANCE. Is the file cut off?");
          read_instance(i, end);
          i = end;
        }
      else
        read_keyword(keywords[i], none);
  }



  void Deck::set_placement(Instance &instance, const DeckKeyword &keyword) const
  {
    for (unsigned int c = 0; c < 3; ++c)
      instance.rotation[c][c] = 1.;
    std::vector<std::vector<double>> rows;
    for (const DeckLine &line : keyword.lines)
      {
        rows.emplace_back();
        for (const std::string &word : deck_words(line.text))
          rows.back().push_back(word.empty() ? 0. : source.number(word, line.place));
      }
    if (rows.empty())
      return;
    instance.is_moved = true;
    if (rows.size() > 2 || rows[0].size() > 3 || (rows.size() == 2 && rows[1].size() != 7))
      source.fail(keyword.place,
                  "an INSTANCE has three numbers for its translation, and then two points of an "
                  "axis and an angle (seven numbers) for its rotation.");
    for (unsigned int c = 0; c < rows[0].size(); ++c)
      instance.translation[c] = rows[0][c];
    if (rows.size() < 2)
      return;
    const Point<3> a(rows[1][0], rows[1][1], rows[1][2]), b(rows[1][3], rows[1][4], rows[1][5]);
    if (!(a.distance(b) > 0.))
      source.fail(keyword.place, "the two points of the axis of rotation are the same.");
    instance.pivot    = a;
    instance.rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
        Point<3>((b - a) / a.distance(b)), rows[1][6] * numbers::PI / 180.);
  }



  void Deck::read_instance(const std::size_t begin, const std::size_t end)
  {
    const DeckKeyword &keyword = source.keywords()[begin];
    Instance           instance;
    instance.name        = keyword.get("NAME");
    instance.node_offset = largest_node;
    set_placement(instance, keyword);
    const auto number = static_cast<unsigned int>(instances.size());
    if (!instance_index.insert({deck_upper(instance.name), number}).second)
      source.fail(keyword.place, "there are two instances \"" + instance.name + "\".");
    instances.push_back(instance);
    if (!keyword.get("PART").empty())
      add_part(keyword.get("PART"), keyword.place, number);
    for (std::size_t k = begin + 1; k < end; ++k)
      read_keyword(source.keywords()[k], number);
  }



  void Deck::add_part(const std::string &name, const DeckPlace &place, const unsigned int instance)
  {
    const auto part = parts.find(deck_upper(name));
    if (part == parts.end())
      source.fail(place, "there is no PART \"" + name + "\".");
    for (std::size_t k = part->second.first; k < part->second.second; ++k)
      read_keyword(source.keywords()[k], instance);
  }



  unsigned int Deck::instance_of_option(const DeckKeyword &keyword, const unsigned int instance) const
  {
    const std::string &name = keyword.get("INSTANCE");
    if (name.empty())
      return instance;
    const auto it = instance_index.find(deck_upper(name));
    if (it == instance_index.end())
      source.fail(keyword.place, "there is no INSTANCE \"" + name + "\".");
    return it->second;
  }



  void Deck::read_keyword(const DeckKeyword &keyword, const unsigned int instance)
  {
    const std::string &name = keyword.name;
    if (name == "NODE")
      read_nodes(keyword, instance);
    else if (name == "ELEMENT")
      {
        // Nodes may come behind the elements.
        if (keyword.has("ELSET"))
          raw_set(raw_element_sets, keyword.get("ELSET"), instance);
        element_keywords.push_back({&keyword, instance});
      }
    else if (name == "NSET")
      read_set(raw_node_sets, keyword, "NSET", instance);
    else if (name == "ELSET")
      read_set(raw_element_sets, keyword, "ELSET", instance);
    else if (name == "SURFACE")
      read_surface(keyword, instance);
    else if (name == "SYSTEM")
      {
        if (!keyword.lines.empty())
          source.fail(keyword.place, "SYSTEM with an origin of its own is not supported; write the nodes in "
                                     "global coordinates.");
      }
    else if (!is_bracket(name))
      other_list.push_back({&keyword, instance});
  }



  void Deck::read_nodes(const DeckKeyword &keyword, const unsigned int instance)
  {
    const std::string system = deck_upper(keyword.get("SYSTEM"));
    if (!system.empty() && system != "R" && system != "C")
      source.fail(keyword.place, "nodes in spherical coordinates are not supported.");
    // Reference nodes of an assembly have numbers of their own.
    if (instance == none && !instances.empty() && assembly_offset == 0)
      assembly_offset = largest_node;
    for (const DeckLine &line : keyword.lines)
      {
        const std::vector<std::string> words = deck_words(line.text);
        if (words.empty() || std::count(line.text.begin(), line.text.end(), ',') < 3)
          source.fail(line.place, "a node needs a number and three coordinates. Is the file cut off?");
        const long label = source.label(words[0], line.place) + offset(instance, true);
        Point<3>   x;
        for (unsigned int c = 0; c < 3; ++c)
          if (words.size() > c + 1 && !words[c + 1].empty())
            x[c] = source.number(words[c + 1], line.place);
        if (system == "C")
          x = Point<3>(x[0] * std::cos(x[1] * numbers::PI / 180.), x[0] * std::sin(x[1] * numbers::PI / 180.),
                       x[2]);
        if (instance != none && instances[instance].is_moved)
          {
            const Instance &i = instances[instance];
            x                 = i.pivot + i.rotation * (x + i.translation - i.pivot);
          }
        const auto [it, is_new] = node_index.insert({label, static_cast<unsigned int>(points.size())});
        if (is_new)
          {
            points.push_back(x);
            labels.push_back(label);
            largest_node = std::max(largest_node, label);
          }
        else if (points[it->second] != x)
          source.fail(line.place, "node " + words[0] +
                                      " is there twice, in different places. Give each node its own number.");
        if (keyword.has("NSET"))
          raw_set(raw_node_sets, keyword.get("NSET"), instance)
              .entries.push_back({label, label, 1, "", all_instances, line.place});
      }
  }



  void Deck::read_elements(const DeckKeyword &keyword, const unsigned int instance)
  {
    const std::string            name = deck_upper(keyword.get("TYPE"));
    const DeckElementType *const type = find_deck_element_type(name);
    if (type == nullptr)
      source.fail(keyword.place, "elements of type \"" + name +
                                     "\" are not supported; use C3D4, C3D6, C3D8, C3D10, C3D15 or C3D20.");
    std::vector<long> numbers;
    DeckPlace         place;
    const auto        add = [&]() {
      const long label = numbers[0] + offset(instance, false);
      if (!element_index.insert({label, static_cast<unsigned int>(element_list.size())}).second)
        source.fail(place, "element " + std::to_string(numbers[0]) +
                                      " is there twice. Give each element its own number, or take the copy out.");
      largest_element = std::max(largest_element, label);
      element_list.push_back({label, type, {}, place});
      for (unsigned int i = 1; i <= type->n_nodes; ++i)
        {
          const auto it = node_index.find(numbers[i] + offset(instance, true));
          if (it == node_index.end())
            source.fail(place, "an element refers to node " + std::to_string(numbers[i]) +
                                          ", which is missing. Is the file cut off?");
          element_list.back().nodes.push_back(it->second);
        }
      if (keyword.has("ELSET"))
        raw_set(raw_element_sets, keyword.get("ELSET"), instance)
            .entries.push_back({label, label, 1, "", all_instances, place});
      numbers.clear();
    };
    for (const DeckLine &line : keyword.lines)
      {
        if (numbers.empty())
          place = line.place;
        for (const std::string &word : deck_words(line.text))
          numbers.push_back(source.label(word, line.place));
        if (numbers.size() > type->n_nodes + 1)
          source.fail(place, "too many nodes in an element of type \"" + name + "\".");
        if (numbers.size() == type->n_nodes + 1)
          add();
      }
    if (!numbers.empty())
      source.fail(place, "an element has too few nodes. Is the file cut off?");
  }



  std::string Deck::full_name(const std::string &name, const unsigned int instance) const
  {
    return instance == none ? name : instances[instance].name + "." + name;
  }



  Deck::RawSet &Deck::raw_set(RawSets &sets, const std::string &name, const unsigned int instance)
  {
    const std::string full = full_name(name, instance);
    const auto [it, is_new] =
        sets.index.insert({deck_upper(full), static_cast<unsigned int>(sets.list.size())});
    if (is_new)
      {
        RawSet set;
        set.name     = full;
        set.instance = instance;
        sets.list.push_back(set);
      }
    return sets.list[it->second];
  }



  long Deck::offset(const unsigned int instance, const bool of_nodes) const
  {
    if (instance == all_instances)
      return 0;
    if (instance == none)
      return of_nodes ? assembly_offset : 0;
    return of_nodes ? instances[instance].node_offset : instances[instance].element_offset;
  }



  Deck::Entry Deck::entry_of(const std::string &word, const DeckPlace &place,
                             const unsigned int instance) const
  {
    const auto dot = word.rfind('.');
    if (is_deck_label(word))
      {
        const long label = source.label(word, place);
        return {label, label, 1, "", instance, place};
      }
    if (dot != std::string::npos && is_deck_label(word.substr(dot + 1)))
      if (const auto it = instance_index.find(deck_upper(word.substr(0, dot))); it != instance_index.end())
        {
          const long label = source.label(word.substr(dot + 1), place);
          return {label, label, 1, "", it->second, place};
        }
    return {0, -1, 1, word, instance, place};
  }



  void Deck::read_set(RawSets &sets, const DeckKeyword &keyword, const std::string &option,
                      const unsigned int instance)
  {
    if (keyword.get(option).empty())
      source.fail(keyword.place, option + " needs a name: *" + option + ", " + option + "=NAME.");
    // Numbers belong to the instance that is named, the name of the set to where it stands.
    const unsigned int of_numbers = instance_of_option(keyword, instance);
    RawSet            &set        = raw_set(sets, keyword.get(option), instance);
    if (option == "NSET" && keyword.has("ELSET"))
      set.of_elements.push_back({0, -1, 1, keyword.get("ELSET"), of_numbers, keyword.place});
    for (const DeckLine &line : keyword.lines)
      {
        const std::vector<std::string> words = deck_words(line.text);
        if (keyword.has("GENERATE"))
          {
            if (words.size() < 2)
              source.fail(line.place, "GENERATE needs first, last and step.");
            const Entry entry{source.label(words[0], line.place),
                              source.label(words[1], line.place),
                              words.size() > 2 ? source.label(words[2], line.place) : 1,
                              "",
                              of_numbers,
                              line.place};
            if (entry.step < 1)
              source.fail(line.place, "the step must be positive.");
            set.entries.push_back(entry);
          }
        else
          for (const std::string &word : words)
            if (!word.empty())
              set.entries.push_back(entry_of(word, line.place, of_numbers));
      }
  }



  void Deck::read_surface(const DeckKeyword &keyword, const unsigned int instance)
  {
    DeckSurface surface;
    surface.name  = full_name(keyword.get("NAME"), instance);
    surface.place = keyword.place;
    if (keyword.get("NAME").empty())
      source.fail(keyword.place, "SURFACE needs a name: *SURFACE, NAME=NAME.");
    const auto [it, is_new] =
        surface_index.insert({deck_upper(surface.name), static_cast<unsigned int>(surface_list.size())});
    if (is_new)
      surface_list.push_back(surface);
    surface_keywords.push_back({it->second, {&keyword, instance}});
  }
} // namespace Signorini
