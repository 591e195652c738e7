// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_motion_columns_h
#define signorini_source_application_motion_columns_h

#include <signorini/algebra/dense_matrix.h>

#include <vector>

namespace Signorini
{
  /// Coefficients of the free motions by column; at least one motion.
  inline Eigen::MatrixXd as_columns(const std::vector<std::vector<double>> &motions)
  {
    Eigen::MatrixXd result(motions[0].size(), motions.size());
    for (std::size_t k = 0; k < motions.size(); ++k)
      result.col(k) = Eigen::Map<const Eigen::VectorXd>(motions[k].data(), result.rows());
    return result;
  }
} // namespace Signorini

#endif
