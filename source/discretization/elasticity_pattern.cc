// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "elasticity_pattern.h"

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Cell = NodalSpace::Cell;

    /// The nodes of each owned cell after expansion.
    struct CellNodes
    {
      std::vector<std::size_t> start = {0};
      std::vector<NodeIndex>   nodes;
    };

    CellNodes collect_cell_nodes(const NodalSpace &space, const VertexExpansion &expansion)
    {
      CellNodes                          result;
      std::vector<VertexExpansion::Term> terms;
      std::vector<NodeIndex>             list;
      for (const Cell &cell : space.cells())
        if (cell.is_owned)
          {
            const auto vertices = space.nodes(cell);
            if (std::all_of(vertices.begin(), vertices.end(),
                            [&](const NodeIndex n) { return expansion.is_plain(n); }))
              result.nodes.insert(result.nodes.end(), vertices.begin(), vertices.end());
            else
              {
                list.clear();
                for (const NodeIndex vertex : vertices)
                  {
                    expansion.expand(vertex, terms);
                    for (const auto &term : terms)
                      list.push_back(term.node);
                  }
                std::sort(list.begin(), list.end());
                list.erase(std::unique(list.begin(), list.end()), list.end());
                result.nodes.insert(result.nodes.end(), list.begin(), list.end());
              }
            result.start.push_back(result.nodes.size());
          }
      return result;
    }



    /// The cells at each row: of[start[row]] ... of[start[row + 1] - 1].
    struct CellsOfRows
    {
      std::vector<std::size_t>  start;
      std::vector<unsigned int> of;

      /// @param rows of all nodes of all cells
      CellsOfRows(const CellNodes &cells, const std::vector<unsigned int> &rows, const std::size_t n_rows)
        : start(n_rows + 1, 0)
        , of(rows.size())
      {
        for (const unsigned int row : rows)
          ++start[row + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (std::size_t cell = 0; cell + 1 < cells.start.size(); ++cell)
          for (std::size_t k = cells.start[cell]; k < cells.start[cell + 1]; ++k)
            of[next[rows[k]]++] = static_cast<unsigned int>(cell);
      }
    };
  } // namespace



  NodePattern make_pattern(const NodalSpace &space, const VertexExpansion &expansion)
  {
    const CellNodes cells = collect_cell_nodes(space, expansion);
    const IndexSet &owned = space.owned();
    const NodeIndex begin = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    const NodeIndex n     = owned.n_elements();
    NodePattern     pattern;
    for (const NodeIndex node : cells.nodes)
      if (node < begin || node >= begin + n)
        pattern.foreign_rows.push_back(node);
    std::sort(pattern.foreign_rows.begin(), pattern.foreign_rows.end());
    pattern.foreign_rows.erase(std::unique(pattern.foreign_rows.begin(), pattern.foreign_rows.end()),
                               pattern.foreign_rows.end());
    const auto row_of = [&](const NodeIndex node) -> std::size_t {
      if (node >= begin && node < begin + n)
        return node - begin;
      return n + (std::lower_bound(pattern.foreign_rows.begin(), pattern.foreign_rows.end(), node) -
                  pattern.foreign_rows.begin());
    };

    const std::size_t         n_rows = n + pattern.foreign_rows.size();
    std::vector<unsigned int> rows(cells.nodes.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k] = static_cast<unsigned int>(row_of(cells.nodes[k]));
    const CellsOfRows at_row(cells, rows, n_rows);

    std::vector<unsigned int> seen(n_rows, numbers::invalid_unsigned_int);
    pattern.columns.reserve(27 * n_rows);
    for (unsigned int row = 0; row < n_rows; ++row)
      {
        for (std::size_t l = at_row.start[row]; l < at_row.start[row + 1]; ++l)
          for (std::size_t k = cells.start[at_row.of[l]]; k < cells.start[at_row.of[l] + 1]; ++k)
            if (seen[rows[k]] != row)
              {
                seen[rows[k]] = row;
                pattern.columns.push_back(cells.nodes[k]);
              }
        pattern.row_start.push_back(pattern.columns.size());
      }
    return pattern;
  }
} // namespace Signorini
