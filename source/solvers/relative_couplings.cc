// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/relative_couplings.h>

#include <Eigen/Core>

namespace Signorini
{
  namespace
  {
    using Matrix  = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    using Numbers = Eigen::Map<const Matrix>;

    /// The inverse of the Cholesky factor of a block. Pivots that rounding has left count as nothing: their
    /// rows are zero.
    Matrix inverse_factor(const Numbers &a)
    {
      const auto   inverse_root = [](const double x) { return x > 0. ? 1. / std::sqrt(x) : 0.; };
      const double i0 = inverse_root(a(0, 0)), c10 = a(1, 0) * i0, c20 = a(2, 0) * i0;
      const double i1 = inverse_root(a(1, 1) - c10 * c10), c21 = (a(2, 1) - c20 * c10) * i1;
      const double i2     = inverse_root(a(2, 2) - c20 * c20 - c21 * c21);
      Matrix       result = Matrix::Zero();
      result.diagonal() << i0, i1, i2;
      result(1, 0) = -i1 * c10 * i0;
      result(2, 1) = -i2 * c21 * i1;
      result(2, 0) = -i2 * (c20 * i0 + c21 * result(1, 0));
      return result;
    }

    Matrix read(const Vector &diagonal, const Vector &off_diagonal, const unsigned int node)
    {
      const double *const d = diagonal.begin() + dim * static_cast<std::size_t>(node);
      const double *const o = off_diagonal.begin() + dim * static_cast<std::size_t>(node);
      Matrix              factor;
      factor << d[0], 0., 0., o[0], d[1], 0., o[1], o[2], d[2];
      return factor;
    }
  } // namespace



  RelativeCouplings::RelativeCouplings(const NodeBlockMatrix &matrix)
    : matrix(matrix)
  {
    for (Vector *vector : {&diagonal, &off_diagonal})
      matrix.partition().reinit(*vector);
    for (const unsigned int node : matrix.partition().shared_nodes())
      {
        const std::size_t i      = dim * static_cast<std::size_t>(node);
        const Matrix      factor = inverse_factor(Numbers(matrix.block(matrix.diagonal(node))));
        for (unsigned int c = 0; c < dim; ++c)
          diagonal.local_element(i + c) = factor(c, c);
        off_diagonal.local_element(i)     = factor(1, 0);
        off_diagonal.local_element(i + 1) = factor(2, 0);
        off_diagonal.local_element(i + 2) = factor(2, 1);
      }
    diagonal.update_ghost_values();
    off_diagonal.update_ghost_values();
  }



  double RelativeCouplings::bound(const NodeBlockMatrix::GhostCoupling &coupling,
                                  const unsigned int                    ghost) const
  {
    const Matrix scaled =
        (read(diagonal, off_diagonal, coupling.row) * Numbers(matrix.block(coupling.block)) *
         read(diagonal, off_diagonal, matrix.n_rows() + ghost).transpose())
            .cwiseAbs();
    return std::sqrt(scaled.colwise().sum().maxCoeff() * scaled.rowwise().sum().maxCoeff());
  }
} // namespace Signorini
