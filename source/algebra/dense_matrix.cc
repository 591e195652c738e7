// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>

#include <Eigen/Dense>

namespace Signorini
{
  SymmetricEigen symmetric_eigen(const Eigen::MatrixXd &matrix)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    return {eigen.eigenvalues(), eigen.eigenvectors()};
  }



  Eigen::VectorXd least_squares(const Eigen::MatrixXd &a, const Eigen::VectorXd &b)
  {
    return a.completeOrthogonalDecomposition().solve(b);
  }



  Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd &a, const Eigen::Index n_columns)
  {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
    return qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), n_columns);
  }



  Eigen::MatrixXd inverse(const Eigen::MatrixXd &matrix)
  {
    return matrix.inverse();
  }
} // namespace Signorini
