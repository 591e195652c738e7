// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
#include <signorini/mesh/symmetry_planes.h>
#include <signorini/mortar/edge_normals.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct EdgeRule
    {
      /// Normals of one wall.
      double one_wall = .5;
      /// What of the way from the centre of a facet to the vertex is looked from: where two walls meet, too,
      /// each facet sees its own.
      double toward_vertex = .9;
      /// What the places that neighbours see may come closer to each other, in parts of their distance.
      double least_image = .5;
      /// Differences of unit normals that are rounding.
      double rounding = 1e-6;
      /// Distances of one place (SurfaceSight), in widths of the facet.
      double same_place = 1e-6;
    };

    struct SurfaceWithEdges
    {
      explicit SurfaceWithEdges(const ContactSurface &surface)
        : sight(surface)
        , sharp(vertices_on_sharp_edges(surface, std::vector<bool>(surface.faces.size(), true)))
      {
      }

      const SurfaceSight      sight;
      const std::vector<bool> sharp;
    };

    /// The facets around a vertex, and what they meet.
    class Edge
    {
    public:
      /// @param own normal of the vertex; zero on a sharp edge, where it is that of no face
      explicit Edge(const Vector3 &own = Vector3())
        : own(own)
      {
      }

      /// A facet by its unit normal and the way from the vertex to its centre.
      void add_facet(const Vector3 &normal, const Vector3 &way)
      {
        facets.emplace_back(normal, way);
      }

      /// What is met along the normal of the last facet.
      void add(const MetPartner &met)
      {
        normals.push_back(met.normal);
        farthest  = std::max(farthest, std::abs(met.distance));
        doubt     = std::max(doubt, (facets.back().first - own).norm());
        its_doubt = std::max(its_doubt, met.doubt);
      }

      /// Zero if that is not one wall, if the vertex has it already, or in a groove.
      Vector3 normal() const
      {
        Vector3 sum;
        for (const Vector3 &one : normals)
          {
            sum += one;
            for (const Vector3 &other : normals)
              if (one * other < EdgeRule().one_wall)
                return Vector3();
          }
        const bool is_sharp = !(own.norm() > 0.);
        if (normals.empty() || (is_sharp && !is_convex()))
          return Vector3();
        const Vector3 result = sum / sum.norm();
        const bool    is_the_same =
            !is_sharp && (result - own).norm() <= doubt + its_doubt + EdgeRule().rounding;
        return is_the_same ? Vector3() : result;
      }

      /// Length.
      double farthest_met() const
      {
        return farthest;
      }

    private:
      /// Whether no facet sees another one.
      bool is_convex() const
      {
        for (const auto &one : facets)
          for (const auto &other : facets)
            if (one.first * other.second > EdgeRule().rounding * other.second.norm())
              return false;
        return true;
      }

      Vector3                                  own;
      std::vector<std::pair<Vector3, Vector3>> facets;
      std::vector<Vector3>                     normals;
      double                                   farthest = 0., doubt = 0., its_doubt = 0.;
    };

    std::map<unsigned int, Edge> look_from_edges(const ContactSurface &surface, const PartnerSight &partner)
    {
      const std::vector<bool> sharp  = vertices_on_sharp_edges(surface,
                                                               std::vector<bool>(surface.faces.size(), true)),
                              border = vertices_on_border_off_planes(surface);
      const auto                  &x = surface.mesh.vertices;
      std::map<unsigned int, Edge> edges;
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        for (const unsigned int v : surface.mesh.triangles[t])
          if (sharp[v] || border[v])
            {
              const auto    &c = surface.mesh.triangles[t];
              const Vector3  n = facet_normal(surface, t);
              const Point<3> centre((Vector3(x[c[0]]) + Vector3(x[c[1]]) + Vector3(x[c[2]])) / 3.);
              if (!(n.norm() > 0.))
                continue;
              Edge &edge =
                  edges.emplace(v, Edge(sharp[v] ? Vector3() : surface.mesh.vertex_normals[v])).first->second;
              edge.add_facet(n, centre - x[v]);
              if (MetPartner met; partner(met, centre + EdgeRule().toward_vertex * (x[v] - centre), n,
                                          std::sqrt(triangle_area(surface.mesh, t))))
                edge.add(met);
            }
      return edges;
    }
  } // namespace



  PartnerSight sight_of(const RigidObstacle &obstacle, const double size)
  {
    return [&obstacle, size](MetPartner &met, const Point<3> &place, const Vector3 &normal, const double) {
      return obstacle.contact_normal(met.normal, met.distance, place, normal, size);
    };
  }



  PartnerSight sight_of(const ContactSurface &other)
  {
    // Made when it is first needed: most surfaces end at symmetry planes, or have no end.
    auto known = std::make_shared<std::unique_ptr<const SurfaceWithEdges>>();
    return
        [&other, known](MetPartner &met, const Point<3> &place, const Vector3 &normal, const double width) {
          if (!*known)
            *known = std::make_unique<const SurfaceWithEdges>(other);
          const SurfaceWithEdges &surface = **known;
          SurfaceSight::Place     seen;
          if (!surface.sight.find(seen, place, normal, EdgeRule().same_place * width,
                                  [width](const double distance) { return distance >= -width; }))
            return false;
          Vector3 sum;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const unsigned int v = other.mesh.triangles[seen.triangle][i];
              sum += seen.weights[i] *
                     (surface.sharp[v] ? true_normal(other, seen.triangle, i) : other.mesh.vertex_normals[v]);
            }
          met.distance = seen.distance;
          met.normal   = -sum / sum.norm();
          return sum.norm() > 0. && met.normal * normal >= EdgeRule().one_wall;
        };
  }



  void turn_edges(ContactSurface &surface, const PartnerSight &partner)
  {
    const std::map<unsigned int, Edge> edges   = look_from_edges(surface, partner);
    const std::vector<Point<3>>       &x       = surface.mesh.vertices;
    std::vector<Vector3>               normals = surface.mesh.vertex_normals;
    for (const auto &[v, edge] : edges)
      if (const Vector3 normal = edge.normal(); normal.norm() > 0.)
        normals[v] = normal;
    std::vector<bool> folds(x.size(), false);
    const auto        check = [&](const unsigned int v, const Vector3 &normal_there, const unsigned int w) {
      const auto edge = edges.find(v);
      if (edge == edges.end())
        return;
      const Vector3 way = x[w] - x[v];
      if (edge->second.farthest_met() * ((normal_there - normals[v]) * way) <
          (EdgeRule().least_image - 1.) * way.norm_square())
        folds[v] = true;
    };
    for (const auto &t : surface.mesh.triangles)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          if (i != j)
            for (const Vector3 &there : {normals[t[j]], surface.mesh.vertex_normals[t[j]]})
              check(t[i], there, t[j]);
    surface.has_partner_normal.assign(x.size(), false);
    for (const auto &[v, edge] : edges)
      if (edge.normal().norm() > 0. && !folds[v])
        {
          surface.mesh.vertex_normals[v] = normals[v];
          surface.has_partner_normal[v]  = true;
        }
  }
} // namespace Signorini
