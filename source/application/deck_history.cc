// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Keywords of decks: contact, and what acts in the steps.

#include "deck_model_reader.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/deck_elements.h>

#include <algorithm>
#include <iterator>

namespace Signorini
{
  using namespace dealii;

  void DeckModelReader::read_interaction(const Keyword &keyword, const unsigned int)
  {
    interaction = deck_upper(keyword.get("NAME"));
    interactions[interaction];
  }



  void DeckModelReader::read_behaviour(const Keyword &keyword, const unsigned int)
  {
    const std::string law = deck_upper(keyword.get("PRESSURE-OVERCLOSURE"));
    if (keyword.has("NO SEPARATION"))
      model.refuse(keyword.place, "SURFACE BEHAVIOR", "surfaces that cannot separate are not supported.");
    if (law == "TIED")
      interactions[interaction].is_tied = true;
    else if (!law.empty() && law != "HARD")
      model.differ(keyword.place, "the penalty law PRESSURE-OVERCLOSURE=" + law +
                                      " is taken as hard contact: surfaces do not overlap.");
  }



  bool DeckModelReader::has_friction(const Keyword &keyword, const Deck &deck)
  {
    const Words words = keyword.lines.empty() ? Words() : deck_words(keyword.lines[0].text);
    return words.empty() || keyword.has("ROUGH") ||
           deck.text().number(words[0], keyword.lines[0].place) != 0.;
  }



  void DeckModelReader::read_friction(const Keyword &keyword, const unsigned int)
  {
    if (!has_friction(keyword, deck))
      return;
    // CalculiX wants the stiffness of what sticks there.
    if (interactions[interaction].is_tied)
      model.differ(keyword.place, "FRICTION of tied surfaces: these do not slide at all.");
    else
      model.refuse(keyword.place, "FRICTION", "contact is frictionless.");
  }



  void DeckModelReader::read_contact_pair(const Keyword &keyword, const unsigned int instance)
  {
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 2)
          fail(line.place, "CONTACT PAIR needs two surfaces: the dependent one, then the independent one.");
        DeckPair pair;
        pair.slave   = &deck.surface(words[0], line.place, instance);
        pair.master  = &deck.surface(words[1], line.place, instance);
        pair.name    = pair.slave->name + "-" + pair.master->name;
        pair.is_tied = keyword.has("TIED");
        pair.place   = line.place;
        if (const std::string &adjust = keyword.get("ADJUST"); !adjust.empty())
          {
            if (adjust.find_first_not_of("0123456789.+-eEdD") == std::string::npos)
              pair.adjust = deck.text().number(adjust, keyword.place);
            else
              pair.adjusted_nodes = deck.nodes_of(adjust, keyword.place, instance);
          }
        contact.emplace_back(pair, keyword.get("INTERACTION"));
      }
  }



  void DeckModelReader::read_tie(const Keyword &keyword, const unsigned int instance)
  {
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 2)
          fail(line.place, "TIE needs two surfaces: the dependent one, then the independent one.");
        DeckPair pair;
        pair.slave  = &deck.surface(words[0], line.place, instance);
        pair.master = &deck.surface(words[1], line.place, instance);
        pair.name =
            keyword.get("NAME").empty() ? pair.slave->name + "-" + pair.master->name : keyword.get("NAME");
        pair.is_tied = true;
        pair.place   = line.place;
        contact.emplace_back(pair, "");
      }
  }



  void DeckModelReader::read_initial_conditions(const Keyword &keyword, const unsigned int instance)
  {
    const std::string type = deck_upper(keyword.get("TYPE"));
    if (type != "TEMPERATURE")
      {
        model.refuse(keyword.place, "INITIAL CONDITIONS", "TYPE=" + type + " is not supported.");
        return;
      }
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 2)
          fail(line.place, "a node or a set and its temperature are needed.");
        for (const unsigned int node : deck.nodes_of(words[0], line.place, instance))
          model.initial_temperature[node] = number(words, 1, line);
      }
  }



  void DeckModelReader::read_step(const Keyword &keyword, const unsigned int)
  {
    if (is_in_step)
      fail(keyword.place, "a STEP within a STEP. Is there an END STEP missing?");
    is_in_step = true;
    ++step;
    period                   = 1.;
    const std::string nlgeom = deck_upper(keyword.get("NLGEOM"));
    state.nonlinear_geometry = keyword.has("NLGEOM") && nlgeom != "NO" && nlgeom != "OFF";
    if (state.nonlinear_geometry)
      model.differ(keyword.place,
                   "NLGEOM: displacements, rotations and strains are taken as small; what this costs is "
                   "said at the end.");
    if (keyword.has("PERTURBATION"))
      model.refuse(keyword.place, "STEP", "PERTURBATION is not supported.");
  }



  void DeckModelReader::read_static(const Keyword &keyword, const unsigned int)
  {
    if (!is_in_step)
      fail(keyword.place, "STATIC belongs into a STEP.");
    if (keyword.lines.empty())
      return;
    const Words words = deck_words(keyword.lines[0].text);
    if (words.size() > 1 && !words[1].empty())
      period = number(words, 1, keyword.lines[0]);
  }



  void DeckModelReader::read_end_step(const Keyword &keyword, const unsigned int)
  {
    if (!is_in_step)
      fail(keyword.place, "END STEP without STEP.");
    state.time += period;
    follow_total_time();
    is_in_step = false;
    model.step_list.push_back(state);
  }



  bool DeckModelReader::is_new(const Keyword &keyword) const
  {
    return deck_upper(keyword.get("OP")) == "NEW";
  }



  void DeckModelReader::read_boundary(const Keyword &keyword, const unsigned int instance)
  {
    for (const char *const option : {"USER", "SUBMODEL", "BASE MOTION", "BLANKING"})
      if (keyword.has(option))
        model.refuse(keyword.place, "BOUNDARY", std::string(option) + " is not supported.");
    if (const std::string type = deck_upper(keyword.get("TYPE")); !type.empty() && type != "DISPLACEMENT")
      model.refuse(keyword.place, "BOUNDARY", "TYPE=" + type + " is not supported.");
    if (is_new(keyword))
      {
        for (auto node = state.locked_nodes.begin(); node != state.locked_nodes.end();)
          node = node->second < step ? state.locked_nodes.erase(node) : std::next(node);
        if (!keyword.has("FIXED"))
          {
            state.boundaries.clear();
            state.rotations.clear();
          }
      }
    for (const DeckLine &line : keyword.lines)
      if (keyword.has("FIXED"))
        lock(line, instance);
      else
        add_boundary(keyword, line, instance);
  }



  namespace
  {
    /// Directions that a name of a condition holds, as bits; 0 for other words.
    unsigned int named_directions(const std::string &word)
    {
      static const std::map<std::string, unsigned int> names = {{"ENCASTRE", 7}, {"PINNED", 7}, {"XSYMM", 1},
                                                                {"YSYMM", 2},    {"ZSYMM", 4},  {"XASYMM", 6},
                                                                {"YASYMM", 5},   {"ZASYMM", 3}};
      const auto                                       it    = names.find(word);
      return it == names.end() ? 0 : it->second;
    }
  } // namespace



  void DeckModelReader::add_boundary(const Keyword &keyword, const DeckLine &line,
                                     const unsigned int instance)
  {
    const Words words = deck_words(line.text);
    if (words.size() < 2)
      fail(line.place, "BOUNDARY needs a node or a set, and directions.");
    DeckBoundary condition;
    condition.set   = is_deck_label(words[0]) ? "" : words[0];
    condition.nodes = deck.nodes_of(words[0], line.place, instance);
    condition.place = line.place;
    if (const unsigned int named = named_directions(deck_upper(words[1])); named != 0)
      {
        for (unsigned int c = 0; c < dim; ++c)
          if (named & (1u << c))
            condition.values[c] = 0.;
        if (deck_upper(words[1]) == "ENCASTRE")
          for (const unsigned int node : condition.nodes)
            for (unsigned int c = 0; c < dim && is_reference(node); ++c)
              state.rotations[{node, c}] = 0.;
      }
    else
      {
        const long first = deck.text().label(words[1], line.place);
        const long last =
            words.size() > 2 && !words[2].empty() ? deck.text().label(words[2], line.place) : first;
        const double value =
            words.size() > 3 && !words[3].empty() ? number(words, 3, line) * factor(keyword) : 0.;
        if (first < 1 || last > 6)
          {
            // Temperatures, voltages, ... do not move anything.
            model.refuse(line.place, "BOUNDARY", "only directions 1 to 6 are displacements.");
            return;
          }
        for (long c = first; c <= std::min(last, 3l); ++c)
          condition.values[c - 1] = value;
        for (const unsigned int node : condition.nodes)
          for (long c = std::max(first, 4l); c <= last && is_reference(node); ++c)
            state.rotations[{node, static_cast<unsigned int>(c - 4)}] = value;
      }
    if (!condition.values[0] && !condition.values[1] && !condition.values[2])
      return;
    // Lines of one set, and of single nodes with the same values, are one condition. A set of a part is
    // another one in each instance.
    if (!state.boundaries.empty())
      {
        DeckBoundary &last = state.boundaries.back();
        if (!condition.set.empty() && last.set == condition.set && last.nodes == condition.nodes)
          {
            for (unsigned int c = 0; c < dim; ++c)
              if (condition.values[c])
                last.values[c] = condition.values[c];
            return;
          }
        if (condition.set.empty() && last.set.empty() && last.values == condition.values)
          {
            last.nodes.push_back(condition.nodes[0]);
            return;
          }
        if (condition.set.empty() && last.set.empty() && last.nodes == condition.nodes)
          {
            for (unsigned int c = 0; c < dim; ++c)
              if (condition.values[c])
                last.values[c] = condition.values[c];
            // It may have become what the one before is.
            if (state.boundaries.size() > 1)
              if (DeckBoundary &before = state.boundaries[state.boundaries.size() - 2];
                  before.set.empty() && before.values == last.values)
                {
                  before.nodes.push_back(last.nodes[0]);
                  state.boundaries.pop_back();
                }
            return;
          }
      }
    state.boundaries.push_back(condition);
  }



  void DeckModelReader::set_load(DeckLoad &load, const double value) const
  {
    load = {value + (load.step == step ? load.value : 0.), step};
  }



  void DeckModelReader::read_nodal_force(const Keyword &keyword, const unsigned int instance)
  {
    if (!is_in_step)
      fail(keyword.place, "CLOAD belongs into a STEP.");
    if (keyword.has("FOLLOWER"))
      model.differ(keyword.place, "CLOAD: the force keeps its direction.");
    if (is_new(keyword))
      state.forces.clear();
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 3)
          fail(line.place, "CLOAD needs a node or a set, a direction and a force.");
        const long                      direction = deck.text().label(words[1], line.place);
        const std::vector<unsigned int> nodes     = deck.nodes_of(words[0], line.place, instance);
        const bool                      is_moment = direction > 3 && direction < 7 &&
                               std::all_of(nodes.begin(), nodes.end(),
                                           [this](const unsigned int node) { return is_reference(node); });
        if (direction < 1 || (direction > 3 && !is_moment))
          {
            model.refuse(line.place, "CLOAD",
                         "nodes of solid elements take forces in the directions 1 to 3.");
            continue;
          }
        const double value = number(words, 2, line) * factor(keyword);
        for (const unsigned int node : nodes)
          set_load(state.forces[{node, static_cast<unsigned int>(direction - 1)}], value);
      }
  }



  void DeckModelReader::add_volume_load(const Keyword &keyword, const DeckLine &line, const Words &words,
                                        const unsigned int instance)
  {
    DeckVolumeLoad    load;
    const std::string kind = deck_upper(words[1]);
    load.kind              = kind;
    load.place             = line.place;
    load.step              = step;
    if (words[0].empty())
      for (unsigned int e = 0; e < deck.elements().size(); ++e)
        load.elements.push_back(e);
    else
      load.elements = deck.elements_of(words[0], line.place, instance);
    const double size = number(words, 2, line) * factor(keyword);
    if (kind == "GRAV")
      {
        const Vector3 along = direction(words, 3, line);
        if (!(along.norm() > 0.))
          fail(line.place, "GRAV needs a direction.");
        load.value = size / along.norm() * along;
      }
    else
      {
        load.is_acceleration      = false;
        load.value[kind[1] - 'X'] = size;
      }
    // The same load of an earlier step is replaced.
    auto &list = state.volume_loads;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](const DeckVolumeLoad &other) {
                                return other.step < step && other.kind == load.kind &&
                                       other.elements == load.elements;
                              }),
               list.end());
    list.push_back(load);
  }



  void DeckModelReader::read_element_load(const Keyword &keyword, const unsigned int instance)
  {
    if (is_new(keyword))
      {
        state.pressures.clear();
        state.volume_loads.clear();
      }
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 3)
          fail(line.place, "DLOAD needs elements, the kind of the load and its size.");
        const std::string kind = deck_upper(words[1]);
        if (kind == "GRAV" || kind == "BX" || kind == "BY" || kind == "BZ")
          add_volume_load(keyword, line, words, instance);
        else if (kind.size() == 2 && kind[0] == 'P')
          for (const unsigned int e : deck.elements_of(words[0], line.place, instance))
            {
              if (!deck.elements()[e].type->is_solid())
                fail(line.place, "loads on elements that are not solid are not supported.");
              const unsigned int side = deck_side(deck, kind, 'P', deck.elements()[e], line.place);
              set_load(state.pressures[{e, side}], number(words, 2, line) * factor(keyword));
            }
        else
          model.refuse(line.place, "DLOAD",
                       "loads are P1, P2, ... (pressure), GRAV, BX, BY, BZ, not " + kind + ".");
      }
  }



  void DeckModelReader::read_surface_load(const Keyword &keyword, const unsigned int instance)
  {
    auto &list = state.surface_loads;
    if (is_new(keyword))
      list.clear();
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 3)
          fail(line.place, "DSLOAD needs a surface, the kind of the load and its size.");
        const std::string kind = deck_upper(words[1]);
        DeckSurfaceLoad   load;
        load.surface      = &deck.surface(words[0], line.place, instance);
        load.kind         = kind;
        load.step         = step;
        load.place        = line.place;
        const double size = number(words, 2, line) * factor(keyword);
        if (kind == "P")
          load.pressure = size;
        else if (const Vector3 along = direction(words, 3, line); kind == "TRVEC" && along.norm() > 0.)
          load.traction = size / along.norm() * along;
        else
          {
            model.refuse(line.place, "DSLOAD", "loads are P (pressure) and TRVEC, not " + kind + ".");
            continue;
          }
        list.erase(std::remove_if(list.begin(), list.end(),
                                  [&](const DeckSurfaceLoad &other) {
                                    return other.step < step && other.kind == load.kind &&
                                           other.surface == load.surface;
                                  }),
                   list.end());
        list.push_back(load);
      }
  }



  void DeckModelReader::read_temperature(const Keyword &keyword, const unsigned int instance)
  {
    if (is_new(keyword))
      state.temperatures.clear();
    if (keyword.has("FILE"))
      model.refuse(keyword.place, "TEMPERATURE", "temperatures from a file are not supported.");
    for (const DeckLine &line : keyword.lines)
      {
        const Words words = deck_words(line.text);
        if (words.size() < 2)
          fail(line.place, "a node or a set and its temperature are needed.");
        for (const unsigned int node : deck.nodes_of(words[0], line.place, instance))
          state.temperatures[node] = {number(words, 1, line) * factor(keyword), step};
      }
  }
} // namespace Signorini
