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



  void subtract_change(double *const residual, const NodeBlockMatrix &matrix, const unsigned int node,
                       const double *const change)
  {
    if (node >= matrix.n_rows())
      {
        for (auto [coupling, end] = matrix.ghost_column(node - matrix.n_rows()); coupling != end; ++coupling)
          {
            const double *const a = matrix.block(coupling->block);
            double *const       r = residual + dim * static_cast<std::size_t>(coupling->row);
            for (unsigned int c = 0; c < dim; ++c)
              r[c] -= a[dim * c] * change[0] + a[dim * c + 1] * change[1] + a[dim * c + 2] * change[2];
          }
        return;
      }
    for (const BlockRange &range : matrix.stored(node))
      subtract_transposed_blocks(residual, matrix.block_data(), matrix.column_data(), range, change);
    subtract_mirrored_blocks(residual, matrix.mirrored_blocks(node), change);
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
