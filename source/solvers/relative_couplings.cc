// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/relative_couplings.h>

#include <Eigen/Dense>

namespace Signorini
{
  namespace
  {
    using Numbers = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

    /// The symmetric root of a positive block; negative eigenvalues, which are rounding, count as zero.
    Eigen::Matrix3d root(const Numbers &block)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(block);
      const Eigen::Vector3d roots = eigen.eigenvalues().cwiseMax(0.).cwiseSqrt();
      return eigen.eigenvectors() * roots.asDiagonal() * eigen.eigenvectors().transpose();
    }

    Eigen::Matrix3d read(const Vector &diagonal, const Vector &off_diagonal, const unsigned int node)
    {
      const double *const d = diagonal.begin() + dim * static_cast<std::size_t>(node);
      const double *const o = off_diagonal.begin() + dim * static_cast<std::size_t>(node);
      Eigen::Matrix3d     block;
      block << d[0], o[0], o[1], o[0], d[1], o[2], o[1], o[2], d[2];
      return block;
    }
  } // namespace



  RelativeCouplings::RelativeCouplings(const NodeBlockMatrix &matrix, const double *const inverse_diagonal)
    : matrix(matrix)
  {
    for (Vector *vector : {&diagonal, &off_diagonal})
      matrix.partition().reinit(*vector);
    for (const unsigned int node : matrix.partition().shared_nodes())
      {
        const std::size_t     i     = dim * static_cast<std::size_t>(node);
        const Eigen::Matrix3d block = root(Numbers(inverse_diagonal + dim * i));
        for (unsigned int c = 0; c < dim; ++c)
          diagonal.local_element(i + c) = block(c, c);
        off_diagonal.local_element(i)     = block(0, 1);
        off_diagonal.local_element(i + 1) = block(0, 2);
        off_diagonal.local_element(i + 2) = block(1, 2);
      }
    diagonal.update_ghost_values();
    off_diagonal.update_ghost_values();
  }



  double RelativeCouplings::norm(const NodeBlockMatrix::GhostCoupling &coupling,
                                 const unsigned int                    ghost) const
  {
    const Eigen::Matrix3d scaled = read(diagonal, off_diagonal, coupling.row) *
                                   Numbers(matrix.block(coupling.block)) *
                                   read(diagonal, off_diagonal, matrix.n_rows() + ghost);
    // Roots of the largest eigenvalue of its square.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scaled.transpose() * scaled,
                                                               Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0., eigen.eigenvalues()[2]));
  }
} // namespace Signorini
