// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/mesh/curve_order.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Coarse cell, and the path of children with all levels that a path can have: leaves compare as they
    /// come along the curve.
    std::array<std::uint64_t, 2> place_on_curve(const NodalSpace::Cell &cell)
    {
      constexpr unsigned int deepest = 21;
      unsigned int           depth   = 0;
      while (cell.path >> 3 * depth > 1)
        ++depth;
      const std::uint64_t children = cell.path - (std::uint64_t(1) << 3 * depth);
      return {{cell.coarse_cell, children << 3 * (deepest - depth)}};
    }

    unsigned int kind_of(const NodalSpace::Cell &cell)
    {
      return cell.n_vertices == CellShape::hexahedron ? 0 : 1;
    }

    /// Uniform in [-1, 1], from the place of a node in a list.
    double weight(const std::uint64_t place, const unsigned int component)
    {
      std::uint64_t h = (3 * place + component + 1) * 0x9e3779b97f4a7c15ull;
      h               = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ull;
      h               = (h ^ h >> 27) * 0x94d049bb133111ebull;
      return static_cast<double>((h ^ h >> 31) >> 11) / static_cast<double>(std::uint64_t(1) << 52) - 1.;
    }
  } // namespace



  CurveOrder::CurveOrder(const NodalSpace &space)
    : space(space)
  {
    const auto &cells = space.cells();
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (cells[c].is_owned)
        cell_lists[kind_of(cells[c])].push_back(c);
    const NodeIndex   n_owned = space.owned().n_elements();
    const NodeIndex   begin   = n_owned > 0 ? space.owned().nth_index_in_set(0) : 0;
    std::vector<bool> is_listed(n_owned, false);
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
      {
        std::sort(cell_lists[kind].begin(), cell_lists[kind].end(),
                  [&](const unsigned int a, const unsigned int b) {
                    return place_on_curve(cells[a]) < place_on_curve(cells[b]);
                  });
        for (const unsigned int c : cell_lists[kind])
          for (const NodeIndex node : space.nodes(cells[c]))
            if (node >= begin && node < begin + n_owned && !is_listed[node - begin])
              {
                is_listed[node - begin] = true;
                node_lists[kind].push_back(node);
              }
        const auto counts =
            gather_values(static_cast<std::uint64_t>(node_lists[kind].size()), space.communicator());
        first[kind] = 0;
        for (unsigned int r = 0; r < Utilities::MPI::this_mpi_process(space.communicator()); ++r)
          first[kind] += counts[r];
      }
    check_pieces();
  }



  void CurveOrder::check_pieces() const
  {
    AssertThrow(node_lists[0].size() + node_lists[1].size() == space.owned().n_elements(),
                ExcMessage("A rank owns a node of which it has no cell."));
    using Place = std::array<std::uint64_t, 2>;
    std::vector<Place> ends;
    for (const std::vector<unsigned int> &list : cell_lists)
      for (unsigned int i = 0; i < 2; ++i)
        ends.push_back(list.empty() ? Place{{1, 0}}
                                    : place_on_curve(space.cells()[i == 0 ? list.front() : list.back()]));
    // Whether there are cells, which an end alone does not tell.
    for (const std::vector<unsigned int> &list : cell_lists)
      ends.push_back({{list.empty() ? 0u : 1u, 0}});
    const auto all = gather_values(ends, space.communicator());
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
      {
        const Place *last = nullptr;
        for (const std::vector<Place> &rank : all)
          if (rank[2 * n_kinds + kind][0] != 0)
            {
              AssertThrow(last == nullptr || *last < rank[2 * kind],
                          ExcMessage("Cells are not distributed along their curve."));
              last = &rank[2 * kind + 1];
            }
      }
  }



  double CurveOrder::trace() const
  {
    std::vector<double> sums(2, 0.);
    for (unsigned int kind = 0; kind < n_kinds; ++kind)
      for (std::size_t i = 0; i < node_lists[kind].size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double x = space.position(node_lists[kind][i])[c];
            sums[0] += weight(first[kind] + i, c) * x;
            sums[1] += std::abs(x);
          }
    std::vector<double> all(2);
    Utilities::MPI::sum(sums, space.communicator(), all);
    return all[1] > 0. ? all[0] / all[1] : 0.;
  }
} // namespace Signorini
