// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_interface_coupling_h
#define signorini_algebra_interface_coupling_h

#include <signorini/algebra/types.h>

#include <algorithm>
#include <vector>

namespace Signorini
{
  /// The transfer operator S = D^-1 M of all contact pairs, and what belongs to its rows.
  ///
  /// Row k is a node that carries a multiplier (the set K of the nonmortar nodes):
  ///   relative displacement  û_k = u_k - sum_q S_kq u_q .
  /// Columns q are mortar nodes and nonmortar nodes without multiplier (the set R). A column is a row only
  /// where pairs form a chain: S² = 0 without chains, and some power of S is zero. All nodes are conforming:
  /// hanging nodes are resolved. A rank has the rows of the nodes that it owns and of others that it needs,
  /// with all of their entries.
  struct InterfaceCoupling
  {
    /// A node of the other side, or in R, with its weight (pure number).
    struct Entry
    {
      /// The node, and its weight (pure number).
      NodeIndex node;
      double    weight;
    };

    /// Sorted, unique global node numbers of the rows.
    std::vector<NodeIndex> rows;
    /// CSR: entries of row i are entries[row_start[i]] ... entries[row_start[i+1]-1], sorted by node.
    std::vector<std::size_t> row_start = {0};
    /// The entries of all rows, one row after the other.
    std::vector<Entry> entries;
    /// D_kk: integral of the dual basis function (area).
    std::vector<double> weight;

    /// Number of rows: nodes with a multiplier.
    std::size_t n_rows() const
    {
      return rows.size();
    }

    /// Position of a node among the rows, or -1.
    std::ptrdiff_t find(const NodeIndex node) const
    {
      const auto it = std::lower_bound(rows.begin(), rows.end(), node);
      return it != rows.end() && *it == node ? it - rows.begin() : -1;
    }

    /// First entry of a row.
    const Entry *begin(const std::size_t row) const
    {
      return entries.data() + row_start[row];
    }

    /// The entry behind the last one of a row.
    const Entry *end(const std::size_t row) const
    {
      return entries.data() + row_start[row + 1];
    }
  };
} // namespace Signorini

#endif
