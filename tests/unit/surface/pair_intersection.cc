// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/pair_intersection.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;
  using NormalProjection::OrientedEdge;

  namespace
  {
    /// Surfaces that can touch face each other: the cosine of their normals is below this.
    constexpr double facing_cosine = -.1;

    Tensor<1, 3> normal_of(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      const auto &t = mesh.triangles[triangle];
      return cross_product_3d(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                              mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    }

    bool facing(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      return a * b < facing_cosine * a.norm() * b.norm();
    }

    /// Barycentric coordinates of the point at parameter t of edge e (corner e to corner e + 1).
    std::array<double, 3> on_edge(const unsigned int e, const double t)
    {
      const double          s = std::min(1., std::max(0., t));
      std::array<double, 3> w = {{0., 0., 0.}};
      w[e]                    = 1. - s;
      w[(e + 1) % 3]          = s;
      return w;
    }

    /// Nonnegative coordinates with sum 1.
    std::array<double, 3> clamped(std::array<double, 3> w)
    {
      double sum = 0.;
      for (double &x : w)
        {
          x = std::max(0., x);
          sum += x;
        }
      for (double &x : w)
        x /= sum;
      return w;
    }

    std::array<double, 3> at_corner(const unsigned int corner)
    {
      std::array<double, 3> w = {{0., 0., 0.}};
      w[corner]               = 1.;
      return w;
    }

    /// Sorts the corners of a convex polygon counterclockwise in barycentric coordinates.
    void sort_counterclockwise(PairIntersection::Polygon &polygon)
    {
      double x = 0., y = 0.;
      for (const auto &corner : polygon)
        {
          x += corner.nonmortar[1] / static_cast<double>(polygon.size());
          y += corner.nonmortar[2] / static_cast<double>(polygon.size());
        }
      std::sort(polygon.begin(), polygon.end(), [&](const auto &a, const auto &b) {
        return std::atan2(a.nonmortar[2] - y, a.nonmortar[1] - x) <
               std::atan2(b.nonmortar[2] - y, b.nonmortar[1] - x);
      });
    }
  } // namespace



  /// Sides of all vertices with respect to all edges of a pair. A corner lies inside where all signs are >=
  /// 0.
  struct PairIntersection::PairData
  {
    unsigned int t, m;
    /// [mortar corner][nonmortar edge], seen from the nonmortar surface's outside.
    std::array<std::array<Side, 3>, 3> mortar_side;
    /// [nonmortar corner][mortar edge], seen from the mortar surface's outside.
    std::array<std::array<Side, 3>, 3> nonmortar_side;
  };



  PairIntersection::PairIntersection(const SurfaceMesh &nonmortar, const SurfaceMesh &mortar)
    : nonmortar(nonmortar)
    , mortar(mortar)
  {
  }



  OrientedEdge PairIntersection::edge(const SurfaceMesh &mesh, const unsigned int a,
                                      const unsigned int b) const
  {
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertex_normals[a], mesh.vertex_normals[b]};
  }



  PairIntersection::Side PairIntersection::mortar_vertex_side(const unsigned int vertex, const unsigned int a,
                                                              const unsigned int b) const
  {
    if (a > b)
      {
        const Side side = mortar_vertex_side(vertex, b, a);
        return {-side.sign, -side.distance, 1. - side.position};
      }
    Side       side;
    const auto e = edge(nonmortar, a, b);
    // The mortar normal points against the viewer of the nonmortar surface, hence the sign.
    side.distance = NormalProjection::distance_from_edge(mortar.vertices[vertex],
                                                         mortar.vertex_normals[vertex], e, side.position);
    side.sign     = std::abs(side.distance) <= NormalProjection::incidence_tolerance * e.a.distance(e.b)
                        ? 0
                        : (side.distance > 0. ? 1 : -1);
    return side;
  }



  PairIntersection::Side PairIntersection::nonmortar_vertex_side(const unsigned int vertex,
                                                                 const unsigned int a,
                                                                 const unsigned int b) const
  {
    if (a > b)
      {
        const Side side = nonmortar_vertex_side(vertex, b, a);
        return {-side.sign, -side.distance, 1. - side.position};
      }
    Side       side;
    const auto e  = edge(mortar, a, b);
    side.distance = -NormalProjection::distance_from_curtain(nonmortar.vertices[vertex], e, side.position);
    side.sign     = std::abs(side.distance) <= NormalProjection::incidence_tolerance * e.a.distance(e.b)
                        ? 0
                        : (side.distance > 0. ? 1 : -1);
    return side;
  }



  bool PairIntersection::line_hits(std::array<double, 3> &weights, double &eta, const unsigned int vertex,
                                   const unsigned int triangle) const
  {
    if (!facing(normal_of(nonmortar, triangle), mortar.vertex_normals[vertex]))
      return false;
    const auto &t = nonmortar.triangles[triangle];
    if (!NormalProjection::intersect_line(
            weights, eta, mortar.vertices[vertex], mortar.vertex_normals[vertex],
            {{nonmortar.vertices[t[0]], nonmortar.vertices[t[1]], nonmortar.vertices[t[2]]}}))
      return false;
    return *std::min_element(weights.begin(), weights.end()) >= -1e-9;
  }



  void PairIntersection::add_mortar_vertices(Result &result, const PairData &pair) const
  {
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto &sides = pair.mortar_side[c];
        if (sides[0].sign < 0 || sides[1].sign < 0 || sides[2].sign < 0)
          continue;
        const int             zero[] = {sides[0].sign == 0, sides[1].sign == 0, sides[2].sign == 0};
        std::array<double, 3> w;
        // On two edges: their common corner. On one edge: the foot there. Else inside.
        int on_two = -1, on_one = -1;
        for (int e = 0; e < 3; ++e)
          {
            if (zero[e] && zero[(e + 2) % 3])
              on_two = e;
            if (zero[e])
              on_one = e;
          }
        if (on_two >= 0)
          w = at_corner(on_two);
        else if (on_one >= 0)
          {
            if (sides[on_one].position < -1e-9 || sides[on_one].position > 1. + 1e-9)
              continue;
            w = on_edge(on_one, sides[on_one].position);
          }
        else
          {
            double eta;
            if (!line_hits(w, eta, mortar.triangles[pair.m][c], pair.t))
              continue;
            w = clamped(w);
          }
        result.polygon.push_back({w, at_corner(c)});
        for (unsigned int e = 0; e < 3; ++e)
          result.touches_nonmortar_edge[e] = result.touches_nonmortar_edge[e] || zero[e];
        result.touches_mortar_edge[c]           = true;
        result.touches_mortar_edge[(c + 2) % 3] = true;
      }
  }



  void PairIntersection::add_nonmortar_vertices(Result &result, const PairData &pair) const
  {
    const auto &m = mortar.triangles[pair.m];
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto &sides = pair.nonmortar_side[c];
        if (sides[0].sign < 0 || sides[1].sign < 0 || sides[2].sign < 0)
          continue;
        int on_two = -1, on_one = -1;
        for (int e = 0; e < 3; ++e)
          {
            if (sides[e].sign == 0 && sides[(e + 2) % 3].sign == 0)
              on_two = e;
            if (sides[e].sign == 0)
              on_one = e;
          }
        std::array<double, 3> w;
        if (on_two >= 0)
          w = at_corner(on_two);
        else if (on_one >= 0)
          w = on_edge(on_one, sides[on_one].position);
        else
          {
            double eta;
            if (!NormalProjection::inverse_project(
                    w, eta, nonmortar.vertices[nonmortar.triangles[pair.t][c]],
                    {{mortar.vertices[m[0]], mortar.vertices[m[1]], mortar.vertices[m[2]]}},
                    {{mortar.vertex_normals[m[0]], mortar.vertex_normals[m[1]],
                      mortar.vertex_normals[m[2]]}}))
              continue;
            w = clamped(w);
          }
        result.polygon.push_back({at_corner(c), w});
        result.touches_nonmortar_edge[c]           = true;
        result.touches_nonmortar_edge[(c + 2) % 3] = true;
        for (unsigned int e = 0; e < 3; ++e)
          result.touches_mortar_edge[e] = result.touches_mortar_edge[e] || sides[e].sign == 0;
      }
  }



  void PairIntersection::add_crossings(Result &result, const PairData &pair) const
  {
    for (unsigned int e = 0; e < 3; ++e)
      for (unsigned int f = 0; f < 3; ++f)
        {
          const Side &a = pair.nonmortar_side[e][f], &b = pair.nonmortar_side[(e + 1) % 3][f];
          const Side &p = pair.mortar_side[f][e], &q = pair.mortar_side[(f + 1) % 3][e];
          if (a.sign * b.sign >= 0 || p.sign * q.sign >= 0)
            continue;
          // The same numbers for all four triangles around: from lower to higher vertex numbers.
          unsigned int v0 = nonmortar.triangles[pair.t][e], v1 = nonmortar.triangles[pair.t][(e + 1) % 3];
          unsigned int m0 = mortar.triangles[pair.m][f], m1 = mortar.triangles[pair.m][(f + 1) % 3];
          double       t = a.distance / (a.distance - b.distance), s = p.distance / (p.distance - q.distance);
          const bool   turn_v = v0 > v1, turn_m = m0 > m1;
          if (turn_v)
            {
              std::swap(v0, v1);
              t = 1. - t;
            }
          if (turn_m)
            {
              std::swap(m0, m1);
              s = 1. - s;
            }
          const double s_guess = s, t_guess = t;
          if (!NormalProjection::intersect_edges(edge(mortar, m0, m1), edge(nonmortar, v0, v1), s, t) ||
              s < -1e-6 || s > 1. + 1e-6 || t < -1e-6 || t > 1. + 1e-6)
            {
              s = s_guess;
              t = t_guess;
            }
          result.polygon.push_back({on_edge(e, turn_v ? 1. - t : t), on_edge(f, turn_m ? 1. - s : s)});
          result.touches_nonmortar_edge[e] = true;
          result.touches_mortar_edge[f]    = true;
        }
  }



  PairIntersection::Result PairIntersection::compute(const unsigned int t, const unsigned int m) const
  {
    Result result;
    if (!facing(normal_of(nonmortar, t), normal_of(mortar, m)))
      return result;
    PairData pair;
    pair.t = t;
    pair.m = m;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int e = 0; e < 3; ++e)
        {
          pair.mortar_side[c][e]    = mortar_vertex_side(mortar.triangles[m][c], nonmortar.triangles[t][e],
                                                         nonmortar.triangles[t][(e + 1) % 3]);
          pair.nonmortar_side[c][e] = nonmortar_vertex_side(nonmortar.triangles[t][c], mortar.triangles[m][e],
                                                            mortar.triangles[m][(e + 1) % 3]);
        }
    add_mortar_vertices(result, pair);
    add_nonmortar_vertices(result, pair);
    add_crossings(result, pair);
    if (result.polygon.size() >= 3)
      sort_counterclockwise(result.polygon);
    return result;
  }
} // namespace Signorini
