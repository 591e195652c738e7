// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_boundary_depth_h
#define signorini_surface_boundary_depth_h

#include <signorini/surface/nearest_triangle.h>

#include <vector>

namespace Signorini
{
  /// How deep points lie in a body, by its boundary, or by all of that near them.
  class BoundaryDepth
  {
  public:
    /// Builds a search tree.
    /// @param boundary its triangles; their normals point out of the body
    /// @param triangle_face by triangle, the face of the mesh that it is a part of
    BoundaryDepth(SurfaceMesh boundary, std::vector<unsigned int> triangle_face);
    /// It searches in its own surface.
    BoundaryDepth(const BoundaryDepth &) = delete;

    /// The distance of a point in the body from the boundary, without what facets that stand for a curved
    /// surface may be wrong by; zero outside, and where the boundary ends (length).
    /// @param reach up to which distance from the point the boundary is known
    double operator()(const dealii::Point<3> &p, const double reach) const;

  private:
    std::vector<double>  doubts_of_faces(const std::vector<unsigned int> &triangle_face) const;
    dealii::Tensor<1, 3> normal(const SurfaceFoot &foot) const;
    double               doubt_at(const SurfaceFoot &foot) const;

    const SurfaceMesh     mesh;
    const SurfaceTopology topology;
    /// By triangle.
    std::vector<double>               doubts;
    const NearestTriangle             nearest;
    mutable std::vector<unsigned int> found;
  };
} // namespace Signorini

#endif
