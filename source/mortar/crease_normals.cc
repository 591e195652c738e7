// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "crease_normals.h"
#include "corner_sight.h"

#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_creases.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/surface/contact_mapping.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct CreaseNormalRule
    {
      /// Sines and shares that are rounding.
      double rounding = 1e-12;
    };

    /// All directions between some unit vectors: their combinations with weights of at least 0.
    class NormalCone
    {
    public:
      explicit NormalCone(std::vector<Vector3> generators)
        : generators(std::move(generators))
      {
      }

      /// The unit vector of the cone at the smallest angle to a unit vector that is less than a right angle
      /// away from all of it.
      Vector3 nearest(const Vector3 &target) const
      {
        if (contains(target))
          return target;
        Vector3    best    = generators[0];
        const auto improve = [&](const Vector3 &candidate) {
          if (candidate * target > best * target)
            best = candidate;
        };
        for (unsigned int i = 0; i < generators.size(); ++i)
          {
            improve(generators[i]);
            for (unsigned int j = 0; j < i; ++j)
              if (const std::optional<Vector3> between =
                      nearest_between(generators[i], generators[j], target))
                improve(*between);
          }
        return best;
      }

    private:
      bool contains(const Vector3 &target) const
      {
        for (unsigned int i = 0; i < generators.size(); ++i)
          for (unsigned int j = 0; j < i; ++j)
            for (unsigned int k = 0; k < j; ++k)
              {
                const Vector3 &a = generators[i], &b = generators[j], &c = generators[k];
                const double   det = a * cross_product_3d(b, c), least = -CreaseNormalRule().rounding;
                if (std::abs(det) > CreaseNormalRule().rounding &&
                    target * cross_product_3d(b, c) / det >= least &&
                    target * cross_product_3d(c, a) / det >= least &&
                    target * cross_product_3d(a, b) / det >= least)
                  return true;
              }
        return false;
      }

      /// The projection onto the plane of two unit vectors, if that lies between them.
      static std::optional<Vector3> nearest_between(const Vector3 &a, const Vector3 &b, const Vector3 &target)
      {
        const double ab = a * b, det = 1. - ab * ab;
        if (!(det > CreaseNormalRule().rounding))
          return {};
        const double at = a * target, bt = b * target, p = (at - ab * bt) / det, q = (bt - ab * at) / det;
        if (p < 0. || q < 0.)
          return {};
        const Vector3 sum = p * a + q * b;
        return sum / sum.norm();
      }

      const std::vector<Vector3> generators;
    };

    class CreaseNormals
    {
    public:
      CreaseNormals(const ContactSurface &surface, const PartnerSight &partner)
        : surface(surface)
        , sight(surface, partner)
        , x(surface.mesh.vertices)
        , topology(surface.mesh.triangles, x.size())
      {
      }

      std::map<unsigned int, Vector3> find() const
      {
        std::map<unsigned int, Vector3> result;
        const std::vector<bool>         on_crease = vertices_on_creases();
        for (unsigned int v = 0; v < x.size(); ++v)
          if (on_crease[v])
            if (const std::optional<Vector3> normal = normal_at(v))
              result.emplace(v, *normal);
        return result;
      }

    private:
      /// Where all creases stick out.
      std::vector<bool> vertices_on_creases() const
      {
        std::vector<bool>       result(x.size(), false), in_groove(result);
        const std::vector<bool> is_crease = creases_of(surface, topology);
        for (unsigned int e = 0; e < topology.edges.size(); ++e)
          if (is_crease[e])
            for (const unsigned int v : topology.edges[e])
              (sticks_out(e) ? result : in_groove)[v] = true;
        for (unsigned int v = 0; v < x.size(); ++v)
          result[v] = result[v] && !in_groove[v];
        return result;
      }

      bool sticks_out(const unsigned int edge) const
      {
        const auto &[s, t]              = topology.edge_triangles[edge];
        const auto                   &a = topology.edges[edge];
        const std::array<unsigned, 3> v = topology.triangles[t];
        const unsigned int            apex =
            *std::find_if(v.begin(), v.end(), [&](const unsigned int w) { return w != a[0] && w != a[1]; });
        return facet_normal(surface, s) * (x[apex] - x[a[0]]) < 0.;
      }

      /// Nothing if the vertex keeps its own.
      std::optional<Vector3> normal_at(const unsigned int v) const
      {
        std::vector<Vector3> own, met;
        for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
          {
            const unsigned int t = topology.fan[k];
            const Vector3      n = true_normal(surface, t, topology.local_corner(t, v));
            if (!(n.norm() > 0.))
              continue;
            own.push_back(n);
            if (const auto seen = sight.look(t, v, n))
              met.push_back(seen->partner.normal);
          }
        const Vector3 wall = normal_of_wall(met);
        if (!(wall.norm() > 0.) || fall_apart(own))
          return {};
        return along_planes(v, NormalCone(std::move(own)).nearest(wall));
      }

      /// In the symmetry planes in which the vertex and its own normal lie.
      Vector3 along_planes(const unsigned int v, const Vector3 &normal) const
      {
        const Vector3 &own = surface.mesh.vertex_normals[v];
        if ((project_free(surface.vertex_fixed[v], own) - own).norm() > CreaseNormalRule().rounding)
          return normal;
        const Vector3 inside = project_free(surface.vertex_fixed[v], normal);
        return inside / inside.norm();
      }

      const ContactSurface        &surface;
      const CornerSight            sight;
      const std::vector<Point<3>> &x;
      const SurfaceTopology        topology;
    };
  } // namespace



  std::map<unsigned int, Vector3> normals_on_creases(const ContactSurface &surface,
                                                     const PartnerSight   &partner)
  {
    return CreaseNormals(surface, partner).find();
  }
} // namespace Signorini
