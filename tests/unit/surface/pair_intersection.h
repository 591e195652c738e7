// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_pair_intersection_h
#define signorini_surface_pair_intersection_h

#include <signorini/surface/normal_projection.h>
#include <signorini/surface/surface_mesh.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// The common part of a nonmortar and a mortar triangle under the contact mapping: a convex polygon in the
  /// nonmortar triangle.
  class PairIntersection
  {
  public:
    /// A corner in barycentric coordinates of both triangles.
    struct Corner
    {
      std::array<double, 3> nonmortar, mortar;
    };

    /// Counterclockwise in the nonmortar triangle; fewer than three corners if there is no common part.
    using Polygon = std::vector<Corner>;

    struct Result
    {
      Polygon             polygon;
      std::array<bool, 3> touches_nonmortar_edge = {{false, false, false}};
      std::array<bool, 3> touches_mortar_edge    = {{false, false, false}};
    };

    /// Both surfaces need vertex normals and must outlive the object.
    PairIntersection(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar);

    Result compute(const unsigned int nonmortar_triangle, const unsigned int mortar_triangle) const;

    /// Whether the line of a mortar vertex hits a nonmortar triangle that faces it.
    bool line_hits(std::array<double, 3> &weights, double &eta, const unsigned int mortar_vertex,
                   const unsigned int triangle) const;

  private:
    /// Side of a vertex with respect to an edge of the other surface (-1, 0, 1) with its distance and the
    /// parameter of the foot on the edge.
    struct Side
    {
      int    sign;
      double distance, position;
    };

    struct PairData;

    NormalProjection::OrientedEdge edge(const SurfaceMesh &mesh, const unsigned int a,
                                        const unsigned int b) const;

    /// Computed for the edge from the lower to the higher vertex number, then turned: all triangles around
    /// get the same numbers.
    Side mortar_vertex_side(const unsigned int vertex, const unsigned int a, const unsigned int b) const;

    Side nonmortar_vertex_side(const unsigned int vertex, const unsigned int a, const unsigned int b) const;

    void add_mortar_vertices(Result &result, const PairData &pair) const;
    void add_nonmortar_vertices(Result &result, const PairData &pair) const;
    void add_crossings(Result &result, const PairData &pair) const;

    const SurfaceMesh &nonmortar, &mortar;
  };
} // namespace Signorini

#endif
