// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "late_vertices.h"

#include <signorini/mesh/node_movement.h>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  void MovementReport::add(const MovementReport &other)
  {
    quality_before = std::min(quality_before, other.quality_before);
    quality_after  = std::min(quality_after, other.quality_after);
    n_moved += other.n_moved;
    n_damped += other.n_damped;
    for (const auto &[id, entry] : other.late)
      {
        late[id].first += entry.first;
        late[id].second = std::max(late[id].second, entry.second);
      }
  }



  void SharedVertices::try_again(std::vector<unsigned int> &late, const std::vector<Point<3>> &targets,
                                 std::vector<Point<3>>                            &positions,
                                 const std::vector<ArrayView<const unsigned int>> &cells,
                                 const std::vector<bool> &is_free, std::vector<double> &reference) const
  {
    if (!late.empty())
      Signorini::try_again(late, targets, positions, cells, is_free, reference);
  }



  namespace
  {
    using Targets = std::vector<std::pair<unsigned int, Point<3>>>;
    using Cells   = std::vector<ArrayView<const unsigned int>>;
    using Flags   = std::vector<double>;

    /// Who moves, and where to: vertices with targets, and free ones in the layers of cells around them.
    /// Everything is known of all vertices of this rank, but decided by their owners.
    class MovingVertices
    {
    public:
      MovingVertices(const std::vector<Point<3>> &positions, const Targets &wanted, const Cells &cells,
                     const std::vector<bool> &is_fixed, const SharedVertices &shared)
        : has_target(positions.size(), 0.)
        , moves(positions.size(), 0.)
        , displacement(3 * positions.size(), 0.)
        , cells(cells)
        , shared(shared)
      {
        for (const auto &[v, target] : wanted)
          {
            has_target[v] = moves[v] = 1.;
            for (unsigned int d = 0; d < 3; ++d)
              displacement[3 * v + d] = target[d] - positions[v][d];
          }
        shared.update(has_target);
        shared.update(displacement);
        const auto around = cells_near();
        for (const unsigned int c : around)
          for (const unsigned int v : cells[c])
            if (!is_fixed[v] && has_target[v] == 0.)
              moves[v] = 1.;
        shared.update(moves);
        spread(around);
      }

      /// Of each vertex whether it has a target, and whether it moves.
      Flags has_target, moves;
      /// Three components of each vertex.
      std::vector<double> displacement;

    private:
      /// The cells in the `n_layers` layers around vertices with targets.
      std::vector<unsigned int> cells_near() const
      {
        constexpr unsigned int    n_layers = 3;
        Flags                     near     = has_target;
        std::vector<unsigned int> around;
        for (unsigned int layer = 0; layer < n_layers; ++layer)
          {
            around.clear();
            for (unsigned int c = 0; c < cells.size(); ++c)
              if (std::any_of(cells[c].begin(), cells[c].end(),
                              [&](const unsigned int v) { return near[v] > 0.; }))
                around.push_back(c);
            for (const unsigned int c : around)
              for (const unsigned int v : cells[c])
                near[v] = 1.;
            shared.update(near);
          }
        return around;
      }

      /// Jacobi sweeps: each vertex without a target takes the mean of its neighbours, where those that do
      /// not move count as zero.
      void spread(const std::vector<unsigned int> &around)
      {
        constexpr unsigned int                             n_sweeps = 40;
        std::vector<std::pair<unsigned int, unsigned int>> edges;
        for (const unsigned int c : around)
          for (const unsigned int v : cells[c])
            if (moves[v] > 0. && has_target[v] == 0. && shared.owns(v))
              for (const unsigned int w : cells[c])
                if (w != v)
                  edges.emplace_back(v, w);
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        std::vector<double> next = displacement;
        for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
          {
            for (std::size_t i = 0, j; i < edges.size(); i = j)
              {
                Tensor<1, 3> sum;
                for (j = i; j < edges.size() && edges[j].first == edges[i].first; ++j)
                  for (unsigned int d = 0; d < 3; ++d)
                    sum[d] += displacement[3 * edges[j].second + d];
                for (unsigned int d = 0; d < 3; ++d)
                  next[3 * edges[i].first + d] = sum[d] / static_cast<double>(j - i);
              }
            displacement = next;
            shared.update(displacement);
          }
      }

      const Cells          &cells;
      const SharedVertices &shared;
    };



    /// Moves all vertices at once. Those at cells that suffer go half of the way, then a quarter, and so on,
    /// at last none of it, until all cells keep the tolerated share of their quality.
    class CommonMovement
    {
    public:
      CommonMovement(std::vector<Point<3>> &positions, const Cells &cells, const MovingVertices &vertices,
                     const SharedVertices &shared)
        : quality_before(cells.size(), 0.)
        , halvings(positions.size(), 0.)
        , positions(positions)
        , cells(cells)
        , shared(shared)
        , index(positions.size(), -1)
      {
        for (unsigned int v = 0; v < positions.size(); ++v)
          {
            Tensor<1, 3> d;
            for (unsigned int i = 0; i < 3; ++i)
              d[i] = vertices.displacement[3 * v + i];
            if (vertices.moves[v] > 0. && (vertices.has_target[v] > 0. || d.norm() > 0.))
              {
                index[v] = static_cast<int>(moving.size());
                moving.push_back({v, positions[v], d});
              }
          }
        for (unsigned int c = 0; c < cells.size(); ++c)
          if (std::any_of(cells[c].begin(), cells[c].end(),
                          [&](const unsigned int v) { return index[v] >= 0; }))
            {
              around.push_back(c);
              quality_before[c] = cell_quality(positions, cells[c]);
            }
      }

      void run()
      {
        do
          for (const Moving &m : moving)
            place(m);
        while (damp());
      }

      /// Of the cells at vertices that move, now; 1 if there are none.
      double worst_quality() const
      {
        double worst = 1.;
        for (const unsigned int c : around)
          worst = std::min(worst, cell_quality(positions, cells[c]));
        return worst;
      }

      /// By cell; zero where no vertex moves.
      std::vector<double> quality_before;
      /// By vertex how often its way was halved.
      Flags halvings;

    private:
      struct Moving
      {
        unsigned int vertex;
        Point<3>     start;
        Tensor<1, 3> way;
      };

      void place(const Moving &m)
      {
        const double n      = halvings[m.vertex];
        const double share  = n > rule.n_halvings ? 0. : std::ldexp(1., -static_cast<int>(n));
        positions[m.vertex] = m.start + share * m.way;
      }

      /// Halves the ways of the vertices of cells that suffer; false if there are none.
      bool damp()
      {
        std::vector<bool> goes_back(moving.size(), false);
        for (const unsigned int c : around)
          if (!(cell_quality(positions, cells[c]) >= rule.tolerated * quality_before[c]))
            for (const unsigned int v : cells[c])
              if (index[v] >= 0 && halvings[v] <= rule.n_halvings)
                goes_back[index[v]] = true;
        double any = 0.;
        for (std::size_t i = 0; i < moving.size(); ++i)
          if (goes_back[i] && shared.owns(moving[i].vertex))
            {
              ++halvings[moving[i].vertex];
              any = 1.;
            }
        shared.update(halvings);
        return shared.sum(any) > 0.;
      }

      const MovementRule        rule;
      std::vector<Point<3>>    &positions;
      const Cells              &cells;
      const SharedVertices     &shared;
      std::vector<Moving>       moving;
      std::vector<int>          index;
      std::vector<unsigned int> around;
    };
  } // namespace



  MovementReport move_nodes(std::vector<Point<3>> &positions, const Targets &wanted, const Cells &cells,
                            const std::vector<bool> &is_fixed, std::vector<unsigned int> &late,
                            const SharedVertices &shared)
  {
    const MovingVertices vertices(positions, wanted, cells, is_fixed, shared);
    CommonMovement       movement(positions, cells, vertices, shared);
    MovementReport       report;
    report.quality_before = shared.minimum(movement.worst_quality());
    movement.run();
    std::vector<bool> is_free(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v)
      is_free[v] = !is_fixed[v] && vertices.has_target[v] == 0.;
    std::vector<Point<3>> targets;
    for (const auto &[v, target] : wanted)
      if (movement.halvings[v] > 0.)
        {
          late.push_back(v);
          targets.push_back(target);
        }
    shared.try_again(late, targets, positions, cells, is_free, movement.quality_before);
    report.quality_after = shared.minimum(movement.worst_quality());
    report.n_moved       = static_cast<std::size_t>(shared.sum(static_cast<double>(wanted.size())));
    report.n_damped      = static_cast<std::size_t>(shared.sum(static_cast<double>(late.size())));
    return report;
  }
} // namespace Signorini
