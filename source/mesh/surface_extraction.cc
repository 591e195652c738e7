// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/symmetry_planes.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// One face as it travels: where it comes from, corners and hanging vertices on its edges.
    struct PackedFace
    {
      std::uint64_t      coarse_cell, path;
      types::boundary_id boundary;
      unsigned int       face_number, owner, material;
      /// Corners counterclockwise from outside; behind each its successor edge's hanging vertex or
      /// invalid_node.
      std::array<NodeIndex, 8> nodes;

      bool operator<(const PackedFace &other) const
      {
        return std::tie(coarse_cell, path, face_number) <
               std::tie(other.coarse_cell, other.path, other.face_number);
      }

      bool operator==(const PackedFace &other) const
      {
        return std::tie(coarse_cell, path, face_number) ==
               std::tie(other.coarse_cell, other.path, other.face_number);
      }
    };

    /// One entry of the constraint of a hanging node of a face.
    struct PackedParent
    {
      NodeIndex hanging, parent;
      double    weight;

      bool operator<(const PackedParent &other) const
      {
        return std::tie(hanging, parent) < std::tie(other.hanging, other.parent);
      }

      bool operator==(const PackedParent &other) const
      {
        return std::tie(hanging, parent) == std::tie(other.hanging, other.parent);
      }
    };

    /// What is known of a node of faces, or of a parent of one.
    struct PackedVertex
    {
      NodeIndex             node;
      std::array<double, 3> point;
      FixedDirections       fixed;

      bool operator<(const PackedVertex &other) const
      {
        return node < other.node;
      }

      bool operator==(const PackedVertex &other) const
      {
        return node == other.node;
      }
    };

    /// A facet beyond the surface, at one of the nodes of this.
    struct PackedFacet
    {
      NodeIndex             node;
      std::array<double, 3> normal, way;

      bool operator<(const PackedFacet &other) const
      {
        return std::tie(node, normal, way) < std::tie(other.node, other.normal, other.way);
      }

      bool operator==(const PackedFacet &other) const
      {
        return std::tie(node, normal, way) == std::tie(other.node, other.normal, other.way);
      }
    };

    PackedFace pack(const NodalSpace::BoundaryFace &face, const NodalSpace &space)
    {
      const NodalSpace::Cell &cell = space.cells()[face.cell];
      PackedFace              packed;
      packed.coarse_cell = cell.coarse_cell;
      packed.path        = cell.path;
      packed.face_number = face.face;
      packed.boundary    = face.id;
      packed.owner       = Utilities::MPI::this_mpi_process(space.communicator());
      packed.material    = cell.material;
      packed.nodes.fill(invalid_node);
      const auto nodes   = space.nodes(cell);
      const auto corners = CellShape::face(cell.n_vertices, face.face);
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          packed.nodes[2 * v]     = nodes[corners[v]];
          packed.nodes[2 * v + 1] = face.hanging[v];
        }
      return packed;
    }

    void pack_parents(std::vector<PackedParent> &parents, const PackedFace &face, const NodalSpace &space)
    {
      for (const NodeIndex node : face.nodes)
        if (node != invalid_node)
          if (const auto *entries = space.hanging_nodes().get_constraint_entries(node))
            for (const auto &[parent, weight] : *entries)
              parents.push_back({node, parent, weight});
    }

    std::vector<PackedVertex> pack_vertices(const std::vector<PackedFace>   &faces,
                                            const std::vector<PackedParent> &parents, const NodalSpace &space,
                                            const std::function<FixedDirections(const NodeIndex)> &fixed)
    {
      std::vector<NodeIndex> nodes;
      for (const PackedFace &face : faces)
        std::copy_if(face.nodes.begin(), face.nodes.end(), std::back_inserter(nodes),
                     [](const NodeIndex node) { return node != invalid_node; });
      for (const PackedParent &entry : parents)
        nodes.push_back(entry.parent);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      std::vector<PackedVertex> vertices;
      for (const NodeIndex node : nodes)
        {
          const Point<3> &p = space.position(node);
          vertices.push_back({node, {{p[0], p[1], p[2]}}, fixed(node)});
        }
      return vertices;
    }

    /// What all ranks have, sorted and without copies.
    template <typename T>
    std::vector<T> gather_sorted(std::vector<T> mine, const MPI_Comm communicator)
    {
      std::vector<T> all = gather_lists(std::move(mine), communicator, Receivers::all);
      std::stable_sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      return all;
    }

    bool is_known(const NodeIndex node, const std::vector<PackedVertex> &vertices)
    {
      const auto it = std::lower_bound(
          vertices.begin(), vertices.end(), node,
          [](const PackedVertex &vertex, const NodeIndex wanted) { return vertex.node < wanted; });
      return it != vertices.end() && it->node == node;
    }

    /// Of a face that is not in the surface, at the nodes that are.
    void pack_facets(std::vector<PackedFacet> &facets, const PackedFace &face, const NodalSpace &space,
                     const std::vector<PackedVertex> &vertices)
    {
      const unsigned int    n_corners = face.nodes[6] == invalid_node ? 3 : 4;
      std::vector<Point<3>> x;
      Point<3>              centre;
      for (unsigned int v = 0; v < n_corners; ++v)
        {
          x.push_back(space.position(face.nodes[2 * v]));
          centre += Vector3(x.back()) / n_corners;
        }
      // The product of the diagonals; of a triangle that of two edges.
      const Vector3 area = cross_product_3d(x[2] - x[0], x[n_corners - 1] - x[1]);
      if (!(area.norm() > 0.))
        return;
      const auto list = [](const Vector3 &v) { return std::array<double, 3>{{v[0], v[1], v[2]}}; };
      for (const NodeIndex node : face.nodes)
        if (node != invalid_node && is_known(node, vertices))
          facets.push_back({node, list(area / area.norm()), list(centre - space.position(node))});
    }

    /// Twice the area along the normal over the square of the longest edge.
    double triangle_quality(const Point<3> &a, const Point<3> &b, const Point<3> &c,
                            const Tensor<1, 3> &normal)
    {
      const double longest = std::max({(b - a).norm_square(), (c - b).norm_square(), (a - c).norm_square()});
      return cross_product_3d(b - a, c - a) * normal / longest;
    }

    /// Triangulates a polygon such that the worst triangle is as good as possible: hanging vertices lie
    /// on edges, and no triangle may have its three corners on one edge. Dynamic programming over the pieces
    /// that diagonals cut off; there are at most eight corners.
    class PolygonTriangulation
    {
    public:
      PolygonTriangulation(std::vector<std::array<unsigned int, 3>> &triangles,
                           const std::vector<unsigned int> &polygon, const std::vector<Point<3>> &vertices)
        : triangles(triangles)
        , polygon(polygon)
        , n(polygon.size())
        , worst(n * n, std::numeric_limits<double>::max())
        , apex(n * n, 0)
      {
        Tensor<1, 3> normal;
        for (std::size_t i = 1; i + 1 < n; ++i)
          normal += cross_product_3d(vertices[polygon[i]] - vertices[polygon[0]],
                                     vertices[polygon[i + 1]] - vertices[polygon[0]]);
        normal /= normal.norm();
        for (std::size_t length = 2; length < n; ++length)
          for (std::size_t i = 0; i + length < n; ++i)
            {
              const std::size_t j = i + length;
              worst[n * i + j]    = -std::numeric_limits<double>::max();
              for (std::size_t k = i + 1; k < j; ++k)
                {
                  const double quality =
                      std::min({worst[n * i + k], worst[n * k + j],
                                triangle_quality(vertices[polygon[i]], vertices[polygon[k]],
                                                 vertices[polygon[j]], normal)});
                  // Among equals the first, whatever the rounding.
                  if (k == i + 1 || quality > worst[n * i + j] + 1e-9)
                    {
                      worst[n * i + j] = quality;
                      apex[n * i + j]  = k;
                    }
                }
            }
        add(0, n - 1);
      }

    private:
      void add(const std::size_t i, const std::size_t j)
      {
        if (j - i < 2)
          return;
        const std::size_t k = apex[n * i + j];
        add(i, k);
        add(k, j);
        triangles.push_back({{polygon[i], polygon[k], polygon[j]}});
      }

      std::vector<std::array<unsigned int, 3>> &triangles;
      const std::vector<unsigned int>          &polygon;
      const std::size_t                         n;
      std::vector<double>                       worst;
      std::vector<std::size_t>                  apex;
    };

    /// Whether a corner of a face or its centre lies in a region.
    bool touches(const PackedFace &face, const NodalSpace &space,
                 const std::function<bool(const Point<3> &point)> &region)
    {
      const unsigned int n_corners = face.nodes[6] == invalid_node ? 3 : 4;
      Point<3>           centre;
      for (unsigned int v = 0; v < 2 * n_corners; v += 2)
        {
          const Point<3> &corner = space.position(face.nodes[v]);
          if (region(corner))
            return true;
          centre += Tensor<1, 3>(corner) / n_corners;
        }
      return region(centre);
    }

    /// Puts a surface together from the faces of all ranks.
    class SurfaceAssembly
    {
    public:
      /// @param nodes what is known of all nodes, sorted
      explicit SurfaceAssembly(const std::vector<PackedVertex> &nodes)
        : nodes(nodes)
        , number(nodes.size(), none)
      {
      }

      void add_face(const PackedFace &face)
      {
        polygon.clear();
        ContactSurface::Face added;
        added.owner    = face.owner;
        added.worker   = face.owner;
        added.boundary = face.boundary;
        added.material = face.material;
        for (unsigned int v = 0; v < 8; ++v)
          if (face.nodes[v] != invalid_node)
            {
              polygon.push_back(add_vertex(face.nodes[v]));
              if (v % 2 == 0)
                added.corners[v / 2] = polygon.back();
            }
        if (face.nodes[6] == invalid_node)
          {
            added.n_corners  = 3;
            added.corners[3] = added.corners[0];
          }
        surface.faces.push_back(added);
        PolygonTriangulation(surface.mesh.triangles, polygon, surface.mesh.vertices);
        surface.triangle_face.resize(surface.mesh.triangles.size(),
                                     static_cast<unsigned int>(surface.faces.size() - 1));
      }

      /// After all faces.
      void add_facet(const PackedFacet &facet)
      {
        const auto vector = [](const std::array<double, 3> &v) { return Vector3({v[0], v[1], v[2]}); };
        surface.beyond[add_vertex(facet.node)].push_back({vector(facet.normal), vector(facet.way)});
      }

      /// After all faces.
      void add_parent(const PackedParent &entry)
      {
        const unsigned int parent = add_vertex(entry.parent);
        surface.hanging.resize(surface.vertex_node.size());
        surface.hanging[add_vertex(entry.hanging)].emplace_back(parent, entry.weight);
      }

      ContactSurface surface;

    private:
      static constexpr unsigned int none = numbers::invalid_unsigned_int;

      /// The number of a node, a new one where it is mentioned first.
      unsigned int add_vertex(const NodeIndex node)
      {
        const auto it = std::lower_bound(
            nodes.begin(), nodes.end(), node,
            [](const PackedVertex &vertex, const NodeIndex wanted) { return vertex.node < wanted; });
        unsigned int &v = number[it - nodes.begin()];
        if (v == none)
          {
            v = static_cast<unsigned int>(surface.vertex_node.size());
            surface.vertex_node.push_back(node);
            surface.vertex_fixed.push_back(it->fixed);
            surface.mesh.vertices.emplace_back(it->point[0], it->point[1], it->point[2]);
          }
        return v;
      }

      const std::vector<PackedVertex> &nodes;
      std::vector<unsigned int>        number, polygon;
    };

    Point<3> centre(const ContactSurface &surface, const ContactSurface::Face &face)
    {
      Tensor<1, 3> sum;
      for (unsigned int k = 0; k < face.n_corners; ++k)
        sum += surface.mesh.vertices[face.corners[k]];
      return Point<3>(sum / face.n_corners);
    }

    TrueShape true_shape_of(const ContactSurface &surface, const SurfaceShapes &shapes)
    {
      std::vector<BoundaryShapePointer>            list;
      std::vector<unsigned int>                    of_face, of_triangle;
      std::map<BoundaryShapePointer, unsigned int> number;
      for (const ContactSurface::Face &face : surface.faces)
        {
          const auto known = shapes.by_boundary.find(face.boundary);
          if (known == shapes.by_boundary.end() || !known->second)
            {
              of_face.push_back(TrueShape::no_shape);
              continue;
            }
          const auto          &pieces = known->second->pieces();
          BoundaryShapePointer shape  = known->second;
          if (!pieces.empty())
            shape = pieces[shape->piece_at(centre(surface, face), area_vector(surface, face))];
          const auto [it, is_new] = number.insert({shape, static_cast<unsigned int>(list.size())});
          of_face.push_back(it->second);
          if (is_new)
            list.push_back(shape);
        }
      for (const unsigned int face : surface.triangle_face)
        of_triangle.push_back(of_face[face]);
      return TrueShape(surface.mesh, std::move(list), std::move(of_triangle), shapes.are_used);
    }
  } // namespace



  ContactSurface extract_contact_surface(const NodalSpace &space, const std::set<types::boundary_id> &ids,
                                         const std::function<FixedDirections(const NodeIndex)> &fixed,
                                         const std::function<bool(const Point<3> &point)>      &region,
                                         const SurfaceShapes                                   &shapes)
  {
    std::vector<PackedFace>   mine, others;
    std::vector<PackedParent> my_parents;
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (space.cells()[face.cell].is_owned)
        {
          const PackedFace packed = pack(face, space);
          if (ids.count(face.id) == 0 || (region && !touches(packed, space, region)))
            {
              others.push_back(packed);
              continue;
            }
          mine.push_back(packed);
          pack_parents(my_parents, packed, space);
        }
    const std::vector<PackedVertex> vertices =
        gather_sorted(pack_vertices(mine, my_parents, space, fixed), space.communicator());
    std::vector<PackedFacet> my_facets;
    for (const PackedFace &face : others)
      pack_facets(my_facets, face, space, vertices);
    SurfaceAssembly assembly(vertices);
    for (const PackedFace &face : gather_sorted(std::move(mine), space.communicator()))
      assembly.add_face(face);
    // The constraints come from the mesh, not from the faces: the coarser neighbour of a hanging vertex may
    // lie outside of the region or belong to another boundary. Its corners then are vertices without faces.
    for (const PackedParent &entry : gather_sorted(std::move(my_parents), space.communicator()))
      assembly.add_parent(entry);
    for (const PackedFacet &facet : gather_sorted(std::move(my_facets), space.communicator()))
      assembly.add_facet(facet);
    ContactSurface surface = std::move(assembly.surface);
    surface.hanging.resize(surface.vertex_node.size());
    surface.true_shape = true_shape_of(surface, shapes);
    set_normals(surface, shapes);
    project_onto_symmetry_planes(surface);
    return surface;
  }



  std::vector<Vector3> vertex_values(const ContactSurface &surface, const NodePartition &partition,
                                     const Vector &field)
  {
    std::vector<NodeIndex> nodes(surface.vertex_node);
    std::sort(nodes.begin(), nodes.end());
    const std::vector<Vector3> values = import_values(partition, field, nodes);
    std::vector<Vector3>       result;
    result.reserve(nodes.size());
    for (const NodeIndex node : surface.vertex_node)
      result.push_back(values[std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()]);
    return result;
  }
} // namespace Signorini
