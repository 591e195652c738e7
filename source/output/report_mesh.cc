// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/report_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  void ReportMesh::add_face(const std::array<unsigned int, 4> &corners, const unsigned int n_corners,
                            const bool is_in_contact)
  {
    const unsigned char place = is_in_contact ? in_contact : 0;
    triangles.push_back({{corners[0], corners[1], corners[2]}});
    kinds.push_back(n_corners == 4 ? place | half : place);
    if (n_corners == 4)
      {
        triangles.push_back({{corners[2], corners[3], corners[0]}});
        kinds.push_back(place | half);
      }
  }



  void ReportMesh::sort_by_kind()
  {
    std::vector<std::size_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](const std::size_t a, const std::size_t b) { return kinds[a] < kinds[b]; });
    auto new_triangles = triangles;
    auto new_kinds     = kinds;
    for (std::size_t i = 0; i < order.size(); ++i)
      {
        new_triangles[i] = triangles[order[i]];
        new_kinds[i]     = kinds[order[i]];
      }
    triangles.swap(new_triangles);
    kinds.swap(new_kinds);
  }



  namespace
  {
    /// A box around the vertices: its lowest corner and its longest edge.
    std::pair<Point<3>, double> box_of(const std::vector<Point<3>> &vertices)
    {
      Point<3> low = vertices[0], high = vertices[0];
      for (const Point<3> &p : vertices)
        for (unsigned int c = 0; c < 3; ++c)
          {
            low[c]  = std::min(low[c], p[c]);
            high[c] = std::max(high[c], p[c]);
          }
      const Tensor<1, 3> size = high - low;
      return {low, std::max({size[0], size[1], size[2]})};
    }

    /// By vertex the one that it becomes: the first in its cube of a grid.
    std::vector<unsigned int> merge(const std::vector<Point<3>> &vertices, const Point<3> &origin,
                                    const double width, const std::vector<bool> &pinned)
    {
      std::unordered_map<std::uint64_t, unsigned int> first;
      std::vector<unsigned int>                       target(vertices.size());
      for (unsigned int v = 0; v < vertices.size(); ++v)
        if (target[v] = v; pinned.empty() || !pinned[v])
          {
            std::uint64_t cube = 0;
            for (unsigned int c = 0; c < 3; ++c)
              cube =
                  cube << 21 | static_cast<std::uint64_t>(std::floor((vertices[v][c] - origin[c]) / width));
            target[v] = first.emplace(cube, v).first->second;
          }
      return target;
    }

    bool collapses(const std::array<unsigned int, 3> &t, const std::vector<unsigned int> &target)
    {
      return target[t[0]] == target[t[1]] || target[t[1]] == target[t[2]] || target[t[2]] == target[t[0]];
    }

    /// Moves the corners of triangles to the targets of these, and drops what collapses and what is unused.
    std::vector<unsigned int> merge_vertices(ReportMesh &mesh, const std::vector<unsigned int> &target)
    {
      constexpr unsigned int    none = std::numeric_limits<unsigned int>::max();
      std::vector<unsigned int> number(mesh.vertices.size(), none), kept;
      ReportMesh                thinned;
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        if (auto t = mesh.triangles[i]; !collapses(t, target))
          {
            const bool is_whole = t[0] == target[t[0]] && t[1] == target[t[1]] && t[2] == target[t[2]];
            for (unsigned int &v : t)
              {
                unsigned int &n = number[target[v]];
                if (n == none)
                  {
                    n = static_cast<unsigned int>(kept.size());
                    kept.push_back(target[v]);
                    thinned.vertices.push_back(mesh.vertices[target[v]]);
                  }
                v = n;
              }
            thinned.triangles.push_back(t);
            thinned.kinds.push_back(is_whole ? mesh.kinds[i] : mesh.kinds[i] & ~ReportMesh::half);
          }
      mesh = std::move(thinned);
      return kept;
    }
  } // namespace



  std::vector<unsigned int> thin(ReportMesh &mesh, const std::size_t n_triangles,
                                 const std::vector<bool> &pinned)
  {
    if (mesh.triangles.size() <= n_triangles)
      return {};
    const auto [origin, size] = box_of(mesh.vertices);
    // Beyond 16 cubes across nothing of a shape is left: then what is pinned has to give way.
    constexpr double finest = 65536., coarsest = 16.;
    for (double n = finest; n >= 1.; n /= std::sqrt(2.))
      {
        const auto target =
            merge(mesh.vertices, origin, 1.0001 * size / n, n >= coarsest ? pinned : std::vector<bool>());
        const auto left = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                        [&](const auto &t) { return !collapses(t, target); });
        if (static_cast<std::size_t>(left) <= n_triangles)
          return merge_vertices(mesh, target);
      }
    return merge_vertices(mesh, std::vector<unsigned int>(mesh.vertices.size(), 0));
  }
} // namespace Signorini
