// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_face_map_h
#define signorini_mortar_face_map_h

#include <signorini/mesh/contact_surface.h>

#include <deal.II/base/point.h>

#include <array>

namespace Signorini
{
  /// A face in space, bilinear quadrilateral or triangle, with the inverse of its map.
  ///
  /// Corner functions must be evaluated at the true reference point: through the affine halves they are wrong
  /// by 1-3 % on faces that are no parallelograms (doc/algorithm.md, chapter 3, moments).
  class FaceMap
  {
  public:
    /// Corners in the order (0,0), (1,0), (1,1), (0,1) of the unit square.
    explicit FaceMap(const std::array<dealii::Point<3>, 4> &corners);

    /// A face of a surface.
    FaceMap(const ContactSurface &surface, const unsigned int face);

    /// The corner functions at a point of the unit square; the fourth of a triangle is zero.
    std::array<double, 4> shape(const double s, const double t) const
    {
      if (triangle)
        return {{1. - s - t, s, t, 0.}};
      return {{(1. - s) * (1. - t), s * (1. - t), s * t, (1. - s) * t}};
    }

    /// Whether the map is affine, to 1e-12 of the diagonals.
    bool is_parallelogram() const
    {
      return parallelogram;
    }

    /// Reference coordinates of the point of the (extended) face that is nearest to p. On entry s and t hold
    /// a starting guess. Returns false for a face that is degenerate there; s and t are then the best known.
    bool invert(double &s, double &t, const dealii::Point<3> &p) const;

  private:
    bool invert_affine(double &s, double &t, const dealii::Tensor<1, 3> &from_origin) const;

    /// The map: origin + s * edge_s + t * edge_t + s * t * twist.
    dealii::Point<3>     origin;
    dealii::Tensor<1, 3> edge_s, edge_t, twist;
    bool                 parallelogram, planar, triangle = false;
    /// For parallelograms: s = dual_s * (p - origin), likewise t; zero for degenerate ones.
    dealii::Tensor<1, 3> dual_s, dual_t;
  };
} // namespace Signorini

#endif
