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
    bool has_cosine_below(const double cosine, const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      const double product = a * b;
      return product < 0. && product * product > cosine * cosine * a.norm_square() * b.norm_square();
    }

    bool facing(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      return has_cosine_below(Incidence::facing_cosine, a, b);
    }

    std::vector<Tensor<1, 3>> area_normals(const SurfaceMesh &mesh)
    {
      std::vector<Tensor<1, 3>> normals;
      normals.reserve(mesh.triangles.size());
      for (const auto &t : mesh.triangles)
        normals.push_back(.5 * cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                                mesh.vertices[t[2]] - mesh.vertices[t[0]]));
      return normals;
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

    /// With an origin in the middle of the nonmortar surface: numbers far from theirs have few digits left
    /// for the distances that are decided here.
    SurfaceMesh near_origin(SurfaceMesh mesh, const SurfaceMesh &nonmortar)
    {
      if (nonmortar.vertices.empty())
        return mesh;
      Point<3> low = nonmortar.vertices[0], high = low;
      for (const Point<3> &p : nonmortar.vertices)
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c]  = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
          }
      const Tensor<1, 3> middle = low + .5 * (high - low) - Point<3>();
      for (Point<3> &p : mesh.vertices)
        p -= middle;
      return mesh;
    }

    Incidence::Side decide(const double distance, const double position, const double tolerance)
    {
      const bool on_it = std::abs(distance) <= tolerance;
      return {on_it ? 0 : (distance > 0. ? 1 : -1), distance, position};
    }
  } // namespace



  Incidence::Incidence(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar,
                       const SurfaceTopology &nonmortar_topology, const SurfaceTopology &mortar_topology)
    : nonmortar(near_origin(nonmortar, nonmortar))
    , mortar(near_origin(mortar, nonmortar))
    , nonmortar_topology(nonmortar_topology)
    , mortar_topology(mortar_topology)
    , nonmortar_normal(area_normals(nonmortar))
    , mortar_normal(area_normals(mortar))
    , nonmortar_size(shortest_edges(nonmortar, nonmortar_topology))
    , mortar_size(shortest_edges(mortar, mortar_topology))
  {
  }



  bool Incidence::is_at(const unsigned int mortar_vertex, const unsigned int vertex) const
  {
    const Tensor<1, 3> way    = nonmortar.vertices[vertex] - mortar.vertices[mortar_vertex];
    const Tensor<1, 3> across = cross_product_3d(way, mortar.vertex_normals[mortar_vertex]);
    return across.norm() <=
           NormalProjection::vertex_tolerance * std::min(mortar_size[mortar_vertex], nonmortar_size[vertex]);
  }



  void Incidence::move_mortar_vertex(const unsigned int vertex, const Point<3> &image)
  {
    const Tensor<1, 3> &n   = mortar.vertex_normals[vertex];
    const Tensor<1, 3>  way = image - mortar.vertices[vertex];
    mortar.vertices[vertex] += way - (way * n) * n;
  }



  void Incidence::move_nonmortar_vertex(const unsigned int vertex, const unsigned int mortar_edge,
                                        const double s)
  {
    const auto        &e   = mortar_topology.edges[mortar_edge];
    const Point<3>     x   = mortar.vertices[e[0]] + s * (mortar.vertices[e[1]] - mortar.vertices[e[0]]);
    const Tensor<1, 3> n   = (1. - s) * mortar.vertex_normals[e[0]] + s * mortar.vertex_normals[e[1]];
    const Tensor<1, 3> way = nonmortar.vertices[vertex] - x;
    nonmortar.vertices[vertex] -= way - ((way * n) / n.norm_square()) * n;
  }



  Incidence::Side Incidence::of_mortar_vertex(const unsigned int vertex, const unsigned int edge) const
  {
    const OrientedEdge e = edge_of(nonmortar, nonmortar_topology.edges[edge]);
    double             position;
    const double       distance = NormalProjection::distance_from_edge(mortar.vertices[vertex],
                                                                       mortar.vertex_normals[vertex], e, position);
    return decide(
        distance, position,
        NormalProjection::on_nonmortar_tolerance *
            std::min(mortar_size[vertex], nonmortar_size[nonmortar_topology.edges[edge][position > .5]]));
  }



  Incidence::Side Incidence::of_nonmortar_vertex(const unsigned int vertex, const unsigned int edge) const
  {
    const OrientedEdge e = edge_of(mortar, mortar_topology.edges[edge]);
    double             position;
    const double distance = NormalProjection::distance_from_curtain(nonmortar.vertices[vertex], e, position);
    return decide(
        distance, position,
        NormalProjection::on_mortar_tolerance *
            std::min(nonmortar_size[vertex], mortar_size[mortar_topology.edges[edge][position > .5]]));
  }



  bool Incidence::cross(double &t, double &s, const unsigned int nonmortar_edge,
                        const unsigned int mortar_edge, const Side &low, const Side &high) const
  {
    const double share = low.distance - high.distance;
    t                  = share != 0. ? low.distance / share : .5;
    s                  = (1. - t) * low.position + t * high.position;
    // A little outside is rounding.
    constexpr double   outside = near_end;
    const OrientedEdge e       = edge_of(nonmortar, nonmortar_topology.edges[nonmortar_edge]);
    const double       t_first = t, s_first = s;
    const auto         is_inside = [](const double x) { return x >= -outside && x <= 1. + outside; };
    bool               inside =
        NormalProjection::intersect_edges(edge_of(mortar, mortar_topology.edges[mortar_edge]), e, s, t) &&
        is_inside(s) && is_inside(t);
    if (!inside && is_inside(s_first) && std::abs(share) < near_end * e.a.distance(e.b))
      {
        // Nearly parallel edges, whose crossing is an ill-conditioned place: any between the sides will do.
        t      = t_first;
        s      = s_first;
        inside = true;
      }
    t = std::min(1., std::max(0., t));
    s = std::min(1., std::max(0., s));
    return inside;
  }



  // The line through x(s) along n(s) meets the line of the edge e from a: (a - x(s)) . (n(s) x e) = 0, which
  // is quadratic in s.
  std::vector<Incidence::Crossing> Incidence::all_crossings(const unsigned int nonmortar_edge,
                                                            const unsigned int mortar_edge) const
  {
    const OrientedEdge e     = edge_of(nonmortar, nonmortar_topology.edges[nonmortar_edge]),
                       f     = edge_of(mortar, mortar_topology.edges[mortar_edge]);
    const Tensor<1, 3> along = e.b - e.a, d = f.b - f.a, r = e.a - f.a, slope = f.normal_b - f.normal_a;
    const Tensor<1, 3> n0 = cross_product_3d(f.normal_a, along), n1 = cross_product_3d(slope, along);
    const double       c0 = r * n0, c1 = r * n1 - d * n0, c2 = -(d * n1);
    double             roots[2];
    unsigned int       n_roots = 0;
    if (std::abs(c2) <= 1e-14 * std::abs(c1))
      roots[n_roots++] = -c0 / c1;
    else if (const double discriminant = c1 * c1 - 4. * c2 * c0; discriminant >= 0.)
      {
        const double q   = -.5 * (c1 + std::copysign(std::sqrt(discriminant), c1));
        roots[n_roots++] = q / c2;
        roots[n_roots++] = c0 / q;
        if (roots[1] < roots[0])
          std::swap(roots[0], roots[1]);
      }
    constexpr double      outside = near_end;
    std::vector<Crossing> result;
    for (unsigned int i = 0; i < n_roots; ++i)
      {
        const double s = roots[i];
        if (!(s >= -outside && s <= 1. + outside))
          continue;
        const Tensor<1, 3> n = f.normal_a + s * slope, across = cross_product_3d(along, n),
                           way = f.a + s * d - e.a;
        const double t         = (cross_product_3d(way, n) * across) / across.norm_square();
        if (!(t >= -outside && t <= 1. + outside))
          continue;
        const double       eta     = ((e.a + t * along - f.a - s * d) * n) / n.norm_square();
        const Tensor<1, 3> tangent = d + eta * slope;
        result.push_back({std::min(1., std::max(0., t)), std::min(1., std::max(0., s)),
                          cross_product_3d(tangent, along) * n > 0. ? 1 : -1});
      }
    return result;
  }



  bool Incidence::faces(const unsigned int triangle, const Tensor<1, 3> &direction) const
  {
    return facing(nonmortar_normal[triangle], direction);
  }



  bool Incidence::vertex_faces(const unsigned int vertex, const unsigned int triangle) const
  {
    return facing(nonmortar_normal[triangle], mortar.vertex_normals[vertex]);
  }



  bool Incidence::edge_faces(const unsigned int mortar_edge, const double s,
                             const unsigned int triangle) const
  {
    const auto &e = mortar_topology.edges[mortar_edge];
    return facing(nonmortar_normal[triangle],
                  (1. - s) * mortar.vertex_normals[e[0]] + s * mortar.vertex_normals[e[1]]);
  }



  bool Incidence::triangles_face(const unsigned int t, const unsigned int m) const
  {
    return facing(nonmortar_normal[t], mortar_normal[m]);
  }



  bool Incidence::triangles_turn_away(const unsigned int t, const unsigned int m) const
  {
    return !has_cosine_below(touching_cosine, nonmortar_normal[t], mortar_normal[m]);
  }



  bool Incidence::point_faces(const unsigned int t, const unsigned int m, const SurfacePoint &point) const
  {
    const auto   w = point.weights_in(mortar_topology, m);
    Tensor<1, 3> normal;
    for (unsigned int i = 0; i < 3; ++i)
      normal += w[i] * mortar.vertex_normals[mortar_topology.triangles[m][i]];
    return facing(nonmortar_normal[t], normal);
  }
} // namespace Signorini
