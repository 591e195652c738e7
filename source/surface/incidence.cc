// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/incidence.h>
#include <signorini/surface/normal_projection.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;
  using NormalProjection::OrientedEdge;

  namespace
  {
    /// Surfaces that can touch face each other: the cosine of their normals is below this.
    constexpr double facing_cosine = -.1;

    bool facing(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      const double product = a * b;
      return product < 0. &&
             product * product > facing_cosine * facing_cosine * a.norm_square() * b.norm_square();
    }

    Tensor<1, 3> normal_of(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      const auto &t = mesh.triangles[triangle];
      return cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                              mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    }

    OrientedEdge edge_of(const SurfaceMesh &mesh, const std::array<unsigned int, 2> &e)
    {
      return {mesh.vertices[e[0]], mesh.vertices[e[1]], mesh.vertex_normals[e[0]], mesh.vertex_normals[e[1]]};
    }

    std::vector<double> shortest_edges(const SurfaceMesh &mesh, const SurfaceTopology &topology)
    {
      std::vector<double> size(mesh.vertices.size(), std::numeric_limits<double>::max());
      for (const auto &e : topology.edges)
        {
          const double length = mesh.vertices[e[0]].distance(mesh.vertices[e[1]]);
          size[e[0]]          = std::min(size[e[0]], length);
          size[e[1]]          = std::min(size[e[1]], length);
        }
      return size;
    }

    Incidence::Side decide(const double distance, const double position, const double size)
    {
      const bool on_it = std::abs(distance) <= NormalProjection::incidence_tolerance * size;
      return {on_it ? 0 : (distance > 0. ? 1 : -1), distance, position};
    }
  } // namespace



  Incidence::Incidence(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                       const SurfaceTopology &nonmortar_topology, const SurfaceTopology &mortar_topology)
    : nonmortar(nonmortar)
    , mortar(mortar)
    , nonmortar_topology(nonmortar_topology)
    , mortar_topology(mortar_topology)
    , nonmortar_size(shortest_edges(nonmortar, nonmortar_topology))
    , mortar_size(shortest_edges(mortar, mortar_topology))
  {
  }



  Incidence::Side Incidence::of_mortar_vertex(const unsigned int vertex, const unsigned int edge) const
  {
    const OrientedEdge e = edge_of(nonmortar, nonmortar_topology.edges[edge]);
    double             position;
    const double distance = NormalProjection::distance_from_edge(mortar.vertices[vertex],
                                                                 mortar.vertex_normals[vertex], e, position);
    return decide(distance, position, std::min(mortar_size[vertex], e.a.distance(e.b)));
  }



  Incidence::Side Incidence::of_nonmortar_vertex(const unsigned int vertex, const unsigned int edge) const
  {
    const OrientedEdge e = edge_of(mortar, mortar_topology.edges[edge]);
    double             position;
    const double       distance =
        NormalProjection::distance_from_curtain(nonmortar.vertices[vertex], e, position);
    return decide(distance, position, std::min(nonmortar_size[vertex], e.a.distance(e.b)));
  }



  bool Incidence::cross(double &t, double &s, const unsigned int nonmortar_edge,
                        const unsigned int mortar_edge, const Side &low, const Side &high) const
  {
    const double share   = low.distance - high.distance;
    const double t_guess = share != 0. ? low.distance / share : .5;
    const double s_guess = (1. - t_guess) * low.position + t_guess * high.position;
    t                    = t_guess;
    s                    = s_guess;
    // A little outside is rounding; far outside Newton has run away, or there is no crossing.
    constexpr double outside = 1e-6;
    const bool       inside =
        NormalProjection::intersect_edges(edge_of(mortar, mortar_topology.edges[mortar_edge]),
                                          edge_of(nonmortar, nonmortar_topology.edges[nonmortar_edge]), s,
                                          t) &&
        s >= -outside && s <= 1. + outside && t >= -outside && t <= 1. + outside;
    if (!inside)
      {
        t = t_guess;
        s = s_guess;
      }
    t = std::min(1., std::max(0., t));
    s = std::min(1., std::max(0., s));
    return inside;
  }



  bool Incidence::vertex_faces(const unsigned int vertex, const unsigned int triangle) const
  {
    return facing(normal_of(nonmortar, triangle), mortar.vertex_normals[vertex]);
  }



  bool Incidence::triangles_face(const unsigned int t, const unsigned int m) const
  {
    return facing(normal_of(nonmortar, t), normal_of(mortar, m));
  }
} // namespace Signorini
