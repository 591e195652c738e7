// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_node_exchange_h
#define signorini_algebra_node_exchange_h

#include <signorini/algebra/node_partition.h>

#include <vector>

namespace Signorini
{
  /// Sends the values of some owned nodes to the ranks that have them as ghosts, one message to each, while
  /// the sender goes on with something else.
  class NodeExchange
  {
  public:
    /// Not collective. `is_sent` says of each local node whether it is; the ranks agree on the nodes that
    /// they share.
    NodeExchange(const NodePartition &partition, const std::vector<unsigned char> &is_sent);
    NodeExchange(const NodeExchange &)            = delete;
    NodeExchange &operator=(const NodeExchange &) = delete;

    /// Sends what the owned nodes have now.
    void start(const Vector &v);

    /// Waits for the others, and calls follow(ghost, change) with the three numbers by which a ghost (counted
    /// from 0) is changed here, where it is.
    template <typename Follow>
    void finish(Vector &v, const Follow &follow);

    /// Messages that this rank sends each time.
    std::size_t n_messages() const
    {
      return sent.size();
    }

  private:
    void wait();

    struct Message
    {
      unsigned int              rank;
      std::vector<unsigned int> nodes;
      /// Three numbers a node.
      std::vector<double> values;
    };

    /// Those of the list that are sent at all.
    static std::vector<Message> messages(const std::vector<NodePartition::Neighbour> &neighbours,
                                         const std::vector<unsigned char>            &is_sent);

    MPI_Comm                 communicator;
    unsigned int             n_owned;
    std::vector<Message>     sent, received;
    std::vector<MPI_Request> requests;
  };



  template <typename Follow>
  void NodeExchange::finish(Vector &v, const Follow &follow)
  {
    wait();
    for (const Message &message : received)
      {
        const double *now = message.values.data();
        for (const unsigned int node : message.nodes)
          {
            double *const here        = v.begin() + dim * static_cast<std::size_t>(node);
            const double  change[dim] = {now[0] - here[0], now[1] - here[1], now[2] - here[2]};
            for (unsigned int c = 0; c < dim; ++c)
              here[c] = *now++;
            if (change[0] != 0. || change[1] != 0. || change[2] != 0.)
              follow(node - n_owned, change);
          }
      }
  }
} // namespace Signorini

#endif
