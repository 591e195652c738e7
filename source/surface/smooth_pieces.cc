// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "smooth_pieces.h"

#include <algorithm>
#include <numeric>

namespace Signorini
{
  SmoothPieces::SmoothPieces(const SurfaceTopology &topology, const std::vector<bool> &is_cut)
    : of_corner(3 * topology.triangles.size())
  {
    const auto corner = [&](const unsigned int t, const unsigned int v) {
      return 3 * t + topology.local_corner(t, v);
    };
    std::iota(of_corner.begin(), of_corner.end(), 0u);
    for (unsigned int e = 0; e < topology.edges.size(); ++e)
      if (!is_cut[e])
        for (const unsigned int v : topology.edges[e])
          join(corner(topology.edge_triangles[e][0], v), corner(topology.edge_triangles[e][1], v));
    std::vector<unsigned int> number(of_corner.size(), SurfaceTopology::none);
    for (unsigned int c = 0; c < of_corner.size(); ++c)
      {
        const unsigned int r = root(c);
        if (number[r] == SurfaceTopology::none)
          {
            number[r] = static_cast<unsigned int>(vertices.size());
            vertices.emplace_back();
            vertices.back().vertex = topology.triangles[c / 3][c % 3];
          }
        vertices[number[r]].triangles.push_back(c / 3);
      }
    std::vector<unsigned int> piece_vertex;
    for (unsigned int c = 0; c < of_corner.size(); ++c)
      piece_vertex.push_back(number[root(c)]);
    of_corner = std::move(piece_vertex);
    for (unsigned int t = 0; t < topology.triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        if (is_cut[topology.triangle_edges[t][i]])
          for (const unsigned int k : {i, (i + 1) % 3})
            vertices[of_corner[3 * t + k]].is_closed = false;
  }



  void SmoothPieces::neighbours(std::vector<unsigned int> &found, const unsigned int centre,
                                const unsigned int n_rings) const
  {
    found            = {centre};
    std::size_t next = 0;
    for (unsigned int ring = 0; ring < n_rings; ++ring)
      for (const std::size_t end = found.size(); next < end; ++next)
        for (const unsigned int t : vertices[found[next]].triangles)
          for (unsigned int i = 0; i < 3; ++i)
            if (const unsigned int p = of_corner[3 * t + i];
                std::find(found.begin(), found.end(), p) == found.end())
              found.push_back(p);
    found.erase(found.begin());
  }



  unsigned int SmoothPieces::root(unsigned int c)
  {
    while (of_corner[c] != c)
      c = of_corner[c] = of_corner[of_corner[c]];
    return c;
  }



  void SmoothPieces::join(const unsigned int a, const unsigned int b)
  {
    const unsigned int ra = root(a), rb = root(b);
    of_corner[std::max(ra, rb)] = std::min(ra, rb);
  }
} // namespace Signorini
