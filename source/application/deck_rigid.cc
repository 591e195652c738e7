// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Nodes of a deck that move together, as boundaries that move as rigid bodies.

#include "deck_bodies.h"
#include "deck_series.h"

#include <signorini/algebra/input_error.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Three components over the steps; empty where all are zero.
    VectorField vector_field(const std::array<DeckSeries, 3> &series)
    {
      if (series[0].is_zero() && series[1].is_zero() && series[2].is_zero())
        return {};
      return [series](const Point<3> &, const double t) {
        return Vector3({series[0].at(t), series[1].at(t), series[2].at(t)});
      };
    }

    /// The faces of a body that a set of nodes makes up. Errors: InputError if nodes are left over.
    std::set<VolumeMesh::Face> faces_of(const DeckBody &body, const DeckModel &model, const DeckRigid &rigid)
    {
      const Deck &deck = model.deck();
      if (rigid.surface != nullptr)
        return faces_of_surface(deck, *rigid.surface, *body.cells, body.boundary);
      const std::set<VolumeMesh::Face> faces    = faces_within(rigid.nodes, *body.cells, body.boundary);
      const std::vector<unsigned int>  vertices = vertices_within(rigid.nodes, *body.cells);
      std::set<unsigned int>           covered;
      for (const VolumeMesh::Face &face : faces)
        covered.insert(face.begin(), face.end());
      for (const unsigned int v : vertices)
        // Nodes inside of a body that is rigid as a whole follow its boundary.
        if (covered.count(v) == 0 && (faces.empty() || faces.size() < body.boundary.size()))
          {
            model.refuse(rigid.place, rigid.keyword,
                         "nodes that move together have to be whole faces of a body; node " +
                             std::to_string(deck.node_labels()[body.cells->support(v)[0]]) +
                             " belongs to none of them.");
            return {};
          }
      return faces;
    }

    /// What acts on a rigid boundary by its reference node.
    void add_reference(LoadDefinition::RigidBoundary &boundary, const DeckRigid &rigid,
                       const DeckModel &model, const DeckHistory &history)
    {
      const auto       forces = history.forces();
      const DeckSeries none{std::vector<double>(history.n_steps(), 0.)};
      const auto       force_at = [&](const unsigned int node, const unsigned int direction) {
        const auto it = forces.find({node, direction});
        return it == forces.end() ? none : it->second;
      };
      std::array<DeckSeries, 3> force, moment;
      for (unsigned int c = 0; c < 3; ++c)
        {
          force[c]  = force_at(rigid.reference, c);
          moment[c] = force_at(rigid.reference, 3 + c);
          if (const auto value = history.value_at(rigid.reference, c))
            boundary.displacement[c] = value->field();
          if (const auto value = history.rotation_at(rigid.reference, c))
            boundary.rotation[c] = value->field();
          if (rigid.rotation == DeckRigid::none)
            continue;
          if (moment[c].is_zero())
            moment[c] = force_at(rigid.rotation, c);
          if (const auto value = history.value_at(rigid.rotation, c))
            boundary.rotation[c] = value->field();
        }
      boundary.force  = vector_field(force);
      boundary.moment = vector_field(moment);
      boundary.about  = model.deck().positions()[rigid.reference];
    }

    /// The node of equations that belongs to no body, if there is one.
    unsigned int floating_node(const std::vector<DeckBody> &bodies, const DeckRigid &rigid)
    {
      for (const unsigned int node : rigid.nodes)
        if (std::none_of(bodies.begin(), bodies.end(), [node](const DeckBody &body) {
              return body.cells->vertex(node) != VolumeMesh::no_vertex;
            }))
          return node;
      return DeckRigid::none;
    }
  } // namespace



  std::set<unsigned int> add_rigid_faces(std::vector<DeckBody> &bodies, const DeckModel &model,
                                         const DeckHistory &history)
  {
    std::set<unsigned int> references;
    unsigned int           n = 0;
    for (DeckRigid rigid : model.rigid())
      {
        const std::string name = "rigid face " + std::to_string(++n);
        if (rigid.reference == DeckRigid::none)
          rigid.reference = floating_node(bodies, rigid);
        bool is_anywhere = false;
        for (DeckBody &body : bodies)
          {
            const std::set<VolumeMesh::Face> faces = faces_of(body, model, rigid);
            if (faces.empty())
              continue;
            if (is_anywhere)
              model.deck().text().fail(rigid.place,
                                       rigid.keyword + ": the nodes belong to several bodies; tie these.");
            is_anywhere = true;
            body.named.emplace_back(name, faces);
            LoadDefinition::RigidBoundary boundary;
            boundary.boundary = name;
            if (rigid.reference != DeckRigid::none)
              add_reference(boundary, rigid, model, history);
            if (rigid.translates_only)
              for (ScalarField &component : boundary.rotation)
                component = [](const Point<3> &) { return 0.; };
            body.loads.rigid_boundaries.push_back(boundary);
          }
        if (!is_anywhere)
          model.refuse(rigid.place, rigid.keyword,
                       "nodes that move together have to be whole faces of a body.");
        for (const unsigned int node : {rigid.reference, rigid.rotation})
          if (node != DeckRigid::none)
            references.insert(node);
      }
    return references;
  }
} // namespace Signorini
