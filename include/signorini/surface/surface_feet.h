// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_surface_feet_h
#define signorini_surface_surface_feet_h

#include <signorini/surface/nearest_triangle.h>

#include <vector>

namespace Signorini
{
  /// The points of a triangulated surface that belong to points near it: along its continuous normals, as in
  /// the contact mapping (system (9) of the paper), so that neighbours stay neighbours; where no normal meets
  /// a point, the nearest one.
  class SurfaceFeet
  {
  public:
    /// The point that belongs to another one.
    using Foot = SurfaceFoot;

    /// Unit normals at the corners of a triangle.
    using CornerNormals = std::array<dealii::Tensor<1, 3>, 3>;

    /// The surface must outlive the object.
    /// @param triangles those that feet may lie in
    /// @param normals unit normals at their corners
    SurfaceFeet(const SurfaceMesh &mesh, std::vector<unsigned int> triangles,
                std::vector<CornerNormals> normals);

    /// The foot of a point.
    Foot find(const dealii::Point<3> &p) const;

    /// The normal of the surface at the foot of a point (unit length). Where several triangles are equally
    /// near, at creases, that of the one that faces `facing` most.
    dealii::Tensor<1, 3> normal(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &facing) const;

    /// The triangle near p that faces `facing` (any length): of those about as near as the nearest one that
    /// face there about as well as any of them, the nearest.
    unsigned int facing(const dealii::Point<3> &p, const dealii::Tensor<1, 3> &facing) const;

  private:
    NearestTriangle            triangles;
    std::vector<CornerNormals> normals;
  };
} // namespace Signorini

#endif
