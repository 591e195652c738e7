// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/background_octree.h>
#include <signorini/discretization/hexahedron.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A cell is a leaf when it is smaller than this many times the wanted size: halving leaves sizes between
    /// 0.7 and 1.4 of it.
    constexpr double largest_leaf_size = 1.4;

    /// A weight below this is rounding: the node lies on a face of its cell.
    constexpr double rounding = 1e-7;

    /// Bits of three numbers of 20 bits in turns.
    std::uint64_t interleave(const std::array<std::uint32_t, 3> &place)
    {
      std::uint64_t key = 0;
      for (unsigned int bit = 0; bit < 20; ++bit)
        for (unsigned int c = 0; c < 3; ++c)
          key |= static_cast<std::uint64_t>((place[c] >> bit) & 1u) << (3 * bit + c);
      return key;
    }

    /// Adds equal vertices together.
    void collect(BackgroundOctree::Expansion &expansion)
    {
      std::sort(expansion.begin(), expansion.end());
      std::size_t last = 0;
      for (std::size_t k = 1; k < expansion.size(); ++k)
        if (expansion[k].first == expansion[last].first)
          expansion[last].second += expansion[k].second;
        else
          expansion[++last] = expansion[k];
      expansion.resize(last + 1);
    }

    /// Without the weights that are rounding.
    void clean(BackgroundOctree::Expansion &expansion)
    {
      double sum = 0.;
      expansion.erase(std::remove_if(expansion.begin(), expansion.end(),
                                     [](const auto &entry) { return entry.second < rounding; }),
                      expansion.end());
      for (const auto &entry : expansion)
        sum += entry.second;
      for (auto &entry : expansion)
        entry.second /= sum;
    }
  } // namespace



  BackgroundOctree::BackgroundOctree(const std::vector<Point<3>> &nodes, const std::vector<double> &sizes,
                                     const double first_ratio)
  {
    Point<3> low = nodes.front(), high = nodes.front();
    for (const Point<3> &node : nodes)
      for (unsigned int c = 0; c < 3; ++c)
        {
          low[c]  = std::min(low[c], node[c]);
          high[c] = std::max(high[c], node[c]);
        }
    std::vector<double> log_sizes;
    for (const double s : sizes)
      log_sizes.push_back(std::log(s));
    std::vector<double> sorted = log_sizes;
    std::sort(sorted.begin(), sorted.end());
    const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.) / sorted.size();

    double extent = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      extent = std::max(extent, high[c] - low[c]);
    size = first_ratio * std::exp(mean);
    while (size < extent)
      size *= 2.;
    for (unsigned int c = 0; c < 3; ++c)
      origin[c] = .5 * (low[c] + high[c] - size);

    constexpr std::uint32_t    edge = 1u << depth;
    std::vector<Point<3>>      places;
    std::vector<std::uint64_t> key_of_node;
    for (const Point<3> &node : nodes)
      {
        Place place;
        places.emplace_back((node - origin) * (edge / size));
        for (unsigned int c = 0; c < 3; ++c)
          place[c] = static_cast<std::uint32_t>(std::clamp(places.back()[c], 0., edge - 1.));
        key_of_node.push_back(interleave(place));
      }
    order.resize(nodes.size());
    std::iota(order.begin(), order.end(), 0u);
    // Nodes of one cell by position: sums must not depend on the order in which nodes come.
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      if (key_of_node[a] != key_of_node[b])
        return key_of_node[a] < key_of_node[b];
      for (unsigned int c = 0; c < 3; ++c)
        if (places[a][c] != places[b][c])
          return places[a][c] < places[b][c];
      return a < b;
    });
    for (const unsigned int node : order)
      keys.push_back(key_of_node[node]);
    scaled = std::move(places);
    cells.push_back({{{0, 0, 0}}, edge, 0., {}});
    divide(0, log_sizes, 0, static_cast<unsigned int>(order.size()), first_ratio);
  }



  void BackgroundOctree::divide(const unsigned int cell, const std::vector<double> &log_sizes,
                                const unsigned int begin, const unsigned int end, const double first_ratio)
  {
    double sum = 0.;
    for (unsigned int k = begin; k < end; ++k)
      sum += log_sizes[order[k]];
    const std::uint32_t edge   = cells[cell].edge;
    const double        length = size * edge / (1u << depth);
    cells[cell].smallest_ratio = length / (largest_leaf_size * std::exp(sum / (end - begin)));
    if (edge == 1)
      cells[cell].smallest_ratio = 0.;
    if (cells[cell].smallest_ratio < first_ratio)
      return;
    const std::uint32_t half       = edge / 2;
    const std::uint64_t n_in_child = static_cast<std::uint64_t>(half) * half * half;
    unsigned int        first      = begin;
    while (first < end)
      {
        const std::uint64_t child = keys[first] / n_in_child;
        const unsigned int  last  = static_cast<unsigned int>(
            std::lower_bound(keys.begin() + first, keys.begin() + end, (child + 1) * n_in_child) -
            keys.begin());
        Cell new_cell{cells[cell].corner, half, 0., {}};
        for (unsigned int c = 0; c < 3; ++c)
          new_cell.corner[c] += ((child >> c) & 1u) * half;
        const auto number                = static_cast<unsigned int>(cells.size());
        cells[cell].children[child & 7u] = number;
        cells.push_back(new_cell);
        divide(number, log_sizes, first, last, first_ratio);
        first = last;
      }
  }



  BackgroundOctree::Vertex BackgroundOctree::vertex_at(const Place &place)
  {
    return (static_cast<Vertex>(place[2]) << 42) | (static_cast<Vertex>(place[1]) << 21) | place[0];
  }



  BackgroundOctree::Place BackgroundOctree::place_of(const Vertex vertex)
  {
    constexpr Vertex mask = (1u << 21) - 1;
    return {{static_cast<std::uint32_t>(vertex & mask), static_cast<std::uint32_t>((vertex >> 21) & mask),
             static_cast<std::uint32_t>(vertex >> 42)}};
  }



  Point<3> BackgroundOctree::position(const Vertex vertex) const
  {
    const Place place = place_of(vertex);
    Point<3>    result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = origin[c] + size * place[c] / (1u << depth);
    return result;
  }



  unsigned int BackgroundOctree::find_leaf(const Place &place, const double ratio) const
  {
    unsigned int cell = 0;
    while (cells[cell].smallest_ratio >= ratio)
      {
        const std::uint32_t half  = cells[cell].edge / 2;
        unsigned int        child = 0;
        for (unsigned int c = 0; c < 3; ++c)
          child |= static_cast<unsigned int>(place[c] >= cells[cell].corner[c] + half) << c;
        cell = cells[cell].children[child];
        if (cell == 0)
          return no_cell;
      }
    return cell;
  }



  unsigned int BackgroundOctree::largest_leaf(const Place &vertex, const double ratio) const
  {
    unsigned int largest = no_cell;
    for (unsigned int neighbour = 0; neighbour < 8; ++neighbour)
      {
        Place place    = vertex;
        bool  is_there = true;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const std::uint32_t below = (neighbour >> c) & 1u;
            is_there                  = is_there && place[c] >= below && place[c] - below < (1u << depth);
            place[c] -= below;
          }
        if (!is_there)
          continue;
        const unsigned int leaf = find_leaf(place, ratio);
        if (leaf != no_cell && (largest == no_cell || cells[leaf].edge > cells[largest].edge))
          largest = leaf;
      }
    return largest;
  }



  BackgroundOctree::Cut::Cut(const BackgroundOctree &tree, const double ratio)
    : tree(tree)
    , ratio(ratio)
    , corners(tree.cells.size())
  {
  }



  const BackgroundOctree::Expansion &BackgroundOctree::Cut::expand_corner(const unsigned int cell,
                                                                          const unsigned int corner)
  {
    if (corners[cell][corner] == nullptr)
      {
        Place place = tree.cells[cell].corner;
        for (unsigned int c = 0; c < 3; ++c)
          place[c] += ((corner >> c) & 1u) * tree.cells[cell].edge;
        corners[cell][corner] = &at_vertex(vertex_at(place));
      }
    return *corners[cell][corner];
  }



  const BackgroundOctree::Expansion &BackgroundOctree::Cut::at_vertex(const Vertex vertex)
  {
    if (const auto entry = known.find(vertex); entry != known.end())
      return entry->second;
    const Place        place = place_of(vertex);
    const unsigned int leaf  = tree.largest_leaf(place, ratio);
    const Cell        &cell  = tree.cells[leaf];
    Point<3>           local;
    bool               is_corner = true;
    for (unsigned int c = 0; c < 3; ++c)
      {
        local[c]  = static_cast<double>(place[c] - cell.corner[c]) / cell.edge;
        is_corner = is_corner && (local[c] == 0. || local[c] == 1.);
      }
    Expansion expansion;
    if (is_corner)
      expansion.emplace_back(vertex, 1.);
    else
      {
        const auto weights = Hexahedron::shape_values(local);
        for (unsigned int corner = 0; corner < 8; ++corner)
          if (weights[corner] != 0.)
            for (const auto &[v, weight] : expand_corner(leaf, corner))
              expansion.emplace_back(v, weights[corner] * weight);
        collect(expansion);
      }
    return known.emplace(vertex, std::move(expansion)).first->second;
  }



  void BackgroundOctree::Cut::at_node(Expansion &expansion, const unsigned int node)
  {
    Place place;
    for (unsigned int c = 0; c < 3; ++c)
      place[c] = static_cast<std::uint32_t>(std::clamp(tree.scaled[node][c], 0., (1u << depth) - 1.));
    const unsigned int leaf = tree.find_leaf(place, ratio);
    const Cell        &cell = tree.cells[leaf];
    Point<3>           local;
    for (unsigned int c = 0; c < 3; ++c)
      local[c] = std::clamp((tree.scaled[node][c] - cell.corner[c]) / cell.edge, 0., 1.);
    const auto weights = Hexahedron::shape_values(local);
    expansion.clear();
    for (unsigned int corner = 0; corner < 8; ++corner)
      if (weights[corner] > 0.)
        for (const auto &[vertex, weight] : expand_corner(leaf, corner))
          expansion.emplace_back(vertex, weights[corner] * weight);
    collect(expansion);
    clean(expansion);
  }
} // namespace Signorini
