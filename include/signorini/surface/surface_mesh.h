// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_surface_mesh_h
#define signorini_surface_surface_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// A triangulated surface in space as plain arrays. Triangles are oriented: the normal
  /// (b - a) x (c - a) of a triangle (a, b, c) points out of the body.
  struct SurfaceMesh
  {
    std::vector<dealii::Point<3>>            vertices;
    std::vector<std::array<unsigned int, 3>> triangles;
    /// One unit vector per vertex, pointing out of the body; linear in between. May be left empty:
    /// then compute_vertex_normals() fills it.
    std::vector<dealii::Tensor<1, 3>> vertex_normals;

    /// Vertex normals as normalised, area weighted sum of the normals of the adjacent triangles.
    void compute_vertex_normals();
  };

  /// Who is next to whom on a triangulated surface.
  struct SurfaceTopology
  {
    explicit SurfaceTopology(const SurfaceMesh &mesh);

    /// Per triangle and edge (corner i to corner i + 1) the triangle behind that edge, or -1.
    std::vector<std::array<int, 3>> neighbours;
    /// Triangles around vertex v: fan[fan_start[v]] ... fan[fan_start[v+1]-1].
    std::vector<unsigned int> fan_start, fan;
  };
} // namespace Signorini

#endif
