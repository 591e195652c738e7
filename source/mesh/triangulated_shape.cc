// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/mesh/triangulated_shape.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
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



  BoundaryShapePointer plane_through(const SurfaceMesh &mesh, const std::vector<unsigned int> &triangles)
  {
    const auto  &x = mesh.vertices;
    Tensor<1, 3> normal;
    for (const unsigned int t : triangles)
      {
        const auto &[a, b, c] = mesh.triangles[t];
        normal += cross_product_3d(x[b] - x[a], x[c] - x[a]);
      }
    if (!(normal.norm() > 0.))
      return nullptr;
    normal /= normal.norm();
    const Point<3> &origin = x[mesh.triangles[triangles[0]][0]];
    double          height = 0., size = 0.;
    for (const unsigned int t : triangles)
      for (const unsigned int v : mesh.triangles[t])
        {
          height = std::max(height, std::abs((x[v] - origin) * normal));
          size   = std::max(size, x[v].distance(origin));
        }
    return height <= SmoothingRule().flat * size ? make_plane_shape(origin, normal) : nullptr;
  }



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



  SmoothShape::SmoothShape(std::shared_ptr<const SmoothSurface> smooth_surface,
                           std::vector<unsigned int> triangles, const bool everywhere)
    : surface(std::move(smooth_surface))
    , part(std::move(triangles))
    , feet(surface->mesh(), part, normals_of_patches(*surface, part))
    , everywhere(everywhere)
  {
  }



  SmoothShape::SmoothShape(SurfaceMesh boundary, const std::vector<bool> &wanted, const bool everywhere)
    : SmoothShape(std::make_shared<const SmoothSurface>(std::move(boundary), wanted), chosen(wanted),
                  everywhere)
  {
    divide();
  }



  namespace
  {
    /// By triangle the smallest one that can be reached without crossing a crease or leaving the part.
    std::vector<unsigned int> between_creases_of(const SmoothSurface             &surface,
                                                 const std::vector<unsigned int> &part)
    {
      const SurfaceMesh    &mesh = surface.mesh();
      const SurfaceTopology topology(mesh.triangles, mesh.vertices.size());
      std::vector<bool>     is_in_part(mesh.triangles.size(), false);
      for (const unsigned int t : part)
        is_in_part[t] = true;
      DisjointSets sets(mesh.triangles.size());
      for (unsigned int e = 0; e < topology.edges.size(); ++e)
        if (const auto &[s, t] = topology.edge_triangles[e];
            !topology.is_border(e) && is_in_part[s] && is_in_part[t] && !surface.creases()[e])
          sets.unite(s, t);
      std::vector<unsigned int> result;
      for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
        result.push_back(static_cast<unsigned int>(sets.find(t)));
      return result;
    }
  } // namespace



  void SmoothShape::divide()
  {
    const SurfaceMesh                                &mesh  = surface->mesh();
    const std::vector<unsigned int>                   first = between_creases_of(*surface, part);
    std::map<unsigned int, std::vector<unsigned int>> triangles;
    for (const unsigned int t : part)
      triangles[first[t]].push_back(t);
    if (triangles.size() < 2)
      return;
    piece_of_triangle.resize(mesh.triangles.size(), 0);
    for (auto &[root, list] : triangles)
      {
        for (const unsigned int t : list)
          piece_of_triangle[t] = static_cast<unsigned int>(between_creases.size());
        BoundaryShapePointer plane = plane_through(mesh, list);
        between_creases.push_back(plane ? plane
                                        : std::make_shared<const SmoothShape>(surface, list, everywhere));
      }
  }



  unsigned int SmoothShape::piece_at(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    return between_creases.empty() ? 0 : piece_of_triangle[feet.facing(p, facing)];
  }



  Point<3> SmoothShape::project(const Point<3> &p) const
  {
    const SurfaceFeet::Foot foot = feet.find(p);
    return foot.point + (everywhere ? surface->offset(foot.triangle, foot.weights)
                                    : surface->believed_offset(foot.triangle, foot.weights));
  }



  Tensor<1, 3> SmoothShape::normal(const Point<3> &p, const Tensor<1, 3> &facing) const
  {
    return between_creases.empty() ? feet.normal(p, facing)
                                   : between_creases[piece_at(p, facing)]->normal(p, facing);
  }



  double SmoothShape::doubt(const Point<3> &p) const
  {
    const unsigned int          triangle = feet.find(p).triangle;
    const SmoothSurface::Patch &patch    = surface->patch(triangle);
    const auto                 &ends     = patch.ends_at_edge;
    const bool goes_down = !everywhere && std::find(ends.begin(), ends.end(), true) != ends.end();
    return is_curved(triangle) && !goes_down ? patch.doubt : std::max(patch.doubt, patch.height);
  }



  bool SmoothShape::is_flat() const
  {
    return std::all_of(part.begin(), part.end(),
                       [&](const unsigned int t) { return surface->patch(t).is_flat; });
  }
} // namespace Signorini
