// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_dense_matrix_h
#define signorini_algebra_dense_matrix_h

#include <Eigen/Core>

namespace Signorini
{
  // Eigen's factorizations are compiled here once: each further source that instantiates one takes up to ten
  // seconds.

  /// What a small dense symmetric matrix (n x n) consists of.
  struct SymmetricEigen
  {
    /// Eigenvalues, ascending.
    Eigen::VectorXd values;
    /// Orthonormal eigenvectors, one a column, in the order of the values.
    Eigen::MatrixXd vectors;
  };

  /// Eigenvalues and eigenvectors of a symmetric matrix (n x n, only its lower half is read).
  SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &matrix);

  /// The shortest x (n) among those with the least |A x - b| (A: m x n of any rank, b: m).
  Eigen::VectorXd least_squares(const Eigen::MatrixXd &a, const Eigen::VectorXd &b);

  /// The first @p n_columns of an orthogonal matrix (m x m) whose first columns span what those of A (m x k,
  /// linearly independent) span.
  Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd &a, Eigen::Index n_columns);

  /// The inverse of a regular matrix (n x n).
  Eigen::MatrixXd inverse(const Eigen::MatrixXd &matrix);
} // namespace Signorini

#endif
