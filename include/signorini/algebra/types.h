// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_types_h
#define signorini_algebra_types_h

#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace Signorini
{
  /// The space dimension. The contact mapping and all kernels are written for 3.
  constexpr unsigned int dim = 3;

  /// A displacement-like field: 3 components per node, entry 3 * node + component.
  /// Locally: owned nodes first, ghost nodes behind (see NodePartition).
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Global number of a node (a mesh vertex that carries 3 displacement components).
  using NodeIndex = dealii::types::global_dof_index;

  constexpr NodeIndex invalid_node = dealii::numbers::invalid_dof_index;

  using Vector3 = dealii::Tensor<1, 3>;
  using Block   = dealii::Tensor<2, 3>;

  /// A block from nine numbers, row by row, and back. (A tensor's own memory may have gaps from deal.II 9.6
  /// on.)
  inline Block read_block(const double *const numbers)
  {
    Block block;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        block[c][d] = numbers[dim * c + d];
    return block;
  }

  inline void write_block(double *const numbers, const Block &block)
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        numbers[dim * c + d] = block[c][d];
  }
} // namespace Signorini

#endif
