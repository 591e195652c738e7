// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "deck_bodies.h"

#include <signorini/algebra/input_error.h>

#include <algorithm>
#include <filesystem>

namespace Signorini
{
  using namespace dealii;

  bool is_deck(const std::string &file)
  {
    return deck_upper(std::filesystem::path(file).extension().string()) == ".INP";
  }



  namespace
  {
    /// The box around the faces of a body with a name, wider by a share of its diagonal.
    struct Box
    {
      Box(const DeckBody &body, const std::string &name)
      {
        for (const auto &[other, faces] : body.named)
          if (other == name)
            for (const VolumeMesh::Face &face : faces)
              for (const unsigned int v : face)
                if (v != VolumeMesh::no_vertex)
                  for (unsigned int c = 0; c < 3; ++c)
                    {
                      const double x = body.cells->mesh.vertices[v][c];
                      low[c]         = is_empty ? x : std::min(low[c], x);
                      high[c]        = is_empty ? x : std::max(high[c], x);
                      if (c == 2)
                        is_empty = false;
                    }
        const double margin = .05 * low.distance(high);
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c] -= margin;
            high[c] += margin;
          }
      }

      bool meets(const Box &other) const
      {
        for (unsigned int c = 0; c < 3; ++c)
          if (low[c] > other.high[c] || other.low[c] > high[c])
            return false;
        return true;
      }

      Point<3> low, high;
      bool     is_empty = true;
    };

    /// The bodies that have faces of a surface. Errors: InputError if there is none.
    std::vector<unsigned int> bodies_with(std::vector<DeckBody> &bodies, const Deck &deck,
                                          const DeckSurface &surface, const DeckPlace &place)
    {
      std::vector<unsigned int> result;
      for (unsigned int b = 0; b < bodies.size(); ++b)
        if (name_surface(bodies[b], deck, surface))
          result.push_back(b);
      if (result.empty())
        deck.text().fail(place,
                         "no face of the surface \"" + surface.name + "\" is on the boundary of a body.");
      return result;
    }

    bool share_faces(const DeckBody &body, const std::string &a, const std::string &b)
    {
      const auto faces_of = [&](const std::string &name) -> const auto &
      {
        return std::find_if(body.named.begin(), body.named.end(),
                            [&](const auto &named) { return named.first == name; })
            ->second;
      };
      const auto &first = faces_of(a), &second = faces_of(b);
      return std::any_of(first.begin(), first.end(),
                         [&](const VolumeMesh::Face &face) { return second.count(face) > 0; });
    }

    void add_pair(ProblemDefinition &problem, std::vector<DeckBody> &bodies, const DeckModel &model,
                  const DeckPair &pair, std::vector<std::string> &remarks)
    {
      const Deck &deck  = model.deck();
      const auto  first = bodies_with(bodies, deck, *pair.slave, pair.place),
                 second = bodies_with(bodies, deck, *pair.master, pair.place);
      unsigned int n    = 0;
      for (const unsigned int a : first)
        for (const unsigned int b : second)
          {
            // Surfaces of several bodies: only those that can meet.
            if (first.size() * second.size() > 1 &&
                (a == b || !Box(bodies[a], pair.slave->name).meets(Box(bodies[b], pair.master->name))))
              continue;
            if (a == b && share_faces(bodies[a], pair.slave->name, pair.master->name))
              deck.text().fail(pair.place, "the surfaces \"" + pair.slave->name + "\" and \"" +
                                               pair.master->name +
                                               "\" have faces in common: a body may touch itself where two "
                                               "surfaces of it face each other.");
            PairDefinition definition;
            definition.name      = plain_name(pair.name) + (++n == 1 ? "" : "-" + std::to_string(n));
            definition.first     = {bodies[a].name, pair.slave->name, {}};
            definition.second    = {bodies[b].name, pair.master->name, {}};
            definition.nonmortar = NonmortarChoice::first;
            definition.contact   = pair.is_tied ? ContactKind::tied : ContactKind::unilateral;
            for (const PairDefinition &other : problem.pairs)
              if (other.name == definition.name)
                deck.text().fail(pair.place, "there are two pairs \"" + definition.name + "\".");
            problem.pairs.push_back(definition);
            if (pair.adjust || !pair.adjusted_nodes.empty())
              if (const std::string text = adjust_nodes(bodies[a], bodies[b], pair); !text.empty())
                remarks.push_back(deck.text().where(pair.place) + ": " + text);
          }
      if (n == 0)
        deck.text().fail(pair.place, "the surfaces \"" + pair.slave->name + "\" and \"" + pair.master->name +
                                         "\" are far from each other.");
    }

    DeckProblem::BodyLabels labels_of(const DeckBody &body, const Deck &deck)
    {
      DeckProblem::BodyLabels result;
      for (unsigned int v = 0; v < body.cells->mesh.vertices.size(); ++v)
        result.node_of_vertex.push_back(body.cells->support(v).size() == 1
                                            ? deck.node_labels()[body.cells->support(v)[0]]
                                            : DeckProblem::no_label);
      for (const unsigned int e : body.elements)
        {
          const DeckElement &element = deck.elements()[e];
          result.elements.push_back({element.label, {}});
          for (const unsigned int node : element.nodes)
            result.elements.back().nodes.push_back(deck.node_labels()[node]);
        }
      return result;
    }

    BodyProblem finish(DeckBody &body, const DeckModel &model)
    {
      BodyProblem            result;
      VolumeMesh            &mesh       = body.cells->mesh;
      BodyDefinition        &definition = result.body;
      const BoundaryOfCells &boundary   = body.boundary;
      NamedFaces             named;
      for (const auto &entry : body.named)
        if (!entry.second.empty())
          named.push_back(entry);
      name_faces(mesh, boundary, named);
      mend_orientation(mesh, "body " + body.name);
      definition.name     = body.name;
      definition.material = *model.materials()[body.materials[0]].elastic;
      if (body.materials.size() > 1)
        for (unsigned int i = 0; i < body.materials.size(); ++i)
          definition.volume_materials.emplace_back(mesh.volume_names[i],
                                                   *model.materials()[body.materials[i]].elastic);
      definition.mesh = std::move(mesh);
      result.loads    = std::move(body.loads);
      return result;
    }
  } // namespace



  DeckProblem make_deck_problem(const DeckModel &model)
  {
    DeckProblem           result;
    std::vector<DeckBody> bodies = make_deck_bodies(model);
    result.remarks               = model.remarks();
    for (const long label : model.deck().node_labels())
      result.largest_node_label = std::max(result.largest_node_label, label);
    result.nonlinear_geometry = model.steps().back().nonlinear_geometry;
    for (const DeckPair &pair : model.pairs())
      add_pair(result.problem, bodies, model, pair, result.remarks);
    result.n_steps = add_deck_loads(bodies, model, result.remarks);
    if (result.n_steps < model.steps().size())
      result.remarks.push_back(
          model.deck().text().files()[0] + ": of " + std::to_string(model.steps().size()) +
          " steps the last one is computed, with what the others leave: they hold other directions. Without "
          "friction the way there does not matter.");
    for (DeckBody &body : bodies)
      {
        result.labels.push_back(labels_of(body, model.deck()));
        result.problem.bodies.push_back(finish(body, model));
      }
    return result;
  }
} // namespace Signorini
