// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_dual_basis_h
#define signorini_mortar_dual_basis_h

#include <array>

namespace Signorini
{
  /// The dual basis on the covered part F_c of one face (doc/algorithm.md, (13)): functions
  /// psi_i = sum_a coefficients[i][a] phi_a for the vertices V that may carry a multiplier, with
  ///   int psi_i phi_j = delta_ij int phi_j  for j in V ,   sum_i psi_i = 1 on F_c.
  struct DualBasis
  {
    /// |V|; the arrays below are filled up to here.
    unsigned int n_functions = 0;
    /// The face's corner that function i belongs to.
    std::array<unsigned int, 4> corner = {};
    /// Combination of all four corner functions.
    std::array<std::array<double, 4>, 4> coefficients = {};
  };

  /// psi_v = psi0_v + rho / |V| with psi0 = diag(d) M_F^-1 phi on V and rho = 1 - sum psi0. The scaled mass
  /// matrix is solved by its eigenvectors; directions below 1e-14 of the largest eigenvalue (slivers) are
  /// left out.
  /// @param mass 4x4 integrals of products of corner functions over F_c (area), row by row
  /// @param in_v which corners are in V; if none, the result has no functions
  DualBasis compute_dual_basis(const std::array<double, 16> &mass, const std::array<bool, 4> &in_v);
} // namespace Signorini

#endif
