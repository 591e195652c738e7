// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// ADJUST of contact pairs: dependent nodes that are moved onto the other surface, without strain.

#include "deck_bodies.h"

#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/triangulated_shape.h>

#include <algorithm>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The faces of a body with a name as triangles.
    struct NamedSurface
    {
      SurfaceMesh mesh;
      /// Of the body, by vertex of the surface.
      std::vector<unsigned int> vertices;

      NamedSurface(const DeckBody &body, const std::string &name)
      {
        const auto entry = std::find_if(body.named.begin(), body.named.end(),
                                        [&](const auto &named) { return named.first == name; });
        for (const auto &[face, cell] : body.boundary)
          if (entry->second.count(face_key(face)) > 0)
            add(body.cells->mesh, face, body.cells->mesh.cells[cell]);
        mesh.compute_vertex_normals();
      }

      /// The root of the mean area of its triangles.
      double width() const
      {
        double area = 0.;
        for (const auto &[a, b, c] : mesh.triangles)
          area +=
              .5 * cross_product_3d(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])
                       .norm();
        return std::sqrt(area / static_cast<double>(mesh.triangles.size()));
      }

    private:
      void add(const VolumeMesh &volume, const VolumeMesh::Face &face, const VolumeMesh::Cell &cell)
      {
        const bool                is_triangle = face[3] == VolumeMesh::no_vertex;
        std::vector<unsigned int> polygon(face.begin(), face.begin() + (is_triangle ? 3 : 4));
        // Faces of hexahedra are lexicographic.
        if (!is_triangle)
          std::swap(polygon[2], polygon[3]);
        const auto  &x = volume.vertices;
        Tensor<1, 3> inward;
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          inward += (x[cell.vertices[v]] - x[polygon[0]]) / cell.n_vertices;
        if (cross_product_3d(x[polygon[1]] - x[polygon[0]], x[polygon[2]] - x[polygon[0]]) * inward > 0.)
          std::reverse(polygon.begin() + 1, polygon.end());
        for (unsigned int &v : polygon)
          {
            const auto [it, is_new] = number.insert({v, static_cast<unsigned int>(mesh.vertices.size())});
            if (is_new)
              {
                mesh.vertices.push_back(x[v]);
                vertices.push_back(v);
              }
            v = it->second;
          }
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
          mesh.triangles.push_back({{polygon[0], polygon[i], polygon[i + 1]}});
      }

      std::map<unsigned int, unsigned int> number;
    };
  } // namespace



  std::string adjust_nodes(DeckBody &first, const DeckBody &second, const DeckPair &pair)
  {
    const NamedSurface              slave(first, pair.slave->name);
    const NamedSurface              master(second, pair.master->name);
    const TriangulatedShape         shape(master.mesh, "");
    const std::vector<unsigned int> chosen = vertices_within(pair.adjusted_nodes, *first.cells);
    // Nodes that are deeper than that are on the other side of a body.
    const double deepest = std::max(slave.width(), master.width());
    std::size_t  n_moved = 0;
    double       largest = 0.;
    for (unsigned int i = 0; i < slave.vertices.size(); ++i)
      {
        const Point<3>    &x         = slave.mesh.vertices[i];
        const Tensor<1, 3> facing    = -slave.mesh.vertex_normals[i];
        const Point<3>     foot      = shape.project(x);
        const double       gap       = (x - foot) * shape.normal(x, facing);
        const bool         is_chosen = pair.adjust
                                           ? gap <= *pair.adjust
                                           : std::binary_search(chosen.begin(), chosen.end(), slave.vertices[i]);
        // Beyond the rim of the other surface there is nothing to be moved onto.
        const bool is_above = (x - foot).norm_square() <= 2. * gap * gap;
        if (!is_chosen || !is_above || gap < -deepest || gap == 0.)
          continue;
        first.cells->mesh.vertices[slave.vertices[i]] = foot;
        ++n_moved;
        largest = std::max(largest, std::abs(gap));
      }
    std::ostringstream text;
    text << "ADJUST: " << n_moved << " nodes of \"" << pair.slave->name << "\" were moved onto \""
         << pair.master->name << "\" (by at most " << largest << ").";
    return n_moved > 0 ? text.str() : "";
  }
} // namespace Signorini
