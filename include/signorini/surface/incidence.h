// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_incidence_h
#define signorini_surface_incidence_h

#include <signorini/surface/surface_mesh.h>

#include <vector>

namespace Signorini
{
  /// On which side of an edge of one surface a vertex of the other lies: left, right, or on it. A function of
  /// that vertex and that edge alone, so that all triangles around agree.
  ///
  /// What is found to lie at a vertex or on an edge is moved there, by less than the tolerance, and counts
  /// with its new position from then on: later decisions agree with earlier ones to rounding, which is far
  /// below the tolerance.
  ///
  /// All sides are those of a viewer outside of the nonmortar body.
  class Incidence
  {
  public:
    /// Where a vertex lies beside an edge.
    struct Side
    {
      /// 1 on the left of the edge from its lower to its higher vertex number, -1 on the right, 0 on it.
      int sign;
      /// The signed distance, and the parameter of the foot on the edge (0 at the lower vertex).
      double distance, position;
    };

    /// Copies the surfaces; the topologies must outlive the object.
    Incidence(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
              const SurfaceTopology &nonmortar_topology, const SurfaceTopology &mortar_topology);

    /// Of a mortar vertex, seen along its normal.
    Side of_mortar_vertex(const unsigned int vertex, const unsigned int nonmortar_edge) const;

    /// Of a nonmortar vertex, with respect to the curtain that the normals along a mortar edge span.
    Side of_nonmortar_vertex(const unsigned int vertex, const unsigned int mortar_edge) const;

    /// System (10) of the paper: the parameters where the image of a mortar edge crosses a nonmortar edge
    /// (t on the nonmortar, s on the mortar edge), between given sides of the ends. In [0,1]; false if the
    /// edges do not cross.
    bool cross(double &t, double &s, const unsigned int nonmortar_edge, const unsigned int mortar_edge,
               const Side &low_end, const Side &high_end) const;

    /// A solution of system (10).
    struct Crossing
    {
      /// Parameters on the nonmortar and on the mortar edge.
      double t, s;
      /// Whether the lower vertex of the nonmortar edge lies left (1) or right (-1) of the mortar edge there.
      int low_side;
    };

    /// So close to an end of an edge, as a part of it, rounding could tell a crossing from none otherwise
    /// than the side of the end does.
    static constexpr double near_end = 1e-6;

    /// All solutions of system (10) with t and s in [0,1] or less than near_end outside, by ascending s: at
    /// most two. In closed form.
    std::vector<Crossing> all_crossings(const unsigned int nonmortar_edge,
                                        const unsigned int mortar_edge) const;

    /// Surfaces that can touch face each other: the cosine of their normals is below this.
    static constexpr double facing_cosine = -.1;

    /// Whether a mortar vertex, or a point of a mortar edge, and a nonmortar triangle, or two triangles, face
    /// each other.
    bool faces(const unsigned int nonmortar_triangle, const dealii::Tensor<1, 3> &mortar_direction) const;
    bool vertex_faces(const unsigned int mortar_vertex, const unsigned int nonmortar_triangle) const;
    bool edge_faces(const unsigned int mortar_edge, const double s,
                    const unsigned int nonmortar_triangle) const;
    bool triangles_face(const unsigned int nonmortar_triangle, const unsigned int mortar_triangle) const;

    /// Whether the normals of two triangles are more than 60 degrees from being opposite to each other:
    /// bodies that touch there would overlap beside it.
    bool triangles_turn_away(const unsigned int nonmortar_triangle, const unsigned int mortar_triangle) const;

    /// Whether a nonmortar triangle faces the normal at a point of a mortar triangle.
    bool point_faces(const unsigned int nonmortar_triangle, const unsigned int mortar_triangle,
                     const SurfacePoint &mortar_point) const;

    /// Whether the line of a mortar vertex passes a nonmortar vertex within the tolerance.
    bool is_at(const unsigned int mortar_vertex, const unsigned int nonmortar_vertex) const;

    /// Length of the shortest edge there.
    double size_at_mortar_vertex(const unsigned int vertex) const
    {
      return mortar_size[vertex];
    }

    /// Moves a mortar vertex so that its line meets a point of the nonmortar surface.
    void move_mortar_vertex(const unsigned int vertex, const dealii::Point<3> &image);

    /// Moves a nonmortar vertex onto the curtain of a mortar edge, at a parameter.
    void move_nonmortar_vertex(const unsigned int vertex, const unsigned int mortar_edge, const double s);

    /// The surfaces, with the positions as moved, in coordinates from the middle of the nonmortar surface.
    SurfaceMesh            nonmortar, mortar;
    const SurfaceTopology &nonmortar_topology, &mortar_topology;
    /// Normals of the triangles as they came, as long as their area.
    const std::vector<dealii::Tensor<1, 3>> nonmortar_normal, mortar_normal;

  private:
    /// Length of the shortest edge at each vertex: what the tolerance is relative to.
    std::vector<double> nonmortar_size, mortar_size;
  };
} // namespace Signorini

#endif
