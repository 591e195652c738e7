// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/surface_values.h>

namespace Signorini
{
  using namespace dealii;

  std::array<double, 3> compose(const std::array<std::array<double, 3>, 3> &corners,
                                const std::array<double, 3>                &weights)
  {
    std::array<double, 3> result = {{0., 0., 0.}};
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < 3; ++i)
        result[i] += weights[c] * corners[c][i];
    return result;
  }



  namespace
  {
    /// Normals of vertices, interpolated; zero where one of them is more than 28 degrees away from that of
    /// the triangle: those of a circle of 8 edges are 22 degrees away, of an edge between faces 30 and more.
    Vector3 smooth_normal(const ContactSurface &surface, const unsigned int triangle,
                          const std::array<double, 3> &weights)
    {
      constexpr double least_cosine = .88;
      const Vector3    facet        = facet_normal(surface, triangle);
      Vector3          normal;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Vector3 &n = surface.mesh.vertex_normals[surface.mesh.triangles[triangle][i]];
          if (!(n * facet >= least_cosine))
            return Vector3();
          normal += weights[i] * n;
        }
      return normal / normal.norm();
    }
  } // namespace



  Vector3 initial_gap(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const OverlayTriangle &cell, const std::array<double, 3> &weights, const Point<3> &x,
                      const Point<3> &image)
  {
    // On the cells of the overlay Phi is linear: inside of them images lie a little beside where the normals
    // of the mortar side lead to, by more than a tight fit overlaps.
    const std::array<double, 3> at_x     = compose(cell.nonmortar, weights),
                                at_image = compose(cell.mortar, weights);
    const Vector3 n                      = smooth_normal(nonmortar, cell.nonmortar_triangle, at_x),
                  m                      = smooth_normal(mortar, cell.mortar_triangle, at_image);
    Vector3 gap                          = image - x;
    if (may_touch(n, m))
      gap = (gap * n) / (m * n) * m;
    if (mortar.true_shape.has_offsets())
      gap += mortar.offset(cell.mortar_triangle, at_image);
    if (nonmortar.true_shape.has_offsets())
      gap -= nonmortar.offset(cell.nonmortar_triangle, at_x);
    return gap;
  }



  bool may_touch(const Vector3 &normal, const Vector3 &other)
  {
    return normal * other < touching_cosine;
  }



  SurfaceValues::SurfaceValues(const ContactSurface &surface, std::vector<bool> some_vertices)
    : surface(surface)
    , sharp_vertices(std::move(some_vertices))
  {
    maps.reserve(surface.faces.size());
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      maps.emplace_back(surface, f);
  }



  Point<3> SurfaceValues::point(const unsigned int triangle, const std::array<double, 3> &weights) const
  {
    const auto &t = surface.mesh.triangles[triangle];
    const auto &x = surface.mesh.vertices;
    return Point<3>(weights[0] * x[t[0]] + weights[1] * x[t[1]] + weights[2] * x[t[2]]);
  }



  Vector3 SurfaceValues::normal(const unsigned int triangle, const std::array<double, 3> &weights) const
  {
    const auto &t = surface.mesh.triangles[triangle];
    const auto &n = surface.mesh.vertex_normals;
    Vector3     sum;
    for (unsigned int i = 0; i < 3; ++i)
      if (sharp_vertices.empty() || !sharp_vertices[t[i]])
        sum += weights[i] * n[t[i]];
      else
        sum += weights[i] * true_normal(surface, triangle, i);
    const double norm = sum.norm();
    return norm > 0. ? sum / norm : sum;
  }



  std::array<double, 4> SurfaceValues::shape(const unsigned int triangle, const Point<3> &p) const
  {
    const FaceMap &map = maps[surface.triangle_face[triangle]];
    double         s = .5, t = .5;
    map.invert(s, t, p);
    return map.shape(s, t);
  }



  Vector3 SurfaceValues::value(const std::vector<Vector3> &field, const unsigned int triangle,
                               const std::array<double, 4> &shape) const
  {
    AssertDimension(field.size(), surface.vertex_node.size());
    const auto &corners = surface.faces[surface.triangle_face[triangle]].corners;
    Vector3     sum;
    for (unsigned int a = 0; a < 4; ++a)
      sum += shape[a] * field[corners[a]];
    return sum;
  }



  Vector3 SurfaceValues::value(const CornerValues &field, const unsigned int triangle,
                               const std::array<double, 4> &shape) const
  {
    AssertDimension(field.size(), surface.faces.size());
    const auto &corners = field[surface.triangle_face[triangle]];
    Vector3     sum;
    for (unsigned int a = 0; a < 4; ++a)
      sum += shape[a] * corners[a];
    return sum;
  }
} // namespace Signorini
