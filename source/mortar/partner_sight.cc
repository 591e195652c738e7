// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "body_edges.h"

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/mortar/partner_sight.h>
#include <signorini/surface/contact_mapping.h>

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
      /// Distances of one place (SurfaceSight), in widths of the facet that is looked from.
      double same_place = 1e-6;
      /// How far edges are looked for, in these widths.
      double near_edge = .3;
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
          met.distance = seen.distance;
          met.normal   = -sum / sum.norm();
          met.doubt    = (met.normal + facet_normal(other, seen.triangle)).norm();
          const BodyEdges::Nearest edge =
              surface.edges.find(seen.triangle, evaluate(other.mesh, seen.triangle, seen.weights),
                                 PartnerSightRule().near_edge * width);
          met.beyond_edge   = edge.beyond;
          met.edge_distance = edge.distance;
          return met.normal * normal > -touching_cosine;
        };
  }
} // namespace Signorini
