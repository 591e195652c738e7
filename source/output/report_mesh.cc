// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/report_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>

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
    /// Cubes (nearly) around the vertices, so that those on the faces of the box lie in the middle of cubes.
    class Grid
    {
    public:
      explicit Grid(const std::vector<Point<3>> &vertices)
        : low(vertices[0])
      {
        Point<3> high = low;
        for (const Point<3> &p : vertices)
          for (unsigned int c = 0; c < 3; ++c)
            {
              low[c]  = std::min(low[c], p[c]);
              high[c] = std::max(high[c], p[c]);
            }
        size = high - low;
      }

      /// n cubes along the longest edge of the box.
      void divide(const double n)
      {
        const double longest = std::max({size[0], size[1], size[2]});
        for (unsigned int c = 0; c < 3; ++c)
          width[c] = size[c] > 0. ? size[c] / std::max(1., std::round(n * size[c] / longest)) : 1.;
      }

      /// The number of the cube that a point lies in, and how far it is from the middle.
      std::pair<std::uint64_t, double> find(const Point<3> &p) const
      {
        std::uint64_t cube   = 0;
        double        square = 0.;
        for (unsigned int c = 0; c < 3; ++c)
          {
            const double x = (p[c] - low[c]) / width[c], middle = std::round(x);
            cube = cube << 21 | static_cast<std::uint64_t>(middle);
            square += (x - middle) * (x - middle);
          }
        return {cube, square};
      }

    private:
      Point<3>     low;
      Tensor<1, 3> size, width;
    };

    /// By vertex the one that it becomes: the one nearest to the middle of their cube, the first of several.
    std::vector<unsigned int> merge(const std::vector<Point<3>> &vertices, const Grid &grid,
                                    const std::vector<bool> &pinned)
    {
      const auto is_free = [&](const unsigned int v) { return pinned.empty() || !pinned[v]; };
      std::unordered_map<std::uint64_t, std::pair<double, unsigned int>> nearest;
      for (unsigned int v = 0; v < vertices.size(); ++v)
        if (is_free(v))
          {
            const auto [cube, distance] = grid.find(vertices[v]);
            auto &entry                 = nearest.emplace(cube, std::make_pair(distance, v)).first->second;
            // What differs by rounding only is the same.
            if (distance < entry.first - 1e-9)
              entry = {distance, v};
          }
      std::vector<unsigned int> target(vertices.size());
      for (unsigned int v = 0; v < vertices.size(); ++v)
        target[v] = is_free(v) ? nearest.at(grid.find(vertices[v]).first).second : v;
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
    Grid grid(mesh.vertices);
    // Beyond 16 cubes across nothing of a shape is left: then what is pinned has to give way.
    constexpr double finest = 65536., coarsest = 16.;
    for (double n = finest; n >= 1.; n /= std::sqrt(2.))
      {
        grid.divide(n);
        const auto target = merge(mesh.vertices, grid, n >= coarsest ? pinned : std::vector<bool>());
        const auto left   = std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
                                          [&](const auto &t) { return !collapses(t, target); });
        if (static_cast<std::size_t>(left) <= n_triangles)
          return merge_vertices(mesh, target);
      }
    return merge_vertices(mesh, std::vector<unsigned int>(mesh.vertices.size(), 0));
  }
} // namespace Signorini
