// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/boundary_depth.h>
#include <signorini/surface/normal_projection.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Pure numbers.
    struct FacetDoubtRule
    {
      /// Of turn between facets times width of a facet, how far the surface that they stand for may be from
      /// them: over an arc it is an eighth.
      double of_turn = .5;
      /// Cosine of the turn from which an edge is one of the body.
      double sharp = .5;
      /// Of the width of a facet, what may be rounding: meshes have five digits and more.
      double rounding = 1e-3;
      /// Barycentric coordinates that are zero.
      double on_edge = 1e-9;
    };

    std::vector<unsigned int> all_of(const SurfaceMesh &mesh)
    {
      std::vector<unsigned int> numbers(mesh.triangles.size());
      std::iota(numbers.begin(), numbers.end(), 0u);
      return numbers;
    }

    /// Twice the area, in its direction.
    Tensor<1, 3> area_vector(const SurfaceMesh &mesh, const unsigned int triangle)
    {
      const auto &v = mesh.triangles[triangle];
      return cross_product_3d(mesh.vertices[v[1]] - mesh.vertices[v[0]],
                              mesh.vertices[v[2]] - mesh.vertices[v[0]]);
    }

    Tensor<1, 3> unit(const Tensor<1, 3> &v)
    {
      const double length = v.norm();
      return length > 0. ? v / length : v;
    }

    /// At a corner of a triangle.
    double angle(const SurfaceMesh &mesh, const unsigned int triangle, const unsigned int corner)
    {
      const auto        &v    = mesh.triangles[triangle];
      const Point<3>    &here = mesh.vertices[v[corner]];
      const Tensor<1, 3> a    = unit(mesh.vertices[v[(corner + 1) % 3]] - here),
                         b    = unit(mesh.vertices[v[(corner + 2) % 3]] - here);
      return std::acos(std::max(-1., std::min(1., a * b)));
    }
  } // namespace



  BoundaryDepth::BoundaryDepth(SurfaceMesh boundary, std::vector<unsigned int> triangle_face)
    : mesh(std::move(boundary))
    , topology(mesh.triangles, mesh.vertices.size())
    , doubts(doubts_of_faces(triangle_face))
    , nearest(mesh, all_of(mesh))
  {
  }



  /// What is known of a face goes to all of its triangles.
  std::vector<double> BoundaryDepth::doubts_of_faces(const std::vector<unsigned int> &triangle_face) const
  {
    const FacetDoubtRule rule;
    const unsigned int   n_faces =
        triangle_face.empty() ? 0 : *std::max_element(triangle_face.begin(), triangle_face.end()) + 1;
    std::vector<double> areas(n_faces, 0.), of_faces(n_faces, 0.);
    for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
      areas[triangle_face[t]] += .5 * area_vector(mesh, t).norm();
    for (unsigned int e = 0; e < topology.edges.size(); ++e)
      if (!topology.is_border(e))
        {
          const auto &[s, t] = topology.edge_triangles[e];
          const double length =
              mesh.vertices[topology.edges[e][0]].distance(mesh.vertices[topology.edges[e][1]]);
          const double cosine = unit(area_vector(mesh, s)) * unit(area_vector(mesh, t));
          if (!(length > 0.) || cosine <= rule.sharp)
            continue;
          const double turn = std::acos(std::min(1., cosine));
          for (const unsigned int f : {triangle_face[s], triangle_face[t]})
            of_faces[f] = std::max(of_faces[f], rule.of_turn * turn * areas[f] / length);
        }
    for (unsigned int f = 0; f < n_faces; ++f)
      of_faces[f] += rule.rounding * std::sqrt(areas[f]);
    std::vector<double> result;
    for (const unsigned int f : triangle_face)
      result.push_back(of_faces[f]);
    return result;
  }



  /// One that tells inside from outside (Bærentzen and Aanæs: Signed distance computation using the angle
  /// weighted pseudonormal, 2005). Zero where the boundary ends.
  Tensor<1, 3> BoundaryDepth::normal(const SurfaceFoot &foot) const
  {
    const FacetDoubtRule      rule;
    std::vector<unsigned int> corners;
    for (unsigned int i = 0; i < 3; ++i)
      if (foot.weights[i] > rule.on_edge)
        corners.push_back(i);
    if (corners.size() == 3)
      return unit(area_vector(mesh, foot.triangle));
    if (corners.size() == 2)
      {
        const unsigned int opposite = 3 - corners[0] - corners[1];
        const unsigned int edge     = topology.triangle_edges[foot.triangle][(opposite + 1) % 3];
        if (topology.is_border(edge))
          return Tensor<1, 3>();
        const auto &[s, t] = topology.edge_triangles[edge];
        return unit(area_vector(mesh, s)) + unit(area_vector(mesh, t));
      }
    const unsigned int v = mesh.triangles[foot.triangle][corners[0]];
    Tensor<1, 3>       sum;
    for (unsigned int k = topology.fan_start[v]; k < topology.fan_start[v + 1]; ++k)
      {
        const unsigned int t = topology.fan[k], i = topology.local_corner(t, v);
        if (topology.is_border(topology.triangle_edges[t][i]) ||
            topology.is_border(topology.triangle_edges[t][(i + 2) % 3]))
          return Tensor<1, 3>();
        sum += angle(mesh, t, i) * unit(area_vector(mesh, t));
      }
    return sum;
  }



  /// The largest of the triangles there.
  double BoundaryDepth::doubt_at(const SurfaceFoot &foot) const
  {
    const auto  &corners = mesh.triangles[foot.triangle];
    double       result  = doubts[foot.triangle];
    unsigned int one     = 0;
    for (unsigned int i = 0; i < 3; ++i)
      if (foot.weights[i] > foot.weights[one])
        one = i;
    for (unsigned int k = topology.fan_start[corners[one]]; k < topology.fan_start[corners[one] + 1]; ++k)
      {
        const auto &other    = mesh.triangles[topology.fan[k]];
        bool        contains = true;
        for (unsigned int i = 0; i < 3; ++i)
          contains = contains && (foot.weights[i] <= FacetDoubtRule().on_edge ||
                                  std::find(other.begin(), other.end(), corners[i]) != other.end());
        if (contains)
          result = std::max(result, doubts[topology.fan[k]]);
      }
    return result;
  }



  double BoundaryDepth::operator()(const Point<3> &p, const double reach) const
  {
    if (mesh.triangles.empty())
      return 0.;
    const SurfaceFoot foot = nearest.find(found, p);
    const double      way  = p.distance(foot.point);
    if (way > reach || !((p - foot.point) * normal(foot) < 0.))
      return 0.;
    return std::max(0., way - doubt_at(foot));
  }
} // namespace Signorini
