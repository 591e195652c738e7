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



  MovementReport move_nodes(std::vector<Point<3>>                                &positions,
                            const std::vector<std::pair<unsigned int, Point<3>>> &targets,
                            const std::vector<ArrayView<const unsigned int>>     &cells,
                            std::vector<unsigned int>                            &late)
  {
    constexpr double                              tolerated  = 1. / 3.;
    constexpr unsigned int                        n_halvings = 10;
    MovementReport                                report;
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
    report.n_moved = targets.size();
    for (std::size_t i = 0; i < targets.size(); ++i)
      if (halvings[i] > 0)
        {
          late.push_back(targets[i].first);
          ++report.n_damped;
        }
    return report;
  }
} // namespace Signorini
