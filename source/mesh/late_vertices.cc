// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "late_vertices.h"

#include <signorini/mesh/tetrahedron_bisection.h>
#include <signorini/mesh/volume_mesh.h>

#include <algorithm>
#include <set>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  double cell_quality(const std::vector<Point<3>> &positions, const ArrayView<const unsigned int> &cell)
  {
    if (cell.size() == 4)
      return tetrahedron_quality(
          {{positions[cell[0]], positions[cell[1]], positions[cell[2]], positions[cell[3]]}});
    std::array<Point<3>, 8> x;
    for (unsigned int v = 0; v < 8; ++v)
      x[v] = positions[cell[v]];
    return scaled_jacobian(x);
  }



  namespace
  {
    using Cells = std::vector<ArrayView<const unsigned int>>;

    /// Moves single vertices to their targets where the free ones around can give way. All cells keep the
    /// tolerated share of the quality that they had at the start.
    class LateVertices
    {
    public:
      LateVertices(std::vector<Point<3>> &positions, const Cells &cells, const std::vector<bool> &is_free,
                   std::vector<double> &reference)
        : positions(positions)
        , cells(cells)
        , is_free(is_free)
        , reference(reference)
        , start(positions.size() + 1, 0)
      {
        for (const auto &cell : cells)
          for (const unsigned int v : cell)
            ++start[v + 1];
        for (std::size_t v = 0; v < positions.size(); ++v)
          start[v + 1] += start[v];
        star.resize(start.back());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (unsigned int c = 0; c < cells.size(); ++c)
          for (const unsigned int v : cells[c])
            star[next[v]++] = c;
      }

      /// Whether the vertex got to its target; else whether it got nearer is in `moved`.
      bool advance(bool &moved, const unsigned int v, const Point<3> &target)
      {
        const std::vector<unsigned int> region  = free_vertices_around(v);
        const std::set<unsigned int>    touched = cells_of(region, v);
        for (double share = 1.; share >= .5; share *= .5)
          {
            std::vector<Point<3>> saved = {positions[v]};
            for (const unsigned int w : region)
              saved.push_back(positions[w]);
            positions[v] = share == 1. ? target : positions[v] + share * (target - positions[v]);
            double worst = worst_of(touched);
            for (unsigned int sweep = 0; sweep < rule.n_sweeps && worst < rule.tolerated; ++sweep)
              {
                const double old = worst;
                for (const unsigned int w : region)
                  improve(w);
                worst = worst_of(touched);
                if (worst <= old + 1e-3)
                  break;
              }
            if (worst >= rule.tolerated)
              {
                moved = true;
                return share == 1.;
              }
            positions[v] = saved[0];
            for (std::size_t i = 0; i < region.size(); ++i)
              positions[region[i]] = saved[i + 1];
          }
        return false;
      }

    private:
      ArrayView<const unsigned int> star_of(const unsigned int v) const
      {
        return {star.data() + start[v], start[v + 1] - start[v]};
      }

      /// Of the cells at the vertex and of their neighbours, nearest first.
      std::vector<unsigned int> free_vertices_around(const unsigned int v) const
      {
        std::vector<unsigned int> result, ring = {v};
        std::set<unsigned int>    known = {v};
        for (unsigned int layer = 0; layer < 2; ++layer)
          {
            std::vector<unsigned int> next;
            for (const unsigned int w : ring)
              for (const unsigned int c : star_of(w))
                for (const unsigned int x : cells[c])
                  if (known.insert(x).second)
                    next.push_back(x);
            for (const unsigned int w : next)
              if (is_free[w])
                result.push_back(w);
            ring = std::move(next);
          }
        return result;
      }

      std::set<unsigned int> cells_of(const std::vector<unsigned int> &region, const unsigned int v)
      {
        std::set<unsigned int> touched(star_of(v).begin(), star_of(v).end());
        for (const unsigned int w : region)
          touched.insert(star_of(w).begin(), star_of(w).end());
        // Cells that nothing has moved yet.
        for (const unsigned int c : touched)
          if (reference[c] == 0.)
            reference[c] = cell_quality(positions, cells[c]);
        return touched;
      }

      template <typename List>
      double worst_of(const List &list) const
      {
        double worst = std::numeric_limits<double>::max();
        for (const unsigned int c : list)
          worst = std::min(worst, cell_quality(positions, cells[c]) / reference[c]);
        return worst;
      }

      /// How the share of its quality that a cell keeps grows when the vertex moves.
      Tensor<1, 3> gradient(const unsigned int c, const unsigned int w, const double h)
      {
        const Point<3> from = positions[w];
        Tensor<1, 3>   result;
        for (unsigned int i = 0; i < 3; ++i)
          for (const double sign : {-1., 1.})
            {
              positions[w][i] = from[i] + sign * h;
              result[i] += sign * cell_quality(positions, cells[c]) / reference[c];
              positions[w] = from;
            }
        return result;
      }

      /// Directions that may be good for the worst cells: those in which one or several of them grow, and to
      /// the middle of the neighbours.
      std::vector<Tensor<1, 3>> ways_of(const unsigned int w, const double h)
      {
        std::vector<std::pair<double, unsigned int>> worst;
        Tensor<1, 3>                                 sum;
        for (const unsigned int c : star_of(w))
          {
            worst.emplace_back(cell_quality(positions, cells[c]) / reference[c], c);
            for (const unsigned int x : cells[c])
              sum += positions[x] - positions[w];
          }
        std::vector<Tensor<1, 3>> ways = {sum};
        const std::size_t         n    = std::min<std::size_t>(3, worst.size());
        std::partial_sort(worst.begin(), worst.begin() + n, worst.end());
        sum = 0.;
        for (std::size_t i = 0; i < n; ++i)
          {
            ways.push_back(gradient(worst[i].second, w, h));
            sum += ways.back();
            if (i > 0)
              ways.push_back(sum);
          }
        for (Tensor<1, 3> &way : ways)
          if (const double length = way.norm(); length > 0.)
            way /= length;
        return ways;
      }

      /// Moves a free vertex to where the worst of its cells is better, by shorter and shorter steps.
      void improve(const unsigned int w)
      {
        const auto star_cells = star_of(w);
        double     now        = worst_of(star_cells);
        if (now >= rule.good)
          return;
        double shortest = std::numeric_limits<double>::max();
        for (const unsigned int c : star_cells)
          for (const unsigned int x : cells[c])
            if (x != w)
              shortest = std::min(shortest, positions[x].distance(positions[w]));
        double step = rule.first_step;
        for (unsigned int i = 0; i < rule.n_steps && step >= rule.last_step && now < rule.good; ++i)
          {
            const Point<3> from = positions[w];
            Point<3>       best = from;
            for (const Tensor<1, 3> &way : ways_of(w, rule.last_step * shortest))
              {
                positions[w] = from + step * shortest * way;
                // Steps that hardly help are not worth the next ones.
                if (const double there = worst_of(star_cells); there > now + 1e-3)
                  {
                    now  = there;
                    best = positions[w];
                  }
              }
            positions[w] = best;
            if (best == from)
              step *= .5;
          }
      }

      std::vector<Point<3>>   &positions;
      const Cells             &cells;
      const std::vector<bool> &is_free;
      /// The quality that each cell had at the start; zero where it is not known yet.
      std::vector<double>      &reference;
      const MovementRule        rule;
      std::vector<std::size_t>  start;
      std::vector<unsigned int> star;
    };
  } // namespace



  void try_again(std::vector<unsigned int> &late, const std::vector<Point<3>> &targets,
                 std::vector<Point<3>> &positions, const Cells &cells, const std::vector<bool> &is_free,
                 std::vector<double> &reference)
  {
    std::unordered_map<unsigned int, Point<3>> target;
    for (std::size_t i = 0; i < late.size(); ++i)
      target[late[i]] = targets[i];
    const MovementRule rule;
    std::size_t        n_attempts = 0;
    LateVertices       attempts(positions, cells, is_free, reference);
    bool               moved = true;
    for (unsigned int round = 0; round < rule.n_rounds && moved; ++round)
      {
        moved = false;
        std::vector<unsigned int> still;
        for (const unsigned int v : late)
          if (n_attempts++ >= rule.n_attempts || !attempts.advance(moved, v, target[v]))
            still.push_back(v);
        late = std::move(still);
      }
  }
} // namespace Signorini
