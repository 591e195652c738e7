// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The part of Bodies that moves vertices to the shapes of their boundaries.

#include "placed_body.h"

#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/forest_vertices.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    unsigned int number_of_vertices(const VolumeMesh::Cell &cell)
    {
      return cell.n_vertices;
    }

    unsigned int number_of_vertices(const Tetrahedron &)
    {
      return 4;
    }

    /// Of a face of a tetrahedron; the normal has any length.
    std::pair<Point<3>, Tensor<1, 3>> centre_and_normal(const std::vector<Point<3>> &x,
                                                        const Tetrahedron &cell, const unsigned int face)
    {
      const auto     &corners = CellShape::face(4, face);
      const Point<3> &a = x[cell.vertices[corners[0]]], &b = x[cell.vertices[corners[1]]],
                     &c = x[cell.vertices[corners[2]]];
      Tensor<1, 3> sum;
      for (const unsigned int v : cell.vertices)
        sum += x[v];
      const Point<3>     centre((Tensor<1, 3>(a) + Tensor<1, 3>(b) + Tensor<1, 3>(c)) / 3.);
      const Tensor<1, 3> normal = cross_product_3d(b - a, c - a);
      return {centre, (centre - Point<3>(sum / 4.)) * normal < 0. ? -normal : normal};
    }

    /// Which vertices belong to cells of different materials.
    template <typename Cell, typename Material>
    std::vector<bool> between_materials(const std::size_t n_vertices, const std::vector<Cell> &cells,
                                        const Material &material)
    {
      std::vector<unsigned int> first(n_vertices, numbers::invalid_unsigned_int);
      std::vector<bool>         result(n_vertices, false);
      for (const Cell &cell : cells)
        for (unsigned int v = 0; v < number_of_vertices(cell); ++v)
          {
            unsigned int &m = first[cell.vertices[v]];
            if (m == numbers::invalid_unsigned_int)
              m = material(cell);
            result[cell.vertices[v]] = result[cell.vertices[v]] || m != material(cell);
          }
      return result;
    }
  } // namespace



  std::vector<unsigned int>
  Bodies::move_to_shapes(std::vector<Point<3>>                                 &positions,
                         const std::map<unsigned int, std::set<BoundaryPlace>> &places,
                         const std::vector<ArrayView<const unsigned int>>      &cells,
                         const std::vector<bool> &is_fixed, const SharedVertices &shared)
  {
    std::vector<std::pair<unsigned int, Point<3>>> targets;
    for (const auto &[v, on] : places)
      if (const auto list = shapes_of(on); !list.empty())
        targets.emplace_back(v, project_onto(list, positions[v]));
    std::vector<unsigned int> late;
    MovementReport            report = move_nodes(positions, targets, cells, is_fixed, late, shared);
    std::map<types::boundary_id, double> distances, numbers;
    for (const unsigned int v : late)
      {
        const auto target = std::lower_bound(targets.begin(), targets.end(), v,
                                             [](const auto &t, const unsigned int w) { return t.first < w; });
        for (const types::boundary_id id : boundaries_of(places.at(v)))
          if (shapes[id])
            {
              ++numbers[id];
              distances[id] = std::max(distances[id], positions[v].distance(target->second));
            }
      }
    if (report.n_damped > 0)
      report_late(report, distances, numbers, shared);
    last_movement.add(report);
    return late;
  }



  void Bodies::report_late(MovementReport &report, const std::map<types::boundary_id, double> &distances,
                           const std::map<types::boundary_id, double> &numbers,
                           const SharedVertices                       &shared) const
  {
    for (types::boundary_id id = 0; id < shapes.size(); ++id)
      {
        const auto   it       = numbers.find(id);
        const double number   = shared.sum(it == numbers.end() ? 0. : it->second);
        const double distance = -shared.minimum(it == numbers.end() ? 0. : -distances.at(id));
        if (number > 0.)
          report.late[id] = {static_cast<std::size_t>(number), distance};
      }
  }



  void Bodies::snap_vertices(Placed &body)
  {
    VolumeMesh                                     &mesh = body.mesh;
    std::map<unsigned int, std::set<BoundaryPlace>> places;
    // Shapes of users and of generated meshes have no pieces.
    for (const auto &face : mesh.faces)
      for (const unsigned int v : face.vertices)
        if (v != VolumeMesh::no_vertex)
          places[v].insert({body.first_boundary + face.name, 0});
    std::vector<ArrayView<const unsigned int>> cells;
    for (const VolumeMesh::Cell &cell : mesh.cells)
      cells.emplace_back(cell.vertices.data(), cell.n_vertices);
    std::vector<bool> is_fixed =
        between_materials(mesh.vertices.size(), mesh.cells, [](const auto &cell) { return cell.volume; });
    for (const auto &entry : places)
      is_fixed[entry.first] = true;
    body.late = move_to_shapes(mesh.vertices, places, cells, is_fixed);
  }



  void Bodies::follow_shapes()
  {
    const unsigned int     level = forest->n_levels() - 1;
    const ForestMesh      &mesh  = forest->mesh(level);
    const ForestVertices   vertices(mesh, comm);
    const ForestMesh::Name first_new = forest->history().n_vertices(level - 1);
    std::vector<bool>      is_fixed =
        between_materials(mesh.vertices.size(), mesh.cells, [](const auto &cell) { return cell.material; });
    std::map<unsigned int, std::set<BoundaryPlace>> places;
    std::vector<ArrayView<const unsigned int>>      cells;
    const std::vector<Point<3>>                    &x = forest->points();
    for (const Tetrahedron &cell : mesh.cells)
      {
        cells.emplace_back(cell.vertices.data(), 4);
        for (unsigned int f = 0; f < 4; ++f)
          if (cell.boundary[f] != Tetrahedron::inner)
            {
              std::vector<unsigned int> followers;
              for (const unsigned int k : CellShape::face(4, f))
                {
                  const unsigned int v = cell.vertices[k];
                  is_fixed[v]          = true;
                  if (vertices.owns(v) && (mesh.vertices[v] >= first_new || mesh.is_marked[v]))
                    followers.push_back(v);
                }
              if (followers.empty())
                continue;
              const auto [centre, outward] = centre_and_normal(x, cell, f);
              for (const unsigned int v : followers)
                places[v].insert(place(cell.boundary[f], centre, outward));
            }
      }
    // Owners see all cells around their vertices.
    std::vector<double> flags(is_fixed.begin(), is_fixed.end());
    vertices.update(flags);
    is_fixed.assign(flags.begin(), flags.end());
    const auto late = move_to_shapes(forest->points(), places, cells, is_fixed, vertices);
    flags.assign(flags.size(), 0.);
    for (const unsigned int v : late)
      flags[v] = 1.;
    vertices.update(flags);
    forest->vertex_marks().assign(flags.begin(), flags.end());
  }
} // namespace Signorini
