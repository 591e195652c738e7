// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_normal_projection_h
#define signorini_surface_normal_projection_h

#include <deal.II/base/point.h>

#include <array>

namespace Signorini
{
  /// Kernels of the projection along a continuous, vertexwise linear normal field. Pure functions; what
  /// cannot be computed is a returned status. Distances have the unit of the coordinates.
  namespace NormalProjection
  {
    /// The tolerances of the surface module, relative to the local edge length: a mortar vertex that is
    /// closer than the first to a nonmortar vertex lies at it, closer than the second to a nonmortar edge
    /// lies on it, and a nonmortar vertex closer than the third to a mortar edge lies on it. Vertices are
    /// moved to where they lie. They are decided in this order, each is ten times smaller than the one
    /// before: so a move upsets no side that was told apart before, and what is not at a vertex sees it and
    /// its edges under definite angles. Far above rounding (1e-16), far below what anybody meshes.
    constexpr double vertex_tolerance = 1e-10, on_nonmortar_tolerance = 1e-11, on_mortar_tolerance = 1e-12;

    /// An edge with the normals at its ends.
    struct OrientedEdge
    {
      /// The ends (length).
      dealii::Point<3> a, b;
      /// Normals at the ends; used for mortar edges only.
      dealii::Tensor<1, 3> normal_a, normal_b;
    };

    /// Signed distance of the line through p along n from the line of an edge, seen against n: positive on
    /// the left of a -> b for a viewer to whom n points. `position` is the parameter on the edge.
    double distance_from_edge(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &n,
                              const OrientedEdge &edge, double &position);

    /// Signed distance of a point from the curtain { x(s) + eta n(s) } of a mortar edge, in the same
    /// orientation; `position` is the parameter s of the nearest place.
    double distance_from_curtain(const dealii::Point<3> &v, const OrientedEdge &edge, double &position);

    /// System (10) of the paper: x(s) + eta n(s) = (1 - t) a + t b. s and t hold the starting guess.
    bool intersect_edges(const OrientedEdge &mortar, const OrientedEdge &nonmortar, double &s, double &t);

    /// System (9): v = sum_i w_i (x_i + eta n_i), sum w_i = 1, on a mortar triangle.
    bool inverse_project(std::array<double, 3> &weights, double &eta, const dealii::Point<3> &v,
                         const std::array<dealii::Point<3>, 3>     &corners,
                         const std::array<dealii::Tensor<1, 3>, 3> &normals);

    /// The point p + eta n of a triangle: eta and barycentric coordinates (any sign).
    bool intersect_line(std::array<double, 3> &weights, double &eta, const dealii::Point<3> &p,
                        const dealii::Tensor<1, 3> &n, const std::array<dealii::Point<3>, 3> &corners);
  } // namespace NormalProjection
} // namespace Signorini

#endif
