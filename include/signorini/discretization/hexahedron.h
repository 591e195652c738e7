// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_hexahedron_h
#define signorini_discretization_hexahedron_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/material.h>

#include <deal.II/base/point.h>

#include <array>

namespace Signorini
{
  /// Kernels of the trilinear hexahedron (deal.II's vertex order) with 2x2x2 Gauss points.
  namespace Hexahedron
  {
    /// Corners in deal.II's (lexicographic) order.
    using Corners = std::array<dealii::Point<3>, 8>;

    /// Stiffness of isotropic linear elasticity: blocks[8 * a + b] is the 3x3 block of corners a and b,
    /// nine numbers row by row. Units: E times length. With mean dilatation the change of volume is the mean
    /// over the cell instead of that at each Gauss point (B-bar): no locking where nu is near 0.5.
    /// @return false if the Jacobian is not positive at a Gauss point.
    bool stiffness(std::array<double, 576> &blocks, const Corners &corners, const IsotropicMaterial &material,
                   const bool mean_dilatation = false);

    /// Values of the 8 shape functions at a point of the reference cell.
    std::array<double, 8> shape_values(const dealii::Point<3> &reference);

    /// Gradients of the 8 shape functions in the reference cell.
    std::array<Vector3, 8> reference_gradients(const dealii::Point<3> &reference);

    /// The 8 Gauss points in the reference cell.
    const std::array<dealii::Point<3>, 8> &gauss_points();

    /// Jacobian determinant times weight at a Gauss point, and the point in space.
    std::pair<double, dealii::Point<3>> volume_element(const Corners     &corners,
                                                       const unsigned int gauss_point);

    /// Reference coordinates of a point in space, to rounding. A point of a cell that is not folded is found
    /// inside. Elsewhere there may be several, or none: those found that lie nearest to the cell, or false.
    bool invert_map(dealii::Point<3> &reference, const Corners &corners, const dealii::Point<3> &point);
  } // namespace Hexahedron
} // namespace Signorini

#endif
