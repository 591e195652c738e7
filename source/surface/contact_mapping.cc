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

    std::vector<bool> mortar_border(mortar_mesh.vertices.size(), false);
    for (unsigned int f = 0; f < mortar.edges.size(); ++f)
      if (mortar.is_border(f))
        for (const unsigned int v : mortar.edges[f])
          mortar_border[v] = true;

    for (unsigned int m = 0; m < mortar.triangles.size(); ++m)
      summary.area_mortar += incidence.mortar_normal[m].norm();

    // Visited as they lie beside each other, put in the order of the triangles afterwards.
    struct Found
    {
      unsigned int mortar_triangle, first, last;
    };
    std::vector<Found>                                 found;
    std::vector<unsigned int>                          found_corners;
    std::vector<std::pair<unsigned int, unsigned int>> found_in(nonmortar.triangles.size(), {0, 0});
    std::vector<bool>                                  is_done(nonmortar.triangles.size(), false);
    // About as many polygons as nodes, of four to five corners.
    found.reserve(graph.nodes.size() + graph.nodes.size() / 8);
    found_corners.reserve(5 * found.capacity());
    // Both triangles of an edge run through it in opposite directions: what they have of it adds up to
    // nothing.
    std::vector<double> balance(nonmortar.edges.size(), 0.);
    TrianglePolygons    polygons(incidence, graph, mortar_border);
    const auto          visit = [&](const unsigned int t) {
      polygons.compute(t);
      const double area = incidence.nonmortar_normal[t].norm();
      summary.area_nonmortar += area;
      summary.area_covered += polygons.covered * area;
      summary.n_broken += polygons.n_broken;
      summary.n_lost_triangles += polygons.is_lost();
      const bool is_wrong = polygons.is_lost() || polygons.n_broken > 0 ||
                            polygons.defect() > MappingReport::torn ||
                            std::any_of(polygons.list.begin(), polygons.list.end(),
                                                 [](const auto &polygon) { return polygon.share < -1e-12; });
      if (is_wrong)
        summary.wrong_triangles.push_back(t);
      for (const auto &side : polygons.sides)
        balance[side.edge] += side.length;
      summary.worst_tiling_defect = std::max(summary.worst_tiling_defect, polygons.defect());
      found_in[t].first           = static_cast<unsigned int>(found.size());
      for (const auto &polygon : polygons.list)
        {
          ++summary.n_pairs;
          summary.area_mortar_covered +=
              polygon.mortar_share * incidence.mortar_normal[polygon.mortar_triangle].norm();
          summary.n_flips += polygon.share < -1e-12;
          summary.n_cells += polygon.last - polygon.first - 2;
          const auto first = static_cast<unsigned int>(found_corners.size());
          found_corners.insert(found_corners.end(), polygons.corners.begin() + polygon.first,
                                        polygons.corners.begin() + polygon.last);
          found.push_back({polygon.mortar_triangle, first, static_cast<unsigned int>(found_corners.size())});
        }
      found_in[t].second = static_cast<unsigned int>(found.size());
    };
    for (const unsigned int v : spatial_order(nonmortar_mesh))
      for (unsigned int k = nonmortar.fan_start[v]; k < nonmortar.fan_start[v + 1]; ++k)
        if (const unsigned int t = nonmortar.fan[k]; !is_done[t])
          {
            is_done[t] = true;
            if (!is_selected || is_selected(t))
              visit(t);
          }

    for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
      if (!nonmortar.is_border(e))
        {
          const auto        &beside     = nonmortar.edge_triangles[e];
          const unsigned int n_selected = !is_selected ? 2 : is_selected(beside[0]) + is_selected(beside[1]);
          if (n_selected == 2 && std::abs(balance[e]) > MappingReport::torn)
            {
              ++summary.n_torn_edges;
              summary.torn_edges.push_back(e);
            }
          else if (n_selected == 1)
            summary.open_edges.emplace_back(e, balance[e]);
        }

    polygon_triangles.reserve(found.size());
    polygon_start.reserve(found.size() + 1);
    polygon_corners.reserve(found_corners.size());
    for (unsigned int t = 0; t < nonmortar.triangles.size(); ++t)
      for (unsigned int i = found_in[t].first; i < found_in[t].second; ++i)
        {
          polygon_triangles.emplace_back(t, found[i].mortar_triangle);
          polygon_corners.insert(polygon_corners.end(), found_corners.begin() + found[i].first,
                                 found_corners.begin() + found[i].last);
          polygon_start.push_back(static_cast<unsigned int>(polygon_corners.size()));
        }
    graph_nodes = std::move(graph.nodes);
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
