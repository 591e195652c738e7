// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/node_partition.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The index set of the three components of every node of a set.
    IndexSet component_set(const NodeIndex n_nodes, const std::vector<NodeIndex> &nodes)
    {
      IndexSet set(dim * n_nodes);
      for (std::size_t i = 0; i < nodes.size();)
        {
          std::size_t j = i + 1;
          while (j < nodes.size() && nodes[j] == nodes[j - 1] + 1)
            ++j;
          set.add_range(dim * nodes[i], dim * (nodes[j - 1] + 1));
          i = j;
        }
      set.compress();
      return set;
    }
  } // namespace



  NodePartition::NodePartition(const IndexSet &owned, const IndexSet &ghosts, const MPI_Comm communicator)
    : comm(communicator)
    , begin(owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0)
    , owned_size(static_cast<unsigned int>(owned.n_elements()))
  {
    Assert(owned.is_contiguous(), ExcMessage("A rank must own a contiguous range of nodes."));
    rank_begin.push_back(0);
    for (const NodeIndex n : gather_values(owned.n_elements(), comm))
      rank_begin.push_back(rank_begin.back() + n);
    begin = rank_begin[Utilities::MPI::this_mpi_process(comm)];

    for (const NodeIndex node : ghosts)
      if (!owns(node))
        ghost_list.push_back(node);

    IndexSet owned_dofs(dim * n_global());
    owned_dofs.add_range(dim * begin, dim * (begin + owned_size));
    dofs = std::make_shared<Utilities::MPI::Partitioner>(owned_dofs, component_set(n_global(), ghost_list),
                                                         comm);
  }



  unsigned int NodePartition::to_local(const NodeIndex node) const
  {
    if (owns(node))
      return static_cast<unsigned int>(node - begin);
    const auto it = std::lower_bound(ghost_list.begin(), ghost_list.end(), node);
    if (it == ghost_list.end() || *it != node)
      return numbers::invalid_unsigned_int;
    return owned_size + static_cast<unsigned int>(it - ghost_list.begin());
  }



  unsigned int NodePartition::owner(const NodeIndex node) const
  {
    return static_cast<unsigned int>(std::upper_bound(rank_begin.begin(), rank_begin.end(), node) -
                                     rank_begin.begin()) -
           1;
  }



  std::vector<unsigned int> NodePartition::shared_nodes() const
  {
    std::vector<unsigned int> nodes;
    for (const Neighbour &viewer : viewers())
      nodes.insert(nodes.end(), viewer.nodes.begin(), viewer.nodes.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }



  std::vector<NodePartition::Neighbour> NodePartition::viewers() const
  {
    // The ranges of all ranks, one rank after the other.
    std::vector<Neighbour> result;
    auto                   range = dofs->import_indices().begin();
    for (const auto &[rank, n_dofs] : dofs->import_targets())
      {
        result.push_back({rank, {}});
        for (std::vector<unsigned int> &nodes = result.back().nodes; dim * nodes.size() < n_dofs; ++range)
          for (unsigned int i = range->first / dim; i < range->second / dim; ++i)
            nodes.push_back(i);
      }
    return result;
  }



  std::vector<NodePartition::Neighbour> NodePartition::owners() const
  {
    std::vector<Neighbour> result;
    unsigned int           ghost = owned_size;
    for (const auto &[rank, n_dofs] : dofs->ghost_targets())
      {
        result.push_back({rank, std::vector<unsigned int>(n_dofs / dim)});
        for (unsigned int &node : result.back().nodes)
          node = ghost++;
      }
    return result;
  }
} // namespace Signorini
