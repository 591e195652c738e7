// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Keywords of decks: nodes that move together.

#include "deck_model_reader.h"

#include <signorini/algebra/input_error.h>

#include <algorithm>

namespace Signorini
{
  unsigned int DeckModelReader::only_node(const Keyword &keyword, const std::string &option,
                                          const unsigned int instance) const
  {
    const auto nodes = deck.nodes_of(keyword.get(option), keyword.place, instance);
    if (nodes.size() != 1)
      fail(keyword.place, option + " should be one node.");
    return nodes[0];
  }



  bool DeckModelReader::is_reference(const unsigned int node) const
  {
    return std::any_of(model.rigid_list.begin(), model.rigid_list.end(), [node](const DeckRigid &rigid) {
      return !rigid.translates_only && rigid.reference == node;
    });
  }



  void DeckModelReader::read_rigid_body(const Keyword &keyword, const unsigned int instance)
  {
    if (keyword.get("NSET").empty() || keyword.get("REF NODE").empty())
      {
        model.refuse(keyword.place, "RIGID BODY", "it needs an NSET and a REF NODE.");
        return;
      }
    DeckRigid rigid;
    rigid.keyword   = "RIGID BODY";
    rigid.place     = keyword.place;
    rigid.nodes     = deck.nodes_of(keyword.get("NSET"), keyword.place, instance);
    rigid.reference = only_node(keyword, "REF NODE", instance);
    if (!keyword.get("ROT NODE").empty())
      rigid.rotation = only_node(keyword, "ROT NODE", instance);
    model.rigid_list.push_back(rigid);
  }



  void DeckModelReader::read_pretension(const Keyword &keyword, const unsigned int instance)
  {
    if (keyword.get("SURFACE").empty() || keyword.get("NODE").empty())
      {
        model.refuse(keyword.place, "PRE-TENSION SECTION",
                     "pretension acts on a SURFACE between solid elements, by the force of a NODE.");
        return;
      }
    DeckPretension bolt;
    bolt.place   = keyword.place;
    bolt.surface = &deck.surface(keyword.get("SURFACE"), keyword.place, instance);
    bolt.node    = only_node(keyword, "NODE", instance);
    if (!keyword.lines.empty())
      bolt.axis = direction(deck_words(keyword.lines[0].text), 0, keyword.lines[0]);
    if (std::any_of(bolt.surface->faces.begin(), bolt.surface->faces.end(),
                    [](const DeckSurface::Faces &faces) { return faces.side.empty(); }) ||
        bolt.surface->faces.empty())
      {
        model.refuse(keyword.place, "PRE-TENSION SECTION",
                     "the surface should be sides (S1, S2, ...) of the elements behind the section.");
        return;
      }
    model.pretension_list.push_back(bolt);
  }



  void DeckModelReader::lock(const DeckLine &line, const unsigned int instance)
  {
    const Words                     words = deck_words(line.text);
    const std::vector<unsigned int> nodes =
        words.empty() ? std::vector<unsigned int>() : deck.nodes_of(words[0], line.place, instance);
    const auto &bolts = model.pretensions();
    for (const unsigned int node : nodes)
      if (words.size() < 2 || words[1] != "1" || (words.size() > 2 && !words[2].empty() && words[2] != "1") ||
          std::none_of(bolts.begin(), bolts.end(),
                       [node](const DeckPretension &bolt) { return bolt.node == node; }))
        {
          model.refuse(line.place, "BOUNDARY",
                       "FIXED is supported in direction 1 of nodes of a PRE-TENSION SECTION only.");
          return;
        }
    for (const unsigned int node : nodes)
      state.locked_nodes.insert({node, step});
  }



  void DeckModelReader::read_kinematic_coupling(const Keyword &keyword, const unsigned int instance)
  {
    DeckRigid rigid;
    rigid.keyword   = "KINEMATIC COUPLING";
    rigid.place     = keyword.place;
    rigid.reference = only_node(keyword, "REF NODE", instance);
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 2 || deck.text().label(words[1], line.place) != 1 ||
            (words.size() > 2 ? deck.text().label(words[2], line.place) : 1) < 3)
          {
            model.refuse(line.place, "KINEMATIC COUPLING", "nodes follow in all directions (1, 3) only.");
            return;
          }
        const auto nodes = deck.nodes_of(words[0], line.place, instance);
        rigid.nodes.insert(rigid.nodes.end(), nodes.begin(), nodes.end());
      }
    model.rigid_list.push_back(rigid);
  }



  void DeckModelReader::read_coupling(const Keyword &keyword, const unsigned int instance)
  {
    coupling           = DeckRigid();
    coupling.keyword   = "COUPLING";
    coupling.place     = keyword.place;
    coupling.reference = only_node(keyword, "REF NODE", instance);
    coupling.surface   = &deck.surface(keyword.get("SURFACE"), keyword.place, instance);
  }



  void DeckModelReader::read_kinematic(const Keyword &keyword, const unsigned int)
  {
    if (coupling.surface == nullptr)
      fail(keyword.place, "KINEMATIC belongs below a COUPLING.");
    unsigned int held = keyword.lines.empty() ? 7 : 0;
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        const long  first = deck.text().label(words.empty() ? "" : words[0], line.place);
        const long  last  = words.size() > 1 ? deck.text().label(words[1], line.place) : first;
        for (long c = std::max(first, 1l); c <= std::min(last, 3l); ++c)
          held |= 1u << (c - 1);
      }
    if ((held & 7) != 7)
      model.refuse(keyword.place, "KINEMATIC", "nodes follow in all directions (1, 3) only.");
    else
      model.rigid_list.push_back(coupling);
  }



  void DeckModelReader::read_equation(const Keyword &keyword, const unsigned int instance)
  {
    const std::string advice = "only equations that make nodes move alike (u - v = 0) are taken.";
    first_equation           = keyword.place;
    Words words;
    long  n_terms = 0;
    for (const DeckLine &line : keyword.lines)
      {
        const Words more = deck_words(line.text);
        if (n_terms == 0)
          {
            n_terms = deck.text().label(more.empty() ? "" : more[0], line.place);
            words.clear();
            continue;
          }
        words.insert(words.end(), more.begin(), more.end());
        if (static_cast<long>(words.size()) < 3 * n_terms)
          continue;
        const auto term = [&](const std::size_t i) {
          return std::make_pair(deck.text().label(words[3 * i + 1], line.place),
                                deck.text().number(words[3 * i + 2], line.place));
        };
        if (n_terms != 2 || term(0).first != term(1).first || term(0).second != -term(1).second ||
            term(0).first < 1 || term(0).first > 3)
          {
            model.refuse(line.place, "EQUATION", advice);
            return;
          }
        const auto first  = deck.nodes_of(words[0], line.place, instance),
                   second = deck.nodes_of(words[3], line.place, instance);
        for (const unsigned int a : first)
          for (const unsigned int b : second)
            alike[term(0).first - 1].emplace_back(a, b);
        n_terms = 0;
      }
  }



  namespace
  {
    /// The sets of nodes that pairs connect.
    std::vector<std::vector<unsigned int>>
    connected(const std::vector<std::pair<unsigned int, unsigned int>> &pairs)
    {
      std::map<unsigned int, unsigned int> root;
      const auto                           find = [&](unsigned int v) {
        while (root.insert({v, v}).first->second != v)
          v = root[v];
        return v;
      };
      for (const auto &[a, b] : pairs)
        root[find(a)] = find(b);
      std::map<unsigned int, std::vector<unsigned int>> sets;
      for (const auto &entry : root)
        sets[find(entry.first)].push_back(entry.first);
      std::vector<std::vector<unsigned int>> result;
      for (const auto &entry : sets)
        result.push_back(entry.second);
      return result;
    }
  } // namespace



  void DeckModelReader::join_equations()
  {
    // Sets of nodes, and the directions in which they move alike.
    std::map<std::vector<unsigned int>, unsigned int> directions;
    for (unsigned int c = 0; c < 3; ++c)
      for (const std::vector<unsigned int> &nodes : connected(alike[c]))
        directions[nodes] |= 1u << c;
    for (const auto &[nodes, mask] : directions)
      {
        DeckRigid rigid;
        rigid.keyword         = "EQUATION";
        rigid.place           = first_equation;
        rigid.nodes           = nodes;
        rigid.translates_only = true;
        model.rigid_list.push_back(rigid);
        if (mask != 7)
          model.differ(first_equation,
                       "EQUATION: nodes that move alike in some directions do so in all, as the face of a "
                       "stiff plate that does not turn.");
      }
  }
} // namespace Signorini
