// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/mortar/partner_sight.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct PartnerSightRule
    {
      /// Cosine between a direction of sight and what is seen at all.
      double facing = .5;
      /// Distances of one place (SurfaceSight), in widths of the facet that is looked from.
      double same_place = 1e-6;
      /// How far from an edge one is on that, in these widths: rims of 20 and 24 chords are apart by .03.
      double on_edge = .25;
      /// Cosine of the turn of an edge.
      double sharp = .5;
    };

    /// The edges of a surface that are edges of its body and stick out.
    class BodyEdges
    {
    public:
      explicit BodyEdges(const ContactSurface &surface)
        : surface(surface)
        , topology(surface.mesh.triangles, surface.mesh.vertices.size())
      {
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (topology.is_border(e))
            add_border(e);
          else
            add_inner(e);
      }

      /// The outward normal of the face beyond the nearest edge of those at the triangle of a place and its
      /// neighbours; zero if none is as near as some distance (length).
      Vector3 beyond(const SurfaceSight::Place &place, const double distance) const
      {
        const Point<3> x     = evaluate(surface.mesh, place.triangle, place.weights);
        const Vector3  here  = facet_normal(surface, place.triangle);
        double         least = distance;
        Vector3        result;
        for (const unsigned int v : topology.triangles[place.triangle])
          for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
            for (const unsigned int e : topology.triangle_edges[topology.fan[k]])
              if (const auto found = faces.find(e); found != faces.end())
                if (const double way = distance_from(x, e); way < least)
                  {
                    const auto &[one, other] = found->second;
                    least                    = way;
                    result                   = one * here < other * here ? one : other;
                  }
        return result;
      }

    private:
      static bool turns(const Vector3 &a, const Vector3 &b)
      {
        return a * b < PartnerSightRule().sharp;
      }

      double length(const unsigned int edge) const
      {
        const auto &[a, b] = topology.edges[edge];
        return surface.mesh.vertices[a].distance(surface.mesh.vertices[b]);
      }

      double distance_from(const Point<3> &p, const unsigned int edge) const
      {
        const Point<3> &a     = surface.mesh.vertices[topology.edges[edge][0]];
        const Vector3   along = surface.mesh.vertices[topology.edges[edge][1]] - a;
        const double    s     = std::max(0., std::min(1., (p - a) * along / along.norm_square()));
        return (p - (a + s * along)).norm();
      }

      void add_inner(const unsigned int edge)
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
      void add_border(const unsigned int edge)
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
            if (((x[a] + one.way) - (x[b] + other.way)).norm() <=
                    PartnerSightRule().same_place * length(edge) &&
                turns(here, one.normal) && here * one.way < 0. &&
                !(surface.vertex_fixed[a].contains(one.normal) &&
                  surface.vertex_fixed[b].contains(one.normal)))
              faces[edge] = {{here, one.normal}};
      }

      const ContactSurface &surface;
      const SurfaceTopology topology;
      /// By edge, the outward normals of both sides.
      std::map<unsigned int, std::array<Vector3, 2>> faces;
    };

    struct SurfaceWithEdges
    {
      explicit SurfaceWithEdges(const ContactSurface &surface)
        : sight(surface)
        , sharp(vertices_on_sharp_edges(surface, all_faces))
        , edges(surface)
      {
      }

      const SurfaceSight      sight;
      const std::vector<bool> sharp;
      const BodyEdges         edges;
    };
  } // namespace



  PartnerSight sight_of(const RigidObstacle &obstacle, const double size)
  {
    return [&obstacle, size](MetPartner &met, const Point<3> &place, const Vector3 &normal, const double) {
      return obstacle.contact_normal(met.normal, met.distance, place, normal, size);
    };
  }



  PartnerSight sight_of(const ContactSurface &other)
  {
    // Made when it is first needed: many surfaces have no edges.
    auto known = std::make_shared<std::unique_ptr<const SurfaceWithEdges>>();
    return
        [&other, known](MetPartner &met, const Point<3> &place, const Vector3 &normal, const double width) {
          if (!*known)
            *known = std::make_unique<const SurfaceWithEdges>(other);
          const SurfaceWithEdges &surface = **known;
          SurfaceSight::Place     seen;
          if (!surface.sight.find(seen, place, normal, PartnerSightRule().same_place * width,
                                  [width](const double distance) { return distance >= -width; }))
            return false;
          Vector3 sum;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int v = other.mesh.triangles[seen.triangle][i];
              sum += seen.weights[i] *
                     (surface.sharp[v] ? true_normal(other, seen.triangle, i) : other.mesh.vertex_normals[v]);
            }
          if (!(sum.norm() > 0.))
            return false;
          met.distance    = seen.distance;
          met.normal      = -sum / sum.norm();
          met.doubt       = (met.normal + facet_normal(other, seen.triangle)).norm();
          met.beyond_edge = surface.edges.beyond(seen, PartnerSightRule().on_edge * width);
          return met.normal * normal >= PartnerSightRule().facing;
        };
  }
} // namespace Signorini
