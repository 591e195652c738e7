// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/rank_colour.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  RankColour colour_rank(const NodePartition &partition)
  {
    std::vector<unsigned int> owners;
    for (const NodePartition::Neighbour &owner : partition.owners())
      owners.push_back(owner.rank);
    const auto                          neighbours = gather_values(owners, partition.communicator());
    std::vector<std::set<unsigned int>> graph(neighbours.size());
    for (unsigned int rank = 0; rank < neighbours.size(); ++rank)
      for (const unsigned int other : neighbours[rank])
        {
          graph[rank].insert(other);
          graph[other].insert(rank);
        }
    std::vector<unsigned int> colours(graph.size());
    for (unsigned int rank = 0; rank < graph.size(); ++rank)
      {
        std::set<unsigned int> taken;
        for (const unsigned int other : graph[rank])
          if (other < rank)
            taken.insert(colours[other]);
        while (taken.count(colours[rank]) > 0)
          ++colours[rank];
      }
    return {colours[Utilities::MPI::this_mpi_process(partition.communicator())],
            *std::max_element(colours.begin(), colours.end()) + 1};
  }
} // namespace Signorini
