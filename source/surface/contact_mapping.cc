// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/normal_projection.h>
#include <signorini/surface/pair_intersection.h>

#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/boost_adaptors/point.h>
#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <queue>

namespace Signorini
{
  using namespace dealii;

  Point<3> evaluate(const SurfaceMesh &mesh, const unsigned int triangle,
                    const std::array<double, 3> &barycentric)
  {
    Point<3> p;
    for (unsigned int i = 0; i < 3; ++i)
      p += barycentric[i] * mesh.vertices[mesh.triangles[triangle][i]];
    return p;
  }



  double triangle_area(const SurfaceMesh &mesh, const unsigned int triangle)
  {
    const auto &t = mesh.triangles[triangle];
    return .5 * cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                 mesh.vertices[t[2]] - mesh.vertices[t[0]])
                    .norm();
  }



  namespace
  {
    namespace bg  = boost::geometry;
    namespace bgi = boost::geometry::index;

    using TreeBox   = bg::model::box<Point<3>>;
    using TreeValue = std::pair<TreeBox, unsigned int>;
    using Tree      = bgi::rtree<TreeValue, bgi::linear<16>>;

    /// Coordinate c of any of boost's points.
    template <typename P>
    double component(const P &p, const unsigned int c)
    {
      return c == 0 ? bg::get<0>(p) : (c == 1 ? bg::get<1>(p) : bg::get<2>(p));
    }

    TreeBox bounding_box(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      Point<3> low = mesh.vertices[mesh.triangles[triangle][0]], high = low;
      for (const unsigned int v : mesh.triangles[triangle])
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c]  = std::min(low[c], mesh.vertices[v][c]);
            high[c] = std::max(high[c], mesh.vertices[v][c]);
          }
      // A box of a flat triangle has no thickness: give it some, against rounding in the ray test.
      const double margin = 1e-9 * low.distance(high);
      for (unsigned int c = 0; c < 3; ++c)
        {
          low[c] -= margin;
          high[c] += margin;
        }
      return {low, high};
    }

    Tree make_tree(const SurfaceMesh &mesh)
    {
      std::vector<TreeValue> boxes;
      boxes.reserve(mesh.triangles.size());
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        boxes.emplace_back(bounding_box(mesh, t), t);
      return Tree(boxes.begin(), boxes.end());
    }

    /// Collects all pairs of triangles that meet, from seeds, by walking over edges that are crossed.
    class PairFront
    {
    public:
      PairFront(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar)
        : nonmortar(nonmortar)
        , mortar(mortar)
        , nonmortar_topology(nonmortar)
        , mortar_topology(mortar)
        , intersection(nonmortar, mortar)
        , met(nonmortar.triangles.size())
      {
        seed_from_mortar_vertices();
        advance();
        seed_from_nonmortar_vertices();
        advance();
      }

      /// Mortar triangles of each nonmortar triangle, with their common polygons.
      std::vector<std::vector<std::pair<unsigned int, PairIntersection::Polygon>>> polygons;

      std::vector<unsigned int> unmapped;

    private:
      void push(const unsigned int t, const unsigned int m)
      {
        auto &list = met[t];
        if (std::find(list.begin(), list.end(), m) == list.end())
          {
            list.push_back(m);
            front.emplace(t, m);
          }
      }

      /// Step 1 of the paper: lines from the mortar vertices along their normals, nearest admissible hit.
      void seed_from_mortar_vertices()
      {
        polygons.resize(nonmortar.triangles.size());
        if (nonmortar.triangles.empty() || mortar.triangles.empty())
          return;
        const Tree tree   = make_tree(nonmortar);
        const auto bounds = tree.bounds();
        for (unsigned int v = 0; v < mortar.vertices.size(); ++v)
          {
            // As far as the other surface reaches.
            double reach = 0.;
            for (unsigned int c = 0; c < 3; ++c)
              reach += std::max(std::abs(component(bounds.min_corner(), c) - mortar.vertices[v][c]),
                                std::abs(component(bounds.max_corner(), c) - mortar.vertices[v][c]));
            const Tensor<1, 3>                &n = mortar.vertex_normals[v];
            const bg::model::segment<Point<3>> line(mortar.vertices[v] - reach * n,
                                                    mortar.vertices[v] + reach * n);
            double                             nearest = std::numeric_limits<double>::max();
            int                                hit     = -1;
            for (auto it = tree.qbegin(bgi::intersects(line)); it != tree.qend(); ++it)
              {
                std::array<double, 3> w;
                double                eta;
                if (intersection.line_hits(w, eta, v, it->second) && std::abs(eta) < nearest)
                  {
                    nearest = std::abs(eta);
                    hit     = static_cast<int>(it->second);
                  }
              }
            if (hit < 0)
              unmapped.push_back(v);
            else
              for (unsigned int k = mortar_topology.fan_start[v]; k < mortar_topology.fan_start[v + 1]; ++k)
                push(hit, mortar_topology.fan[k]);
          }
      }

      /// Where the nonmortar surface lies inside of one mortar triangle no mortar vertex leads to it: try
      /// the mortar triangles nearest to the vertices of triangles that nothing has met yet.
      void seed_from_nonmortar_vertices()
      {
        if (nonmortar.triangles.empty() || mortar.triangles.empty())
          return;
        const Tree        tree = make_tree(mortar);
        std::vector<bool> tried(nonmortar.vertices.size(), false);
        for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
          if (polygons[t].empty())
            for (const unsigned int v : nonmortar.triangles[t])
              if (!tried[v])
                {
                  tried[v] = true;
                  std::vector<TreeValue> candidates;
                  tree.query(bgi::nearest(nonmortar.vertices[v], 8), std::back_inserter(candidates));
                  for (const TreeValue &candidate : candidates)
                    push(t, candidate.second);
                }
      }

      void advance()
      {
        while (!front.empty())
          {
            const auto [t, m] = front.front();
            front.pop();
            PairIntersection::Result result = intersection.compute(t, m);
            if (result.polygon.size() < 3)
              continue;
            // Corners on an edge: the triangles behind it meet as well (or touch, which costs one look).
            for (unsigned int e = 0; e < 3; ++e)
              {
                if (result.touches_nonmortar_edge[e] && nonmortar_topology.neighbours[t][e] >= 0)
                  push(nonmortar_topology.neighbours[t][e], m);
                if (result.touches_mortar_edge[e] && mortar_topology.neighbours[m][e] >= 0)
                  push(t, mortar_topology.neighbours[m][e]);
              }
            polygons[t].emplace_back(m, std::move(result.polygon));
          }
      }

      const SurfaceMesh                                &nonmortar, &mortar;
      const SurfaceTopology                             nonmortar_topology, mortar_topology;
      PairIntersection                                  intersection;
      std::vector<std::vector<unsigned int>>            met;
      std::queue<std::pair<unsigned int, unsigned int>> front;
    };
  } // namespace



  ContactMapping::ContactMapping(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                                 const std::function<bool(const unsigned int)> &is_selected)
  {
    PairFront front(nonmortar, mortar);
    summary.unmapped_mortar = std::move(front.unmapped);
    for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
      {
        if (is_selected && !is_selected(t))
          continue;
        const double area = triangle_area(nonmortar, t);
        double       sum  = 0.;
        summary.area_nonmortar += area;
        auto &list = front.polygons[t];
        std::sort(list.begin(), list.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
        for (const auto &[m, polygon] : list)
          {
            ++summary.n_pairs;
            for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
              {
                const auto &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
                // Twice the share of the triangle's area: the determinant of the barycentric coordinates.
                const double share = (b.nonmortar[1] - a.nonmortar[1]) * (c.nonmortar[2] - a.nonmortar[2]) -
                                     (b.nonmortar[2] - a.nonmortar[2]) * (c.nonmortar[1] - a.nonmortar[1]);
                if (std::abs(share) < 1e-15)
                  continue;
                cells.push_back(
                    {t, m, {{a.nonmortar, b.nonmortar, c.nonmortar}}, {{a.mortar, b.mortar, c.mortar}}});
                sum += std::abs(share) * area;
              }
          }
        summary.area_covered += sum;
        if (std::abs(sum - area) < 1e-6 * area)
          summary.worst_tiling_defect = std::max(summary.worst_tiling_defect, std::abs(sum - area) / area);
      }
    summary.n_cells = cells.size();
  }
} // namespace Signorini
