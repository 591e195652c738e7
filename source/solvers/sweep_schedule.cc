// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_schedule.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Greedy colouring of the ranks; neighbours share ghost nodes.
    std::vector<unsigned int> colour_ranks(const NodePartition &partition)
    {
      std::set<unsigned int> owners;
      for (const NodeIndex ghost : partition.ghosts())
        owners.insert(partition.owner(ghost));
      const auto neighbours = Utilities::MPI::all_gather(
          partition.communicator(), std::vector<unsigned int>(owners.begin(), owners.end()));
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
      return colours;
    }
  } // namespace



  SweepSchedule::SweepSchedule(const NodePartition &partition)
  {
    if (partition.n_ranks() == 1)
      {
        rows.resize(1, std::vector<unsigned int>(partition.n_owned()));
        std::iota(rows[0].begin(), rows[0].end(), 0u);
        return;
      }
    const std::vector<unsigned int> colours = colour_ranks(partition);
    rows.resize(*std::max_element(colours.begin(), colours.end()) + 2);

    std::vector<bool> is_shared(partition.n_owned(), false);
    for (const unsigned int node : partition.shared_nodes())
      is_shared[node] = true;
    // Nodes that see ghosts without being seen would race with their neighbours as well; with a
    // symmetric matrix structure there are none.
    auto &shared = rows[colours[Utilities::MPI::this_mpi_process(partition.communicator())]];
    for (unsigned int node = 0; node < partition.n_owned(); ++node)
      (is_shared[node] ? shared : rows.back()).push_back(node);
  }



  SweepSchedule SweepSchedule::subset(const std::vector<unsigned int> &nodes) const
  {
    const std::set<unsigned int> wanted(nodes.begin(), nodes.end());
    SweepSchedule                result;
    result.rows.resize(rows.size());
    for (std::size_t phase = 0; phase < rows.size(); ++phase)
      std::set_intersection(rows[phase].begin(), rows[phase].end(), wanted.begin(), wanted.end(),
                            std::back_inserter(result.rows[phase]));
    return result;
  }
} // namespace Signorini
