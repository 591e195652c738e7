// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/checked_count.h>
#include <signorini/algebra/node_exchange.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  namespace
  {
    /// Not used by deal.II on the same communicator. Messages of one rank to another arrive in the order in
    /// which they are sent, and all ranks go through their exchanges in the same order.
    constexpr int tag = 24107;
  } // namespace



  NodeExchange::NodeExchange(const NodePartition &partition, const std::vector<unsigned char> &is_sent)
    : communicator(partition.communicator())
    , n_owned(partition.n_owned())
    , sent(messages(partition.viewers(), is_sent))
    , received(messages(partition.owners(), is_sent))
    , requests(sent.size() + received.size(), MPI_REQUEST_NULL)
  {
  }



  std::vector<NodeExchange::Message>
  NodeExchange::messages(const std::vector<NodePartition::Neighbour> &neighbours,
                         const std::vector<unsigned char>            &is_sent)
  {
    std::vector<Message> result;
    for (const NodePartition::Neighbour &neighbour : neighbours)
      {
        Message message{neighbour.rank, {}, {}};
        for (const unsigned int node : neighbour.nodes)
          if (is_sent[node])
            message.nodes.push_back(node);
        message.values.resize(dim * message.nodes.size());
        if (!message.nodes.empty())
          result.push_back(std::move(message));
      }
    return result;
  }



  void NodeExchange::start(const Vector &v)
  {
    MPI_Request *request = requests.data();
    for (Message &message : received)
      MPI_Irecv(message.values.data(), checked_count(message.values.size(), "numbers of a message"),
                MPI_DOUBLE, static_cast<int>(message.rank), tag, communicator, request++);
    for (Message &message : sent)
      {
        double *value = message.values.data();
        for (const unsigned int node : message.nodes)
          for (unsigned int c = 0; c < dim; ++c)
            *value++ = v.local_element(dim * node + c);
        MPI_Isend(message.values.data(), checked_count(message.values.size(), "numbers of a message"),
                  MPI_DOUBLE, static_cast<int>(message.rank), tag, communicator, request++);
      }
  }



  void NodeExchange::wait()
  {
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace Signorini
