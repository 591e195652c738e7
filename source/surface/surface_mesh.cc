// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/surface_mesh.h>

#include <deal.II/base/tensor.h>

namespace Signorini
{
  using namespace dealii;

  void SurfaceMesh::compute_vertex_normals()
  {
    vertex_normals.assign(vertices.size(), Tensor<1, 3>());
    for (const auto &t : triangles)
      {
        // Twice the area times the unit normal: the weighting by area comes for free.
        const Tensor<1, 3> normal =
            cross_product_3d(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
        for (const unsigned int v : t)
          vertex_normals[v] += normal;
      }
    for (Tensor<1, 3> &normal : vertex_normals)
      if (const double length = normal.norm(); length > 0.)
        normal /= length;
  }



  SurfaceTopology::SurfaceTopology(const SurfaceMesh &mesh)
    : neighbours(mesh.triangles.size(), {{-1, -1, -1}})
    , fan_start(mesh.vertices.size() + 1, 0)
    , fan(3 * mesh.triangles.size())
  {
    for (const auto &triangle : mesh.triangles)
      for (const unsigned int v : triangle)
        ++fan_start[v + 1];
    std::partial_sum(fan_start.begin(), fan_start.end(), fan_start.begin());
    std::vector<unsigned int> next(fan_start.begin(), fan_start.end() - 1);
    for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
      for (const unsigned int v : mesh.triangles[t])
        fan[next[v]++] = t;

    for (unsigned int t = 0; t < mesh.triangles.size(); ++t)
      for (unsigned int e = 0; e < 3; ++e)
        {
          const unsigned int a = mesh.triangles[t][e], b = mesh.triangles[t][(e + 1) % 3];
          for (unsigned int k = fan_start[a]; k < fan_start[a + 1]; ++k)
            if (const auto &other = mesh.triangles[fan[k]];
                fan[k] != t && std::find(other.begin(), other.end(), b) != other.end())
              {
                neighbours[t][e] = static_cast<int>(fan[k]);
                break;
              }
        }
  }
} // namespace Signorini
