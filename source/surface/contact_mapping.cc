// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "triangle_polygons.h"

#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/tensor.h>

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



  void MappingReport::add_edge(const OpenEdge &sides)
  {
    if (std::abs(sides.excess) <= torn)
      return;
    if (!sides.can_touch)
      {
        ++n_turned_away;
        return;
      }
    if (std::abs(sides.excess) <= slight || sides.are_tiled)
      {
        ++n_slight;
        return;
      }
    ++n_torn_edges;
    torn_edges.push_back(sides.edge);
  }



  namespace
  {
    using Selection = std::function<bool(const unsigned int)>;

    /// Polygons with a smaller part of their triangle are turned.
    constexpr double turned_share = -1e-12;

    std::vector<bool> border_vertices(const SurfaceTopology &surface)
    {
      std::vector<bool> result(surface.fan_start.size() - 1, false);
      for (unsigned int f = 0; f < surface.edges.size(); ++f)
        if (surface.is_border(f))
          for (const unsigned int v : surface.edges[f])
            result[v] = true;
      return result;
    }



    /// Visits the selected triangles as they lie beside each other.
    template <typename Visit>
    void visit_triangles(const SurfaceMesh &mesh, const SurfaceTopology &topology,
                         const Selection &is_selected, const Visit &visit)
    {
      std::vector<bool> is_done(topology.triangles.size(), false);
      for (const unsigned int v : spatial_order(mesh))
        for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
          if (const unsigned int t = topology.fan[k]; !is_done[t])
            {
              is_done[t] = true;
              if (!is_selected || is_selected(t))
                visit(t);
            }
    }



    /// Adds what a nonmortar triangle and its polygons cover.
    void add_area(MappingReport &report, const TrianglePolygons &polygons, const unsigned int t,
                  const Incidence &incidence)
    {
      const double area = incidence.nonmortar_normal[t].norm();
      report.area_nonmortar += area;
      report.area_covered += polygons.covered * area;
      for (const auto &polygon : polygons.list)
        {
          ++report.n_pairs;
          report.area_mortar_covered +=
              polygon.mortar_share * incidence.mortar_normal[polygon.mortar_triangle].norm();
          report.n_cells += polygon.last - polygon.first - 2;
        }
    }



    /// Adds what is wrong with a nonmortar triangle.
    void add_errors(MappingReport &report, const TrianglePolygons &polygons, const unsigned int t)
    {
      const auto n_flips  = std::count_if(polygons.list.begin(), polygons.list.end(),
                                          [](const auto &polygon) { return polygon.share < turned_share; });
      const bool is_wrong = polygons.is_lost() || polygons.n_broken > 0 || n_flips > 0 ||
                            polygons.defect() > MappingReport::torn;
      if (is_wrong && (polygons.is_lost() || !polygons.list.empty()) && !polygons.can_touch())
        {
          ++report.n_turned_away;
          return;
        }
      report.worst_tiling_defect = std::max(report.worst_tiling_defect, polygons.defect());
      const auto is_slight = [](const auto &polygon) { return polygon.share >= -MappingReport::slight; };
      if (is_wrong && !polygons.is_lost() && polygons.n_broken == 0 &&
          polygons.defect() <= MappingReport::slight &&
          std::all_of(polygons.list.begin(), polygons.list.end(), is_slight))
        {
          ++report.n_slight;
          return;
        }
      report.n_flips += n_flips;
      report.n_broken += polygons.n_broken;
      report.n_lost_triangles += polygons.is_lost();
      if (is_wrong)
        report.wrong_triangles.push_back(t);
    }



    /// Both triangles of an edge run through it in opposite directions: what they have of it adds up to
    /// nothing.
    /// @param balance these sums, by edge
    /// @param can_touch, is_tiled by triangle
    void find_torn_edges(MappingReport &report, const SurfaceTopology &nonmortar,
                         const std::vector<double> &balance, const std::vector<bool> &can_touch,
                         const std::vector<bool> &is_tiled, const Selection &is_selected)
    {
      for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
        if (!nonmortar.is_border(e))
          {
            const auto        &beside = nonmortar.edge_triangles[e];
            const unsigned int n_selected =
                !is_selected ? 2 : is_selected(beside[0]) + is_selected(beside[1]);
            const auto is_unknown = [&](const unsigned int t) { return is_selected && !is_selected(t); };
            const MappingReport::OpenEdge edge = {e, balance[e], can_touch[beside[0]] || can_touch[beside[1]],
                                                  (is_tiled[beside[0]] || is_unknown(beside[0])) &&
                                                      (is_tiled[beside[1]] || is_unknown(beside[1]))};
            if (n_selected == 2)
              report.add_edge(edge);
            else if (n_selected == 1)
              report.open_edges.push_back(edge);
          }
    }



    /// The polygons as the triangles are visited, to be put in the order of these.
    class VisitedPolygons
    {
    public:
      /// @param n_nodes of the plane graph: there are about as many polygons, of four to five corners
      VisitedPolygons(const std::size_t n_triangles, const std::size_t n_nodes)
        : in_triangle(n_triangles, {0, 0})
      {
        list.reserve(n_nodes + n_nodes / 8);
        corners.reserve(5 * list.capacity());
      }

      void add(const TrianglePolygons &polygons, const unsigned int t)
      {
        in_triangle[t].first = list.size();
        for (const auto &polygon : polygons.list)
          {
            const std::size_t first = corners.size();
            corners.insert(corners.end(), polygons.corners.begin() + polygon.first,
                           polygons.corners.begin() + polygon.last);
            list.push_back({polygon.mortar_triangle, static_cast<unsigned int>(first),
                            static_cast<unsigned int>(corners.size())});
          }
        in_triangle[t].second = list.size();
      }

      void put_in_order(ContactMapping &mapping) const
      {
        mapping.polygon_triangles.reserve(list.size());
        mapping.polygon_start.reserve(list.size() + 1);
        mapping.polygon_corners.reserve(corners.size());
        for (unsigned int t = 0; t < in_triangle.size(); ++t)
          for (std::size_t i = in_triangle[t].first; i < in_triangle[t].second; ++i)
            {
              mapping.polygon_triangles.emplace_back(t, list[i].mortar_triangle);
              mapping.polygon_corners.insert(mapping.polygon_corners.end(), corners.begin() + list[i].first,
                                             corners.begin() + list[i].last);
              mapping.polygon_start.push_back(static_cast<unsigned int>(mapping.polygon_corners.size()));
            }
      }

    private:
      struct Polygon
      {
        unsigned int mortar_triangle, first, last;
      };
      std::vector<Polygon>                             list;
      std::vector<unsigned int>                        corners;
      std::vector<std::pair<std::size_t, std::size_t>> in_triangle;
    };
  } // namespace



  ContactMapping::ContactMapping(const SurfaceMesh &nonmortar_mesh, const SurfaceMesh &mortar_mesh,
                                 const std::function<bool(const unsigned int)> &is_selected,
                                 const MPI_Comm                                 communicator)
    : polygon_start(1, 0)
    , nonmortar(nonmortar_mesh.triangles, nonmortar_mesh.vertices.size())
    , mortar(mortar_mesh.triangles, mortar_mesh.vertices.size())
  {
    Incidence        incidence(nonmortar_mesh, mortar_mesh, nonmortar, mortar);
    const PartRegion region(incidence.nonmortar, is_selected);
    PlaneGraph       graph(incidence, region, communicator);
    summary.lost_edges  = std::move(graph.lost_edges);
    summary.n_conflicts = nonmortar.n_conflicts + mortar.n_conflicts;
    summary.unmapped    = std::move(graph.unmapped);
    for (unsigned int m = 0; m < mortar.triangles.size(); ++m)
      summary.area_mortar += incidence.mortar_normal[m].norm();

    const std::vector<bool> mortar_border = border_vertices(mortar);
    TrianglePolygons        polygons(incidence, graph, mortar_border);
    VisitedPolygons         visited(nonmortar.triangles.size(), graph.nodes.size());
    std::vector<double>     balance(nonmortar.edges.size(), 0.);
    std::vector<bool>       can_touch(nonmortar.triangles.size(), false), is_tiled(can_touch);
    visit_triangles(nonmortar_mesh, nonmortar, is_selected, [&](const unsigned int t) {
      polygons.compute(t);
      can_touch[t] = polygons.can_touch();
      is_tiled[t]  = polygons.is_tiled(MappingReport::slight);
      add_area(summary, polygons, t, incidence);
      add_errors(summary, polygons, t);
      for (const auto &side : polygons.sides)
        balance[side.edge] += side.length;
      visited.add(polygons, t);
    });
    find_torn_edges(summary, nonmortar, balance, can_touch, is_tiled, is_selected);
    visited.put_in_order(*this);
    graph_nodes = std::move(graph.nodes);
  }



  namespace
  {
    /// A place that lies in a part of a surface.
    SurfacePoint place_in_part(SurfacePoint place, const SurfacePart &part, const Renumbering &edges)
    {
      if (place.on == SurfacePoint::On::vertex)
        place.index = part.vertices[place.index];
      else if (place.on == SurfacePoint::On::edge)
        place.index = edges[place.index];
      else if (place.on == SurfacePoint::On::triangle)
        place.index = part.triangles[place.index];
      return place;
    }
  } // namespace



  ContactMapping::ContactMapping(const ContactMapping &whole, const SurfacePart &nonmortar_part,
                                 const SurfacePart &mortar_part)
    : polygon_triangles(whole.polygon_triangles)
    , polygon_start(whole.polygon_start)
    , polygon_corners(whole.polygon_corners)
    , nonmortar(whole.nonmortar, nonmortar_part, whole.nonmortar.edges_of(nonmortar_part.triangles))
    , mortar(whole.mortar, mortar_part, whole.mortar.edges_of(mortar_part.triangles))
    , summary(whole.summary)
  {
    for (auto &[t, m] : polygon_triangles)
      {
        t = nonmortar_part.triangles[t];
        m = mortar_part.triangles[m];
        Assert(t != Renumbering::none && m != Renumbering::none, ExcInternalError());
      }
    keep_nodes(
        whole, {{&nonmortar_part, &mortar_part}},
        {{whole.nonmortar.edges_of(nonmortar_part.triangles), whole.mortar.edges_of(mortar_part.triangles)}});
  }



  void ContactMapping::keep_nodes(const ContactMapping                     &whole,
                                  const std::array<const SurfacePart *, 2> &parts,
                                  const std::array<Renumbering, 2>         &edges_of_parts)
  {
    std::vector<bool> is_used(whole.graph_nodes.size(), false);
    for (const unsigned int node : polygon_corners)
      is_used[node] = true;
    const Renumbering numbers(is_used);
    graph_nodes = numbers.select(whole.graph_nodes);
    for (unsigned int &node : polygon_corners)
      node = numbers[node];
    for (MappingNode &node : graph_nodes)
      node = {place_in_part(node.nonmortar, *parts[0], edges_of_parts[0]),
              place_in_part(node.mortar, *parts[1], edges_of_parts[1])};
  }



  void ContactMapping::leave_out(const std::vector<bool> &polygons)
  {
    AssertDimension(polygons.size(), n_polygons());
    std::vector<std::pair<unsigned int, unsigned int>> triangles;
    std::vector<unsigned int>                          start(1, 0), corners;
    for (std::size_t i = 0; i < polygons.size(); ++i)
      if (!polygons[i])
        {
          triangles.push_back(polygon_triangles[i]);
          corners.insert(corners.end(), polygon_corners.begin() + polygon_start[i],
                         polygon_corners.begin() + polygon_start[i + 1]);
          start.push_back(static_cast<unsigned int>(corners.size()));
        }
    polygon_triangles.swap(triangles);
    polygon_start.swap(start);
    polygon_corners.swap(corners);
    by_mortar_start.clear();
    by_mortar.clear();
  }



  void ContactMapping::triangulate(std::vector<OverlayTriangle> &triangles, const std::size_t polygon) const
  {
    const auto [t, m] = polygon_triangles[polygon];
    std::vector<std::array<double, 2>> flat;
    for (unsigned int k = polygon_start[polygon]; k < polygon_start[polygon + 1]; ++k)
      {
        const auto w = graph_nodes[polygon_corners[k]].nonmortar.weights_in(nonmortar, t);
        flat.push_back({{w[1], w[2]}});
      }
    std::vector<std::array<unsigned int, 3>> pieces;
    triangulate_polygon(pieces, flat);
    for (const auto &piece : pieces)
      {
        OverlayTriangle cell;
        cell.nonmortar_triangle = t;
        cell.mortar_triangle    = m;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const MappingNode &node = graph_nodes[polygon_corners[polygon_start[polygon] + piece[c]]];
            cell.nonmortar[c]       = node.nonmortar.weights_in(nonmortar, t);
            cell.mortar[c]          = node.mortar.weights_in(mortar, m);
          }
        if (std::abs(cell.share()) >= 1e-15)
          triangles.push_back(cell);
      }
  }



  std::vector<OverlayTriangle> ContactMapping::overlay() const
  {
    std::vector<OverlayTriangle> triangles;
    triangles.reserve(summary.n_cells);
    for (std::size_t i = 0; i < n_polygons(); ++i)
      triangulate(triangles, i);
    return triangles;
  }



  SurfacePoint ContactMapping::locate(const std::vector<unsigned int> &order, const std::size_t first,
                                      const std::size_t last, const std::array<double, 3> &weights,
                                      const bool to_mortar) const
  {
    // The triangle in which the smallest coordinate of the point is largest: at least 0 inside.
    std::vector<OverlayTriangle> triangles;
    for (std::size_t i = first; i < last; ++i)
      triangulate(triangles, order.empty() ? i : order[i]);
    double       best = -1e-10;
    SurfacePoint result;
    for (const OverlayTriangle &cell : triangles)
      {
        const auto &from = to_mortar ? cell.nonmortar : cell.mortar,
                   &to   = to_mortar ? cell.mortar : cell.nonmortar;
        const double ux = from[1][1] - from[0][1], uy = from[1][2] - from[0][2], vx = from[2][1] - from[0][1],
                     vy = from[2][2] - from[0][2], px = weights[1] - from[0][1], py = weights[2] - from[0][2];
        const double det = ux * vy - uy * vx;
        if (det == 0.)
          continue;
        const double b = (px * vy - py * vx) / det, c = (ux * py - uy * px) / det, a = 1. - b - c;
        if (const double smallest = std::min(a, std::min(b, c)); smallest > best)
          {
            best = smallest;
            std::array<double, 3> w;
            for (unsigned int k = 0; k < 3; ++k)
              w[k] = a * to[0][k] + b * to[1][k] + c * to[2][k];
            result = SurfacePoint::in_triangle(to_mortar ? cell.mortar_triangle : cell.nonmortar_triangle, w);
          }
      }
    return result;
  }



  SurfacePoint ContactMapping::image(const unsigned int t, const std::array<double, 3> &weights) const
  {
    const auto range =
        std::equal_range(polygon_triangles.begin(), polygon_triangles.end(), std::make_pair(t, 0u),
                         [](const auto &a, const auto &b) { return a.first < b.first; });
    return locate({}, range.first - polygon_triangles.begin(), range.second - polygon_triangles.begin(),
                  weights, true);
  }



  SurfacePoint ContactMapping::preimage(const unsigned int m, const std::array<double, 3> &weights) const
  {
    if (by_mortar_start.empty())
      {
        by_mortar_start.assign(mortar.triangles.size() + 1, 0);
        for (const auto &pair : polygon_triangles)
          ++by_mortar_start[pair.second + 1];
        std::partial_sum(by_mortar_start.begin(), by_mortar_start.end(), by_mortar_start.begin());
        by_mortar.resize(polygon_triangles.size());
        std::vector<unsigned int> next(by_mortar_start.begin(), by_mortar_start.end() - 1);
        for (unsigned int i = 0; i < polygon_triangles.size(); ++i)
          by_mortar[next[polygon_triangles[i].second]++] = i;
      }
    return locate(by_mortar, by_mortar_start[m], by_mortar_start[m + 1], weights, false);
  }
} // namespace Signorini
