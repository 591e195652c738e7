// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/node_movement.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>

#include <set>
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
    for (const auto &[id, entry] : other.late)
      {
        late[id].first += entry.first;
        late[id].second = std::max(late[id].second, entry.second);
      }
  }



  namespace
  {
    using Targets = std::vector<std::pair<unsigned int, Point<3>>>;
    using Cells   = std::vector<ArrayView<const unsigned int>>;
    using Near    = std::vector<const ArrayView<const unsigned int> *>;

    /// The cells in the `n_layers` layers around vertices with targets.
    Near cells_near(const std::size_t n_vertices, const Targets &targets, const Cells &cells)
    {
      constexpr unsigned int n_layers = 3;
      std::vector<bool>      near(n_vertices, false);
      for (const auto &target : targets)
        near[target.first] = true;
      Near around;
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
      return around;
    }

    /// Displacements of the vertices that move and of free ones near them.
    struct Displacements
    {
      std::unordered_map<unsigned int, std::size_t> index;
      std::vector<Tensor<1, 3>>                     values;

      void add(const unsigned int v, const Tensor<1, 3> &value)
      {
        index[v] = values.size();
        values.push_back(value);
      }

      /// Gauss-Seidel sweeps: each vertex from number n_given on takes the mean of its neighbours, where
      /// those without a displacement count as zero.
      void spread(const Near &around, const std::size_t n_given)
      {
        constexpr unsigned int                             n_sweeps = 20;
        std::vector<std::pair<unsigned int, unsigned int>> edges;
        for (const auto *cell : around)
          for (const unsigned int v : *cell)
            if (const auto it = index.find(v); it != index.end() && it->second >= n_given)
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
                  sum += values[it->second];
              values[index[edges[i].first]] = sum / static_cast<double>(j - i);
            }
      }
    };

    /// Adds targets for free vertices around the moved ones: their displacements are means of those of their
    /// neighbours.
    Targets let_others_follow(const std::vector<Point<3>> &positions, const Targets &targets,
                              const Cells &cells, const std::vector<bool> &is_fixed)
    {
      const Near    around = cells_near(positions.size(), targets, cells);
      Displacements displacement;
      for (const auto &[v, target] : targets)
        displacement.add(v, target - positions[v]);
      std::vector<unsigned int> free;
      for (const auto *cell : around)
        for (const unsigned int v : *cell)
          if (!is_fixed[v] && displacement.index.count(v) == 0)
            {
              displacement.add(v, Tensor<1, 3>());
              free.push_back(v);
            }
      displacement.spread(around, targets.size());
      Targets all = targets;
      for (const unsigned int v : free)
        if (const Tensor<1, 3> &d = displacement.values[displacement.index[v]]; d.norm() > 0.)
          all.emplace_back(v, positions[v] + d);
      return all;
    }
  } // namespace



  namespace
  {
    /// Second attempts for vertices that had to go back. Pure numbers; measured on refined spheres and the
    /// knee.
    struct MovementRule
    {
      /// The share of its quality that a cell keeps at least.
      double tolerated = 1. / 3.;
      /// How many times vertices go back half of the way before they stay where they were.
      unsigned int n_halvings = 10;
      /// Rounds over the vertices that are not there yet, and sweeps over the free vertices around one.
      unsigned int n_rounds = 3, n_sweeps = 3;
      /// A bound for the cost on meshes that are bad all over (some milliseconds each).
      std::size_t n_attempts = 500;
      /// A free vertex moves while the worst of its cells has a smaller share of its quality than this.
      double good = .7;
      /// First and last step of its search, as shares of its shortest edge.
      double       first_step = .4, last_step = .05;
      unsigned int n_steps = 12;
    };

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
            reference[c] = quality(positions, cells[c]);
        return touched;
      }

      template <typename List>
      double worst_of(const List &list) const
      {
        double worst = std::numeric_limits<double>::max();
        for (const unsigned int c : list)
          worst = std::min(worst, quality(positions, cells[c]) / reference[c]);
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
              result[i] += sign * quality(positions, cells[c]) / reference[c];
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
            worst.emplace_back(quality(positions, cells[c]) / reference[c], c);
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



    /// Moves all vertices with targets at once. Those at cells that suffer go half of the way, then a
    /// quarter, and so on, at last none of it, until all cells keep the tolerated share of their quality.
    class CommonMovement
    {
    public:
      CommonMovement(std::vector<Point<3>> &positions, const Cells &cells, const Targets &targets)
        : quality_before(cells.size(), 0.)
        , positions(positions)
        , cells(cells)
        , targets(targets)
        , moves(positions.size(), false)
        , halvings(targets.size(), 0)
      {
        for (std::size_t i = 0; i < targets.size(); ++i)
          {
            index[targets[i].first] = i;
            moves[targets[i].first] = true;
            start.push_back(positions[targets[i].first]);
          }
        for (unsigned int c = 0; c < cells.size(); ++c)
          if (std::any_of(cells[c].begin(), cells[c].end(), [&](const unsigned int v) { return moves[v]; }))
            {
              around.push_back(c);
              quality_before[c] = quality(positions, cells[c]);
            }
      }

      void run()
      {
        for (std::size_t i = 0; i < targets.size(); ++i)
          place(i);
        while (damp())
          {
          }
      }

      /// Whether a vertex did not go the whole way.
      bool is_damped(const std::size_t target) const
      {
        return halvings[target] > 0;
      }

      /// Of the cells at vertices with targets, now; 1 if there are none.
      double worst_quality() const
      {
        double worst = 1.;
        for (const unsigned int c : around)
          worst = std::min(worst, quality(positions, cells[c]));
        return worst;
      }

      /// By cell; zero where no vertex has a target.
      std::vector<double> quality_before;

    private:
      void place(const std::size_t i)
      {
        const auto &[v, target] = targets[i];
        const double share =
            halvings[i] > rule.n_halvings ? 0. : std::ldexp(1., -static_cast<int>(halvings[i]));
        positions[v] = start[i] + share * (target - start[i]);
      }

      /// Takes the vertices of cells that suffer back by one halving; false if there are none.
      bool damp()
      {
        std::vector<bool> goes_back(targets.size(), false);
        for (const unsigned int c : around)
          if (!(quality(positions, cells[c]) >= rule.tolerated * quality_before[c]))
            for (const unsigned int v : cells[c])
              if (moves[v] && halvings[index[v]] <= rule.n_halvings)
                goes_back[index[v]] = true;
        for (std::size_t i = 0; i < targets.size(); ++i)
          if (goes_back[i])
            {
              ++halvings[i];
              place(i);
            }
        return std::find(goes_back.begin(), goes_back.end(), true) != goes_back.end();
      }

      const MovementRule                            rule;
      std::vector<Point<3>>                        &positions;
      const Cells                                  &cells;
      const Targets                                &targets;
      std::unordered_map<unsigned int, std::size_t> index;
      std::vector<bool>                             moves;
      std::vector<unsigned int>                     halvings, around;
      std::vector<Point<3>>                         start;
    };



    /// Several attempts for the vertices that are late, those of `wanted` in its order.
    void try_again(std::vector<unsigned int> &late, std::vector<Point<3>> &positions, const Targets &wanted,
                   const Cells &cells, const std::vector<bool> &is_fixed, std::vector<double> &reference)
    {
      if (late.empty())
        return;
      std::unordered_map<unsigned int, std::size_t> index;
      std::vector<bool>                             is_free(positions.size());
      for (std::size_t v = 0; v < is_free.size(); ++v)
        is_free[v] = !is_fixed[v];
      for (std::size_t i = 0; i < wanted.size(); ++i)
        {
          index[wanted[i].first]   = i;
          is_free[wanted[i].first] = false;
        }
      const MovementRule rule;
      std::size_t        n_attempts = 0;
      LateVertices       attempts(positions, cells, is_free, reference);
      bool               moved = true;
      for (unsigned int round = 0; round < rule.n_rounds && moved; ++round)
        {
          moved = false;
          std::vector<unsigned int> still;
          for (const unsigned int v : late)
            if (n_attempts++ >= rule.n_attempts || !attempts.advance(moved, v, wanted[index[v]].second))
              still.push_back(v);
          late = std::move(still);
        }
    }
  } // namespace



  MovementReport move_nodes(std::vector<Point<3>> &positions, const Targets &wanted, const Cells &cells,
                            const std::vector<bool> &is_fixed, std::vector<unsigned int> &late)
  {
    const Targets  targets = let_others_follow(positions, wanted, cells, is_fixed);
    CommonMovement movement(positions, cells, targets);
    MovementReport report;
    report.quality_before = movement.worst_quality();
    movement.run();
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (movement.is_damped(i))
        late.push_back(wanted[i].first);
    try_again(late, positions, wanted, cells, is_fixed, movement.quality_before);
    report.quality_after = movement.worst_quality();
    report.n_moved       = wanted.size();
    report.n_damped      = late.size();
    return report;
  }
} // namespace Signorini
