// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/crease_edges.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Finds creases by how the surface turns.
    class CreaseFinder
    {
    public:
      CreaseFinder(const SurfaceMesh &mesh, const SurfaceTopology &topology, const CreaseEdgeRule &rule)
        : mesh(mesh)
        , topology(topology)
        , rule(rule)
        , is_sharp(topology.edges.size())
      {
        for (const auto &[a, b, c] : mesh.triangles)
          {
            normals.push_back(
                cross_product_3d(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
            if (const double length = normals.back().norm(); length > 0.)
              normals.back() /= length;
          }
        find_angles();
        find_sharp_edges();
      }

      std::vector<bool> find() const
      {
        std::map<unsigned int, double> share;
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!topology.is_border(e) && !is_sharp[e] && angle(e) > 0.)
            if (const double s = largest_turn_beside(e) / angle(e); s <= rule.may_be_alone)
              share[e] = s;
        drop_loose_ends(share);
        std::vector<bool> result = is_sharp;
        for (const std::vector<unsigned int> &crease : connected(share))
          if (const auto n_alone =
                  std::count_if(crease.begin(), crease.end(),
                                [&](const unsigned int e) { return share[e] <= rule.is_alone; });
              (n_alone >= rule.least_alone || (n_alone > 0 && crosses_a_strip(crease))) &&
              n_alone >= rule.share_alone * static_cast<double>(crease.size()))
            for (const unsigned int e : crease)
              result[e] = true;
        return result;
      }

    private:
      /// Edges of large angles. Some of those that are not so large are chords of coarse fillets.
      void find_sharp_edges()
      {
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          is_sharp[e] = !topology.is_border(e) && angle(e) > rule.largest_chord;
        std::vector<unsigned int> found;
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (!topology.is_border(e) && !is_sharp[e] && angle(e) > rule.sharp && !is_chord(e))
            found.push_back(e);
        for (const unsigned int e : found)
          is_sharp[e] = true;
      }

      /// Whether the surface turns on in the same sense on either side of an edge, straight on.
      bool is_chord(const unsigned int edge) const
      {
        const auto &sides = topology.edge_triangles[edge];
        for (unsigned int i = 0; i < 2; ++i)
          {
            const std::optional<double> on = turn_beside(edge, sides[i]);
            // Beyond an edge that sticks out normals lean away from it.
            const double own =
                std::copysign(angle(edge), -(normals[sides[1 - i]] * away_from(edge, sides[i])));
            if (!on || *on / own < rule.least_of_chord || *on / own > rule.most_of_chord)
              return false;
          }
        return true;
      }

      /// Unit vector in a triangle across its edge, away from that.
      Tensor<1, 3> away_from(const unsigned int edge, const unsigned int triangle) const
      {
        const auto &[p, q]   = topology.edges[edge];
        const unsigned int i = topology.local_corner(triangle, p), j = topology.local_corner(triangle, q);
        const Point<3> &a = mesh.vertices[p], &apex = mesh.vertices[topology.triangles[triangle][3 - i - j]];
        const Tensor<1, 3> along = (mesh.vertices[q] - a) / mesh.vertices[q].distance(a);
        Tensor<1, 3>       away  = apex - a;
        away -= (away * along) * along;
        return away.norm() > 0. ? away / away.norm() : away;
      }

      /// Those that are no creases anyway are taken for zero.
      void find_angles()
      {
        constexpr double rounding = 1e-6;
        const double     most     = std::cos((rule.shallow - rounding) / 180. * numbers::PI);
        angles.assign(topology.edges.size(), 0.);
        for (unsigned int e = 0; e < angles.size(); ++e)
          if (!topology.is_border(e))
            {
              const auto &[s, t]  = topology.edge_triangles[e];
              const double cosine = normals[s] * normals[t];
              if (cosine <= most)
                angles[e] = degrees(std::acos(std::max(-1., cosine)));
            }
      }

      /// Between the triangles at an edge (degrees).
      double angle(const unsigned int edge) const
      {
        return angles[edge];
      }

      static double degrees(const double radians)
      {
        return radians * 180. / numbers::PI;
      }

      /// By how much the surface turns about an edge within reach of it, on that side on which it turns more
      /// (degrees); infinite if there is nothing beyond its triangles.
      double largest_turn_beside(const unsigned int edge) const
      {
        const auto &[s, t]              = topology.edge_triangles[edge];
        const std::optional<double> one = turn_beside(edge, s), other = turn_beside(edge, t);
        if (!one && !other)
          return std::numeric_limits<double>::infinity();
        return one && other ? std::max(std::abs(*one), std::abs(*other))
                            : rule.one_sided * std::abs(one ? *one : *other);
      }

      /// The same on the side of one of its triangles, positive where normals lean away from the edge;
      /// nothing if that ends at a border or sharp edge.
      std::optional<double> turn_beside(const unsigned int edge, const unsigned int triangle) const
      {
        const auto &[p, q]   = topology.edges[edge];
        const Point<3>    &a = mesh.vertices[p], &b = mesh.vertices[q];
        const auto        &corners = topology.triangles[triangle];
        const unsigned int apex =
            *std::find_if(corners.begin(), corners.end(),
                          [&, p = p, q = q](const unsigned int v) { return v != p && v != q; });
        const Tensor<1, 3> along = (b - a) / (b - a).norm();
        Point<3>           x     = a + .5 * (b - a);
        Tensor<1, 3>       away  = mesh.vertices[apex] - x;
        away -= (away * along) * along;
        const double height = away.norm();
        if (!(height > 0.))
          return {};
        away /= height;
        std::optional<double> result;
        Tensor<1, 3>          way  = away;
        double                left = rule.reach * height;
        unsigned int          here = triangle, came = edge;
        // Straight on, across one edge after the other.
        while (const std::optional<Exit> exit = leave(x, way, here, came))
          {
            if (exit->length > left || topology.is_border(exit->edge) || is_sharp[exit->edge])
              break;
            left -= exit->length;
            x += exit->length * way;
            const auto        &sides = topology.edge_triangles[exit->edge];
            const unsigned int next  = sides[0] == here ? sides[1] : sides[0];
            const double       part  = way * exit->direction;
            way = part * exit->direction + way * cross_product_3d(normals[here], exit->direction) *
                                               cross_product_3d(normals[next], exit->direction);
            if (!(way.norm() > 0.))
              break;
            way /= way.norm();
            here              = next;
            came              = exit->edge;
            const double turn = degrees(std::asin(std::max(-1., std::min(1., normals[here] * away))));
            if (!result || std::abs(turn) > std::abs(*result))
              result = turn;
          }
        return result;
      }

      /// Where a straight way leaves a triangle.
      struct Exit
      {
        unsigned int edge;
        double       length;
        /// Of the edge; unit vector.
        Tensor<1, 3> direction;
      };

      std::optional<Exit> leave(const Point<3> &x, const Tensor<1, 3> &way, const unsigned int triangle,
                                const unsigned int came) const
      {
        std::optional<Exit> result;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int e = topology.triangle_edges[triangle][i];
            if (e == came)
              continue;
            const Point<3>    &a    = mesh.vertices[topology.triangles[triangle][i]];
            const Tensor<1, 3> side = mesh.vertices[topology.triangles[triangle][(i + 1) % 3]] - a;
            const Tensor<1, 3> out  = cross_product_3d(side, normals[triangle]);
            const double       rate = way * out;
            if (!(rate > 0.))
              continue;
            const double length = std::max(0., (a - x) * out / rate);
            if (!result || length < result->length)
              result = Exit{e, length, side / side.norm()};
          }
        return result;
      }

      /// Takes away edges that end where neither another one nor a border nor a sharp edge goes on.
      void drop_loose_ends(std::map<unsigned int, double> &edges) const
      {
        std::vector<unsigned int> n_at(mesh.vertices.size(), 0);
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          for (const unsigned int v : topology.edges[e])
            n_at[v] += topology.is_border(e) || is_sharp[e] || edges.count(e) > 0;
        const auto is_loose = [&](const unsigned int e) {
          return std::any_of(topology.edges[e].begin(), topology.edges[e].end(),
                             [&](const unsigned int v) { return n_at[v] < 2; });
        };
        for (bool changes = true; changes;)
          {
            changes = false;
            for (auto it = edges.begin(); it != edges.end();)
              if (is_loose(it->first))
                {
                  for (const unsigned int v : topology.edges[it->first])
                    --n_at[v];
                  it      = edges.erase(it);
                  changes = true;
                }
              else
                ++it;
          }
      }

      /// Whether a single edge goes from border to border, or sharp edge: that of a slab of one layer.
      bool crosses_a_strip(const std::vector<unsigned int> &crease) const
      {
        const auto ends_here = [&](const unsigned int v) {
          for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
            for (const unsigned int e : topology.triangle_edges[topology.fan[k]])
              if ((topology.is_border(e) || is_sharp[e]) &&
                  (topology.edges[e][0] == v || topology.edges[e][1] == v))
                return true;
          return false;
        };
        return crease.size() == 1 && ends_here(topology.edges[crease[0]][0]) &&
               ends_here(topology.edges[crease[0]][1]);
      }

      /// Edges that hang together.
      std::vector<std::vector<unsigned int>> connected(const std::map<unsigned int, double> &edges) const
      {
        std::map<unsigned int, std::vector<unsigned int>> at_vertex;
        for (const auto &[e, share] : edges)
          for (const unsigned int v : topology.edges[e])
            at_vertex[v].push_back(e);
        std::vector<std::vector<unsigned int>> result;
        std::set<unsigned int>                 found;
        for (const auto &[first, share] : edges)
          if (found.insert(first).second)
            {
              std::vector<unsigned int> list = {first};
              for (std::size_t i = 0; i < list.size(); ++i)
                for (const unsigned int v : topology.edges[list[i]])
                  for (const unsigned int e : at_vertex[v])
                    if (found.insert(e).second)
                      list.push_back(e);
              result.push_back(std::move(list));
            }
        return result;
      }

      const SurfaceMesh        &mesh;
      const SurfaceTopology    &topology;
      const CreaseEdgeRule     &rule;
      std::vector<Tensor<1, 3>> normals;
      std::vector<double>       angles;
      std::vector<bool>         is_sharp;
    };
  } // namespace



  std::vector<bool> find_creases(const SurfaceMesh &mesh, const SurfaceTopology &topology,
                                 const CreaseEdgeRule &rule)
  {
    return CreaseFinder(mesh, topology, rule).find();
  }
} // namespace Signorini
