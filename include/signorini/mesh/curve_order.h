// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_curve_order_h
#define signorini_mesh_curve_order_h

#include <signorini/mesh/nodal_space.h>

#include <array>
#include <cstdint>
#include <vector>

namespace Signorini
{
  /// The cells and nodes of a space in an order that is the same on any number of ranks: cells along the
  /// space-filling curve by which they are distributed, nodes as these cells come upon them. A rank has a
  /// piece of each list, and the pieces of all ranks one after the other are the lists. Hexahedra and
  /// tetrahedra have lists of their own: [0] and [1].
  class CurveOrder
  {
  public:
    /// Number of lists of each sort.
    static constexpr unsigned int n_kinds = 2;

    /// Collective. The space must outlive the object.
    explicit CurveOrder(const NodalSpace &space);

    /// This rank's piece of the cells of a kind: indices in NodalSpace::cells().
    const std::vector<unsigned int> &cells(const unsigned int kind) const
    {
      return cell_lists[kind];
    }

    /// This rank's piece of the nodes of a kind.
    const std::vector<NodeIndex> &nodes(const unsigned int kind) const
    {
      return node_lists[kind];
    }

    /// The place of the first node of a piece in the list of all ranks.
    std::uint64_t first_node(const unsigned int kind) const
    {
      return first[kind];
    }

    /// Collective. A number that tells this mesh from others: a sum over all nodes of their positions with
    /// weights that depend on their places in the list. Relative to the sum of the absolute values; the same
    /// on any number of ranks but for rounding.
    double trace() const;

  private:
    void check_pieces() const;

    const NodalSpace                              &space;
    std::array<std::vector<unsigned int>, n_kinds> cell_lists;
    std::array<std::vector<NodeIndex>, n_kinds>    node_lists;
    std::array<std::uint64_t, n_kinds>             first;
  };
} // namespace Signorini

#endif
