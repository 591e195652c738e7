// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mortar/dual_basis.h>

#include <Eigen/Dense>

namespace Signorini
{
  namespace
  {
    using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
    using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;

    /// Pseudo-inverse of a symmetric positive semidefinite matrix, scaled to a unit diagonal first.
    SmallMatrix scaled_inverse(const SmallMatrix &matrix)
    {
      const Eigen::Index n = matrix.rows();
      SmallVector        scale(n);
      for (Eigen::Index i = 0; i < n; ++i)
        scale[i] = matrix(i, i) > 0. ? 1. / std::sqrt(matrix(i, i)) : 0.;
      const SmallMatrix scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
      const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(scaled);
      SmallVector                                      inverse  = eigen.eigenvalues();
      const double                                     smallest = 1e-14 * inverse[n - 1];
      for (Eigen::Index i = 0; i < n; ++i)
        inverse[i] = inverse[i] > smallest ? 1. / inverse[i] : 0.;
      const SmallMatrix vectors = scale.asDiagonal() * eigen.eigenvectors();
      return vectors * inverse.asDiagonal() * vectors.transpose();
    }
  } // namespace



  DualBasis compute_dual_basis(const std::array<double, 16> &mass, const std::array<bool, 4> &in_v)
  {
    DualBasis basis;
    for (unsigned int a = 0; a < 4; ++a)
      if (in_v[a])
        basis.corner[basis.n_functions++] = a;
    const unsigned int n = basis.n_functions;
    if (n == 0)
      return basis;

    SmallMatrix m(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        m(i, j) = mass[4 * basis.corner[i] + basis.corner[j]];
    const SmallMatrix inverse = scaled_inverse(m);
    for (unsigned int i = 0; i < n; ++i)
      {
        // The corner functions sum up to one: int phi_i is a row sum.
        double d = 0.;
        for (unsigned int b = 0; b < 4; ++b)
          d += mass[4 * basis.corner[i] + b];
        for (unsigned int j = 0; j < n; ++j)
          basis.coefficients[i][basis.corner[j]] = d * inverse(i, j);
      }
    for (unsigned int a = 0; a < 4; ++a)
      {
        double rho = 1.;
        for (unsigned int i = 0; i < n; ++i)
          rho -= basis.coefficients[i][a];
        for (unsigned int i = 0; i < n; ++i)
          basis.coefficients[i][a] += rho / n;
      }
    return basis;
  }
} // namespace Signorini
