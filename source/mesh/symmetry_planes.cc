// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/symmetry_planes.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    class SymmetryPlanes
    {
    public:
      SymmetryPlanes(const ContactSurface &surface, const std::vector<FixedMask> &fixed,
                     const SymmetryPlaneRule &rule)
        : mesh(surface.mesh)
        , fixed(fixed)
        , rule(rule)
        , topology(mesh.triangles, mesh.vertices.size())
      {
      }

      /// The components that symmetry planes take from the normal of a vertex.
      FixedMask components(const unsigned int vertex)
      {
        FixedMask result = 0;
        for (unsigned int c = 0; c < dim; ++c)
          if ((fixed[vertex] & (1u << c)) && ends_at_plane(vertex, c) && is_curved_across(vertex, c))
            result |= static_cast<FixedMask>(1u << c);
        return result;
      }

    private:
      /// Whether border edges with prescribed component c meet at a vertex, all in the plane x_c = const.
      bool ends_at_plane(const unsigned int vertex, const unsigned int c) const
      {
        bool any = false;
        for (unsigned int f = topology.fan_start[vertex]; f < topology.fan_start[vertex + 1]; ++f)
          for (const unsigned int edge : topology.triangle_edges[topology.fan[f]])
            {
              const auto &[a, b] = topology.edges[edge];
              if (!topology.is_border(edge) || (a != vertex && b != vertex) ||
                  !(fixed[a] & fixed[b] & (1u << c)))
                continue;
              const Tensor<1, 3> way = mesh.vertices[b] - mesh.vertices[a];
              if (std::abs(way[c]) > rule.planarity * way.norm())
                return false;
              any = true;
            }
        return any;
      }

      /// Whether the facets around a vertex and those around their corners differ in component c by as much
      /// as the normal of the vertex has of it. Where all of them touch the plane there is nothing to compare
      /// with: then whether they differ at all.
      bool is_curved_across(const unsigned int vertex, const unsigned int c)
      {
        near.clear();
        for (unsigned int f = topology.fan_start[vertex]; f < topology.fan_start[vertex + 1]; ++f)
          for (const unsigned int corner : topology.triangles[topology.fan[f]])
            near.insert(near.end(), topology.fan.begin() + topology.fan_start[corner],
                        topology.fan.begin() + topology.fan_start[corner + 1]);
        const Tensor<1, 3> &normal = mesh.vertex_normals[vertex];
        double              least = 1., largest = -1.;
        bool                all_touch = true;
        for (const unsigned int t : near)
          {
            const auto        &x      = mesh.triangles[t];
            const Tensor<1, 3> area   = cross_product_3d(mesh.vertices[x[1]] - mesh.vertices[x[0]],
                                                         mesh.vertices[x[2]] - mesh.vertices[x[0]]);
            const double       length = area.norm();
            if (length == 0. || area * normal < rule.crease * length)
              continue;
            least     = std::min(least, area[c] / length);
            largest   = std::max(largest, area[c] / length);
            all_touch = all_touch && std::any_of(x.begin(), x.end(), [&](const unsigned int corner) {
                          const double distance = mesh.vertices[corner][c] - mesh.vertices[vertex][c];
                          return distance * distance <= rule.planarity * rule.planarity * length;
                        });
          }
        return largest - least >= (all_touch ? rule.flatness : std::abs(normal[c]));
      }

      const SurfaceMesh            &mesh;
      const std::vector<FixedMask> &fixed;
      const SymmetryPlaneRule      &rule;
      const SurfaceTopology         topology;
      std::vector<unsigned int>     near;
    };
  } // namespace



  void project_onto_symmetry_planes(ContactSurface &surface, const SymmetryPlaneRule &rule)
  {
    // Prescribed components of hanging vertices are those of all of their parents.
    std::vector<FixedMask> fixed = surface.vertex_fixed;
    for (std::size_t v = 0; v < fixed.size(); ++v)
      if (!surface.hanging[v].empty())
        {
          fixed[v] = all_fixed;
          for (const auto &parent : surface.hanging[v])
            fixed[v] &= surface.vertex_fixed[parent.first];
        }
    // Vertices without any free component carry no multiplier.
    const auto is_partly_fixed = [](const FixedMask mask) { return mask != 0 && mask != all_fixed; };
    if (std::none_of(fixed.begin(), fixed.end(), is_partly_fixed))
      return;

    SymmetryPlanes                                 planes(surface, fixed, rule);
    std::vector<std::pair<std::size_t, FixedMask>> projected;
    std::vector<bool>                              is_projected(fixed.size(), false);
    for (unsigned int v = 0; v < fixed.size(); ++v)
      if (surface.hanging[v].empty() && is_partly_fixed(fixed[v]))
        if (const FixedMask components = planes.components(v); components != 0)
          projected.emplace_back(v, components);
    for (const auto &[v, components] : projected)
      {
        Tensor<1, 3>      &normal = surface.mesh.vertex_normals[v];
        const Tensor<1, 3> inside = project_free(components, normal);
        if (const double length = inside.norm(); length > 0.)
          {
            normal          = inside / length;
            is_projected[v] = true;
          }
      }
    for (std::size_t v = 0; v < fixed.size(); ++v)
      if (std::any_of(surface.hanging[v].begin(), surface.hanging[v].end(),
                      [&](const auto &parent) { return is_projected[parent.first]; }))
        {
          Tensor<1, 3> mean;
          for (const auto &[parent, weight] : surface.hanging[v])
            mean += weight * surface.mesh.vertex_normals[parent];
          surface.mesh.vertex_normals[v] = mean / mean.norm();
        }
  }
} // namespace Signorini
