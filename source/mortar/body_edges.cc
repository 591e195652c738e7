// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "body_edges.h"

#include <signorini/mesh/surface_normals.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct BodyEdgeRule
    {
      /// Cosine of the turn of an edge.
      double sharp = .5;
      /// Distances of one place, in lengths of an edge.
      double same_place = 1e-6;
    };

    bool turns(const Vector3 &a, const Vector3 &b)
    {
      return a * b < BodyEdgeRule().sharp;
    }
  } // namespace



  BodyEdges::BodyEdges(const ContactSurface &surface)
    : surface(surface)
    , topology(surface.mesh.triangles, surface.mesh.vertices.size())
  {
    for (unsigned int e = 0; e < topology.edges.size(); ++e)
      if (topology.is_border(e))
        add_border(e);
      else
        add_inner(e);
  }



  BodyEdges::Nearest BodyEdges::find(const unsigned int triangle, const Point<3> &x,
                                     const double at_most) const
  {
    const Vector3 here = facet_normal(surface, triangle);
    Nearest       result{at_most, {}};
    for (const unsigned int v : topology.triangles[triangle])
      for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
        for (const unsigned int e : topology.triangle_edges[topology.fan[k]])
          if (const auto found = faces.find(e); found != faces.end())
            if (const double way = distance(x, e); way < result.distance)
              {
                const auto &[one, other] = found->second;
                result                   = {way, one * here < other * here ? one : other};
              }
    return result;
  }



  double BodyEdges::length(const unsigned int edge) const
  {
    const auto &[a, b] = topology.edges[edge];
    return surface.mesh.vertices[a].distance(surface.mesh.vertices[b]);
  }



  double BodyEdges::distance(const Point<3> &p, const unsigned int edge) const
  {
    const Point<3> &a     = surface.mesh.vertices[topology.edges[edge][0]];
    const Vector3   along = surface.mesh.vertices[topology.edges[edge][1]] - a;
    const double    s     = std::max(0., std::min(1., (p - a) * along / along.norm_square()));
    return (p - (a + s * along)).norm();
  }



  void BodyEdges::add_inner(const unsigned int edge)
  {
    const auto &[s, t]        = topology.edge_triangles[edge];
    const unsigned int corner = (topology.local_edge(t, edge) + 2) % 3;
    const Vector3      one = facet_normal(surface, s), other = facet_normal(surface, t);
    if (turns(one, other) && one * (surface.mesh.vertices[topology.triangles[t][corner]] -
                                    surface.mesh.vertices[topology.edges[edge][0]]) <
                                 0.)
      faces[edge] = {{one, other}};
  }



  /// Where the body turns beyond a border, and is not cut there by a plane in which it slides.
  void BodyEdges::add_border(const unsigned int edge)
  {
    const auto &[s, t]  = topology.edge_triangles[edge];
    const auto &[a, b]  = topology.edges[edge];
    const auto around_a = surface.beyond.find(a), around_b = surface.beyond.find(b);
    if (around_a == surface.beyond.end() || around_b == surface.beyond.end())
      return;
    const Vector3 here = facet_normal(surface, s != SurfaceTopology::none ? s : t);
    const auto   &x    = surface.mesh.vertices;
    for (const ContactSurface::Facet &one : around_a->second)
      for (const ContactSurface::Facet &other : around_b->second)
        if (((x[a] + one.way) - (x[b] + other.way)).norm() <= BodyEdgeRule().same_place * length(edge) &&
            turns(here, one.normal) && here * one.way < 0. &&
            !(surface.vertex_fixed[a].contains(one.normal) && surface.vertex_fixed[b].contains(one.normal)))
          faces[edge] = {{here, one.normal}};
  }
} // namespace Signorini
