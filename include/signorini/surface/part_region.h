// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_part_region_h
#define signorini_surface_part_region_h

#include <signorini/surface/surface_mesh.h>

#include <functional>
#include <vector>

namespace Signorini
{
  /// The space around the nonmortar triangles of one part of a mapping (a rank's own faces): a few balls.
  /// What goes on in there is known completely to the part, whatever is left out elsewhere.
  class PartRegion
  {
  public:
    /// @param is_selected the triangles of the part; empty for all of them, then the region is all of space
    PartRegion(const SurfaceMesh &nonmortar, const std::function<bool(const unsigned int)> &is_selected);

    /// Whether nothing is left out.
    bool is_everything() const
    {
      return everything;
    }

    /// Whether a vertex lies in the region, or two vertices lie in the same ball, so that their edge does.
    bool contains(const unsigned int vertex) const;
    bool contains(const unsigned int vertex, const unsigned int other) const;

    /// Whether the curtain over a mortar edge, the points p(s) + eta n(s) with s in [0,1] and any eta, may
    /// meet the region. Never false if it does.
    bool meets_curtain(const dealii::Point<3> &p0, const dealii::Tensor<1, 3> &n0, const dealii::Point<3> &p1,
                       const dealii::Tensor<1, 3> &n1) const;

  private:
    struct Ball
    {
      dealii::Point<3> centre;
      double           radius;

      bool meets_curtain(const dealii::Point<3> &p0, const dealii::Tensor<1, 3> &n0,
                         const dealii::Point<3> &p1, const dealii::Tensor<1, 3> &n1) const;
    };

    /// Balls around the vertices of clusters of triangles.
    static std::vector<Ball> cover(const SurfaceMesh &surface, const std::vector<unsigned int> &triangles);

    bool everything;
    /// The first one contains all others.
    std::vector<Ball> balls;
    /// Bit i of a vertex: whether it lies in ball i + 1.
    std::vector<unsigned short> balls_of_vertex;
  };
} // namespace Signorini

#endif
