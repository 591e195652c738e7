// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_algebraic_multigrid_h
#define signorini_algebra_algebraic_multigrid_h

#include <signorini/algebra/node_block_matrix.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// A V-cycle of smoothed aggregation (Trilinos ML): a symmetric preconditioner. The only place that knows
  /// the library.
  class AlgebraicMultigrid
  {
  public:
    AlgebraicMultigrid();
    ~AlgebraicMultigrid();

    /// Collective. near_kernel: vectors whose energy is small everywhere inside (rigid motions), in the
    /// layout of the matrix; empty for translations alone.
    void initialize(const NodeBlockMatrix &matrix, const std::vector<Vector> &near_kernel);

    /// Collective.
    void vmult(Vector &dst, const Vector &src) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };

  /// Collective. Preconditioned conjugate gradients from the given x until the residual norm has fallen by
  /// `tolerance` against that of b, or max_iterations. Returns the number of iterations.
  unsigned int solve_cg(const NodeBlockMatrix &matrix, const AlgebraicMultigrid &preconditioner, Vector &x,
                        const Vector &b, const double tolerance, const unsigned int max_iterations);
} // namespace Signorini

#endif
