// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Conditions and forces of a deck on its bodies.

#include "deck_bodies.h"
#include "deck_joined_sets.h"
#include "deck_series.h"

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/element.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    bool is_zero(const DeckValues &values)
    {
      return std::all_of(values.begin(), values.end(), [](const auto &v) { return v && v->is_zero(); });
    }

    bool are_equal(const DeckValues &one, const DeckValues &other)
    {
      for (unsigned int c = 0; c < 3; ++c)
        if (one[c].has_value() != other[c].has_value() || (one[c] && one[c]->values != other[c]->values))
          return false;
      return true;
    }

    /// The axis of space that a unit vector lies along, or 3; up to rounding of the numbers in a file.
    unsigned int axis_along(const Tensor<1, 3> &direction)
    {
      for (unsigned int c = 0; c < 3; ++c)
        if (std::abs(std::abs(direction[c]) - 1.) < 1e-12)
          return c;
      return 3;
    }

    /// Of a cylindrical frame: nothing across its axis, or all of it held at zero.
    bool to_global_from_cylindrical(DeckValues &result, const DeckValues &values, const DeckFrame &frame)
    {
      const Tensor<1, 3> axis  = (frame.second - frame.first) / frame.second.distance(frame.first);
      const unsigned int along = axis_along(axis);
      if (along == 3 || values[0].has_value() != values[1].has_value() ||
          (values[0] && !(values[0]->is_zero() && values[1]->is_zero())))
        return false;
      for (unsigned int c = 0; c < 3; ++c)
        if (c != along)
          result[c] = values[0];
      if (values[2])
        result[along] = values[2]->scaled(axis[along]);
      return true;
    }

    /// Values along axes that are those of space in another order or direction; false for oblique ones.
    bool to_global(DeckValues &result, const DeckValues &values, const DeckFrame &frame)
    {
      if (is_zero(values))
        {
          result = values;
          return true;
        }
      result = DeckValues();
      if (frame.is_cylindrical)
        return to_global_from_cylindrical(result, values, frame);
      for (unsigned int i = 0; i < 3; ++i)
        if (values[i])
          {
            const unsigned int along = axis_along(frame.axes[i]);
            if (along == 3)
              return false;
            result[along] = values[i]->scaled(frame.axes[i][along]);
          }
      return true;
    }

    ConditionFrame condition_frame(const DeckFrame &frame)
    {
      return frame.is_cylindrical ? ConditionFrame::cylindrical(frame.first, frame.second - frame.first)
                                  : ConditionFrame::rotated(frame.axes[0], frame.axes[1]);
    }

    class LoadsOfDeck
    {
    public:
      LoadsOfDeck(std::vector<DeckBody> &bodies, const DeckModel &model, std::vector<std::string> &remarks)
        : bodies(bodies)
        , model(model)
        , deck(model.deck())
        , history(model)
        , state(model.steps().back())
        , remarks(remarks)
      {
      }

      void add()
      {
        references = add_rigid_faces(bodies, model, history);
        references.merge(add_bolts(bodies, model, history));
        add_forces();
        add_pressures();
        for (const auto &[surface, load] : history.surface_loads())
          add_surface_load(load);
        // Sets of nodes get names that no surface has.
        for (const DeckBoundary &condition : state.boundaries)
          add_condition(condition);
        add_between_sets();
        add_temperatures(bodies, model, history);
        for (unsigned int k = 0; k < history.n_steps(); ++k)
          for (const DeckVolumeLoad &load : history.step(k).volume_loads)
            add_volume_load(load, k);
        for (DeckBody &body : bodies)
          finish_volume_force(body);
      }

      /// The steps that the loads are given for.
      unsigned int n_steps() const
      {
        return history.n_steps();
      }

    private:
      void add_condition(const DeckBoundary &condition)
      {
        // The nodes by the axes that their directions mean, and what is the same along the axes of space
        // together.
        std::map<unsigned int, std::vector<unsigned int>> by_frame;
        for (const unsigned int node : condition.nodes)
          {
            if (references.count(node) > 0)
              continue;
            const auto it = model.frame_of_node().find(node);
            by_frame[it == model.frame_of_node().end() ? Deck::none : it->second].push_back(node);
          }
        const std::string name =
            condition.set.empty() ? "nodes of line " + std::to_string(condition.place.line) : condition.set;
        const DeckValues     given = history.values(condition);
        std::vector<HeldSet> sets;
        for (const auto &[frame, nodes] : by_frame)
          {
            HeldSet set = {name, nodes, given, frame};
            if (frame != Deck::none && to_global(set.values, given, model.frames()[frame]))
              set.frame = Deck::none;
            else
              set.values = given;
            const auto same = std::find_if(sets.begin(), sets.end(), [&](const HeldSet &other) {
              return other.frame == set.frame && are_equal(other.values, set.values);
            });
            if (same == sets.end())
              sets.push_back(std::move(set));
            else
              same->nodes.insert(same->nodes.end(), nodes.begin(), nodes.end());
          }
        bool is_anywhere = sets.empty();
        for (HeldSet &set : sets)
          {
            std::sort(set.nodes.begin(), set.nodes.end());
            for (DeckBody &body : bodies)
              is_anywhere = add_condition(body, set) || is_anywhere;
            held_sets.push_back(std::move(set));
          }
        if (!is_anywhere)
          remarks.push_back(deck.text().where(condition.place) +
                            ": BOUNDARY: none of the nodes belongs to a solid element.");
      }

      /// Before all others: nodes of the sets keep their own conditions, which are later.
      void add_between_sets()
      {
        for (DeckBody &body : bodies)
          {
            std::vector<LoadDefinition::Displacement> between;
            for (const JoinedSet &joined : join_held_sets(body, held_sets))
              {
                between.emplace_back();
                between.back().is_between_sets = true;
                between.back().boundary        = add_node_set(body, joined.name, joined.vertices);
                between.back().frame           = axes_of(joined.frame);
                between.back().components[joined.component] = joined.value;
              }
            auto &all = body.loads.displacements;
            all.insert(all.begin(), between.begin(), between.end());
          }
      }

      ConditionFrame axes_of(const unsigned int frame) const
      {
        return frame == Deck::none ? ConditionFrame() : condition_frame(model.frames()[frame]);
      }

      bool add_condition(DeckBody &body, const HeldSet &set)
      {
        const std::vector<unsigned int> vertices = vertices_within(set.nodes, *body.cells);
        if (vertices.empty())
          return false;
        LoadDefinition::Displacement displacement;
        displacement.boundary = add_node_set(body, set.name, vertices);
        displacement.frame    = axes_of(set.frame);
        for (unsigned int c = 0; c < 3; ++c)
          if (set.values[c])
            displacement.components[c] = set.values[c]->field();
        body.loads.displacements.push_back(displacement);
        return true;
      }

      /// Returns its name.
      std::string add_node_set(DeckBody &body, const std::string &wanted,
                               const std::vector<unsigned int> &vertices)
      {
        auto             &sets = body.cells->mesh.node_sets;
        const std::string name = name_of_set(body, wanted, vertices);
        if (std::none_of(sets.begin(), sets.end(), [&](const auto &set) { return set.first == name; }))
          sets.emplace_back(name, vertices);
        return name;
      }

      /// A name that neither other nodes nor a surface have.
      std::string name_of_set(const DeckBody &body, const std::string &name,
                              const std::vector<unsigned int> &vertices) const
      {
        for (unsigned int n = 1;; ++n)
          {
            const std::string tried = n == 1 ? name : name + " (" + std::to_string(n) + ")";
            const auto       &sets  = body.cells->mesh.node_sets;
            const auto        set =
                std::find_if(sets.begin(), sets.end(), [&](const auto &s) { return s.first == tried; });
            const bool is_surface = std::any_of(body.named.begin(), body.named.end(),
                                                [&](const auto &s) { return s.first == tried; });
            if (!is_surface && (set == sets.end() || set->second == vertices))
              return tried;
          }
      }

      void add_forces()
      {
        std::size_t n_lost = 0;
        for (const auto &[where, force] : history.forces())
          {
            const auto [node, component] = where;
            if (references.count(node) > 0)
              continue;
            Vector3 direction;
            direction[component] = 1.;
            if (const auto frame = model.frame_of_node().find(node); frame != model.frame_of_node().end())
              direction = condition_frame(model.frames()[frame->second])
                              .axes(deck.positions()[node], Vector3())[component];
            bool is_anywhere = force.is_zero();
            for (DeckBody &body : bodies)
              if (const unsigned int vertex = body.cells->vertex(node); vertex != VolumeMesh::no_vertex)
                {
                  if (!force.is_zero())
                    body.loads.nodal_forces.push_back({vertex, force.field(direction)});
                  is_anywhere = true;
                }
            n_lost += is_anywhere ? 0 : 1;
          }
        if (n_lost > 0)
          throw InputError(deck.text().files()[0] + ": CLOAD: " + std::to_string(n_lost) +
                           " forces act on nodes that belong to no solid element.");
      }

      /// Faces with the same pressure are a boundary together.
      void add_pressures()
      {
        std::map<std::vector<double>, std::map<unsigned int, std::vector<unsigned int>>> sides;
        for (const auto &[where, pressure] : history.pressures())
          if (!pressure.is_zero())
            sides[pressure.values][where.first].push_back(where.second);
        unsigned int n = 0;
        for (const auto &[pressure, of_elements] : sides)
          {
            const std::string name = "pressure " + std::to_string(++n);
            for (DeckBody &body : bodies)
              {
                std::set<VolumeMesh::Face> faces;
                for (const auto &[element, list] : of_elements)
                  if (body.cells->has(element))
                    for (const unsigned int side : list)
                      for (const VolumeMesh::Face &face : body.cells->side(element, side))
                        faces.insert(face);
                if (faces.empty())
                  continue;
                refuse_inner_faces(body, faces);
                body.named.emplace_back(name, faces);
                body.loads.surface_forces.push_back({name, {}, DeckSeries{pressure}.field()});
              }
          }
      }

      void refuse_inner_faces(const DeckBody &body, std::set<VolumeMesh::Face> faces) const
      {
        for (const auto &[face, cell] : body.boundary)
          faces.erase(face_key(face));
        if (!faces.empty())
          throw InputError(deck.text().files()[0] + ": DLOAD: " + std::to_string(faces.size()) +
                           " of the loaded faces are inside of the body \"" + body.name + "\".");
      }

      void add_surface_load(const DeckHistory::SurfaceLoad &load)
      {
        bool is_anywhere = false;
        for (DeckBody &body : bodies)
          if (name_surface(body, deck, *load.surface))
            {
              is_anywhere = true;
              if (!load.pressure.is_zero())
                body.loads.surface_forces.push_back({load.surface->name, {}, load.pressure.field()});
              for (unsigned int c = 0; c < 3; ++c)
                if (!load.traction[c].is_zero())
                  {
                    Vector3 direction;
                    direction[c] = 1.;
                    body.loads.surface_forces.push_back(
                        {load.surface->name, load.traction[c].field(direction), {}});
                  }
            }
        if (!is_anywhere)
          deck.text().fail(load.place, "no face of the surface \"" + load.surface->name +
                                           "\" is on the boundary of a body.");
      }

      void add_volume_load(const DeckVolumeLoad &load, const unsigned int step)
      {
        const std::set<unsigned int> elements(load.elements.begin(), load.elements.end());
        for (DeckBody &body : bodies)
          {
            auto &forces = volume_forces[&body];
            forces.resize(body.elements.size(), std::vector<Vector3>(history.n_steps()));
            for (std::size_t i = 0; i < body.elements.size(); ++i)
              if (elements.count(body.elements[i]) > 0)
                {
                  double factor = 1.;
                  if (load.is_acceleration)
                    {
                      const DeckMaterial &material =
                          model.materials()[model.material_of_element()[body.elements[i]]];
                      if (!material.density)
                        deck.text().fail(load.place,
                                         "GRAV needs the DENSITY of MATERIAL \"" + material.name + "\".");
                      factor = *material.density;
                    }
                  forces[i][step] += factor * load.value;
                }
          }
      }

      /// One force per volume for the whole body, or else forces at its nodes.
      void finish_volume_force(DeckBody &body)
      {
        const auto it = volume_forces.find(&body);
        if (it == volume_forces.end())
          return;
        const std::vector<std::vector<Vector3>> &forces = it->second;
        const auto component = [](const std::vector<Vector3> &f, const unsigned int c) {
          DeckSeries series;
          for (const Vector3 &v : f)
            series.values.push_back(v[c]);
          return series;
        };
        if (std::all_of(forces.begin(), forces.end(), [&](const auto &f) { return f == forces[0]; }))
          {
            body.loads.volume_force = [x = component(forces[0], 0), y = component(forces[0], 1),
                                       z = component(forces[0], 2)](const Point<3> &, const double t) {
              return Vector3({x.at(t), y.at(t), z.at(t)});
            };
            return;
          }
        std::map<unsigned int, const std::vector<Vector3> *> force_of;
        for (std::size_t i = 0; i < forces.size(); ++i)
          force_of[body.elements[i]] = &forces[i];
        const VolumeMesh                            &mesh = body.cells->mesh;
        std::map<unsigned int, std::vector<Vector3>> nodal;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          for (const auto &[vertex, volume] : nodal_volumes(mesh, mesh.cells[c]))
            for (unsigned int k = 0; k < history.n_steps(); ++k)
              {
                nodal[vertex].resize(history.n_steps());
                nodal[vertex][k] += volume * (*force_of[body.cells->element_of_cell()[c]])[k];
              }
        for (const auto &[vertex, force] : nodal)
          for (unsigned int c = 0; c < 3; ++c)
            if (const DeckSeries series = component(force, c); !series.is_zero())
              {
                Vector3 direction;
                direction[c] = 1.;
                body.loads.nodal_forces.push_back({vertex, series.field(direction)});
              }
        remarks.push_back("body " + body.name +
                          ": forces per volume differ from element to element; they act at the nodes of the "
                          "deck, also where cells are refined.");
      }

      /// Integrals of the shape functions over a cell.
      static std::vector<std::pair<unsigned int, double>> nodal_volumes(const VolumeMesh       &mesh,
                                                                        const VolumeMesh::Cell &cell)
      {
        const Element                                element(mesh, cell);
        std::vector<std::pair<unsigned int, double>> result;
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          result.emplace_back(cell.vertices[v], 0.);
        for (unsigned int q = 0; q < element.n_points(); ++q)
          {
            const double volume = std::abs(element.volume_element(q).first);
            const auto   shape  = element.shape_at_point(q);
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              result[v].second += volume * shape[v];
          }
        return result;
      }

      std::vector<DeckBody> &bodies;
      const DeckModel       &model;
      const Deck            &deck;
      const DeckHistory      history;
      const DeckState       &state;
      /// Nodes of rigid faces and bolts, which have been dealt with.
      std::set<unsigned int> references;
      /// By conditions.
      std::vector<HeldSet>      held_sets;
      std::vector<std::string> &remarks;
      /// By element of the body and step.
      std::map<const DeckBody *, std::vector<std::vector<Vector3>>> volume_forces;
    };
  } // namespace



  unsigned int add_deck_loads(std::vector<DeckBody> &bodies, const DeckModel &model,
                              std::vector<std::string> &remarks)
  {
    LoadsOfDeck loads(bodies, model, remarks);
    loads.add();
    return loads.n_steps();
  }
} // namespace Signorini
