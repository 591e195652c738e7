// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The part of Bodies that makes boundaries follow their shapes.

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/triangulated_shape.h>

#include <sstream>

namespace Signorini
{
  using namespace dealii;

  void Bodies::add_shapes(const BodyDefinition &definition, Placed &body)
  {
    const std::string section = "Body " + definition.name + "/";
    const auto       &known   = body.mesh.boundary_names;
    const auto        indices = [&](const std::string &name, const std::string &where) {
      std::vector<types::boundary_id> ids;
      for (const auto &[group, members] : body.mesh.boundary_groups)
        if (group == name)
          {
            for (const unsigned int i : members)
              ids.push_back(body.first_boundary + i);
            return ids;
          }
      const auto it = std::find(known.begin(), known.end(), name);
      if (it == known.end())
        throw InputError(section + where + ": the body has no boundary \"" + name + "\"; it has " +
                                listed(known) + ".");
      ids.push_back(body.first_boundary + static_cast<types::boundary_id>(it - known.begin()));
      return ids;
    };
    shapes.resize(body.first_boundary + known.size());
    is_user_shape.resize(shapes.size(), false);
    std::set<BoundaryShapePointer> seen;
    for (const BoundaryGeometry &geometry : definition.geometry)
      {
        for (const types::boundary_id id :
             indices(geometry.boundary, "Boundary shapes, \"" + geometry.boundary + "\""))
          {
            if (geometry.manifold)
              {
                body.manifolds.emplace_back(id, geometry.manifold);
                has_manifold.insert(id);
              }
            if (!geometry.shape)
              continue;
            shapes[id]        = geometry.shape;
            is_user_shape[id] = !geometry.manifold;
          }
        if (geometry.shape && seen.insert(geometry.shape).second && !geometry.shape->note().empty())
          remarks.push_back(geometry.shape->note());
      }
    for (const auto &[first, second] : definition.sharp_edges)
      for (const types::boundary_id a : indices(first, "Sharp edges"))
        for (const types::boundary_id b : indices(second, "Sharp edges"))
          sharp.insert({std::min(a, b), std::max(a, b)});
  }



  namespace
  {
    /// Calls add(face, cell) for the named faces of a mesh with a cell that they belong to.
    template <typename Add>
    void for_each_named_face(const VolumeMesh &mesh, const Add &add)
    {
      std::map<VolumeMesh::Face, const VolumeMesh::BoundaryFace *> named;
      std::vector<bool>                                            is_on_face(mesh.vertices.size(), false);
      for (const auto &face : mesh.faces)
        {
          named[face_key(face.vertices)] = &face;
          for (const unsigned int v : face.vertices)
            if (v != VolumeMesh::no_vertex)
              is_on_face[v] = true;
        }
      for (const VolumeMesh::Cell &cell : mesh.cells)
        for (unsigned int f = 0; f < CellShape::n_faces(cell.n_vertices); ++f)
          {
            VolumeMesh::Face key;
            key.fill(VolumeMesh::no_vertex);
            unsigned int n = 0;
            for (const unsigned int v : CellShape::face(cell.n_vertices, f))
              key[n++] = cell.vertices[v];
            if (std::all_of(key.begin(), key.begin() + n, [&](const auto v) { return is_on_face[v]; }))
              if (const auto it = named.find(face_key(key)); it != named.end())
                add(*it->second, cell);
          }
    }

    /// The corners of a face around it, counterclockwise seen from outside of its cell.
    std::vector<unsigned int> outward_polygon(const VolumeMesh &mesh, const VolumeMesh::BoundaryFace &face,
                                              const VolumeMesh::Cell &cell)
    {
      const auto               &x           = mesh.vertices;
      const bool                is_triangle = face.vertices[3] == VolumeMesh::no_vertex;
      std::vector<unsigned int> polygon(face.vertices.begin(), face.vertices.begin() + (is_triangle ? 3 : 4));
      // Faces of hexahedra are lexicographic.
      if (!is_triangle)
        std::swap(polygon[2], polygon[3]);
      Tensor<1, 3> inward;
      for (unsigned int v = 0; v < cell.n_vertices; ++v)
        inward += (x[cell.vertices[v]] - x[polygon[0]]) / cell.n_vertices;
      if (cross_product_3d(x[polygon[1]] - x[polygon[0]], x[polygon[2]] - x[polygon[0]]) * inward > 0.)
        std::reverse(polygon.begin() + 1, polygon.end());
      return polygon;
    }
  } // namespace



  Bodies::StartSurface Bodies::start_surface(const Placed &placed)
  {
    StartSurface              result;
    std::vector<unsigned int> number(placed.mesh.vertices.size(), VolumeMesh::no_vertex);
    for_each_named_face(placed.mesh, [&](const VolumeMesh::BoundaryFace &face, const VolumeMesh::Cell &cell) {
      std::vector<unsigned int> polygon = outward_polygon(placed.mesh, face, cell);
      for (unsigned int &v : polygon)
        {
          if (number[v] == VolumeMesh::no_vertex)
            {
              number[v] = static_cast<unsigned int>(result.mesh.vertices.size());
              result.mesh.vertices.push_back(placed.mesh.vertices[v]);
            }
          v = number[v];
        }
      const auto &x = result.mesh.vertices;
      // The shorter diagonal.
      if (polygon.size() == 4 &&
          x[polygon[1]].distance(x[polygon[3]]) < x[polygon[0]].distance(x[polygon[2]]))
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        {
          result.mesh.triangles.push_back({{polygon[0], polygon[i], polygon[i + 1]}});
          result.boundary.push_back(placed.first_boundary + face.name);
        }
    });
    return result;
  }



  std::map<types::boundary_id, BoundaryShapePointer>
  Bodies::true_shapes(const unsigned int body, const std::set<types::boundary_id> &ids,
                      const bool everywhere) const
  {
    std::map<types::boundary_id, BoundaryShapePointer> result;
    const StartSurface                                &start = start_surfaces[body];
    std::vector<bool>                                  wanted;
    for (const types::boundary_id id : start.boundary)
      wanted.push_back(ids.count(id) > 0 && !shapes[id]);
    BoundaryShapePointer smooth;
    if (std::find(wanted.begin(), wanted.end(), true) != wanted.end())
      if (const auto shape = std::make_shared<const SmoothShape>(start.mesh, wanted, everywhere);
          !shape->is_flat())
        smooth = shape;
    for (const types::boundary_id id : ids)
      result[id] = shapes[id] ? shapes[id] : smooth;
    return result;
  }



  void Bodies::follow_start_mesh(const unsigned int body, const std::set<types::boundary_id> &ids,
                                 const bool everywhere)
  {
    bool any = false;
    for (const auto &[id, shape] : true_shapes(body, ids, everywhere))
      if (!shapes[id] && shape)
        {
          shapes[id]        = shape;
          is_user_shape[id] = has_manifold.count(id) == 0;
          any               = true;
        }
    if (!any)
      return;
    for (unsigned int i = 0; i < boundaries[body].size(); ++i)
      if (const types::boundary_id id = first_boundary[body] + i; !shapes[id])
        {
          const StartSurface       &start = start_surfaces[body];
          std::vector<unsigned int> triangles;
          for (unsigned int t = 0; t < start.boundary.size(); ++t)
            if (start.boundary[t] == id)
              triangles.push_back(t);
          shapes[id]        = triangles.empty() ? nullptr : plane_through(start.mesh, triangles);
          is_user_shape[id] = static_cast<bool>(shapes[id]);
        }
    if (tria)
      set_manifolds();
  }



  bool Bodies::is_sharp(const std::set<types::boundary_id> &ids) const
  {
    return std::any_of(sharp.begin(), sharp.end(), [&](const auto &pair) {
      return ids.count(pair.first) > 0 && ids.count(pair.second) > 0;
    });
  }



  Bodies::BoundaryPlace Bodies::place(const types::boundary_id id, const Point<3> &p,
                                      const Tensor<1, 3> &outward) const
  {
    return {id, shapes[id] && !shapes[id]->pieces().empty() ? shapes[id]->piece_at(p, outward) : 0};
  }



  std::vector<BoundaryShapePointer> Bodies::shapes_of(const std::set<BoundaryPlace> &places) const
  {
    std::vector<BoundaryShapePointer> result;
    if (is_sharp(boundaries_of(places)))
      return result;
    for (const auto &[id, piece] : places)
      if (shapes[id])
        {
          const auto                &pieces = shapes[id]->pieces();
          const BoundaryShapePointer shape  = pieces.empty() ? shapes[id] : pieces[piece];
          if (std::find(result.begin(), result.end(), shape) == result.end())
            result.push_back(shape);
        }
    return result;
  }



  namespace
  {
    /// When a shape is taken for one that belongs to another boundary: shares of the longest edge of the
    /// faces at a vertex. Pure numbers.
    struct ShapePlaceRule
    {
      /// Vertices that stay where they are. Those of a mesh on facets that span 45 degrees lie off by a
      /// tenth; measured: 7e-7 for the bones of the knee from which their mesh was made, 0.007 for the other
      /// examples.
      double largest_distance = .15;
      /// Vertices that are snapped to the shape.
      double largest_snap = 1.;
      /// What is noted at least.
      double noted_distance = .02;
    };
  } // namespace



  void Bodies::check_shapes(const Placed &body, const std::string &where, const bool snaps)
  {
    const VolumeMesh                                    &mesh = body.mesh;
    const ShapePlaceRule                                 rule;
    std::map<unsigned int, std::set<types::boundary_id>> ids;
    std::map<unsigned int, double>                       reach;
    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        if (v != VolumeMesh::no_vertex)
          {
            ids[v].insert(body.first_boundary + face.name);
            for (const unsigned int w : face.vertices)
              if (w != VolumeMesh::no_vertex)
                reach[v] = std::max(reach[v], mesh.vertices[v].distance(mesh.vertices[w]));
          }
    double             largest = 0., distance = 0.;
    unsigned int       worst    = 0;
    types::boundary_id boundary = 0;
    for (const auto &[v, on] : ids)
      if (!is_sharp(on))
        for (const types::boundary_id id : on)
          if (is_user_shape[id])
            {
              const double d = shapes[id]->project(mesh.vertices[v]).distance(mesh.vertices[v]);
              if (!(d <= largest * reach[v]))
                {
                  largest  = d / reach[v];
                  distance = d;
                  worst    = v;
                  boundary = id;
                }
            }
    if (largest <= rule.noted_distance)
      return;
    std::ostringstream text;
    text << where << ", \"" << mesh.boundary_names[boundary - body.first_boundary] << "\": the shape is "
         << distance << " away from the vertex (" << mesh.vertices[worst] << "), where faces are "
         << reach[worst] << " wide";
    if (largest > (snaps ? rule.largest_snap : rule.largest_distance))
      throw InputError(text.str() +
                       ". Does it belong to this boundary, in the units and in the frame of the mesh?" +
                       (snaps ? "" : " If it does, \"Snap boundary vertices\" moves the vertices to it."));
    if (!snaps)
      remarks.push_back(text.str() +
                        "; the vertices of the start mesh stay where they are unless \"Snap boundary "
                        "vertices\" is set.");
  }



  void Bodies::assess_hexahedra()
  {
    // deal.II has moved the new nodes already: what they were like before is not known.
    MovementReport report;
    for (const auto &cell : tria->active_cell_iterators())
      if (cell->is_locally_owned() && cell->has_boundary_lines())
        {
          std::array<Point<3>, 8> corners;
          for (unsigned int v = 0; v < 8; ++v)
            corners[v] = cell->vertex(v);
          report.quality_after = std::min(report.quality_after, scaled_jacobian(corners));
        }
    report.quality_after  = Utilities::MPI::min(report.quality_after, comm);
    report.quality_before = report.quality_after;
    last_movement.add(report);
  }



  void Bodies::set_manifolds()
  {
    if (sharp.empty() && std::find(is_user_shape.begin(), is_user_shape.end(), true) == is_user_shape.end())
      return;
    using Places = std::set<BoundaryPlace>;
    std::map<unsigned int, Places>       places_of_line;
    std::map<Places, types::manifold_id> manifold_of;
    const auto                           manifold = [&](const Places &places) {
      const auto on = shapes_of(places);
      if (on.empty())
        return numbers::flat_manifold_id;
      const auto [it, is_new] = manifold_of.insert({places, next_manifold});
      if (is_new)
        tria->set_manifold(next_manifold++, ShapeManifold(on));
      return it->second;
    };
    // What is neither keeps the manifolds of generated meshes.
    const auto is_ours = [&](const Places &places) {
      const auto ids = boundaries_of(places);
      return is_sharp(ids) ||
             std::any_of(ids.begin(), ids.end(), [&](const auto id) { return is_user_shape[id]; });
    };
    const auto has_sharp_edge = [&](const types::boundary_id id) {
      return std::any_of(sharp.begin(), sharp.end(),
                         [&](const auto &pair) { return pair.first == id || pair.second == id; });
    };
    for (const auto &cell : tria->cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (const auto face = cell->face(f); face->at_boundary())
          {
            const types::boundary_id id     = face->boundary_id();
            const Point<3>           centre = face->center();
            const Tensor<1, 3>       normal =
                cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
            const BoundaryPlace at =
                place(id, centre, normal * (centre - cell->center()) < 0. ? -normal : normal);
            // deal.II's sphere takes the mean radius of the points around: not beside a straight edge.
            if (is_user_shape[id] || (shapes[id] && has_sharp_edge(id)))
              face->set_manifold_id(manifold({at}));
            for (unsigned int l = 0; l < 4; ++l)
              places_of_line[face->line_index(l)].insert(at);
          }
    for (const auto &cell : tria->cell_iterators_on_level(0))
      for (const unsigned int l : cell->line_indices())
        if (const auto it = places_of_line.find(cell->line_index(l));
            it != places_of_line.end() && is_ours(it->second))
          cell->line(l)->set_manifold_id(manifold(it->second));
  }
} // namespace Signorini
