// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_overlay_h
#define signorini_surface_overlay_h

#include <array>
#include <vector>

namespace Signorini
{
  /// One triangle of the overlay of two surfaces. Phi is linear on it: the point with weights w
  /// (w0 + w1 + w2 = 1) of the corners on the nonmortar side is mapped to the point with the same
  /// weights of the corners on the mortar side.
  struct OverlayTriangle
  {
    /// The triangles of either surface in which it lies.
    unsigned int nonmortar_triangle;
    unsigned int mortar_triangle;
    /// Barycentric coordinates (three per corner, sum 1, in [0,1]) of the corners in the nonmortar triangle.
    std::array<std::array<double, 3>, 3> nonmortar;
    /// The same in the mortar triangle.
    std::array<std::array<double, 3>, 3> mortar;

    /// Its part of the area of the nonmortar triangle; negative where the mapping is turned.
    double share() const
    {
      const auto &[a, b, c] = nonmortar;
      return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
    }
  };
} // namespace Signorini

#endif
