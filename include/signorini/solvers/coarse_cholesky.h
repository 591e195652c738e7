// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_coarse_cholesky_h
#define signorini_solvers_coarse_cholesky_h

#include <signorini/algebra/node_block_matrix.h>

#include <memory>

namespace Signorini
{
  /// Direct solver of level 0 and of active-set steps: sparse factors on rank 0, where the matrix is
  /// gathered.
  class CoarseCholesky
  {
  public:
    /// Which factors.
    enum class Kind
    {
      /// LDLᵀ of Eigen, for levels of a few hundred nodes.
      simplicial,
      /// LLᵀ of CHOLMOD, ordered and in dense blocks, for thousands.
      supernodal
    };

    /// Factorizes nothing yet.
    explicit CoarseCholesky(const Kind kind = Kind::simplicial);
    CoarseCholesky(CoarseCholesky &&) noexcept;
    ~CoarseCholesky();

    /// Collective. Orders matrices of the structure of this one; how many multiplications their factorization
    /// takes, infinity where they cannot be ordered (no memory). Supernodal factors only.
    double cost(const NodeBlockMatrix &matrix);

    /// Collective. Factorizes; the ordering is reused while the structure stays the same.
    /// @param is_nearly_singular whether functions of the level may depend on each other: the factors are
    ///   those of a definite matrix beside it
    void factorize(const NodeBlockMatrix &matrix, const bool is_nearly_singular = false);

    /// Collective. solution = A^-1 rhs.
    void solve(Vector &solution, const Vector &rhs) const;

  private:
    struct Factorization;
    std::unique_ptr<Factorization> factorization;
  };
} // namespace Signorini

#endif
