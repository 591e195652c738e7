// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_node_request_h
#define signorini_algebra_node_request_h

#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/sent_lists.h>

#include <vector>

namespace Signorini
{
  /// Asks the ranks that own some nodes for what they know of them.
  class NodeRequest
  {
  public:
    /// Collective. The partition must outlive the object.
    /// @param nodes sorted, each once; every rank has its own list
    NodeRequest(const NodePartition &partition, std::vector<NodeIndex> nodes)
      : partition(partition)
      , wanted_nodes(std::move(nodes))
    {
      ListsByRank<NodeIndex> wanted;
      for (const NodeIndex node : wanted_nodes)
        if (!partition.owns(node))
          wanted[partition.owner(node)].push_back(node);
      asked = send_lists(wanted, partition.communicator());
    }

    /// The nodes of this rank's list.
    const std::vector<NodeIndex> &nodes() const
    {
      return wanted_nodes;
    }

    /// The partition.
    const NodePartition &owners() const
    {
      return partition;
    }

    /// Lists of this rank's nodes, one after the other: that of node i is items[start[i]] ... items[start[i +
    /// 1] - 1].
    template <typename T>
    struct Lists
    {
      std::vector<std::size_t> start = {0};
      std::vector<T>           items;
    };

    /// Collective. What append(list, local node) adds to a list on the rank that owns a node.
    template <typename T, typename Append>
    Lists<T> fetch_lists(const Append &append) const
    {
      ListsByRank<unsigned int> lengths;
      ListsByRank<T>            items;
      for (const auto &[rank, nodes] : asked)
        for (const NodeIndex node : nodes)
          {
            const std::size_t n = items[rank].size();
            append(items[rank], partition.to_local(node));
            lengths[rank].push_back(static_cast<unsigned int>(items[rank].size() - n));
          }
      const auto all_lengths = send_lists(lengths, partition.communicator());
      const auto all_items   = send_lists(items, partition.communicator());
      // Nodes are sorted, and so are the answers of each rank.
      struct Place
      {
        std::size_t node = 0, item = 0;
      };
      std::map<unsigned int, Place> places;
      Lists<T>                      result;
      for (const NodeIndex node : wanted_nodes)
        {
          if (partition.owns(node))
            append(result.items, partition.to_local(node));
          else
            {
              const unsigned int rank  = partition.owner(node);
              Place             &place = places[rank];
              const unsigned int n     = all_lengths.at(rank)[place.node++];
              if (n > 0)
                {
                  const auto first =
                      all_items.at(rank).begin() + static_cast<std::ptrdiff_t>(place.item);
                  result.items.insert(result.items.end(), first, first + n);
                  place.item += n;
                }
            }
          result.start.push_back(result.items.size());
        }
      return result;
    }

    /// Collective. For each node of this rank's list value(local node) on the rank that owns it.
    template <typename Value>
    auto fetch(const Value &value) const
    {
      using T = std::decay_t<decltype(value(0u))>;
      return fetch_lists<T>([&](std::vector<T> &list, const unsigned int local) {
               list.push_back(value(local));
             })
          .items;
    }

  private:
    const NodePartition   &partition;
    std::vector<NodeIndex> wanted_nodes;
    ListsByRank<NodeIndex> asked;
  };
} // namespace Signorini

#endif
