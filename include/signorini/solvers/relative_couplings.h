// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_relative_couplings_h
#define signorini_solvers_relative_couplings_h

#include <signorini/algebra/node_block_matrix.h>

#include <vector>

namespace Signorini
{
  /// How strongly rows of different ranks are coupled: bounds of the spectral norms of A_ii^-½ A_ij A_jj^-½
  /// (pure numbers) for owned rows i and ghosts j.
  ///
  /// With Cholesky factors A_ii = C_i C_iᵀ these are the norms of C_i^-1 A_ij C_j^-ᵀ =: B, and
  /// |B|² <= |B|_1 |B|_inf, at most three times too large (B is 3 x 3), without eigenvalues.
  class RelativeCouplings
  {
  public:
    /// Collective. The matrix must outlive the object.
    explicit RelativeCouplings(const NodeBlockMatrix &matrix);

    /// Of an owned row and a ghost (counted from 0), whose block is at position `block`.
    double bound(const NodeBlockMatrix::GhostCoupling &coupling, const unsigned int ghost) const;

  private:
    const NodeBlockMatrix &matrix;
    /// C_i^-1 by local node, diagonal and (1, 0), (2, 0), (2, 1); zero where no other rank is near.
    Vector diagonal, off_diagonal;
  };
} // namespace Signorini

#endif
