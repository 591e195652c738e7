// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_interface_rows_h
#define signorini_algebra_interface_rows_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/node_request.h>

#include <vector>

namespace Signorini
{
  /// Sorted, each once.
  std::vector<NodeIndex> sorted_nodes(std::vector<NodeIndex> nodes);

  /// The nodes of rows and columns, sorted.
  std::vector<NodeIndex> interface_nodes(const InterfaceCoupling &coupling);

  /// The positions of the rows of nodes that a rank owns.
  std::vector<std::size_t> owned_rows(const InterfaceCoupling &coupling, const NodePartition &partition);

  /// Some rows of a coupling, given by their positions.
  InterfaceCoupling select_rows(const InterfaceCoupling &coupling, const std::vector<std::size_t> &rows);

  /// The same of values by row.
  template <typename T>
  std::vector<T> select_values(const std::vector<T> &values, const std::vector<std::size_t> &rows)
  {
    std::vector<T> result;
    for (const std::size_t row : rows)
      result.push_back(values[row]);
    return result;
  }

  /// Collective. The rows of requested nodes, of those that have one.
  /// @param coupling has the rows of the nodes that this rank owns
  InterfaceCoupling import_rows(const InterfaceCoupling &coupling, const NodeRequest &request);

  /// Collective. The values of the rows that import_rows() gives.
  /// @param values by row of `coupling`
  template <typename T>
  std::vector<T> import_row_values(const InterfaceCoupling &coupling, const std::vector<T> &values,
                                   const NodeRequest &request)
  {
    return request
        .fetch_lists<T>([&](std::vector<T> &list, const unsigned int local) {
          if (const std::ptrdiff_t row = coupling.find(request.owners().to_global(local)); row >= 0)
            list.push_back(values[row]);
        })
        .items;
  }
} // namespace Signorini

#endif
