// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/interface_rows.h>

#include <algorithm>

namespace Signorini
{
  std::vector<NodeIndex> sorted_nodes(std::vector<NodeIndex> nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }



  std::vector<NodeIndex> interface_nodes(const InterfaceCoupling &coupling)
  {
    std::vector<NodeIndex> nodes(coupling.rows);
    for (const auto &entry : coupling.entries)
      nodes.push_back(entry.node);
    return sorted_nodes(std::move(nodes));
  }



  std::vector<std::size_t> owned_rows(const InterfaceCoupling &coupling, const NodePartition &partition)
  {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < coupling.n_rows(); ++row)
      if (partition.owns(coupling.rows[row]))
        rows.push_back(row);
    return rows;
  }



  InterfaceCoupling select_rows(const InterfaceCoupling &coupling, const std::vector<std::size_t> &rows)
  {
    InterfaceCoupling result;
    for (const std::size_t row : rows)
      {
        result.rows.push_back(coupling.rows[row]);
        result.weight.push_back(coupling.weight[row]);
        result.entries.insert(result.entries.end(), coupling.begin(row), coupling.end(row));
        result.row_start.push_back(result.entries.size());
      }
    return result;
  }



  InterfaceCoupling import_rows(const InterfaceCoupling &coupling, const NodeRequest &request)
  {
    // The node itself with its weight, then the entries.
    const auto lists = request.fetch_lists<InterfaceCoupling::Entry>(
        [&](std::vector<InterfaceCoupling::Entry> &list, const unsigned int local) {
          const std::ptrdiff_t row = coupling.find(request.owners().to_global(local));
          if (row < 0)
            return;
          list.push_back({coupling.rows[row], coupling.weight[row]});
          list.insert(list.end(), coupling.begin(row), coupling.end(row));
        });
    InterfaceCoupling result;
    for (std::size_t i = 0; i < request.nodes().size(); ++i)
      if (lists.start[i] < lists.start[i + 1])
        {
          const auto *const first = lists.items.data() + lists.start[i];
          result.rows.push_back(first->node);
          result.weight.push_back(first->weight);
          result.entries.insert(result.entries.end(), first + 1, lists.items.data() + lists.start[i + 1]);
          result.row_start.push_back(result.entries.size());
        }
    return result;
  }
} // namespace Signorini
