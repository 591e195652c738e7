// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_nearest_triangle_h
#define signorini_surface_nearest_triangle_h

#include <signorini/surface/box_tree.h>
#include <signorini/surface/surface_mesh.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// A point of a triangulated surface that belongs to another point.
  struct SurfaceFoot
  {
    /// Where it lies.
    unsigned int triangle = SurfaceTopology::none;
    /// Barycentric coordinates, in [0,1].
    std::array<double, 3> weights = {};
    dealii::Point<3>      point;
  };

  /// The nearest points of some triangles of a surface. Triangles are called by their place in the list.
  class NearestTriangle
  {
  public:
    /// The three corners of a triangle (length).
    using Corners = std::array<dealii::Point<3>, 3>;

    /// The surface must outlive the object.
    NearestTriangle(const SurfaceMesh &mesh, std::vector<unsigned int> triangles);

    /// The point nearest to p; in `found` all triangles whose boxes are as near, and some more.
    SurfaceFoot find(std::vector<unsigned int> &found, const dealii::Point<3> &p) const;

    /// The number in the surface.
    unsigned int triangle(const unsigned int i) const
    {
      return triangles[i];
    }

    /// Its corners.
    Corners corners(const unsigned int i) const;

    /// Search among their boxes.
    const BoxTree &boxes() const
    {
      return tree;
    }

    /// Weights of the point of a triangle that is nearest to p.
    static std::array<double, 3> nearest_weights(const Corners &x, const dealii::Point<3> &p);
    /// How far p is from the box of a triangle (length).
    static double box_distance(const Corners &x, const dealii::Point<3> &p);
    /// The point with some weights.
    static dealii::Point<3> combine(const std::array<double, 3> &weights, const Corners &x);

  private:
    const SurfaceMesh        &mesh;
    std::vector<unsigned int> triangles;
    BoxTree                   tree;
  };
} // namespace Signorini

#endif
