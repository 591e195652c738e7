// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_invariant_products_h
#define signorini_solvers_invariant_products_h

#include <signorini/algebra/node_block_matrix.h>

namespace Signorini
{
  /// Products with a matrix A', to which rigid motions m cost nothing, from those with A. Ties of surfaces
  /// with a gap between them, such as curved ones on meshes that do not match, couple points that rotations
  /// move differently, so that A m is not zero: A would hold bodies that nothing holds. With the opposed
  /// motions M and E = Mᵀ A M,
  ///   A' = A - A M E⁻¹ (A M)ᵀ,   vᵀ A' v = min over theta of (v - M theta)ᵀ A (v - M theta):
  /// the energy of what is left of v without its rigid motion. Without such ties A' = A.
  class InvariantProducts
  {
  public:
    /// When a motion counts as opposed.
    struct Rule
    {
      /// The energy of an opposed motion, relative to that if no two nodes moved together: more than
      /// rounding.
      double opposed = 1e-14;
    };

    /// A' = A.
    InvariantProducts() = default;

    /// Collective.
    /// @param motions orthonormal
    InvariantProducts(const NodeBlockMatrix &matrix, const std::vector<Vector> &motions);

    /// Collective. Makes A' v of A v.
    void correct_product(Vector &product) const;

    /// Collective. Makes rhs - A' v of rhs - A v.
    void correct_residual(Vector &residual, const Vector &rhs) const;

    /// The opposed motions: combinations of those given, orthonormal.
    const std::vector<Vector> &opposed_motions() const
    {
      return opposed;
    }

    /// Collective. The coefficients theta of the opposed motions in a vector.
    std::vector<double> coefficients(const Vector &v) const;

  private:
    std::vector<Vector> opposed;
    /// A M E⁻¹; the scalar products with the opposed motions are 1 and 0.
    std::vector<Vector> forces;
  };
} // namespace Signorini

#endif
