// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "edge_corner.h"
#include "corner_sight.h"

#include <signorini/mesh/facing_parts.h>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct EdgeCornerRule
    {
      /// Of an edge that sticks out no facet sees another one: the sine of the angle at which it would.
      double groove = .3;
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
          if (one.normal * other.way > EdgeCornerRule().groove * other.way.norm())
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
              return std::abs(n * facet.normal) < CornerSightRule().one_wall;
            }))
          planes.push_back(facet.normal);
      return planes;
    }
  } // namespace



  EdgeCorner::EdgeCorner(std::vector<Facet> facets, std::vector<Facet> others, const FixedDirections &fixed,
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



  void EdgeCorner::add(const MetPartner &met, const Vector3 &facet)
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



  Vector3 EdgeCorner::met_normal() const
  {
    return normal_of_wall(normals);
  }



  bool EdgeCorner::meets_edge() const
  {
    const Vector3 met = met_normal();
    if (!is_on_edge || !(own.norm() > 0.) || !(met.norm() > 0.))
      return false;
    const Vector3 turn = .5 * (met - own);
    return std::all_of(edges.begin(), edges.end(), [&](const Vector3 &beyond) {
      const Vector3 toward = beyond - (beyond * met) * met;
      return turn * toward >= EdgeCornerRule().along * turn.norm() * toward.norm() && toward.norm() > 0.;
    });
  }



  Vector3 EdgeCorner::normal() const
  {
    const Vector3 met         = met_normal();
    const bool    is_the_same = own.norm() > 0. && (met - own).norm() <= doubt + EdgeCornerRule().rounding;
    if (!may_turn() || is_the_same)
      return Vector3();
    const Vector3 between = met + own;
    return meets_edge() ? Vector3(between / between.norm()) : met;
  }
} // namespace Signorini
