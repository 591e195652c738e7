// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_contact_surface_h
#define signorini_mesh_contact_surface_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/mesh/true_shape.h>
#include <signorini/surface/surface_mesh.h>

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace Signorini
{
  /// One side of a contact pair: the faces, their triangles and nodes. The whole of it, the same on all
  /// ranks, while it is mapped; then each rank keeps the piece that it needs (SurfacePiece), a surface of its
  /// own in the order of the whole. That order does not depend on the number of ranks.
  struct ContactSurface
  {
    /// A boundary face of a cell: a bilinear quadrilateral or a triangle.
    struct Face
    {
      /// Corners as indices of mesh.vertices, counterclockwise seen from outside the body (reference corners
      /// (0,0), (1,0), (1,1), (0,1); of a triangle (0,0), (1,0), (0,1)). A triangle has its first corner
      /// again in the fourth place, where its function is zero.
      std::array<unsigned int, 4> corners;
      /// The rank that owns the cell.
      unsigned int owner;
      /// The rank that maps the face and integrates over it (share_faces()).
      unsigned int worker;
      unsigned int n_corners = 4;
      /// Of the boundary that the face belongs to.
      dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
      /// Of the cell (Bodies::material()).
      dealii::types::material_id material = 0;
      /// Bit i: at corner i another side of the body is nearer to contact (FacingParts::acts()), or the other
      /// body runs away over this face (leave_flanks()); the multiplier of the vertex does not act on it.
      unsigned char left_corners = 0;
      /// Those of them over which the other body runs away: for the multiplier the face is not covered there.
      unsigned char flank_corners = 0;

      /// See left_corners.
      bool leaves(const unsigned int corner) const
      {
        return (left_corners >> corner & 1u) != 0;
      }

      /// Of a vertex of the surface.
      bool leaves_vertex(const unsigned int vertex) const
      {
        for (unsigned int i = 0; i < n_corners; ++i)
          if (corners[i] == vertex)
            return leaves(i);
        return false;
      }

      /// See flank_corners.
      bool sees_flank(const unsigned int corner) const
      {
        return (flank_corners >> corner & 1u) != 0;
      }
    };

    /// Triangles of all faces. Hanging vertices on the edges of a face are corners of its triangles:
    /// the mesh has no T-junctions. vertex_normals are outward unit normals; on symmetry planes they lie in
    /// the plane (project_onto_symmetry_planes()).
    SurfaceMesh mesh;

    /// In an order that does not depend on the ranks.
    std::vector<Face> faces;
    /// The face of each triangle of mesh.
    std::vector<unsigned int> triangle_face;
    /// By triangle; bit i: its side from corner i to the next one is a crease. Empty before mark_creases().
    std::vector<unsigned char> crease_sides;
    /// Global node number of each vertex of mesh.
    std::vector<NodeIndex> vertex_node;
    /// By vertex, whether its normal is that of the other side of the pair, or the nearest to it on a crease;
    /// empty before turn_edges().
    std::vector<bool> has_partner_normal;
    /// A facet at a vertex: its outward unit normal, and the way from the vertex to its centre (length).
    struct Facet
    {
      /// As above.
      Vector3 normal, way;
    };
    /// By vertex in a groove on one side of which alone its multiplier would act (Face::left_corners): the
    /// normal of that. On a mortar side the normal of the mesh is between both; a nonmortar side takes these.
    std::map<unsigned int, Vector3> normals_of_rows;

    /// Makes them the normals of the mesh.
    void take_row_normals();

    /// By vertex, what else of the boundary of the body is around it: facets that do not belong to the
    /// surface, or were left out. Known of whole surfaces until they are mapped.
    std::map<unsigned int, std::vector<Facet>> beyond;
    /// Prescribed directions of each vertex.
    std::vector<FixedDirections> vertex_fixed;
    /// For hanging vertices: parents (vertex indices) and weights of the closed constraint; else empty.
    std::vector<std::vector<std::pair<unsigned int, double>>> hanging;
    /// The true surface over the facets.
    TrueShape true_shape;

    /// What a piece knows of the surface that it was cut out of: the numbers there of its faces, triangles
    /// and vertices, ascending; the number of vertices; the diagonal of the box around it (length).
    struct Origin
    {
      /// As above.
      std::vector<unsigned int> faces, triangles, vertices;
      std::size_t               n_vertices;
      double                    extent;
    };
    /// Nothing if this is a whole surface.
    std::optional<Origin> origin;

    /// Numbers in the whole surface.
    unsigned int number_of_face(const unsigned int face) const
    {
      return origin ? origin->faces[face] : face;
    }

    /// The same of a triangle.
    unsigned int number_of_triangle(const unsigned int triangle) const
    {
      return origin ? origin->triangles[triangle] : triangle;
    }

    /// The same of a vertex.
    unsigned int number_of_vertex(const unsigned int vertex) const
    {
      return origin ? origin->vertices[vertex] : vertex;
    }

    /// The face of a number in the whole surface, which must be here.
    unsigned int face_of_number(const unsigned int number) const;

    /// Number of vertices of the whole surface.
    std::size_t n_vertices_of_whole() const
    {
      return origin ? origin->n_vertices : mesh.vertices.size();
    }

    /// Diagonal of the box around the whole surface (length).
    double extent() const;

    /// Bytes of what is here.
    std::size_t memory_consumption() const;

    /// From the point of a triangle with given barycentric coordinates to the true surface (length).
    Vector3 offset(const unsigned int triangle, const std::array<double, 3> &weights) const
    {
      return true_shape.offset(mesh, triangle, weights);
    }
  };
} // namespace Signorini

#endif
