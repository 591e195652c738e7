// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mesh/surface_sight.h>
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
      /// Edges are as sharp as those between parts that may be left out (FacingParts).
      double sharp_cosine = .5 - 1e-6;
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
      /// Differences of unit normals that are rounding.
      double rounding = 1e-6;
      /// Distances of one place (SurfaceSight), in widths of the facet.
      double same_place = 1e-6;
    };

    using Facet = ContactSurface::Facet;

    bool fall_apart(const std::vector<Facet> &facets)
    {
      std::vector<Vector3> normals;
      for (const Facet &facet : facets)
        normals.push_back(facet.normal);
      DisjointSets sets = linked_normals(normals, EdgeRule().sharp_cosine);
      for (unsigned int i = 1; i < facets.size(); ++i)
        if (sets.find(i) != sets.find(0))
          return true;
      return false;
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
            const std::vector<Vector3> planes = symmetry_planes(others, fixed);
            others.erase(std::remove_if(others.begin(), others.end(),
                                        [&](const Facet &facet) { return fixed.contains(facet.normal); }),
                         others.end());
            add_mirrored(facets, planes);
            add_mirrored(others, planes);
          }
        if (!fall_apart(facets))
          own = vertex_normal;
        facets.insert(facets.end(), others.begin(), others.end());
        is_on_edge = fall_apart(facets) && stick_out(facets);
      }

      /// What is met along the normal of a facet.
      void add(const MetPartner &met, const Vector3 &facet)
      {
        normals.push_back(met.normal);
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
        return sum_of_distances / static_cast<double>(normals.size());
      }

      /// Zero if that is not one wall, or if the vertex has it already.
      Vector3 normal() const
      {
        const bool has_own = own.norm() > 0.;
        if (normals.empty() || (!has_own && !is_on_edge))
          return Vector3();
        Vector3 sum;
        for (const Vector3 &one : normals)
          {
            sum += one;
            for (const Vector3 &other : normals)
              if (one * other < EdgeRule().one_wall)
                return Vector3();
          }
        const Vector3 result = sum / sum.norm();
        return has_own && (result - own).norm() <= doubt + EdgeRule().rounding ? Vector3() : result;
      }

    private:
      /// Zero where it is that of no face.
      Vector3              own;
      bool                 is_on_edge = false;
      std::vector<Vector3> normals;
      double               sum_of_distances = 0., doubt = 0.;
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
        std::vector<unsigned int>       front;
        const auto                      add = [&](const unsigned int v) {
          if (result.emplace(v, corner(v).normal()).second)
            front.push_back(v);
        };
        std::vector<bool> may_press =
            vertices_on_sharp_edges(surface, std::vector<bool>(surface.faces.size(), true));
        for (const auto &entry : surface.beyond)
          may_press[entry.first] = true;
        for (unsigned int v = 0; v < x.size(); ++v)
          if (may_press[v] && presses(v))
            add(v);
        while (!front.empty())
          {
            const unsigned int v = front.back();
            front.pop_back();
            for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
              for (const unsigned int w : {a, b})
                if (corner(w).meets_anything() && corner(w).normal().norm() > 0. &&
                    corner(w).distance() > corner(v).distance() + least_rise(v, t, x[v].distance(x[w])))
                  add(w);
            });
          }
        add_overhang(result);
        return result;
      }

    private:
      /// Vertices that meet nothing, of facets that do in part: the other side ends there.
      void add_overhang(std::map<unsigned int, Vector3> &normals)
      {
        std::map<unsigned int, Vector3> sums;
        for (const auto &[v, normal] : normals)
          for_facets(v, [&, n = normal](const unsigned int a, const unsigned int b, const unsigned int t) {
            if (n * facet_normal(surface, t) >= EdgeRule().facing)
              for (const unsigned int w : {a, b})
                if (!corner(w).meets_anything())
                  sums[w] += n;
          });
        for (const auto &[w, sum] : sums)
          if (sum.norm() > 0.)
            normals.emplace(w, sum / sum.norm());
      }

      /// Whether a vertex is on an edge with something before it, from which all facets rise.
      bool presses(const unsigned int v)
      {
        if (!corner(v).is_edge() || !(corner(v).normal().norm() > 0.))
          return false;
        bool result = true;
        for_facets(v, [&](const unsigned int a, const unsigned int b, const unsigned int t) {
          const bool has_a = corner(a).meets_anything(), has_b = corner(b).meets_anything();
          if (!has_a && !has_b)
            return;
          const Point<3> middle = has_a && has_b ? Point<3>(.5 * (x[a] + x[b])) : x[has_a ? a : b];
          const double   there  = has_a && has_b ? .5 * (corner(a).distance() + corner(b).distance())
                                                 : corner(has_a ? a : b).distance();
          const double   way    = x[v].distance(middle);
          result =
              result && there >= corner(v).distance() + least_rise(v, t, way) - EdgeRule().rounding * way;
        });
        return result;
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
          if (MetPartner one; partner(one, centre + EdgeRule().toward_vertex * (x[v] - centre), n,
                                      std::sqrt(triangle_area(surface.mesh, t))))
            met.emplace_back(one, n);
        });
        const auto beyond = surface.beyond.find(v);
        Corner     result(std::move(facets),
                      beyond != surface.beyond.end() ? beyond->second : std::vector<Facet>(),
                          surface.vertex_fixed[v], surface.mesh.vertex_normals[v]);
        for (const auto &[one, normal] : met)
          result.add(one, normal);
        return result;
      }

      const ContactSurface          &surface;
      const PartnerSight            &partner;
      const std::vector<Point<3>>   &x;
      const SurfaceTopology          topology;
      std::map<unsigned int, Corner> corners;
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
          if (!(sum.norm() > 0.))
            return false;
          met.distance = seen.distance;
          met.normal   = -sum / sum.norm();
          met.doubt    = (met.normal + facet_normal(other, seen.triangle)).norm();
          return met.normal * normal >= EdgeRule().facing;
        };
  }



  namespace
  {
    /// Hanging vertices between others that were turned have the mean of their parents, as always.
    void turn_hanging(ContactSurface &surface)
    {
      for (std::size_t v = 0; v < surface.hanging.size(); ++v)
        {
          Vector3 mean;
          bool    any = false, all = true;
          for (const auto &[parent, weight] : surface.hanging[v])
            {
              mean += weight * surface.mesh.vertex_normals[parent];
              any = any || surface.has_partner_normal[parent];
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
    const std::map<unsigned int, Vector3> normals = EdgeNormals(surface, partner).find();
    surface.beyond.clear();
    surface.has_partner_normal.assign(surface.mesh.vertices.size(), false);
    for (const auto &[v, normal] : normals)
      if (surface.hanging[v].empty())
        {
          surface.mesh.vertex_normals[v] = normal;
          surface.has_partner_normal[v]  = true;
        }
    turn_hanging(surface);
  }
} // namespace Signorini
