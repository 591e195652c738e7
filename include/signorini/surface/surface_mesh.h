// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_surface_mesh_h
#define signorini_surface_surface_mesh_h

#include <signorini/surface/surface_part.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// Surfaces touch where their normals are less than 60 degrees from being opposite: where the cosine is
  /// below this. By a hair less, for 60 degrees are the angle of many bodies, and rounding must not decide of
  /// them.
  constexpr double touching_cosine = -.500001;

  /// A triangulated surface in space as plain arrays. Triangles are oriented: the normal
  /// (b - a) x (c - a) of a triangle (a, b, c) points out of the body.
  struct SurfaceMesh
  {
    /// Points (length), and vertex numbers of the triangles.
    std::vector<dealii::Point<3>>            vertices;
    std::vector<std::array<unsigned int, 3>> triangles;
    /// One unit vector per vertex, pointing out of the body; linear in between. May be left empty:
    /// then compute_vertex_normals() fills it.
    std::vector<dealii::Tensor<1, 3>> vertex_normals;

    /// Vertex normals as normalised, area weighted sum of the normals of the adjacent triangles.
    void compute_vertex_normals();
  };

  /// Triangles, edges and vertices of a triangulated surface and who is next to whom. Plain arrays, sized
  /// once.
  struct SurfaceTopology
  {
    /// No triangle, edge or vertex.
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// Vertex numbers below n_vertices.
    SurfaceTopology(std::vector<std::array<unsigned int, 3>> triangles, const std::size_t n_vertices);

    /// A part of another one. Its edges are edges of the whole, in their order; where the whole goes on the
    /// part has borders.
    /// @param kept_edges edges_of() of the part
    SurfaceTopology(const SurfaceTopology &whole, const SurfacePart &part, const Renumbering &kept_edges);

    /// The edges of some triangles.
    Renumbering edges_of(const Renumbering &some_triangles) const;

    /// Of an edge the local number (corner i to corner i + 1) in one of its triangles.
    unsigned int local_edge(const unsigned int triangle, const unsigned int edge) const
    {
      const auto &e = triangle_edges[triangle];
      return e[0] == edge ? 0 : (e[1] == edge ? 1 : 2);
    }

    /// Of a vertex the number of the corner in one of its triangles.
    unsigned int local_corner(const unsigned int triangle, const unsigned int vertex) const
    {
      const auto &t = triangles[triangle];
      return t[0] == vertex ? 0 : (t[1] == vertex ? 1 : 2);
    }

    /// Whether an edge has a triangle on one side only.
    bool is_border(const unsigned int edge) const
    {
      return edge_triangles[edge][0] == none || edge_triangles[edge][1] == none;
    }

    /// Bytes.
    std::size_t memory_consumption() const
    {
      return list_bytes(triangles) + list_bytes(triangle_edges) + list_bytes(edges) +
             list_bytes(edge_triangles) + list_bytes(fan_start) + list_bytes(fan);
    }

    /// Vertex numbers of the triangles.
    std::vector<std::array<unsigned int, 3>> triangles;
    /// Edge i of a triangle goes from corner i to corner i + 1.
    std::vector<std::array<unsigned int, 3>> triangle_edges;
    /// Ends of an edge, the lower number first.
    std::vector<std::array<unsigned int, 2>> edges;
    /// The triangle that runs through the edge from its lower to its higher vertex (it lies on the left for a
    /// viewer outside of the body) and the one that runs through it the other way; or `none`.
    std::vector<std::array<unsigned int, 2>> edge_triangles;
    /// Triangles around vertex v: fan[fan_start[v]] ... fan[fan_start[v+1]-1].
    std::vector<unsigned int> fan_start, fan;
    /// Triangles that would be the third on an edge or the second on the same side of it: their edge is a
    /// border of its own.
    std::size_t n_conflicts = 0;

  private:
    void make_fans();
    void make_edges();
    /// The edge whose given side is free among those from `first` on; a new one if there is none.
    unsigned int find_edge(const unsigned int low, const unsigned int high, const unsigned int side,
                           const std::size_t first);
  };

  /// The vertices along a space-filling curve (Morton order): neighbours follow soon after each other, so
  /// that what is visited in this order finds its data in the cache.
  std::vector<unsigned int> spatial_order(const SurfaceMesh &mesh);
  /// Any points along such a curve.
  std::vector<unsigned int> spatial_order(const std::vector<dealii::Point<3>> &points);

  /// A place on a surface: at a vertex, on an edge, or inside of a triangle. Decided once and kept, so that
  /// everything that is built on it agrees.
  struct SurfacePoint
  {
    /// On what it lies.
    enum class On : unsigned char
    {
      nothing,
      vertex,
      edge,
      triangle
    };

    /// Number of the vertex, edge or triangle.
    On           on    = On::nothing;
    unsigned int index = SurfaceTopology::none;
    /// On an edge: the parameter from the lower to the higher vertex number (first); in a triangle: the
    /// barycentric coordinates of corners 1 and 2.
    std::array<double, 2> x = {{0., 0.}};

    /// A place at a vertex, on an edge (parameter from the lower to the higher vertex number), in a triangle
    /// (barycentric coordinates; negative ones count as zero).
    static SurfacePoint at_vertex(const unsigned int vertex);
    static SurfacePoint on_edge(const unsigned int edge, const double parameter);
    static SurfacePoint in_triangle(const unsigned int triangle, const std::array<double, 3> &weights);

    /// Whether it lies in a (closed) triangle.
    bool lies_in(const SurfaceTopology &topology, const unsigned int triangle) const;

    /// Its barycentric coordinates in a triangle that it lies in; in [0,1], exactly 0 and 1 at edges and
    /// corners.
    std::array<double, 3> weights_in(const SurfaceTopology &topology, const unsigned int triangle) const;
  };
} // namespace Signorini

#endif
