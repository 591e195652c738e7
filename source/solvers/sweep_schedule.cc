// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/replicated_data.h>
#include <signorini/solvers/sweep_schedule.h>

namespace Signorini
{
  namespace
  {
    std::vector<SweepSchedule::Item> items_of_rows(const NodePhases                &phases,
                                                   const std::vector<unsigned int> &rows)
    {
      std::vector<SweepSchedule::Item> items;
      items.reserve(rows.size());
      for (const unsigned int row : rows)
        items.push_back({row, phases[row], phases.is_shared(row)});
      return items;
    }

    /// Collective. Bit phases[i] for the rows of a list and the ghosts that are such rows elsewhere.
    std::vector<unsigned char> phases_of_rows(const NodePartition &partition, const NodePhases &phases,
                                              const std::vector<unsigned int> &rows)
    {
      if (partition.n_ranks() == 1)
        return {};
      std::vector<unsigned char> is_visited(partition.n_local(), 0);
      for (const unsigned int row : rows)
        is_visited[row] = 1;
      import_ghost_flags(partition, is_visited);
      for (unsigned int node = 0; node < partition.n_local(); ++node)
        if (is_visited[node])
          is_visited[node] = static_cast<unsigned char>(1u << phases[node]);
      return is_visited;
    }
  } // namespace



  SweepSchedule::SweepSchedule(const NodePartition &partition, const NodePhases &phases,
                               const std::vector<unsigned int> &rows)
    : SweepSchedule(partition, phases.size(), items_of_rows(phases, rows),
                    phases_of_rows(partition, phases, rows))
  {
  }



  SweepSchedule::SweepSchedule(const NodePartition &partition, const unsigned int n_phases,
                               const std::vector<Item> &all, const std::vector<unsigned char> &phases_of_node)
  {
    items.reserve(all.size());
    ranges.clear();
    for (unsigned int phase = 0; phase < n_phases; ++phase)
      {
        Phase range = {items.size(), 0, 0};
        for (const bool is_border : {true, false})
          {
            for (const Item &item : all)
              if (item.phase == phase && item.is_border == is_border)
                items.push_back(item.number);
            (is_border ? range.border_end : range.end) = items.size();
          }
        ranges.push_back(range);
        if (partition.n_ranks() == 1)
          continue;
        std::vector<unsigned char> is_sent(phases_of_node);
        for (unsigned char &flags : is_sent)
          flags &= 1u << phase;
        exchanges.push_back(std::make_shared<NodeExchange>(partition, is_sent));
      }
  }



  std::size_t SweepSchedule::n_messages() const
  {
    std::size_t n = 0;
    for (const auto &exchange : exchanges)
      n += exchange->n_messages();
    return n;
  }
} // namespace Signorini
