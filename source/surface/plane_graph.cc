// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "plane_graph_walk.h"

#include <signorini/surface/box_tree.h>
#include <signorini/surface/normal_projection.h>

namespace Signorini
{
  using namespace dealii;
  using On = SurfacePoint::On;

  namespace
  {
    /// Lists of the nodes on each entity of one kind.
    void group(std::vector<unsigned int> &start, std::vector<unsigned int> &list,
               const std::vector<MappingNode> &nodes, const On kind, const std::size_t n_entities)
    {
      start.assign(n_entities + 1, 0);
      for (const MappingNode &node : nodes)
        if (node.nonmortar.on == kind)
          ++start[node.nonmortar.index + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      list.resize(start.back());
      std::vector<unsigned int> next(start.begin(), start.end() - 1);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (nodes[i].nonmortar.on == kind)
          list[next[nodes[i].nonmortar.index]++] = i;
    }
  } // namespace



  PlaneGraph::PlaneGraph(Incidence &incidence, const PartRegion &region, const MPI_Comm communicator)
    : nonmortar_vertex_node(incidence.nonmortar.vertices.size(), none)
    , mortar_vertex_node(incidence.mortar.vertices.size(), none)
    , incidence(incidence)
    , region(region)
    , nonmortar(incidence.nonmortar_topology)
    , mortar(incidence.mortar_topology)
  {
    if (!nonmortar.triangles.empty() && !mortar.triangles.empty())
      {
        mortar_order = spatial_order(incidence.mortar);
        has_layers   = may_lie_over_itself();
        select_mortar_edges(communicator);
        map_mortar_vertices();
        trace_mortar_edges();
      }
    low_side.resize(nodes.size(), 0);
    group(edge_start, edge_nodes, nodes, On::edge, nonmortar.edges.size());
    group(triangle_start, triangle_nodes, nodes, On::triangle, nonmortar.triangles.size());
    for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
      if (edge_start[e + 1] - edge_start[e] > 1)
        std::sort(edge_nodes.begin() + edge_start[e], edge_nodes.begin() + edge_start[e + 1],
                  [&](const unsigned int a, const unsigned int b) {
                    const double ta = nodes[a].nonmortar.x[0], tb = nodes[b].nonmortar.x[0];
                    return ta != tb ? ta < tb : a < b;
                  });
    if (!nonmortar.triangles.empty() && !mortar.triangles.empty())
      map_nonmortar_vertices();
  }



  PlaneGraph::~PlaneGraph() = default;



  bool PlaneGraph::is_hit(SurfacePoint &place, double &eta, const unsigned int vertex,
                          const unsigned int triangle) const
  {
    const auto           &edges = nonmortar.triangle_edges[triangle];
    const auto           &t     = nonmortar.triangles[triangle];
    std::array<double, 3> w;
    if (!NormalProjection::intersect_line(w, eta, incidence.mortar.vertices[vertex],
                                          incidence.mortar.vertex_normals[vertex],
                                          corners_of(incidence.nonmortar, triangle)))
      return false;
    for (const unsigned int corner : t)
      if (incidence.is_at(vertex, corner))
        {
          place = SurfacePoint::at_vertex(corner);
          return true;
        }
    int    on_edge  = -1;
    double position = 0.;
    for (unsigned int e = 0; e < 3; ++e)
      {
        const Incidence::Side s     = incidence.of_mortar_vertex(vertex, edges[e]);
        const bool            along = t[e] == nonmortar.edges[edges[e]][0];
        if ((along ? s.sign : -s.sign) < 0)
          return false;
        if (s.sign == 0)
          {
            on_edge  = static_cast<int>(e);
            position = s.position;
          }
      }
    if (on_edge >= 0)
      {
        if (position < 0. || position > 1.)
          return false;
        place = SurfacePoint::on_edge(edges[on_edge], position);
      }
    else
      place = SurfacePoint::in_triangle(triangle, w);
    return true;
  }



  void PlaneGraph::select_mortar_edges(const MPI_Comm communicator)
  {
    const std::size_t n       = mortar_order.size();
    const bool        alone   = communicator == MPI_COMM_SELF;
    const std::size_t rank    = alone ? 0 : Utilities::MPI::this_mpi_process(communicator),
                      n_ranks = alone ? 1 : Utilities::MPI::n_mpi_processes(communicator);
    vertex_is_in_share.assign(n, n_ranks == 1);
    for (std::size_t i = rank * n / n_ranks; i < (rank + 1) * n / n_ranks; ++i)
      vertex_is_in_share[mortar_order[i]] = true;

    edge_is_needed.assign(mortar.edges.size(), region.is_everything());
    vertex_is_needed.assign(n, region.is_everything());
    std::size_t n_needed = region.is_everything() ? n : 0;
    if (!region.is_everything())
      for (unsigned int f = 0; f < mortar.edges.size(); ++f)
        {
          const auto [a, b] = mortar.edges[f];
          const auto &x     = incidence.mortar.vertices;
          const auto &n     = incidence.mortar.vertex_normals;
          edge_is_needed[f] = region.meets_curtain(x[a], n[a], x[b], n[b]);
          // Neighbours tell why a vertex of the share has no image.
          if (edge_is_needed[f] || vertex_is_in_share[a] || vertex_is_in_share[b])
            for (const unsigned int v : {a, b})
              if (!vertex_is_needed[v])
                {
                  vertex_is_needed[v] = true;
                  ++n_needed;
                }
        }
    nodes.reserve(5 * (n_needed + nonmortar_vertex_node.size() * n_needed / n));
  }



  PlaneGraph::Hit PlaneGraph::nearest_hit(const unsigned int               vertex,
                                          const std::vector<unsigned int> &candidates) const
  {
    Hit    result;
    double nearest = std::numeric_limits<double>::max();
    for (const unsigned int t : candidates)
      {
        // Turned triangles have all sides reversed: they are no hit by themselves.
        SurfacePoint place;
        double       eta;
        if (!incidence.vertex_faces(vertex, t))
          result.turned_away = true;
        else if (is_hit(place, eta, vertex, t) && std::abs(eta) < nearest)
          {
            nearest      = std::abs(eta);
            result.eta   = eta;
            result.place = place;
          }
      }
    return result;
  }



  Unmapped PlaneGraph::map_mortar_vertex(const unsigned int v, const Hit &hit)
  {
    const SurfacePoint &place = hit.place;
    if (place.on == On::nothing)
      return hit.turned_away ? Unmapped::wrong_side : Unmapped::no_hit;
    if (has_layers && is_behind(incidence.mortar.vertices[v], incidence.mortar.vertex_normals[v], hit.eta,
                                Incidence::near_end * incidence.size_at_mortar_vertex(v)))
      return Unmapped::behind;
    mortar_vertex_node[v] = static_cast<unsigned int>(nodes.size());
    if (place.on == On::vertex)
      {
        if (nonmortar_vertex_node[place.index] == none)
          nonmortar_vertex_node[place.index] = mortar_vertex_node[v];
        incidence.move_mortar_vertex(v, incidence.nonmortar.vertices[place.index]);
      }
    else if (place.on == On::edge)
      {
        const auto     &e = nonmortar.edges[place.index];
        const Point<3> &a = incidence.nonmortar.vertices[e[0]], &b = incidence.nonmortar.vertices[e[1]];
        incidence.move_mortar_vertex(v, a + place.x[0] * (b - a));
      }
    nodes.push_back({place, SurfacePoint::at_vertex(v)});
    return Unmapped::not_at_all;
  }



  void PlaneGraph::map_mortar_vertices()
  {
    std::vector<Unmapped> state(mortar_order.size(), Unmapped::not_at_all);
    nonmortar_tree = std::make_unique<BoxTree>(tree_of_triangles(incidence.nonmortar));
    std::vector<unsigned int> candidates;
    for (const unsigned int v : mortar_order)
      if (vertex_is_needed[v] && mortar.fan_start[v] < mortar.fan_start[v + 1])
        {
          nonmortar_tree->find_along_line(candidates, incidence.mortar.vertices[v],
                                          incidence.mortar.vertex_normals[v]);
          state[v] = map_mortar_vertex(v, nearest_hit(v, candidates));
        }
    for (const auto &e : mortar.edges)
      for (unsigned int i = 0; i < 2; ++i)
        if (mortar_vertex_node[e[i]] == none && mortar_vertex_node[e[1 - i]] != none &&
            state[e[i]] == Unmapped::no_hit)
          state[e[i]] = Unmapped::outside_rim;
    for (unsigned int v = 0; v < state.size(); ++v)
      if (vertex_is_in_share[v] && state[v] != Unmapped::not_at_all)
        unmapped.emplace_back(v, state[v]);
  }
} // namespace Signorini
