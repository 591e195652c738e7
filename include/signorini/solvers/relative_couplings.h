// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_relative_couplings_h
#define signorini_solvers_relative_couplings_h

#include <signorini/algebra/node_block_matrix.h>

#include <vector>

namespace Signorini
{
  /// How strongly rows of different ranks are coupled: the spectral norms of A_ii^-½ A_ij A_jj^-½ (pure
  /// numbers, at most 1) for owned rows i and ghosts j.
  class RelativeCouplings
  {
  public:
    /// Collective. The matrix must outlive the object.
    /// @param inverse_diagonal the inverse diagonal blocks of all owned rows, nine numbers each
    RelativeCouplings(const NodeBlockMatrix &matrix, const double *inverse_diagonal);

    /// Of an owned row and a ghost (counted from 0), whose block is at position `block`.
    double norm(const NodeBlockMatrix::GhostCoupling &coupling, const unsigned int ghost) const;

  private:
    const NodeBlockMatrix &matrix;
    /// Six numbers of A_ii^-½ by local node, zero where no other rank is near.
    Vector diagonal, off_diagonal;
  };
} // namespace Signorini

#endif
