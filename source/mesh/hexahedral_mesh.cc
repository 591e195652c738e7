// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/hexahedral_mesh.h>

#include <deal.II/base/geometry_info.h>

#include <map>

namespace Signorini
{
  using namespace dealii;

  std::vector<std::pair<std::array<unsigned int, 4>, unsigned int>>
  find_boundary_faces(const HexahedralMesh &mesh)
  {
    std::map<std::array<unsigned int, 4>, std::pair<std::array<unsigned int, 4>, int>> open;
    for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int f = 0; f < 6; ++f)
        {
          std::array<unsigned int, 4> face;
          for (unsigned int v = 0; v < 4; ++v)
            face[v] = mesh.cells[cell][GeometryInfo<3>::face_to_cell_vertices(f, v)];
          std::array<unsigned int, 4> key = face;
          std::sort(key.begin(), key.end());
          const auto [it, is_new] = open.insert({key, {face, static_cast<int>(cell)}});
          if (!is_new)
            open.erase(it);
        }
    std::vector<std::pair<std::array<unsigned int, 4>, unsigned int>> faces;
    for (const auto &entry : open)
      faces.emplace_back(entry.second.first, entry.second.second);
    return faces;
  }



  double scaled_jacobian(const std::array<Point<3>, 8> &corners)
  {
    double smallest = std::numeric_limits<double>::max();
    for (unsigned int v = 0; v < 8; ++v)
      {
        std::array<Tensor<1, 3>, 3> edges;
        double                      sign = 1., lengths = 1.;
        for (unsigned int c = 0; c < 3; ++c)
          {
            edges[c] = corners[v ^ (1u << c)] - corners[v];
            sign *= (v & (1u << c)) ? -1. : 1.;
            lengths *= edges[c].norm();
          }
        const double volume = sign * (cross_product_3d(edges[0], edges[1]) * edges[2]);
        smallest            = std::min(smallest, lengths > 0. ? volume / lengths : 0.);
      }
    return smallest;
  }
} // namespace Signorini
