// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "triangle_polygons.h"

namespace Signorini
{
  namespace
  {
    using On       = SurfacePoint::On;
    using Position = CommonPolygon::Position;

    /// Where a point lies on the border of a triangle, counterclockwise.
    Position position_on(const SurfaceTopology &topology, const unsigned int triangle, const SurfacePoint &p)
    {
      if (p.on == On::vertex)
        return {static_cast<int>(2 * topology.local_corner(triangle, p.index)), 0.};
      if (p.on == On::edge)
        {
          const unsigned int i     = topology.local_edge(triangle, p.index);
          const bool         along = topology.triangles[triangle][i] == topology.edges[p.index][0];
          return {static_cast<int>(2 * i + 1), along ? p.x[0] : -p.x[0]};
        }
      return {};
    }

    Position turned(const Position &p)
    {
      return p.feature < 0 ? p : Position{(6 - p.feature) % 6, -p.along};
    }

    void add_incident(std::vector<TrianglePolygons::Incident> &list, const SurfaceTopology &mortar,
                      const MappingNode &node, const unsigned int index)
    {
      const SurfacePoint &p = node.mortar;
      if (p.on == On::triangle)
        list.push_back({p.index, index});
      else if (p.on == On::edge)
        {
          for (const unsigned int m : mortar.edge_triangles[p.index])
            if (m != SurfaceTopology::none)
              list.push_back({m, index});
        }
      else
        for (unsigned int k = mortar.fan_start[p.index]; k < mortar.fan_start[p.index + 1]; ++k)
          list.push_back({mortar.fan[k], index});
    }

    /// Twice the signed part of the triangle that a polygon covers.
    double share_of(const std::vector<std::array<double, 2>> &x)
    {
      double share = 0.;
      for (std::size_t i = 1; i + 1 < x.size(); ++i)
        share +=
            (x[i][0] - x[0][0]) * (x[i + 1][1] - x[0][1]) - (x[i][1] - x[0][1]) * (x[i + 1][0] - x[0][0]);
      return share;
    }

    bool lies_on(const SurfaceTopology &topology, const SurfacePoint &p, const unsigned int edge)
    {
      return (p.on == On::edge && p.index == edge) ||
             (p.on == On::vertex &&
              (p.index == topology.edges[edge][0] || p.index == topology.edges[edge][1]));
    }
  } // namespace



  void TrianglePolygons::compute(const unsigned int t)
  {
    list.clear();
    corners.clear();
    incident.clear();
    sides.clear();
    triangle       = t;
    faces_any      = false;
    touches_any    = false;
    covered        = 0.;
    n_broken       = 0;
    is_covered_all = true;
    for (unsigned int i = 0; i < 3; ++i)
      {
        if (const unsigned int node = graph.nonmortar_vertex_node[nonmortar.triangles[t][i]];
            node != SurfaceTopology::none)
          add(node);
        else
          is_covered_all = false;
        const unsigned int e = nonmortar.triangle_edges[t][i];
        for (unsigned int k = graph.edge_start[e]; k < graph.edge_start[e + 1]; ++k)
          add(graph.edge_nodes[k]);
      }
    for (unsigned int k = graph.triangle_start[t]; k < graph.triangle_start[t + 1]; ++k)
      add(graph.triangle_nodes[k]);
    std::sort(incident.begin(), incident.end());
    for (std::size_t first = 0, last; first < incident.size(); first = last)
      {
        const unsigned int m = incident[first].mortar_triangle;
        for (last = first + 1; last < incident.size() && incident[last].mortar_triangle == m;)
          ++last;
        if (!meet(t, m, first, last))
          continue;
        faces_any   = true;
        touches_any = touches_any || !incidence.triangles_turn_away(t, m);
        if (last - first >= 3)
          add_polygon(t, m, first, last);
      }
  }



  // The paths of the plane graph go where the normals of the mortar surface lead them: at its creases these
  // are not those of its triangles.
  bool TrianglePolygons::meet(const unsigned int t, const unsigned int m, const std::size_t first,
                              const std::size_t last) const
  {
    return incidence.triangles_face(t, m) ||
           std::all_of(incident.begin() + static_cast<std::ptrdiff_t>(first),
                       incident.begin() + static_cast<std::ptrdiff_t>(last), [&](const Incident &i) {
                         return incidence.point_faces(t, m, graph.nodes[i.node].mortar);
                       });
  }



  void TrianglePolygons::add(const unsigned int node)
  {
    const SurfacePoint &p = graph.nodes[node].mortar;
    if ((p.on == On::edge && mortar.is_border(p.index)) || (p.on == On::vertex && mortar_border[p.index]))
      is_covered_all = false;
    add_incident(incident, mortar, graph.nodes[node], node);
  }



  void TrianglePolygons::add_polygon(const unsigned int t, const unsigned int m, const std::size_t first,
                                     const std::size_t last)
  {
    unsorted.clear();
    for (std::size_t k = first; k < last; ++k)
      {
        const MappingNode &node = graph.nodes[incident[k].node];
        unsorted.push_back({incident[k].node, position_on(nonmortar, t, node.nonmortar),
                            turned(position_on(mortar, m, node.mortar))});
      }
    if (!sorter.sort(unsorted))
      {
        ++n_broken;
        return;
      }
    flat.clear();
    for (const auto &corner : unsorted)
      {
        const auto w = graph.nodes[corner.node].nonmortar.weights_in(nonmortar, t);
        flat.push_back({{w[1], w[2]}});
      }
    add_sides(t, m);
    // Triangles that only touch have no area in common.
    const double share = share_of(flat);
    if (std::abs(share) < 1e-15)
      return;
    covered += share;
    flat.clear();
    for (const auto &corner : unsorted)
      {
        const auto w = graph.nodes[corner.node].mortar.weights_in(mortar, m);
        flat.push_back({{w[1], w[2]}});
      }
    const auto begin = static_cast<std::ptrdiff_t>(corners.size());
    for (const auto &corner : unsorted)
      corners.push_back(corner.node);
    list.push_back({m, share, -share_of(flat), begin, static_cast<std::ptrdiff_t>(corners.size())});
  }



  // What the neighbour beyond the edge has to have as well: not where the mortar surface ends, nor what
  // the neighbour does not face.
  void TrianglePolygons::add_sides(const unsigned int t, const unsigned int m)
  {
    for (std::size_t k = 0; k < unsorted.size(); ++k)
      {
        const MappingNode &a = graph.nodes[unsorted[k].node],
                          &b = graph.nodes[unsorted[(k + 1) % unsorted.size()].node];
        for (const unsigned int e : nonmortar.triangle_edges[t])
          {
            if (nonmortar.is_border(e) || !lies_on(nonmortar, a.nonmortar, e) ||
                !lies_on(nonmortar, b.nonmortar, e))
              continue;
            const auto        &beside    = nonmortar.edge_triangles[e];
            const unsigned int neighbour = beside[beside[0] == t ? 1 : 0];
            bool               skip =
                !incidence.triangles_face(neighbour, m) && !(incidence.point_faces(neighbour, m, a.mortar) &&
                                                             incidence.point_faces(neighbour, m, b.mortar));
            for (const unsigned int f : mortar.triangle_edges[m])
              skip = skip ||
                     (mortar.is_border(f) && lies_on(mortar, a.mortar, f) && lies_on(mortar, b.mortar, f));
            if (!skip)
              sides.push_back({e, parameter_on(b.nonmortar, e) - parameter_on(a.nonmortar, e)});
          }
      }
  }



  double TrianglePolygons::parameter_on(const SurfacePoint &p, const unsigned int edge) const
  {
    return p.on == On::edge ? p.x[0] : (p.index == nonmortar.edges[edge][0] ? 0. : 1.);
  }
} // namespace Signorini
