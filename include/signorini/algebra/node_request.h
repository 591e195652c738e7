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
      asked        = send_lists(wanted, partition.communicator());
      owners_asked = ranks_of(wanted);
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
      /// As above.
      std::vector<std::size_t> start = {0};
      std::vector<T>           items;
    };

    /// Collective. What append(list, local node) adds to a list on the rank that owns a node.
    template <typename T, typename Append>
    Lists<T> fetch_lists(const Append &append) const
    {
      ListsByRank<char> answers;
      for (const auto &[rank, nodes] : asked)
        {
          std::vector<unsigned int> lengths;
          std::vector<T>            items;
          for (const NodeIndex node : nodes)
            {
              const std::size_t n = items.size();
              append(items, partition.to_local(node));
              lengths.push_back(static_cast<unsigned int>(items.size() - n));
            }
          Parcel parcel;
          parcel.write(lengths);
          parcel.write(items);
          answers[rank] = parcel.bytes();
        }
      // Nodes are sorted, and so are the answers of each rank.
      struct Answer
      {
        std::vector<unsigned int> lengths;
        std::vector<T>            items;
        std::size_t               node = 0, item = 0;
      };
      std::map<unsigned int, Answer> arrived;
      for (const auto &[rank, bytes] : answer_lists(answers, owners_asked, partition.communicator()))
        {
          Parcel parcel(bytes);
          arrived[rank].lengths = parcel.read<unsigned int>();
          arrived[rank].items   = parcel.template read<T>();
        }
      Lists<T> result;
      for (const NodeIndex node : wanted_nodes)
        {
          if (partition.owns(node))
            append(result.items, partition.to_local(node));
          else
            {
              Answer            &answer = arrived.at(partition.owner(node));
              const unsigned int n      = answer.lengths[answer.node++];
              const auto         first  = answer.items.begin() + static_cast<std::ptrdiff_t>(answer.item);
              result.items.insert(result.items.end(), first, first + n);
              answer.item += n;
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
      return fetch_lists<T>(
                 [&](std::vector<T> &list, const unsigned int local) { list.push_back(value(local)); })
          .items;
    }

  private:
    const NodePartition      &partition;
    std::vector<NodeIndex>    wanted_nodes;
    std::vector<unsigned int> owners_asked;
    ListsByRank<NodeIndex>    asked;
  };
} // namespace Signorini

#endif
