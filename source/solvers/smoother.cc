// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/smoother.h>

namespace Signorini
{
  void Smoother::smooth_from_zero(Vector &v, const Vector &rhs, ContactState &contact,
                                  const SmoothingParameters &parameters, Vector &residual)
  {
    v = 0.;
    smooth(v, rhs, contact, parameters, Direction::forward);
    matrix.symmetric_residual(residual, v, rhs);
  }



  void Smoother::smooth_to_residual(Vector &v, const Vector &rhs, ContactState &contact,
                                    const SmoothingParameters &parameters, Vector *const residual)
  {
    smooth(v, rhs, contact, parameters, Direction::backward);
    if (residual != nullptr)
      matrix.symmetric_residual(*residual, v, rhs);
  }



  void subtract_change(double *const residual, const NodeBlockMatrix &matrix, const unsigned int row,
                       const double *const change)
  {
    for (const BlockRange &range : matrix.ranges(row))
      subtract_transposed_blocks(residual, matrix.block_data(), matrix.column_data(), range, change);
  }



  void SmoothingStage::run_with_residual(Vector &v, const Vector &rhs, ContactState &contact,
                                         Vector &residual)
  {
    run_and_follow(v, rhs, contact, Direction::forward,
                   [&](const unsigned int row, const double *const change) {
                     subtract_change(residual.begin(), matrix, row, change);
                   });
  }
} // namespace Signorini
