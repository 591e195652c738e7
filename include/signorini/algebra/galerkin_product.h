// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_galerkin_product_h
#define signorini_algebra_galerkin_product_h

#include <signorini/algebra/nodal_transfer.h>
#include <signorini/algebra/node_block_matrix.h>

namespace Signorini
{
  /// The Galerkin product P^T A P of a symmetric matrix, block by block; half of it is computed.
  ///
  /// Collective. Builds the structure of the coarse matrix (independent of the values in A and P)
  /// and localizes P on its partition.
  void reinit_galerkin(NodeBlockMatrix &coarse_matrix, const NodeBlockMatrix &matrix, NodalTransfer &transfer,
                       const dealii::IndexSet &owned_coarse_nodes);

  /// Collective. Computes the values of those coarse rows (local coarse nodes) that are marked; an
  /// empty list means all.
  void compute_galerkin(NodeBlockMatrix &coarse_matrix, const NodeBlockMatrix &matrix,
                        const NodalTransfer              &transfer,
                        const std::vector<unsigned char> &marked_coarse_nodes = {});

  /// Collective. Marks the local coarse nodes whose rows of P^T A P change with the given owned fine rows of
  /// A. If rows of P change, the rows of A that couple to them are to be given as well.
  std::vector<unsigned char> mark_coarse_nodes(const NodalTransfer             &transfer,
                                               const std::vector<unsigned int> &fine_rows);
} // namespace Signorini

#endif
