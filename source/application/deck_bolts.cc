// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// PRE-TENSION SECTION: the elements behind a section of a bolt become a volume of their own, which is
// shortened.

#include "deck_bodies.h"
#include "deck_series.h"

#include <signorini/mesh/cell_shape.h>

#include <algorithm>
#include <optional>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct BoltRule
    {
      /// Cosine between the direction that is given and the normal of the section: within 2.6 degrees the
      /// ends of a layer, however thin, do not overlap along the axis.
      double along = .999;
    };

    VolumeMesh::Face face_of(const VolumeMesh::Cell &cell, const unsigned int f)
    {
      VolumeMesh::Face face{};
      face.fill(VolumeMesh::no_vertex);
      const auto vertices = CellShape::face(cell.n_vertices, f);
      for (unsigned int i = 0; i < vertices.size(); ++i)
        face[i] = cell.vertices[vertices[i]];
      return face;
    }

    Point<3> centre(const VolumeMesh &mesh, const VolumeMesh::Cell &cell)
    {
      Point<3> result;
      for (unsigned int v = 0; v < cell.n_vertices; ++v)
        result += 1. / cell.n_vertices * mesh.vertices[cell.vertices[v]];
      return result;
    }

    /// A section of a bolt, and the layer of cells on the side of the elements that name it.
    class Section
    {
    public:
      Section(DeckBody &body, const DeckModel &model, const DeckPretension &bolt)
        : body(body)
        , mesh(body.cells->mesh)
        , model(model)
        , bolt(bolt)
        , faces(faces_of_surface(model.deck(), *bolt.surface, *body.cells, body.boundary))
      {
        for (const auto &[face, cell] : body.boundary)
          outer.insert(face_key(face));
        for (const VolumeMesh::Face &face : faces)
          if (outer.count(face) > 0)
            refuse(
                "its surface should be inside of a bolt, a section between elements, not on its boundary.");
        find_normal();
        find_layer();
        check_sides();
      }

      /// Makes the layer a volume. Returns its name.
      std::string make_volume()
      {
        const std::string  name   = "section " + bolt.surface->name;
        const unsigned int volume = mesh.cells[layer[0]].volume, added = mesh.volume_names.size();
        if (std::find(mesh.volume_names.begin(), mesh.volume_names.end(), name) != mesh.volume_names.end())
          refuse("there are two for this surface.");
        const auto &others    = body.loads.pretensions;
        const bool  is_in_use = std::any_of(others.begin(), others.end(), [&](const auto &other) {
          return other.name == mesh.volume_names[volume];
        });
        for (const unsigned int c : layer)
          {
            if (is_in_use || mesh.cells[c].volume != volume)
              refuse("the elements behind the section have several materials, or belong to another section.");
            mesh.cells[c].volume = added;
          }
        mesh.volume_names.push_back(name);
        const unsigned int material = body.materials[volume];
        body.materials.push_back(material);
        return name;
      }

      /// As it is given, else the normal of the section.
      Vector3 axis() const
      {
        return bolt.axis.norm() > 0. ? bolt.axis / bolt.axis.norm() : normal;
      }

    private:
      [[noreturn]] void refuse(const std::string &text) const
      {
        model.deck().text().fail(bolt.place, "PRE-TENSION SECTION: " + text);
      }

      /// The mean normal, out of the elements that name the section.
      void find_normal()
      {
        std::set<unsigned int> owners;
        for (const DeckSurface::Faces &sides : bolt.surface->faces)
          owners.insert(sides.elements.begin(), sides.elements.end());
        for (const VolumeMesh::Cell &cell : mesh.cells)
          if (owners.count(body.cells->element_of_cell()[&cell - mesh.cells.data()]) > 0)
            for (unsigned int f = 0; f < CellShape::n_faces(cell.n_vertices); ++f)
              if (const VolumeMesh::Face face = face_of(cell, f); faces.count(face_key(face)) > 0)
                {
                  const auto    x    = [&](const unsigned int i) { return mesh.vertices[face[i]]; };
                  const bool    four = face[3] != VolumeMesh::no_vertex;
                  const Vector3 area = .5 * (four ? cross_product_3d(x(2) - x(0), x(3) - x(1))
                                                  : cross_product_3d(x(1) - x(0), x(2) - x(0)));
                  // Cells may be mirrored still.
                  normal += area * (x(0) - centre(mesh, cell)) < 0. ? -area : area;
                }
        if (!(normal.norm() > 0.))
          refuse("its surface has no normal.");
        normal /= normal.norm();
      }

      /// The elements behind the section that touch it.
      void find_layer()
      {
        std::set<unsigned int> on_section, elements;
        for (const VolumeMesh::Face &face : faces)
          on_section.insert(face.begin(), face.end());
        on_section.erase(VolumeMesh::no_vertex);
        const Point<3> place = mesh.vertices[*on_section.begin()];
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          {
            const auto &v = mesh.cells[c].vertices;
            if (normal * (centre(mesh, mesh.cells[c]) - place) < 0. &&
                std::any_of(v.begin(), v.begin() + mesh.cells[c].n_vertices,
                            [&](const unsigned int i) { return on_section.count(i) > 0; }))
              elements.insert(body.cells->element_of_cell()[c]);
          }
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          if (elements.count(body.cells->element_of_cell()[c]) > 0)
            layer.push_back(static_cast<unsigned int>(c));
        if (layer.empty())
          refuse("there are no elements behind its surface.");
      }

      /// A layer of which other elements of the bolt lie beside the section carries only a part of the force.
      void check_sides() const
      {
        std::map<VolumeMesh::Face, unsigned int> count;
        std::set<unsigned int>                   on_section;
        for (const VolumeMesh::Face &face : faces)
          on_section.insert(face.begin(), face.end());
        on_section.erase(VolumeMesh::no_vertex);
        for (const unsigned int c : layer)
          for (unsigned int f = 0; f < CellShape::n_faces(mesh.cells[c].n_vertices); ++f)
            ++count[face_key(face_of(mesh.cells[c], f))];
        for (const auto &[face, n] : count)
          if (n == 1 && outer.count(face) == 0 && faces.count(face) == 0 &&
              std::any_of(face.begin(), face.end(),
                          [&](const unsigned int v) { return on_section.count(v) > 0; }))
            refuse("its surface should cross the whole bolt.");
        if (axis() * normal < BoltRule().along)
          refuse("its direction should be the normal of its surface, out of the elements that name it.");
      }

      DeckBody                  &body;
      VolumeMesh                &mesh;
      const DeckModel           &model;
      const DeckPretension      &bolt;
      std::set<VolumeMesh::Face> faces, outer;
      Vector3                    normal;
      std::vector<unsigned int>  layer;
    };

    /// What may not happen at the node of a section.
    void check_node(const DeckPretension &bolt, const std::vector<DeckBody> &bodies, const DeckModel &model,
                    const DeckHistory &history)
    {
      for (const DeckBody &body : bodies)
        if (body.cells->vertex(bolt.node) != VolumeMesh::no_vertex)
          model.deck().text().fail(bolt.place,
                                   "PRE-TENSION SECTION: NODE should be one that belongs to no element.");
      for (const DeckState &state : model.steps())
        for (const DeckBoundary &condition : state.boundaries)
          if (condition.values[0] &&
              std::find(condition.nodes.begin(), condition.nodes.end(), bolt.node) != condition.nodes.end())
            model.deck().text().fail(
                condition.place, "BOUNDARY: the shortening of a PRE-TENSION SECTION cannot be given, only "
                                 "its force (CLOAD at its node, direction 1), or that it stays (FIXED).");
      for (const auto &[where, force] : history.forces())
        if (where.first == bolt.node && where.second != 0 && !force.is_zero())
          model.deck().text().fail(bolt.place,
                                   "PRE-TENSION SECTION: the force at its node acts in direction 1.");
    }

    /// After which step a section keeps its shortening; none for never.
    std::optional<unsigned int> locking_step(const DeckPretension &bolt, const DeckModel &model,
                                             const DeckHistory &history)
    {
      std::optional<unsigned int> last;
      for (unsigned int k = 0; k < history.n_steps(); ++k)
        {
          const bool is_locked = history.step(k).locked_nodes.count(bolt.node) > 0;
          if (is_locked && k == 0)
            model.deck().text().fail(
                bolt.place, "PRE-TENSION SECTION: it is FIXED in the first step that is computed; there "
                            "should be one before in which its force acts, with conditions in the same "
                            "directions of the same nodes.");
          if (last && !is_locked)
            model.deck().text().fail(bolt.place, "PRE-TENSION SECTION: once FIXED, it should stay so in all "
                                                 "steps that follow.");
          if (is_locked && !last)
            last = k - 1;
        }
      return last;
    }
  } // namespace



  std::set<unsigned int> add_bolts(std::vector<DeckBody> &bodies, const DeckModel &model,
                                   const DeckHistory &history)
  {
    std::set<unsigned int>  nodes;
    std::vector<DeckSeries> forces;
    const auto              given = history.forces();
    for (const DeckPretension &bolt : model.pretensions())
      {
        check_node(bolt, bodies, model, history);
        const auto force = given.find({bolt.node, 0});
        forces.push_back(force == given.end() ? DeckSeries{std::vector<double>(history.n_steps(), 0.)}
                                              : force->second);
        for (const double f : forces.back().values)
          if (f < 0.)
            model.deck().text().fail(
                bolt.place, "PRE-TENSION SECTION: the force of its CLOAD is negative; bolts are pulled.");
        const std::optional<unsigned int> locked = locking_step(bolt, model, history);
        for (unsigned int k = locked ? *locked + 1 : history.n_steps(); k < history.n_steps(); ++k)
          forces.back().values[k] = forces.back().values[*locked];
        bool is_anywhere = false;
        for (DeckBody &body : bodies)
          {
            if (faces_of_surface(model.deck(), *bolt.surface, *body.cells, body.boundary).empty())
              continue;
            if (is_anywhere)
              model.deck().text().fail(bolt.place,
                                       "PRE-TENSION SECTION: its surface belongs to several bodies.");
            is_anywhere = true;
            Section           section(body, model, bolt);
            const std::string name = section.make_volume();
            body.loads.pretensions.push_back({name, section.axis(), forces.back().field()});
            if (locked)
              body.loads.pretensions.back().locked_after = (*locked + 1.) / history.n_steps();
          }
        if (!is_anywhere)
          model.deck().text().fail(bolt.place, "PRE-TENSION SECTION: its surface belongs to no body.");
        nodes.insert(bolt.node);
      }
    for (unsigned int k = 0; k < history.n_steps() && !forces.empty(); ++k)
      if (std::all_of(forces.begin(), forces.end(), [k](const auto &f) { return f.values[k] == 0.; }))
        model.deck().text().fail(model.pretensions()[0].place,
                                 "PRE-TENSION SECTION: in step " + std::to_string(k + 1) +
                                     " no section has a force: CLOAD at its node, direction 1.");
    return nodes;
  }
} // namespace Signorini
