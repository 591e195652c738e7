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



  Vector3 initial_gap(const ContactSurface &nonmortar, const ContactSurface &mortar,
                      const OverlayTriangle &cell, const std::array<double, 3> &weights, const Point<3> &x,
                      const Point<3> &image)
  {
    Vector3 gap = image - x;
    if (mortar.true_shape.has_offsets())
      gap += mortar.offset(cell.mortar_triangle, compose(cell.mortar, weights));
    if (nonmortar.true_shape.has_offsets())
      gap -= nonmortar.offset(cell.nonmortar_triangle, compose(cell.nonmortar, weights));
    return gap;
  }



  bool may_touch(const Vector3 &normal, const Vector3 &other)
  {
    constexpr double touching_cosine = -.5;
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
