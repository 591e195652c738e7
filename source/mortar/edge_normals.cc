// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "body_edges.h"
#include "corner_sight.h"
#include "crease_normals.h"
#include "edge_corner.h"

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/edge_normals.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct EdgeRule
    {
      /// By what part of its slope against the other side a face must rise from an edge that presses on that.
      double least_rise = .1;
      /// How much of the first one the turn from own to new normals may change by as these spread: where a
      /// surface or the other side is curved they go no farther than they matter.
      double change = .5;
      /// Distances from edges of both sides, in widths of the facet, that differ by what facets do from an
      /// arc: rims of 20 and 24 chords are apart by .03.
      double same_edge = .05;
      /// Differences of unit normals that are rounding.
      double rounding = 1e-6;
    };

    class EdgeNormals
    {
    public:
      EdgeNormals(const ContactSurface &surface, const PartnerSight &partner)
        : surface(surface)
        , sight(surface, partner)
        , x(surface.mesh.vertices)
        , topology(surface.mesh.triangles, x.size())
      {
      }

      /// The new normals, by vertex.
      std::map<unsigned int, Vector3> find()
      {
        std::map<unsigned int, Vector3> result;
        std::vector<bool>               may_press = vertices_on_sharp_edges(surface, all_faces);
        for (const auto &entry : surface.beyond)
          may_press[entry.first] = true;
        for (unsigned int v = 0; v < x.size(); ++v)
          if (may_press[v] && presses(v))
            {
              result.emplace(v, corner(v).normal());
              if (!corner(v).meets_edge())
                front.push_back({v, corner(v).turn()});
            }
        for (; !front.empty(); front.pop_front())
          for_facets(front[0].vertex,
                     [&, from = front[0]](const unsigned int a, const unsigned int b, const unsigned int t) {
                       for (const unsigned int w : {a, b})
                         if (spreads(from, w, t) && result.emplace(w, corner(w).normal()).second)
                           front.push_back({w, from.turn.norm() > 0. ? from.turn : corner(w).turn()});
                     });
        add_overhang(result);
        return result;
      }

    private:
      /// A vertex with a new normal, and the turn at the edge that this comes from; zero on a sharp one.
      struct Turned
      {
        unsigned int vertex;
        Vector3      turn;
      };

      /// Whether a new normal goes on over a facet: if it rises, and the turn is much the same.
      bool spreads(const Turned &from, const unsigned int w, const unsigned int triangle)
      {
        const unsigned int v = from.vertex;
        return corner(w).meets_anything() && corner(w).normal().norm() > 0. &&
               corner(w).distance() > corner(v).distance() + least_rise(v, triangle, x[v].distance(x[w])) &&
               (corner(w).turn() - from.turn).norm() <=
                   (from.turn.norm() > 0. ? EdgeRule().change * from.turn.norm() : 2.);
      }

      /// Vertices that meet nothing, of facets that do in part: the other side ends there.
      void add_overhang(std::map<unsigned int, Vector3> &normals)
      {
        std::map<unsigned int, Vector3> sums;
        for (const auto &[v, normal] : normals)
          for_facets(v, [&, n = normal](const unsigned int a, const unsigned int b, const unsigned int t) {
            if (n * facet_normal(surface, t) > -touching_cosine)
              for (const unsigned int w : {a, b})
                if (!corner(w).meets_anything() && corner(w).may_turn())
                  sums[w] += n;
          });
        for (const auto &[w, normal] : sums)
          if (normal.norm() > 0.)
            normals.emplace(w, normal / normal.norm());
      }

      /// Whether a vertex is on an edge with something before it, and all facets rise from there.
      bool presses(const unsigned int v)
      {
        const EdgeCorner &here = corner(v);
        if (!here.is_edge() || !(here.normal().norm() > 0.))
          return false;
        bool all_rise = true, any = false;
        for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
          Vector3 middle;
          double  distance = 0., n = 0.;
          for (const unsigned int w : {a, b})
            if (const EdgeCorner &there = corner(w); there.meets_anything())
              {
                middle += x[w] - x[v];
                distance += there.distance();
                n += 1.;
                all_rise = all_rise && is_by_an_edge(v, w);
              }
          if (n == 0.)
            return;
          const double way = middle.norm() / n;
          any              = true;
          all_rise         = all_rise &&
                     (distance / n >= here.distance() + least_rise(v, t, way) - EdgeRule().rounding * way ||
                      rises_across_edge(v, a, b, t));
        });
        return all_rise && any;
      }

      /// The same of a facet v, a, b of which one side is a long piece of an edge: along that the other side
      /// comes nearer and goes farther as its facets lie. What counts is the slope where the facet is
      /// steepest, if the edge does not fall by much of that.
      bool rises_across_edge(const unsigned int v, const unsigned int a, const unsigned int b,
                             const unsigned int triangle)
      {
        const EdgeCorner &here = corner(v);
        for (const unsigned int w : {a, b})
          if (!corner(w).meets_anything())
            return false;
        if (!corner(a).is_edge() && !corner(b).is_edge())
          return false;
        const Vector3 n = facet_normal(surface, triangle), to_a = x[a] - x[v], to_b = x[b] - x[v];
        const Vector3 up    = (here.normal() * n) * n - here.normal();
        const double  slope = (n - here.normal()).norm();
        if (!(slope > EdgeRule().rounding) || !(up.norm() > 0.))
          return false;
        const double rise_a = corner(a).distance() - here.distance(),
                     rise_b = corner(b).distance() - here.distance();
        for (const auto &[w, rise, way] :
             {std::make_tuple(a, rise_a, to_a.norm()), std::make_tuple(b, rise_b, to_b.norm())})
          if (corner(w).is_edge() && -rise > EdgeRule().change * slope * way)
            return false;
        // up / |up| = p to_a + q to_b.
        const double aa = to_a * to_a, ab = to_a * to_b, bb = to_b * to_b, determinant = aa * bb - ab * ab;
        if (!(determinant > 0.))
          return false;
        const double ua = up * to_a / up.norm(), ub = up * to_b / up.norm();
        const double p = (ua * bb - ub * ab) / determinant, q = (ub * aa - ua * ab) / determinant;
        return p * rise_a + q * rise_b >= EdgeRule().least_rise * slope;
      }

      /// Whether a turn is that of a face that rises from an edge, as far as a neighbour tells: not that of
      /// the vertex nearest to a place where smooth surfaces touch, whose neighbours meet normals that differ
      /// by as much; nor beside that along the edge, where the other side comes nearer in this direction.
      bool is_by_an_edge(const unsigned int v, const unsigned int w)
      {
        const EdgeCorner &here = corner(v), &there = corner(w);
        const double      turn = here.turn().norm(), way = x[v].distance(x[w]);
        const Vector3     met = there.met_normal();
        return turn == 0. || (here.distance() - there.distance() <=
                                  (EdgeRule().change * turn + EdgeRule().rounding) * way &&
                              (met.norm() == 0. || (met - here.met_normal()).norm() < turn));
      }

      /// By how much farther the other side is over a way from v (lengths) if a facet rises.
      double least_rise(const unsigned int v, const unsigned int triangle, const double way)
      {
        return EdgeRule().least_rise * (facet_normal(surface, triangle) - corner(v).normal()).norm() * way;
      }

      /// Calls f(a, b, triangle) for the facets v, a, b.
      template <typename F>
      void for_facets(const unsigned int v, const F &f) const
      {
        for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
          {
            const unsigned int t = topology.fan[k], i = topology.local_corner(t, v);
            f(topology.triangles[t][(i + 1) % 3], topology.triangles[t][(i + 2) % 3], t);
          }
      }

      /// Looks when it is first needed: few are.
      const EdgeCorner &corner(const unsigned int v)
      {
        const auto known = corners.find(v);
        return known != corners.end() ? known->second : corners.emplace(v, look_from(v)).first->second;
      }

      EdgeCorner look_from(const unsigned int v) const
      {
        std::vector<ContactSurface::Facet>          facets;
        std::vector<std::pair<MetPartner, Vector3>> met;
        for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
          const Vector3 n = facet_normal(surface, t);
          if (!(n.norm() > 0.))
            return;
          facets.push_back({n, (x[a] - x[v] + (x[b] - x[v])) / 3.});
          if (const auto seen = sight.look(t, v, n))
            {
              MetPartner one = seen->partner;
              if (one.beyond_edge.norm() > 0. &&
                  std::abs(edges().find(t, seen->place, seen->width).distance - one.edge_distance) >
                      EdgeRule().same_edge * seen->width)
                one.beyond_edge = Vector3();
              met.emplace_back(one, n);
            }
        });
        const auto beyond = surface.beyond.find(v);
        EdgeCorner result(std::move(facets),
                          beyond != surface.beyond.end() ? beyond->second
                                                         : std::vector<ContactSurface::Facet>(),
                          surface.vertex_fixed[v], surface.mesh.vertex_normals[v]);
        for (const auto &[one, normal] : met)
          result.add(one, normal);
        return result;
      }

      /// Made when they are first needed.
      const BodyEdges &edges() const
      {
        if (!body_edges)
          body_edges.emplace(surface);
        return *body_edges;
      }

      const ContactSurface              &surface;
      mutable std::optional<BodyEdges>   body_edges;
      const CornerSight                  sight;
      const std::vector<Point<3>>       &x;
      const SurfaceTopology              topology;
      std::map<unsigned int, EdgeCorner> corners;
      std::deque<Turned>                 front;
    };
  } // namespace



  namespace
  {
    /// Hanging vertices between others that were turned have the mean of their parents, as always.
    /// @param is_turned by vertex, whether it was turned
    void turn_hanging(ContactSurface &surface, const std::vector<bool> &is_turned)
    {
      for (std::size_t v = 0; v < surface.hanging.size(); ++v)
        {
          Vector3 mean;
          bool    any = false, all = true;
          for (const auto &[parent, weight] : surface.hanging[v])
            {
              mean += weight * surface.mesh.vertex_normals[parent];
              any = any || is_turned[parent];
              all = all && surface.has_partner_normal[parent];
            }
          if (!any)
            continue;
          surface.mesh.vertex_normals[v] = mean / mean.norm();
          surface.has_partner_normal[v]  = all;
        }
    }
  } // namespace



  void turn_edges(ContactSurface &surface, const PartnerSight &partner)
  {
    const std::map<unsigned int, Vector3> normals    = EdgeNormals(surface, partner).find();
    const std::map<unsigned int, Vector3> on_creases = normals_on_creases(surface, partner);
    surface.beyond.clear();
    surface.has_partner_normal.assign(surface.mesh.vertices.size(), false);
    std::vector<bool> is_turned(surface.mesh.vertices.size(), false);
    const auto        turn = [&](const std::map<unsigned int, Vector3> &new_normals) {
      for (const auto &[v, normal] : new_normals)
        if (surface.hanging[v].empty() && !is_turned[v])
          {
            surface.mesh.vertex_normals[v] = normal;
            is_turned[v]                   = true;
          }
    };
    turn(normals);
    turn(on_creases);
    surface.has_partner_normal = is_turned;
    turn_hanging(surface, is_turned);
  }



  void face_plane(ContactSurface &surface, const Vector3 &plane_normal)
  {
    std::vector<bool> is_turned(surface.mesh.vertices.size(), false);
    surface.has_partner_normal.resize(is_turned.size(), false);
    for (unsigned int v = 0; v < is_turned.size(); ++v)
      if (surface.hanging[v].empty() && plane_normal * surface.mesh.vertex_normals[v] < touching_cosine)
        {
          surface.mesh.vertex_normals[v] = -plane_normal;
          surface.has_partner_normal[v]  = true;
          is_turned[v]                   = true;
        }
    turn_hanging(surface, is_turned);
  }
} // namespace Signorini
