// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "interpolated_field.h"

#include <signorini/algebra/types.h>
#include <signorini/mesh/cell_shape.h>

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
      /// Newton's method for places in hexahedra; it is exact after one step in parallelepipeds.
      unsigned int steps    = 30;
      double       accuracy = 1e-14;
      /// Boxes of cells are wider by this part of the mesh: rounding.
      double margin = 1e-10;
    };

    /// Values and derivatives of the shape functions of a cell.
    void shape(const unsigned int n_vertices, const std::array<double, 3> &xi, std::array<double, 8> &values,
               std::array<Vector3, 8> &gradients)
    {
      if (n_vertices == CellShape::tetrahedron)
        {
          values[0]    = 1. - xi[0] - xi[1] - xi[2];
          gradients[0] = Vector3({-1., -1., -1.});
          for (unsigned int c = 0; c < 3; ++c)
            {
              values[c + 1]       = xi[c];
              gradients[c + 1]    = Vector3();
              gradients[c + 1][c] = 1.;
            }
          return;
        }
      for (unsigned int v = 0; v < 8; ++v)
        {
          double f[3], d[3];
          for (unsigned int c = 0; c < 3; ++c)
            {
              f[c] = (v >> c & 1) ? xi[c] : 1. - xi[c];
              d[c] = (v >> c & 1) ? 1. : -1.;
            }
          values[v] = f[0] * f[1] * f[2];
          for (unsigned int c = 0; c < 3; ++c)
            gradients[v][c] = d[c] * f[(c + 1) % 3] * f[(c + 2) % 3];
        }
    }

    /// How far a place is outside of the reference cell; not positive inside.
    double outside(const unsigned int n_vertices, const std::array<double, 3> &xi)
    {
      double result = n_vertices == CellShape::tetrahedron ? xi[0] + xi[1] + xi[2] - 1. : -1.;
      for (const double x : xi)
        result = std::max({result, -x, n_vertices == CellShape::tetrahedron ? -1. : x - 1.});
      return result;
    }
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



  bool MeshInterpolation::to_reference(std::array<double, 3> &xi, const VolumeMesh::Cell &cell,
                                       const Point<3> &p) const
  {
    const InterpolationRule rule;
    xi.fill(cell.n_vertices == CellShape::tetrahedron ? .25 : .5);
    std::array<double, 8>  values;
    std::array<Vector3, 8> gradients;
    for (unsigned int step = 0; step < rule.steps; ++step)
      {
        shape(cell.n_vertices, xi, values, gradients);
        Vector3      missing(p);
        Tensor<2, 3> jacobian;
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          {
            const Vector3 x(mesh.vertices[cell.vertices[v]]);
            missing -= values[v] * x;
            jacobian += outer_product(x, gradients[v]);
          }
        if (determinant(jacobian) == 0.)
          return false;
        const Vector3 change = invert(jacobian) * missing;
        for (unsigned int c = 0; c < 3; ++c)
          xi[c] += change[c];
        if (!(change.norm() > rule.accuracy))
          break;
      }
    return std::isfinite(xi[0] + xi[1] + xi[2]);
  }



  MeshInterpolation::Weights MeshInterpolation::weights(const Point<3> &p) const
  {
    const Bin               bin  = bin_at(p);
    const int               most = *std::max_element(n_bins.begin(), n_bins.end());
    const VolumeMesh::Cell *best = nullptr;
    std::array<double, 3>   place{};
    double                  least = std::numeric_limits<double>::max();
    // Places on true shapes may lie beside all cells: bins farther away are searched.
    for (int width = 0; width <= most && best == nullptr; ++width)
      for (int z = std::max(0, bin[2] - width); z <= std::min(n_bins[2] - 1, bin[2] + width); ++z)
        for (int y = std::max(0, bin[1] - width); y <= std::min(n_bins[1] - 1, bin[1] + width); ++y)
          for (int x = std::max(0, bin[0] - width); x <= std::min(n_bins[0] - 1, bin[0] + width); ++x)
            for (const unsigned int i : cells_in({{x, y, z}}))
              {
                std::array<double, 3> xi;
                if (!to_reference(xi, mesh.cells[i], p))
                  continue;
                const double distance = outside(mesh.cells[i].n_vertices, xi);
                if (distance < least)
                  {
                    least = distance;
                    best  = &mesh.cells[i];
                    place = xi;
                  }
              }
    Weights                result;
    std::array<Vector3, 8> gradients;
    if (best == nullptr)
      {
        result.n         = 1;
        result.values[0] = 1.;
        return result;
      }
    // Nothing is extrapolated.
    double sum = 0.;
    for (double &x : place)
      {
        x = std::min(std::max(x, 0.), 1.);
        sum += x;
      }
    if (best->n_vertices == CellShape::tetrahedron && sum > 1.)
      for (double &x : place)
        x /= sum;
    result.n        = best->n_vertices;
    result.vertices = best->vertices;
    shape(best->n_vertices, place, result.values, gradients);
    return result;
  }
} // namespace Signorini
