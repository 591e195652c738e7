// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "surface_overlay.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mortar/dual_basis.h>
#include <signorini/output/json_writer.h>
#include <signorini/output/summary.h>
#include <signorini/surface/mapping_quality.h>

#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    void check_surface(const SurfaceMesh &mesh, const std::string &side)
    {
      if (mesh.triangles.empty())
        throw InputError("The " + side + " surface has no triangles.");
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        if (!std::isfinite(mesh.vertices[v].norm()))
          throw InputError("Vertex " + std::to_string(v) + " of the " + side +
                           " surface has no finite coordinates.");
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const unsigned int v : mesh.triangles[t])
          if (v >= mesh.vertices.size())
            throw InputError("Triangle " + std::to_string(t) + " of the " + side +
                             " surface has a corner that is none of its " +
                             std::to_string(mesh.vertices.size()) + " vertices.");
      for (std::size_t v = 0; v < mesh.vertex_normals.size(); ++v)
        if (!(std::abs(mesh.vertex_normals[v].norm() - 1.) < 1e-6))
          throw InputError("Normal " + std::to_string(v) + " of the " + side + " surface is no unit vector.");
    }

    std::string report_of(const ContactMapping &mapping, const SurfaceMesh &nonmortar,
                          const SurfaceMesh &mortar)
    {
      std::ostringstream   text;
      JsonWriter           json(text);
      const MappingQuality quality = assess_mapping(mapping, nonmortar, mortar);
      json.begin('{');
      write_mapping_report(json, mapping.report());
      json.number("largest_angle_degrees", quality.largest_angle);
      json.number("mean_angle_degrees", quality.mean_angle);
      json.number("min_gap", quality.min_gap);
      json.number("max_gap", quality.max_gap);
      json.end('}');
      return text.str();
    }

    /// Integral over an overlay triangle of the product of two functions with such values at its corners.
    double integral(const std::array<double, 3> &f, const std::array<double, 3> &g, const double area)
    {
      double sum = (f[0] + f[1] + f[2]) * (g[0] + g[1] + g[2]);
      for (unsigned int c = 0; c < 3; ++c)
        sum += f[c] * g[c];
      return area / 12. * sum;
    }

    /// A hat function of the triangle around at the corners of an overlay triangle.
    std::array<double, 3> hat(const std::array<std::array<double, 3>, 3> &corners, const unsigned int i)
    {
      return {{corners[0][i], corners[1][i], corners[2][i]}};
    }

    /// By corner of a nonmortar triangle, its multiplier as a combination of the hat functions.
    using Multipliers = std::array<std::array<double, 3>, 3>;

    Multipliers dual_multipliers(const std::vector<OverlayTriangle> &cells, const std::vector<double> &areas,
                                 const std::size_t begin, const std::size_t end)
    {
      std::array<double, 16> mass = {};
      for (std::size_t k = begin; k < end; ++k)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            mass[4 * i + j] += integral(hat(cells[k].nonmortar, i), hat(cells[k].nonmortar, j), areas[k]);
      const DualBasis basis  = compute_dual_basis(mass, {{true, true, true, false}});
      Multipliers     result = {};
      for (unsigned int f = 0; f < basis.n_functions; ++f)
        for (unsigned int a = 0; a < 3; ++a)
          result[basis.corner[f]][a] = basis.coefficients[f][a];
      return result;
    }

    void add(SurfaceOverlay::Matrix &matrix, const unsigned int row, const unsigned int column,
             const double value)
    {
      matrix.rows.push_back(row);
      matrix.columns.push_back(column);
      matrix.values.push_back(value);
    }
  } // namespace



  SurfaceOverlay::SurfaceOverlay(SurfaceMesh nonmortar_surface, SurfaceMesh mortar_surface)
    : nonmortar(std::move(nonmortar_surface))
    , mortar(std::move(mortar_surface))
  {
    check_surface(nonmortar, "nonmortar");
    check_surface(mortar, "mortar");
    for (SurfaceMesh *mesh : {&nonmortar, &mortar})
      if (mesh->vertex_normals.empty())
        mesh->compute_vertex_normals();
    the_mapping = std::make_unique<const ContactMapping>(nonmortar, mortar);
    cells       = the_mapping->overlay();
    for (const OverlayTriangle &cell : cells)
      areas.push_back(cell.share() * triangle_area(nonmortar, cell.nonmortar_triangle));
    report = report_of(*the_mapping, nonmortar, mortar);
    errors = describe_errors(the_mapping->report());
  }



  std::vector<double> SurfaceOverlay::polygon_coordinates(const bool on_mortar) const
  {
    const ContactMapping &m = *the_mapping;
    std::vector<double>   result;
    for (std::size_t p = 0; p < m.n_polygons(); ++p)
      for (unsigned int k = m.polygon_start[p]; k < m.polygon_start[p + 1]; ++k)
        {
          const MappingNode          &node = m.nodes()[m.polygon_corners[k]];
          const std::array<double, 3> weights =
              on_mortar ? node.mortar.weights_in(m.mortar_topology(), m.polygon_triangles[p].second)
                        : node.nonmortar.weights_in(m.nonmortar_topology(), m.polygon_triangles[p].first);
          result.insert(result.end(), weights.begin(), weights.end());
        }
    return result;
  }



  std::pair<SurfaceOverlay::Matrix, SurfaceOverlay::Matrix> SurfaceOverlay::coupling(const bool is_dual) const
  {
    std::pair<Matrix, Matrix> result;
    // The overlay is ordered by nonmortar triangle.
    for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end)
      {
        while (end < cells.size() && cells[end].nonmortar_triangle == cells[begin].nonmortar_triangle)
          ++end;
        Multipliers multipliers = {};
        for (unsigned int i = 0; i < 3; ++i)
          multipliers[i][i] = 1.;
        if (is_dual)
          multipliers = dual_multipliers(cells, areas, begin, end);
        const auto &t = nonmortar.triangles[cells[begin].nonmortar_triangle];
        for (std::size_t k = begin; k < end; ++k)
          for (unsigned int i = 0; i < 3; ++i)
            {
              std::array<double, 3> psi = {};
              for (unsigned int a = 0; a < 3; ++a)
                for (unsigned int c = 0; c < 3; ++c)
                  psi[c] += multipliers[i][a] * cells[k].nonmortar[c][a];
              const auto &s = mortar.triangles[cells[k].mortar_triangle];
              for (unsigned int j = 0; j < 3; ++j)
                {
                  add(result.first, t[i], t[j], integral(psi, hat(cells[k].nonmortar, j), areas[k]));
                  add(result.second, t[i], s[j], integral(psi, hat(cells[k].mortar, j), areas[k]));
                }
            }
      }
    return result;
  }



  std::pair<std::vector<std::int64_t>, std::vector<double>>
  SurfaceOverlay::images(const std::vector<std::int64_t> &triangles, const std::vector<double> &weights,
                         const bool from_mortar) const
  {
    const SurfaceTopology &from = from_mortar ? the_mapping->mortar_topology()
                                              : the_mapping->nonmortar_topology(),
                          &to   = from_mortar ? the_mapping->nonmortar_topology()
                                              : the_mapping->mortar_topology();
    std::pair<std::vector<std::int64_t>, std::vector<double>> result;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        if (triangles[i] < 0 || static_cast<std::size_t>(triangles[i]) >= from.triangles.size())
          throw InputError("Point " + std::to_string(i) + ": there is no triangle " +
                           std::to_string(triangles[i]) + ".");
        const unsigned int          t = static_cast<unsigned int>(triangles[i]);
        const std::array<double, 3> w = {{weights[3 * i], weights[3 * i + 1], weights[3 * i + 2]}};
        if (!(std::min({w[0], w[1], w[2]}) >= 0. && std::abs(w[0] + w[1] + w[2] - 1.) < 1e-9))
          throw InputError("Point " + std::to_string(i) +
                           ": barycentric coordinates must not be negative, and their sum is 1.");
        const SurfacePoint point    = from_mortar ? the_mapping->preimage(t, w) : the_mapping->image(t, w);
        unsigned int       triangle = SurfaceTopology::none;
        if (point.on == SurfacePoint::On::triangle)
          triangle = point.index;
        else if (point.on == SurfacePoint::On::edge)
          triangle = std::min(to.edge_triangles[point.index][0], to.edge_triangles[point.index][1]);
        else if (point.on == SurfacePoint::On::vertex)
          triangle = to.fan[to.fan_start[point.index]];
        const bool                  is_mapped = triangle != SurfaceTopology::none;
        const std::array<double, 3> at =
            is_mapped ? point.weights_in(to, triangle) : std::array<double, 3>{{0., 0., 0.}};
        result.first.push_back(is_mapped ? static_cast<std::int64_t>(triangle) : -1);
        result.second.insert(result.second.end(), at.begin(), at.end());
      }
    return result;
  }
} // namespace Signorini
