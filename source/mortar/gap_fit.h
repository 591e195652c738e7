// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_gap_fit_h
#define signorini_source_mortar_gap_fit_h

#include <signorini/algebra/types.h>

#include <Eigen/Core>

#include <array>

namespace Signorini
{
  /// The gap over a face as corner functions and bubbles that vanish at the corners, fitted to its values.
  class GapFit
  {
  public:
    /// @param n_corners of the face
    explicit GapFit(const unsigned int n_corners)
      : n_corners(n_corners)
    {
    }

    /// Adds a point.
    /// @param weight of it (area)
    /// @param phi the corner functions there
    void add(const double weight, const Vector3 &gap, const std::array<double, 4> &phi);

    /// Products of the corner functions with the bubbles of the gap (area * length), times the part of what
    /// is no corner function that these bubbles account for: of a smooth gap all, of a rough one little.
    std::array<Vector3, 4> bubble_moments() const;

  private:
    /// Three or four corner functions and three or two bubbles.
    static constexpr int n = 6;
    using Products         = Eigen::Matrix<double, n, n>;
    using Values           = Eigen::Matrix<double, n, dim>;

    const unsigned int n_corners;
    Products           gram   = Products::Zero();
    Values             right  = Values::Zero();
    double             square = 0.;
  };
} // namespace Signorini

#endif
