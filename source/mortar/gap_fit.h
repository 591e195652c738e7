// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_gap_fit_h
#define signorini_source_mortar_gap_fit_h

#include <signorini/algebra/types.h>

#include <Eigen/Core>

#include <array>
#include <vector>

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

    /// What the products of the corner functions with the gap (area * length) must change by to be those of
    /// the gap that linear elements can follow (doc/algorithm.md, (17a) and (17b)): without bubbles, and at
    /// corners not outside the range of the gap beside them along their normals.
    /// @param has_bubbles false where too little of the face is covered to tell
    std::array<Vector3, 4> correction(const std::array<Vector3, 4> &normals, const bool has_bubbles) const;

  private:
    /// Three or four corner functions and three or two bubbles.
    static constexpr int n = 6;
    using Basis            = Eigen::Matrix<double, n, 1>;
    using Products         = Eigen::Matrix<double, n, n>;
    using Values           = Eigen::Matrix<double, n, dim>;

    struct Sample
    {
      double          weight;
      Basis           basis;
      Eigen::Vector3d gap;
    };

    /// Bubbles times the part of what is no corner function that they account for: of a smooth gap all, of a
    /// rough one little. The corner functions that are left of the gap without them.
    Values fit_with_bubbles() const;

    /// What the fit lacks at a corner to be within the range that the gap has in the half of the face around
    /// it, along a unit normal; no more than the fit is wrong by anywhere, so that linear gaps are what they
    /// are where the corner is not covered.
    double missing(const unsigned int corner, const Values &fit, const Eigen::Vector3d &normal) const;

    const unsigned int  n_corners;
    Products            gram  = Products::Zero();
    Values              right = Values::Zero();
    std::vector<Sample> samples;
  };
} // namespace Signorini

#endif
