// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/node_movement.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>

#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    double quality(const std::vector<Point<3>> &positions, const ArrayView<const unsigned int> &cell)
    {
      if (cell.size() == 4)
        return tetrahedron_quality(
            {{positions[cell[0]], positions[cell[1]], positions[cell[2]], positions[cell[3]]}});
      std::array<Point<3>, 8> x;
      for (unsigned int v = 0; v < 8; ++v)
        x[v] = positions[cell[v]];
      return scaled_jacobian(x);
    }
  } // namespace



  void MovementReport::add(const MovementReport &other)
  {
    quality_before = std::min(quality_before, other.quality_before);
    quality_after  = std::min(quality_after, other.quality_after);
    n_moved += other.n_moved;
    n_damped += other.n_damped;
  }



  namespace
  {
    using Targets = std::vector<std::pair<unsigned int, Point<3>>>;
    using Cells   = std::vector<ArrayView<const unsigned int>>;

    /// Adds targets for free vertices in the `n_layers` layers of cells around the moved ones: their
    /// displacements are means of those of their neighbours.
    Targets let_others_follow(const std::vector<Point<3>> &positions, const Targets &targets,
                              const Cells &cells, const std::vector<bool> &is_fixed)
    {
      constexpr unsigned int n_layers = 3, n_sweeps = 20;
      std::vector<bool>      near(positions.size(), false);
      for (const auto &target : targets)
        near[target.first] = true;
      std::vector<const ArrayView<const unsigned int> *> around;
      for (unsigned int layer = 0; layer < n_layers; ++layer)
        {
          around.clear();
          for (const auto &cell : cells)
            if (std::any_of(cell.begin(), cell.end(), [&](const unsigned int v) { return near[v]; }))
              around.push_back(&cell);
          for (const auto *cell : around)
            for (const unsigned int v : *cell)
              near[v] = true;
        }

      std::unordered_map<unsigned int, std::size_t> index;
      std::vector<Tensor<1, 3>>                     displacement;
      for (const auto &[v, target] : targets)
        {
          index[v] = displacement.size();
          displacement.push_back(target - positions[v]);
        }
      std::vector<std::pair<unsigned int, unsigned int>> edges;
      std::vector<unsigned int>                          free;
      for (const auto *cell : around)
        for (const unsigned int v : *cell)
          if (!is_fixed[v] && index.count(v) == 0)
            {
              index[v] = displacement.size();
              displacement.emplace_back();
              free.push_back(v);
            }
      for (const auto *cell : around)
        for (const unsigned int v : *cell)
          if (const auto it = index.find(v); it != index.end() && it->second >= targets.size())
            for (const unsigned int w : *cell)
              if (w != v)
                edges.emplace_back(v, w);
      std::sort(edges.begin(), edges.end());
      edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
      for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
        for (std::size_t i = 0, j; i < edges.size(); i = j)
          {
            Tensor<1, 3> sum;
            for (j = i; j < edges.size() && edges[j].first == edges[i].first; ++j)
              if (const auto it = index.find(edges[j].second); it != index.end())
                sum += displacement[it->second];
            displacement[index[edges[i].first]] = sum / static_cast<double>(j - i);
          }
      Targets all = targets;
      for (const unsigned int v : free)
        if (const Tensor<1, 3> &d = displacement[index[v]]; d.norm() > 0.)
          all.emplace_back(v, positions[v] + d);
      return all;
    }
  } // namespace



  MovementReport move_nodes(std::vector<Point<3>> &positions, const Targets &wanted, const Cells &cells,
                            const std::vector<bool> &is_fixed, std::vector<unsigned int> &late)
  {
    constexpr double       tolerated  = 1. / 3.;
    constexpr unsigned int n_halvings = 10;
    MovementReport         report;
    const Targets          targets = let_others_follow(positions, wanted, cells, is_fixed);
    std::unordered_map<unsigned int, std::size_t> index;
    std::vector<bool>                             moves(positions.size(), false);
    for (std::size_t i = 0; i < targets.size(); ++i)
      {
        index[targets[i].first] = i;
        moves[targets[i].first] = true;
      }
    std::vector<const ArrayView<const unsigned int> *> around;
    std::vector<double>                                before;
    for (const auto &cell : cells)
      if (std::any_of(cell.begin(), cell.end(), [&](const unsigned int v) { return moves[v]; }))
        {
          around.push_back(&cell);
          before.push_back(quality(positions, cell));
          report.quality_before = std::min(report.quality_before, before.back());
        }

    std::vector<Point<3>>     start;
    std::vector<unsigned int> halvings(targets.size(), 0);
    const auto                place = [&](const std::size_t i) {
      const auto &[v, target] = targets[i];
      const double share = halvings[i] > n_halvings ? 0. : std::ldexp(1., -static_cast<int>(halvings[i]));
      positions[v] = start[i] + share * (target - start[i]);
    };
    for (const auto &target : targets)
      start.push_back(positions[target.first]);
    for (std::size_t i = 0; i < targets.size(); ++i)
      place(i);
    std::vector<bool> goes_back(targets.size());
    for (bool changed = true; changed;)
      {
        changed = false;
        goes_back.assign(targets.size(), false);
        for (std::size_t c = 0; c < around.size(); ++c)
          if (!(quality(positions, *around[c]) >= tolerated * before[c]))
            for (const unsigned int v : *around[c])
              if (moves[v] && halvings[index[v]] <= n_halvings)
                goes_back[index[v]] = true;
        for (std::size_t i = 0; i < targets.size(); ++i)
          if (goes_back[i])
            {
              ++halvings[i];
              place(i);
              changed = true;
            }
      }
    for (const auto *cell : around)
      report.quality_after = std::min(report.quality_after, quality(positions, *cell));
    report.n_moved = wanted.size();
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (halvings[i] > 0)
        {
          late.push_back(targets[i].first);
          ++report.n_damped;
        }
    return report;
  }
} // namespace Signorini
