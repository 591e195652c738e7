// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/triangulated_shape.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::vector<unsigned int> all_triangles(const SurfaceMesh &mesh)
    {
      std::vector<unsigned int> list(mesh.triangles.size());
      std::iota(list.begin(), list.end(), 0u);
      return list;
    }

    std::vector<SurfaceFeet::CornerNormals> normals_of_vertices(const SurfaceMesh &mesh)
    {
      std::vector<SurfaceFeet::CornerNormals> normals;
      for (const auto &t : mesh.triangles)
        normals.push_back(
            {{mesh.vertex_normals[t[0]], mesh.vertex_normals[t[1]], mesh.vertex_normals[t[2]]}});
      return normals;
    }

    std::vector<unsigned int> chosen(const std::vector<bool> &wanted)
    {
      std::vector<unsigned int> list;
      for (unsigned int t = 0; t < wanted.size(); ++t)
        if (wanted[t])
          list.push_back(t);
      return list;
    }

    std::vector<SurfaceFeet::CornerNormals> normals_of_patches(const SmoothSurface             &surface,
                                                               const std::vector<unsigned int> &part)
    {
      std::vector<SurfaceFeet::CornerNormals> normals;
      for (const unsigned int t : part)
        normals.push_back(surface.patch(t).normals);
      return normals;
    }
  } // namespace



  TriangulatedShape::TriangulatedShape(SurfaceMesh surface, std::string remark)
    : mesh(std::move(surface))
    , feet(mesh, all_triangles(mesh), normals_of_vertices(mesh))
    , remark(std::move(remark))
  {
  }



  Point<3> TriangulatedShape::project(const Point<3> &p) const
  {
    return feet.find(p).point;
  }



  Tensor<1, 3> TriangulatedShape::normal(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    const Tensor<1, 3> n = feet.normal(p, facing);
    return n * facing < 0. ? -n : n;
  }



  SmoothShape::SmoothShape(SurfaceMesh boundary, const std::vector<bool> &wanted, const bool everywhere)
    : part(chosen(wanted))
    , surface(std::move(boundary), wanted)
    , feet(surface.mesh(), part, normals_of_patches(surface, part))
    , everywhere(everywhere)
  {
  }



  Point<3> SmoothShape::project(const Point<3> &p) const
  {
    const SurfaceFeet::Foot foot = feet.find(p);
    return is_curved(foot.triangle) ? foot.point + surface.offset(foot.triangle, foot.weights) : foot.point;
  }



  Tensor<1, 3> SmoothShape::normal(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    return feet.normal(p, facing);
  }



  double SmoothShape::doubt(const Point<3> &p) const
  {
    const unsigned int          triangle = feet.find(p).triangle;
    const SmoothSurface::Patch &patch    = surface.patch(triangle);
    return is_curved(triangle) ? patch.doubt : std::max(patch.doubt, patch.height);
  }



  bool SmoothShape::is_flat() const
  {
    return std::all_of(part.begin(), part.end(),
                       [&](const unsigned int t) { return surface.patch(t).is_flat; });
  }
} // namespace Signorini
