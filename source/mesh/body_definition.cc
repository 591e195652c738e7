// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/body_definition.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/mesh_input.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    template <typename Id>
    std::string name_of(const std::map<Id, std::string> &names, const Id id)
    {
      const auto it = names.find(id);
      return it == names.end() ? std::to_string(static_cast<unsigned int>(id)) : it->second;
    }

    template <typename Face>
    VolumeMesh::Face face_vertices(const Face &face, const std::vector<unsigned int> &number)
    {
      VolumeMesh::Face result;
      result.fill(VolumeMesh::no_vertex);
      for (const unsigned int v : face->vertex_indices())
        result[v] = number[face->vertex_index(v)];
      return face_key(result);
    }
  } // namespace



  VolumeMesh make_volume_mesh(const Triangulation<3>                          &triangulation,
                              const std::map<types::boundary_id, std::string> &boundary_names,
                              const std::map<types::material_id, std::string> &volume_names)
  {
    if (triangulation.has_hanging_nodes())
      throw InputError("The mesh of a body must not have hanging nodes; refine it as part of the problem.");
    VolumeMesh                mesh;
    std::vector<unsigned int> number(triangulation.n_vertices(), VolumeMesh::no_vertex);
    FaceNames                 named;
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        const unsigned int n = cell->n_vertices();
        if (!cell->reference_cell().is_hyper_cube() && !cell->reference_cell().is_simplex())
          throw InputError("The mesh of a body must consist of hexahedra or tetrahedra; it has a " +
                           cell->reference_cell().to_string() + ".");
        mesh.cells.push_back(
            {{}, n, index_of(mesh.volume_names, name_of(volume_names, cell->material_id()))});
        for (unsigned int v = 0; v < n; ++v)
          {
            unsigned int &vertex = number[cell->vertex_index(v)];
            if (vertex == VolumeMesh::no_vertex)
              {
                vertex = static_cast<unsigned int>(mesh.vertices.size());
                mesh.vertices.push_back(cell->vertex(v));
              }
            mesh.cells.back().vertices[v] = vertex;
          }
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            named.of_face[face_vertices(cell->face(f), number)] = {
                index_of(named.names, name_of(boundary_names, cell->face(f)->boundary_id()))};
      }
    name_faces(mesh, find_boundary_faces(mesh), std::move(named));
    return mesh;
  }



  BodyDefinition make_body(const std::string &name, const Triangulation<3> &triangulation,
                           const std::map<types::boundary_id, std::string> &boundary_names,
                           const std::map<types::material_id, std::string> &volume_names)
  {
    BodyDefinition body;
    body.name = name;
    body.mesh = make_volume_mesh(triangulation, boundary_names, volume_names);
    std::map<types::boundary_id, std::set<types::manifold_id>> manifolds;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
          manifolds[cell->face(f)->boundary_id()].insert(cell->face(f)->manifold_id());
    for (const auto &[boundary, ids] : manifolds)
      if (ids.size() == 1 && *ids.begin() != numbers::flat_manifold_id)
        body.geometry.push_back(
            {name_of(boundary_names, boundary), nullptr, triangulation.get_manifold(*ids.begin()).clone()});
    return body;
  }
} // namespace Signorini
