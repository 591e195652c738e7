// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_extraction.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// One face as it travels: where it comes from, corners and hanging vertices on its edges.
    struct PackedFace
    {
      std::uint64_t coarse_cell, path, face_number;
      /// Corners counterclockwise from outside; behind each its successor edge's hanging vertex or
      /// invalid_node.
      std::array<NodeIndex, 8>             nodes;
      std::array<std::array<double, 3>, 8> points;
      std::array<FixedMask, 8>             fixed;
      unsigned int                         owner;

      bool operator<(const PackedFace &other) const
      {
        return std::tie(coarse_cell, path, face_number) <
               std::tie(other.coarse_cell, other.path, other.face_number);
      }
    };

    using Cell = DoFHandler<3>::active_cell_iterator;

    /// The hanging vertex in the middle of an edge of an owned cell, or invalid_node.
    NodeIndex hanging_vertex(const Cell &cell, const unsigned int line)
    {
      if (!cell->line(line)->has_children())
        return invalid_node;
      return cell->line(line)->child(0)->vertex_dof_index(1, 0, 0);
    }

    /// The line of a cell between two of its vertices.
    unsigned int line_between(const unsigned int a, const unsigned int b)
    {
      for (unsigned int l = 0; l < GeometryInfo<3>::lines_per_cell; ++l)
        {
          const unsigned int v0 = GeometryInfo<3>::line_to_cell_vertices(l, 0);
          const unsigned int v1 = GeometryInfo<3>::line_to_cell_vertices(l, 1);
          if ((v0 == a && v1 == b) || (v0 == b && v1 == a))
            return l;
        }
      Assert(false, ExcInternalError());
      return 0;
    }

    PackedFace pack(const Cell &cell, const unsigned int face, const NodalSpace &space,
                    const std::function<FixedMask(const NodeIndex)> &fixed)
    {
      PackedFace   packed;
      const CellId id    = cell->id();
      packed.coarse_cell = id.get_coarse_cell_id();
      packed.path        = 1;
      for (const std::uint8_t child : id.get_child_indices())
        packed.path = packed.path << 3 | child;
      packed.face_number = face;
      packed.owner       = Utilities::MPI::this_mpi_process(space.communicator());

      // deal.II's face vertices in reference order (lexicographic); the faces x = 0, y = 1, z = 0 are seen
      // from inside when run through counterclockwise.
      std::array<unsigned int, 4> loop;
      static const unsigned int   ccw[4] = {0, 1, 3, 2};
      for (unsigned int v = 0; v < 4; ++v)
        loop[v] = GeometryInfo<3>::face_to_cell_vertices(face, ccw[v]);
      std::array<NodeIndex, 8> nodes;
      space.cell_nodes(cell, nodes);
      Point<3> cell_centre, face_centre;
      for (const NodeIndex node : nodes)
        cell_centre += .125 * space.position(node);
      for (const unsigned int v : loop)
        face_centre += .25 * space.position(nodes[v]);
      const Tensor<1, 3> normal =
          cross_product_3d(space.position(nodes[loop[2]]) - space.position(nodes[loop[0]]),
                           space.position(nodes[loop[3]]) - space.position(nodes[loop[1]]));
      if (normal * (face_centre - cell_centre) < 0.)
        std::swap(loop[1], loop[3]);

      for (unsigned int v = 0; v < 4; ++v)
        {
          packed.nodes[2 * v]     = nodes[loop[v]];
          packed.nodes[2 * v + 1] = hanging_vertex(cell, line_between(loop[v], loop[(v + 1) % 4]));
        }
      for (unsigned int v = 0; v < 8; ++v)
        if (packed.nodes[v] != invalid_node)
          {
            const Point<3> &p = space.position(packed.nodes[v]);
            packed.points[v]  = {{p[0], p[1], p[2]}};
            packed.fixed[v]   = fixed(packed.nodes[v]);
          }
        else
          {
            packed.points[v] = {{0., 0., 0.}};
            packed.fixed[v]  = 0;
          }
      return packed;
    }

    std::vector<PackedFace> gather_faces(const std::vector<PackedFace> &mine, const MPI_Comm communicator)
    {
      std::vector<PackedFace> all;
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        all = mine;
      else
        {
          const char *const begin = reinterpret_cast<const char *>(mine.data());
          for (const auto &bytes : Utilities::MPI::all_gather(
                   communicator, std::vector<char>(begin, begin + mine.size() * sizeof(PackedFace))))
            {
              const std::size_t n = all.size();
              all.resize(n + bytes.size() / sizeof(PackedFace));
              std::memcpy(static_cast<void *>(all.data() + n), bytes.data(), bytes.size());
            }
        }
      std::sort(all.begin(), all.end());
      return all;
    }

    /// Triangles of a face with hanging vertices on some of its edges: ears with a corner between two
    /// neighbouring polygon vertices are cut where the remaining polygon stays well shaped.
    void triangulate(std::vector<std::array<unsigned int, 3>> &triangles, std::vector<unsigned int> polygon,
                     const std::vector<Point<3>> &vertices)
    {
      while (polygon.size() > 3)
        {
          // The ear with the shortest diagonal; a flat ear (three points of one edge) is none.
          const std::size_t n        = polygon.size();
          std::size_t       best     = n;
          double            shortest = std::numeric_limits<double>::max();
          for (std::size_t i = 0; i < n; ++i)
            {
              const Point<3> &a = vertices[polygon[(i + n - 1) % n]], &b = vertices[polygon[i]],
                             &c     = vertices[polygon[(i + 1) % n]];
              const double diagonal = a.distance(c);
              const double height   = cross_product_3d(b - a, c - b).norm() / diagonal;
              if (height > 1e-3 * diagonal && diagonal < shortest * (1. - 1e-9))
                {
                  shortest = diagonal;
                  best     = i;
                }
            }
          Assert(best < n, ExcInternalError());
          triangles.push_back({{polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]}});
          polygon.erase(polygon.begin() + best);
        }
      triangles.push_back({{polygon[0], polygon[1], polygon[2]}});
    }

    /// Vertex normals: area weighted; hanging vertices get the mean of their parents; then projected onto the
    /// free directions.
    void set_normals(ContactSurface &surface)
    {
      surface.mesh.compute_vertex_normals();
      auto &normals = surface.mesh.vertex_normals;
      for (std::size_t v = 0; v < normals.size(); ++v)
        if (!surface.hanging[v].empty())
          {
            Tensor<1, 3> mean;
            for (const auto &[parent, weight] : surface.hanging[v])
              mean += weight * normals[parent];
            if (mean.norm() > 0.)
              normals[v] = mean / mean.norm();
          }
      surface.normal_share.resize(normals.size());
      for (std::size_t v = 0; v < normals.size(); ++v)
        {
          const Vector3 projected = project_free(surface.vertex_fixed[v], normals[v]);
          surface.normal_share[v] = projected.norm();
          if (surface.normal_share[v] > 1e-6)
            normals[v] = projected / surface.normal_share[v];
        }
    }
  } // namespace



  ContactSurface extract_contact_surface(const NodalSpace &space, const std::set<types::boundary_id> &ids,
                                         const std::function<FixedMask(const NodeIndex)>  &fixed,
                                         const std::function<bool(const Point<3> &point)> &region)
  {
    std::vector<PackedFace> mine;
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int face : cell->face_indices())
          if (cell->face(face)->at_boundary() && ids.count(cell->face(face)->boundary_id()) > 0)
            {
              const PackedFace packed = pack(cell, face, space, fixed);
              bool             inside = !region;
              Point<3>         centre;
              for (unsigned int v = 0; v < 8 && !inside; v += 2)
                {
                  const Point<3> corner(packed.points[v][0], packed.points[v][1], packed.points[v][2]);
                  centre += .25 * corner;
                  inside = region(corner);
                }
              if (inside || region(centre))
                mine.push_back(packed);
            }

    ContactSurface                              surface;
    std::unordered_map<NodeIndex, unsigned int> number;
    std::vector<unsigned int>                   polygon;
    const std::vector<PackedFace>               faces = gather_faces(mine, space.communicator());
    for (const PackedFace &face : faces)
      {
        polygon.clear();
        surface.faces.emplace_back();
        surface.faces.back().owner = face.owner;
        for (unsigned int v = 0; v < 8; ++v)
          if (face.nodes[v] != invalid_node)
            {
              const auto [it, is_new] =
                  number.insert({face.nodes[v], static_cast<unsigned int>(surface.vertex_node.size())});
              if (is_new)
                {
                  surface.vertex_node.push_back(face.nodes[v]);
                  surface.vertex_fixed.push_back(face.fixed[v]);
                  surface.mesh.vertices.emplace_back(face.points[v][0], face.points[v][1], face.points[v][2]);
                }
              polygon.push_back(it->second);
              if (v % 2 == 0)
                surface.faces.back().corners[v / 2] = it->second;
            }
        triangulate(surface.mesh.triangles, polygon, surface.mesh.vertices);
        surface.triangle_face.resize(surface.mesh.triangles.size(),
                                     static_cast<unsigned int>(surface.faces.size() - 1));
      }

    // A vertex in the middle of an edge of any face depends on the ends of the edge; chains are resolved.
    surface.hanging.resize(surface.vertex_node.size());
    for (const PackedFace &face : faces)
      for (unsigned int v = 1; v < 8; v += 2)
        if (face.nodes[v] != invalid_node)
          surface.hanging[number[face.nodes[v]]] = {{number[face.nodes[v - 1]], .5},
                                                    {number[face.nodes[(v + 1) % 8]], .5}};
    for (auto &entries : surface.hanging)
      for (std::size_t i = 0; i < entries.size();)
        if (const auto &parents = surface.hanging[entries[i].first]; !parents.empty())
          {
            const auto [parent, weight] = entries[i];
            (void)parent;
            entries.erase(entries.begin() + i);
            for (const auto &[grandparent, share] : std::vector<std::pair<unsigned int, double>>(parents))
              entries.emplace_back(grandparent, weight * share);
          }
        else
          ++i;
    set_normals(surface);
    return surface;
  }
} // namespace Signorini
