// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "body_edges.h"
#include "crease_normals.h"

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
      /// Of an edge that sticks out no facet sees another one: the sine of the angle at which it would.
      double groove = .3;
      /// Normals of one wall.
      double one_wall = .9;
      /// Of what is seen at all.
      double facing = .5;
      /// What of the way from the centre of a facet to the vertex is looked from: where two walls meet, too,
      /// each facet sees its own.
      double toward_vertex = .9;
      /// By what part of its slope against the other side a face must rise from an edge that presses on that.
      double least_rise = .1;
      /// How much of the first one the turn from own to new normals may change by as these spread: where a
      /// surface or the other side is curved they go no farther than they matter.
      double change = .5;
      /// Distances from edges of both sides, in widths of the facet, that differ by what facets do from an
      /// arc: rims of 20 and 24 chords are apart by .03.
      double same_edge = .05;
      /// Cosine between turns of normals that are one: about edges that lie along each other.
      double along = .9;
      /// Differences of unit normals that are rounding.
      double rounding = 1e-6;
    };

    using Facet = ContactSurface::Facet;

    bool have_sharp_edge(const std::vector<Facet> &facets)
    {
      std::vector<Vector3> normals;
      for (const Facet &facet : facets)
        normals.push_back(facet.normal);
      return fall_apart(normals);
    }

    /// Whether no facet sees another one.
    bool stick_out(const std::vector<Facet> &facets)
    {
      for (const Facet &one : facets)
        for (const Facet &other : facets)
          if (one.normal * other.way > EdgeRule().groove * other.way.norm())
            return false;
      return true;
    }

    /// Adds what is beyond symmetry planes.
    void add_mirrored(std::vector<Facet> &facets, const std::vector<Vector3> &planes)
    {
      for (const Vector3 &n : planes)
        for (std::size_t i = 0, size = facets.size(); i < size; ++i)
          {
            const auto mirrored = [&n](const Vector3 &v) -> Vector3 { return v - 2. * (v * n) * n; };
            facets.push_back({mirrored(facets[i].normal), mirrored(facets[i].way)});
          }
    }

    /// The normals of those facets that lie in planes across prescribed directions.
    std::vector<Vector3> symmetry_planes(const std::vector<Facet> &facets, const FixedDirections &fixed)
    {
      std::vector<Vector3> planes;
      for (const Facet &facet : facets)
        if (fixed.contains(facet.normal) && std::all_of(planes.begin(), planes.end(), [&](const Vector3 &n) {
              return std::abs(n * facet.normal) < EdgeRule().one_wall;
            }))
          planes.push_back(facet.normal);
      return planes;
    }

    /// The facets around a vertex, and what they meet.
    class Corner
    {
    public:
      /// @param facets of the surface
      /// @param others the rest of the boundary of the body
      /// @param fixed what is prescribed
      Corner(std::vector<Facet> facets, std::vector<Facet> others, const FixedDirections &fixed,
             const Vector3 &vertex_normal)
      {
        if (fixed.any() && !fixed.all())
          {
            planes = symmetry_planes(others, fixed);
            others.erase(std::remove_if(others.begin(), others.end(),
                                        [&](const Facet &facet) { return fixed.contains(facet.normal); }),
                         others.end());
            add_mirrored(facets, planes);
            add_mirrored(others, planes);
          }
        if (!have_sharp_edge(facets))
          own = vertex_normal;
        facets.insert(facets.end(), others.begin(), others.end());
        is_on_edge = have_sharp_edge(facets) && stick_out(facets);
      }

      /// What is met along the normal of a facet.
      void add(const MetPartner &met, const Vector3 &facet)
      {
        std::vector<Facet> images = {{met.normal, Vector3()}};
        add_mirrored(images, planes);
        for (const Facet &image : images)
          normals.push_back(image.normal);
        ++n_met;
        edges.push_back(met.beyond_edge);
        sum_of_distances += met.distance;
        doubt = std::max(doubt, (facet - own).norm() + met.doubt);
      }

      /// Whether it is on an edge of the body that sticks out.
      bool is_edge() const
      {
        return is_on_edge;
      }

      bool meets_anything() const
      {
        return !normals.empty();
      }

      /// Mean along the facets (length).
      double distance() const
      {
        return sum_of_distances / n_met;
      }

      /// Whether its normal is that of a face beside it, or it is on an edge that sticks out: not in a
      /// groove.
      bool may_turn() const
      {
        return own.norm() > 0. || is_on_edge;
      }

      /// The normal of what is met; zero if that is not one wall.
      Vector3 met_normal() const
      {
        Vector3 sum;
        for (const Vector3 &one : normals)
          {
            sum += one;
            for (const Vector3 &other : normals)
              if (one * other < EdgeRule().one_wall)
                return Vector3();
          }
        return normals.empty() ? sum : sum / sum.norm();
      }

      /// Whether it is an edge that meets an edge along it: the normals of the other one, from that of the
      /// face that is met to that beyond, go through the one between both faces.
      bool meets_edge() const
      {
        const Vector3 met = met_normal();
        if (!is_on_edge || !(own.norm() > 0.) || !(met.norm() > 0.))
          return false;
        const Vector3 turn = .5 * (met - own);
        return std::all_of(edges.begin(), edges.end(), [&](const Vector3 &beyond) {
          const Vector3 toward = beyond - (beyond * met) * met;
          return turn * toward >= EdgeRule().along * turn.norm() * toward.norm() && toward.norm() > 0.;
        });
      }

      /// The normal of what is met where it is not the one that the vertex has already, between these where
      /// edges meet; else zero.
      Vector3 normal() const
      {
        const Vector3 met         = met_normal();
        const bool    is_the_same = own.norm() > 0. && (met - own).norm() <= doubt + EdgeRule().rounding;
        if (!may_turn() || is_the_same)
          return Vector3();
        const Vector3 between = met + own;
        return meets_edge() ? Vector3(between / between.norm()) : met;
      }

      /// From the own normal; from nothing where there is none.
      Vector3 turn() const
      {
        return own.norm() > 0. ? Vector3(met_normal() - own) : Vector3();
      }

    private:
      /// Zero where it is that of no face.
      Vector3              own;
      bool                 is_on_edge = false;
      std::vector<Vector3> planes, normals, edges;
      double               sum_of_distances = 0., n_met = 0., doubt = 0.;
    };

    class EdgeNormals
    {
    public:
      EdgeNormals(const ContactSurface &surface, const PartnerSight &partner)
        : surface(surface)
        , partner(partner)
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
            if (n * facet_normal(surface, t) >= EdgeRule().facing)
              for (const unsigned int w : {a, b})
                if (!corner(w).meets_anything() && corner(w).may_turn())
                  sums[w] += n;
          });
        for (const auto &[w, sum] : sums)
          if (sum.norm() > 0.)
            normals.emplace(w, sum / sum.norm());
      }

      /// Whether a vertex is on an edge with something before it, and all facets rise from there.
      bool presses(const unsigned int v)
      {
        const Corner &here = corner(v);
        if (!here.is_edge() || !(here.normal().norm() > 0.))
          return false;
        bool all_rise = true, any = false;
        for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
          Vector3 middle;
          double  distance = 0., n = 0.;
          for (const unsigned int w : {a, b})
            if (const Corner &there = corner(w); there.meets_anything())
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
        const Corner &here = corner(v);
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
        const Corner &here = corner(v), &there = corner(w);
        const double  turn = here.turn().norm(), way = x[v].distance(x[w]);
        const Vector3 met = there.met_normal();
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
      const Corner &corner(const unsigned int v)
      {
        const auto known = corners.find(v);
        return known != corners.end() ? known->second : corners.emplace(v, look_from(v)).first->second;
      }

      Corner look_from(const unsigned int v) const
      {
        std::vector<Facet>                          facets;
        std::vector<std::pair<MetPartner, Vector3>> met;
        for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
          const Vector3 n = facet_normal(surface, t);
          if (!(n.norm() > 0.))
            return;
          const Point<3> centre((Vector3(x[v]) + Vector3(x[a]) + Vector3(x[b])) / 3.);
          facets.push_back({n, centre - x[v]});
          const Point<3> place(centre + EdgeRule().toward_vertex * (x[v] - centre));
          const double   width = std::sqrt(triangle_area(surface.mesh, t));
          if (MetPartner one; partner(one, place, n, width))
            {
              if (one.beyond_edge.norm() > 0. && std::abs(edges().find(t, place, width).distance -
                                                          one.edge_distance) > EdgeRule().same_edge * width)
                one.beyond_edge = Vector3();
              met.emplace_back(one, n);
            }
        });
        const auto beyond = surface.beyond.find(v);
        Corner     result(std::move(facets),
                      beyond != surface.beyond.end() ? beyond->second : std::vector<Facet>(),
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

      const ContactSurface            &surface;
      mutable std::optional<BodyEdges> body_edges;
      const PartnerSight              &partner;
      const std::vector<Point<3>>     &x;
      const SurfaceTopology            topology;
      std::map<unsigned int, Corner>   corners;
      std::deque<Turned>               front;
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
    surface.has_partner_normal = is_turned;
    turn(on_creases);
    turn_hanging(surface, is_turned);
  }



  void face_plane(ContactSurface &surface, const Vector3 &plane_normal)
  {
    std::vector<bool> is_turned(surface.mesh.vertices.size(), false);
    surface.has_partner_normal.resize(is_turned.size(), false);
    for (unsigned int v = 0; v < is_turned.size(); ++v)
      if (surface.hanging[v].empty() && -plane_normal * surface.mesh.vertex_normals[v] >= EdgeRule().facing)
        {
          surface.mesh.vertex_normals[v] = -plane_normal;
          surface.has_partner_normal[v]  = true;
          is_turned[v]                   = true;
        }
    turn_hanging(surface, is_turned);
  }
} // namespace Signorini
