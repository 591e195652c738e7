// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_node_partition_h
#define signorini_algebra_node_partition_h

#include <signorini/algebra/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Owned and ghost nodes of a rank, and the layout of vectors with three entries per node.
  ///
  /// Local numbers: owned nodes 0 ... n_owned()-1 in global order, then the ghost nodes in global
  /// order. Every rank owns a contiguous range of global numbers.
  class NodePartition
  {
  public:
    /// Collective. ghosts may contain owned nodes; they are ignored.
    NodePartition(const dealii::IndexSet &owned, const dealii::IndexSet &ghosts, const MPI_Comm communicator);

    /// Number of nodes that this rank owns.
    unsigned int n_owned() const
    {
      return owned_size;
    }

    /// Owned and ghost nodes.
    unsigned int n_local() const
    {
      return owned_size + static_cast<unsigned int>(ghost_list.size());
    }

    /// Number of nodes of all ranks.
    NodeIndex n_global() const
    {
      return rank_begin.back();
    }

    /// The owned nodes are first_owned() ... first_owned() + n_owned() - 1.
    NodeIndex first_owned() const
    {
      return begin;
    }

    /// Whether this rank owns a node.
    bool owns(const NodeIndex node) const
    {
      return node >= begin && node < begin + owned_size;
    }

    /// Local number of a global node, or dealii::numbers::invalid_unsigned_int if it is not here.
    unsigned int to_local(const NodeIndex node) const;

    /// The global number of a local node, owned or ghost.
    NodeIndex to_global(const unsigned int local) const
    {
      return local < owned_size ? begin + local : ghost_list[local - owned_size];
    }

    /// Sorted global numbers of the ghost nodes.
    const std::vector<NodeIndex> &ghosts() const
    {
      return ghost_list;
    }

    /// The rank that owns a node.
    unsigned int owner(const NodeIndex node) const;

    /// The ranks that share the nodes.
    MPI_Comm communicator() const
    {
      return comm;
    }

    /// Number of ranks of the communicator.
    unsigned int n_ranks() const
    {
      return static_cast<unsigned int>(rank_begin.size()) - 1;
    }

    /// Gives a vector the layout of this partition and sets it to zero.
    void reinit(Vector &vector) const
    {
      vector.reinit(dofs);
    }

    /// Local numbers of the owned nodes that are ghosts elsewhere, sorted.
    std::vector<unsigned int> shared_nodes() const;

    /// Local nodes of this rank that another rank has as well.
    struct Neighbour
    {
      /// The other rank, and the local nodes in the order of their global numbers.
      unsigned int              rank;
      std::vector<unsigned int> nodes;
    };

    /// The ranks that have owned nodes of this one as ghosts, and these nodes.
    std::vector<Neighbour> viewers() const;

    /// The ranks that own ghosts of this one, and these ghosts.
    std::vector<Neighbour> owners() const;

  private:
    MPI_Comm                                                   comm;
    NodeIndex                                                  begin;
    unsigned int                                               owned_size;
    std::vector<NodeIndex>                                     ghost_list;
    std::vector<NodeIndex>                                     rank_begin;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs;
  };
} // namespace Signorini

#endif
