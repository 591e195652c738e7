// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "interpolated_field.h"

#include <signorini/discretization/element.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct InterpolationRule
    {
      /// Boxes of cells are wider by this part of the mesh: rounding.
      double margin = 1e-10;
    };
  } // namespace



  MeshInterpolation::MeshInterpolation(const VolumeMesh &given)
  {
    mesh.vertices = given.vertices;
    mesh.cells    = given.cells;
    low = high = mesh.vertices[0];
    for (const Point<3> &p : mesh.vertices)
      for (unsigned int c = 0; c < 3; ++c)
        {
          low[c]  = std::min(low[c], p[c]);
          high[c] = std::max(high[c], p[c]);
        }
    // About one cell to a bin.
    const double longest = (high - low).norm(), n = std::cbrt(static_cast<double>(mesh.cells.size()));
    for (unsigned int c = 0; c < 3; ++c)
      n_bins[c] = std::max(1, static_cast<int>(n * (high[c] - low[c]) / longest));
    bins.resize(static_cast<std::size_t>(n_bins[0]) * n_bins[1] * n_bins[2]);
    const double margin = InterpolationRule().margin * longest;
    for (unsigned int i = 0; i < mesh.cells.size(); ++i)
      {
        Point<3> first = mesh.vertices[mesh.cells[i].vertices[0]], last = first;
        for (unsigned int v = 0; v < mesh.cells[i].n_vertices; ++v)
          for (unsigned int c = 0; c < 3; ++c)
            {
              const double x = mesh.vertices[mesh.cells[i].vertices[v]][c];
              first[c]       = std::min(first[c], x - margin);
              last[c]        = std::max(last[c], x + margin);
            }
        const Bin a = bin_at(first), b = bin_at(last);
        for (int z = a[2]; z <= b[2]; ++z)
          for (int y = a[1]; y <= b[1]; ++y)
            for (int x = a[0]; x <= b[0]; ++x)
              bins[(static_cast<std::size_t>(z) * n_bins[1] + y) * n_bins[0] + x].push_back(i);
      }
  }



  MeshInterpolation::Bin MeshInterpolation::bin_at(const Point<3> &p) const
  {
    Bin result;
    for (unsigned int c = 0; c < 3; ++c)
      {
        const double share = high[c] > low[c] ? (p[c] - low[c]) / (high[c] - low[c]) : 0.;
        result[c]          = static_cast<int>(std::min(std::max(share, 0.) * n_bins[c], n_bins[c] - 1.));
      }
    return result;
  }



  MeshInterpolation::Weights MeshInterpolation::weights(const Point<3> &p) const
  {
    const Bin               bin  = bin_at(p);
    const int               most = *std::max_element(n_bins.begin(), n_bins.end());
    const VolumeMesh::Cell *best = nullptr;
    Point<3>                place;
    double                  least = std::numeric_limits<double>::max();
    // Places on true shapes may lie beside all cells: bins farther away are searched.
    for (int width = 0; width <= most && best == nullptr; ++width)
      for (int z = std::max(0, bin[2] - width); z <= std::min(n_bins[2] - 1, bin[2] + width); ++z)
        for (int y = std::max(0, bin[1] - width); y <= std::min(n_bins[1] - 1, bin[1] + width); ++y)
          for (int x = std::max(0, bin[0] - width); x <= std::min(n_bins[0] - 1, bin[0] + width); ++x)
            for (const unsigned int i : cells_in({{x, y, z}}))
              {
                const Element element(mesh, mesh.cells[i]);
                Point<3>      xi;
                if (!element.invert_map(xi, p))
                  continue;
                const double distance = element.outside(xi);
                if (distance < least)
                  {
                    least = distance;
                    best  = &mesh.cells[i];
                    place = xi;
                  }
              }
    Weights result;
    if (best == nullptr)
      {
        result.n         = 1;
        result.values[0] = 1.;
        return result;
      }
    // Nothing is extrapolated.
    double sum = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      {
        place[c] = std::min(std::max(place[c], 0.), 1.);
        sum += place[c];
      }
    if (best->n_vertices == CellShape::tetrahedron && sum > 1.)
      place /= sum;
    result.n        = best->n_vertices;
    result.vertices = best->vertices;
    result.values   = Element(mesh, *best).shape_values(place);
    return result;
  }
} // namespace Signorini
