// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/mortar/partner_sight.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <limits>
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
        , is_sharp(topology.edges.size(), false)
      {
        for (unsigned int e = 0; e < is_sharp.size(); ++e)
          {
            const auto &[s, t] = topology.edge_triangles[e];
            is_sharp[e] =
                topology.is_border(e) ? ends_at(e, s != SurfaceTopology::none ? s : t) : bends_at(e);
          }
      }

      /// Of a place from those at its triangle and its neighbours (length); large without any.
      double distance(const SurfaceSight::Place &place) const
      {
        const Point<3> x      = evaluate(surface.mesh, place.triangle, place.weights);
        double         result = std::numeric_limits<double>::max();
        for (const unsigned int v : topology.triangles[place.triangle])
          for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
            for (const unsigned int e : topology.triangle_edges[topology.fan[k]])
              if (is_sharp[e])
                result = std::min(result, distance(x, e));
        return result;
      }

    private:
      /// Whether the surface turns away from its facets.
      bool bends_at(const unsigned int edge) const
      {
        const auto &[s, t]        = topology.edge_triangles[edge];
        const unsigned int corner = (topology.local_edge(t, edge) + 2) % 3;
        const Vector3      normal = facet_normal(surface, s);
        return turns(normal, facet_normal(surface, t)) &&
               normal * (surface.mesh.vertices[topology.triangles[t][corner]] -
                         surface.mesh.vertices[topology.edges[edge][0]]) <
                   0.;
      }

      static bool turns(const Vector3 &a, const Vector3 &b)
      {
        return a * b < PartnerSightRule().sharp;
      }

      double length(const unsigned int edge) const
      {
        const auto &[a, b] = topology.edges[edge];
        return surface.mesh.vertices[a].distance(surface.mesh.vertices[b]);
      }

      double distance(const Point<3> &p, const unsigned int edge) const
      {
        const Point<3> &a     = surface.mesh.vertices[topology.edges[edge][0]];
        const Vector3   along = surface.mesh.vertices[topology.edges[edge][1]] - a;
        const double    s     = std::max(0., std::min(1., (p - a) * along / along.norm_square()));
        return (p - (a + s * along)).norm();
      }

      /// Whether the body turns beyond a border, and is not cut there by a plane in which it slides.
      bool ends_at(const unsigned int edge, const unsigned int triangle) const
      {
        const auto &[a, b]  = topology.edges[edge];
        const auto around_a = surface.beyond.find(a), around_b = surface.beyond.find(b);
        if (around_a == surface.beyond.end() || around_b == surface.beyond.end())
          return false;
        const auto &x = surface.mesh.vertices;
        for (const ContactSurface::Facet &one : around_a->second)
          for (const ContactSurface::Facet &other : around_b->second)
            if (((x[a] + one.way) - (x[b] + other.way)).norm() <=
                PartnerSightRule().same_place * length(edge))
              return turns(facet_normal(surface, triangle), one.normal) &&
                     facet_normal(surface, triangle) * one.way < 0. &&
                     !(surface.vertex_fixed[a].contains(one.normal) &&
                       surface.vertex_fixed[b].contains(one.normal));
        return false;
      }

      const ContactSurface &surface;
      const SurfaceTopology topology;
      std::vector<bool>     is_sharp;
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
          met.distance   = seen.distance;
          met.normal     = -sum / sum.norm();
          met.doubt      = (met.normal + facet_normal(other, seen.triangle)).norm();
          met.is_on_edge = surface.edges.distance(seen) < PartnerSightRule().on_edge * width;
          return met.normal * normal >= PartnerSightRule().facing;
        };
  }
} // namespace Signorini
