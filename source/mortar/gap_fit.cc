// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gap_fit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>

namespace Signorini
{
  void GapFit::add(const double weight, const Vector3 &gap, const std::array<double, 4> &phi)
  {
    Basis basis;
    if (n_corners == 3)
      basis << phi[0], phi[1], phi[2], phi[0] * phi[1], phi[1] * phi[2], phi[2] * phi[0];
    else
      {
        const double s = phi[1] + phi[2], t = phi[2] + phi[3];
        basis << phi[0], phi[1], phi[2], phi[3], s * (1. - s), t * (1. - t);
      }
    const Eigen::Vector3d value(gap[0], gap[1], gap[2]);
    gram += weight * basis * basis.transpose();
    right += weight * basis * value.transpose();
    samples.push_back({weight, basis, value});
  }



  GapFit::Values GapFit::fit_with_bubbles() const
  {
    const Eigen::LDLT<Products> factors(gram);
    Values                      fit = factors.solve(right);
    const auto                  k = static_cast<Eigen::Index>(n_corners), m = n - k;
    const Eigen::MatrixXd       mixed   = gram.topRightCorner(k, m);
    const auto                  corners = gram.topLeftCorner(k, k).ldlt();
    const Eigen::MatrixXd among     = gram.bottomRightCorner(m, m) - mixed.transpose() * corners.solve(mixed);
    const double          explained = (fit.bottomRows(m).transpose() * among * fit.bottomRows(m)).trace();
    double                left      = 0.;
    for (const Sample &sample : samples)
      left += sample.weight * (sample.gap - fit.transpose() * sample.basis).squaredNorm();
    fit.bottomRows(m) *= explained > 0. ? explained / (explained + left) : 0.;
    fit.topRows(k) = corners.solve(right.topRows(k) - mixed * fit.bottomRows(m));
    return fit;
  }



  double GapFit::missing(const unsigned int corner, const Values &fit, const Eigen::Vector3d &normal) const
  {
    const Basis along   = fit * normal;
    double      nearest = 0.;
    for (const Sample &sample : samples)
      nearest = std::max(nearest, sample.basis[corner]);
    double least = std::numeric_limits<double>::infinity(), greatest = -least, above = 0., below = 0.;
    for (const Sample &sample : samples)
      {
        const double gap = sample.gap.dot(normal), rest = gap - sample.basis.dot(along);
        above = std::max(above, rest);
        below = std::max(below, -rest);
        if (sample.basis[corner] >= .5 * nearest)
          {
            least    = std::min(least, gap);
            greatest = std::max(greatest, gap);
          }
      }
    const double raise = std::min(above, least - along[corner]),
                 lower = std::min(below, along[corner] - greatest);
    return std::max(0., raise) - std::max(0., lower);
  }



  std::array<Vector3, 4> GapFit::correction(const std::array<Vector3, 4> &normals,
                                            const bool                    has_bubbles) const
  {
    std::array<Vector3, 4> result;
    const auto             k = static_cast<Eigen::Index>(n_corners), m = n - k;
    Values                 fit = Values::Zero(), change = Values::Zero();
    if (has_bubbles)
      fit = fit_with_bubbles();
    else
      fit.topRows(k) = gram.topLeftCorner(k, k).ldlt().solve(right.topRows(k));
    change.bottomRows(m) = -fit.bottomRows(m);
    for (unsigned int a = 0; a < n_corners; ++a)
      {
        const Eigen::Vector3d normal(normals[a][0], normals[a][1], normals[a][2]);
        change.row(a) = missing(a, fit, normal) * normal.transpose();
      }
    const Values moments = gram * change;
    for (unsigned int a = 0; a < n_corners; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        result[a][c] = moments(a, c);
    return result;
  }
} // namespace Signorini
