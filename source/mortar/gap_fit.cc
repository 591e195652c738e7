// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gap_fit.h"

#include <Eigen/Cholesky>

namespace Signorini
{
  void GapFit::add(const double weight, const Vector3 &gap, const std::array<double, 4> &phi)
  {
    Eigen::Matrix<double, n, 1> basis;
    if (n_corners == 3)
      basis << phi[0], phi[1], phi[2], phi[0] * phi[1], phi[1] * phi[2], phi[2] * phi[0];
    else
      {
        const double s = phi[1] + phi[2], t = phi[2] + phi[3];
        basis << phi[0], phi[1], phi[2], phi[3], s * (1. - s), t * (1. - t);
      }
    const Eigen::Matrix<double, 1, dim> value(gap[0], gap[1], gap[2]);
    gram += weight * basis * basis.transpose();
    right += weight * basis * value;
    square += weight * value.squaredNorm();
  }



  std::array<Vector3, 4> GapFit::bubble_moments() const
  {
    std::array<Vector3, 4>      result;
    const Eigen::LDLT<Products> factors(gram);
    const Values                fit = factors.solve(right);
    const auto                  k = static_cast<Eigen::Index>(n_corners), m = n - k;
    const Eigen::MatrixXd       bubbles = fit.bottomRows(m), mixed = gram.topRightCorner(k, m);
    const Eigen::MatrixXd       among =
        gram.bottomRightCorner(m, m) - mixed.transpose() * gram.topLeftCorner(k, k).ldlt().solve(mixed);
    const double explained = (bubbles.transpose() * among * bubbles).trace();
    const double left      = std::max(0., square - (right.transpose() * fit).trace());
    if (!(explained > 0.))
      return result;
    const Eigen::MatrixXd moments = explained / (explained + left) * mixed * bubbles;
    for (unsigned int a = 0; a < n_corners; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        result[a][c] = moments(a, c);
    return result;
  }
} // namespace Signorini
