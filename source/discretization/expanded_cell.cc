// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "expanded_cell.h"

#include <algorithm>

namespace Signorini
{
  void ExpandedCell::scatter(LinearSystem &system, const CellData &data, const VertexExpansion &expansion)
  {
    collect(data, expansion, system.matrix.partition());
    const std::size_t n = nodes.size();
    product.assign(data.n() * n * 9, 0.);
    for (unsigned int a = 0; a < data.n(); ++a)
      for (unsigned int b = 0; b < data.n(); ++b)
        for (const auto &[m, term] : terms[b])
          term.add_product(product.data() + 9 * (n * a + m), data.block(a, b));
    find_mirrored(system.matrix);
    result.assign(n * n * 9, 0.);
    load.assign(n, Vector3());
    for (unsigned int a = 0; a < data.n(); ++a)
      for (const auto &[l, term] : terms[a])
        {
          load[l] += term.transposed_product(data.load[a]);
          add_row(l, 0, l + 1, a, term);
          add_row(l, mirrored_end[l], n, a, term);
        }
    add_to(system);
  }


  void ExpandedCell::collect(const CellData &data, const VertexExpansion &expansion,
                             const NodePartition &partition)
  {
    nodes.clear();
    for (unsigned int v = 0; v < data.n(); ++v)
      {
        expansion.expand(data.vertices[v], buffer[v]);
        locals[v].clear();
        for (const auto &term : buffer[v])
          locals[v].push_back(partition.to_local(term.node));
        nodes.insert(nodes.end(), locals[v].begin(), locals[v].end());
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (unsigned int v = 0; v < data.n(); ++v)
      {
        terms[v].clear();
        for (std::size_t k = 0; k < buffer[v].size(); ++k)
          terms[v].emplace_back(std::lower_bound(nodes.begin(), nodes.end(), locals[v][k]) - nodes.begin(),
                                buffer[v][k]);
      }
  }


  void ExpandedCell::find_mirrored(const NodeBlockMatrix &matrix)
  {
    mirrored_end.clear();
    for (std::size_t l = 0; l < nodes.size(); ++l)
      {
        std::size_t end = l + 1;
        while (end < nodes.size() && !matrix.stores(matrix.row_of(nodes[l]), nodes[end]))
          ++end;
        mirrored_end.push_back(end);
      }
  }


  void ExpandedCell::add_row(const std::size_t l, const std::size_t begin, const std::size_t end,
                             const unsigned int a, const Term &term)
  {
    const std::size_t n = nodes.size();
    for (std::size_t m = begin; m < end; ++m)
      term.add_transposed_product(result.data() + 9 * (n * l + m), product.data() + 9 * (n * a + m));
  }


  void ExpandedCell::add_to(LinearSystem &system) const
  {
    for (std::size_t l = 0; l < nodes.size(); ++l)
      {
        const double *const row = result.data() + 9 * nodes.size() * l;
        system.matrix.add_to_row(system.matrix.row_of(nodes[l]), nodes,
                                 [&](const std::size_t m) { return row + 9 * m; });
        for (unsigned int c = 0; c < dim; ++c)
          system.rhs.local_element(dim * static_cast<std::size_t>(nodes[l]) + c) += load[l][c];
      }
  }
} // namespace Signorini
