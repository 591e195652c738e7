// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The connected parts of bodies.

#include "placed_body.h"

#include <sstream>

namespace Signorini
{
  using namespace dealii;

  void Bodies::find_parts(Placed &placed, const unsigned int body)
  {
    const VolumeMesh                                             &mesh         = placed.mesh;
    const unsigned int                                            first_part   = n_parts();
    const std::vector<unsigned int>                               part_of_cell = connected_parts(mesh);
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> copies;
    std::vector<unsigned int> part_of_vertex(mesh.vertices.size(), VolumeMesh::no_vertex);
    std::vector<Point<3>>     low, high;
    placed.material_of_cell.clear();
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const VolumeMesh::Cell &cell = mesh.cells[c];
        const unsigned int      part = part_of_cell[c], base = placed.material_of_volume[cell.volume];
        if (part == low.size())
          {
            parts.push_back({body, Point<3>(), {}});
            low.push_back(mesh.vertices[cell.vertices[0]]);
            high.push_back(low.back());
          }
        for (unsigned int v = 0; v < cell.n_vertices; ++v)
          {
            part_of_vertex[cell.vertices[v]] = part;
            for (unsigned int i = 0; i < 3; ++i)
              {
                low[part][i]  = std::min(low[part][i], mesh.vertices[cell.vertices[v]][i]);
                high[part][i] = std::max(high[part][i], mesh.vertices[cell.vertices[v]][i]);
              }
          }
        if (part == 0)
          {
            placed.material_of_cell.push_back(base);
            continue;
          }
        const auto [it, is_new] = copies.insert({{base, part}, static_cast<unsigned int>(materials.size())});
        if (is_new)
          {
            Material copy = materials[base];
            copy.part     = first_part + part;
            materials.push_back(copy);
          }
        placed.material_of_cell.push_back(it->second);
      }
    for (std::size_t part = 0; part < low.size(); ++part)
      parts[first_part + part].centre = low[part] + .5 * (high[part] - low[part]);
    for (const auto &face : mesh.faces)
      parts[first_part + part_of_vertex[face.vertices[0]]].boundaries.insert(placed.first_boundary +
                                                                             face.name);
  }



  std::string Bodies::part_name(const unsigned int part) const
  {
    std::ostringstream text;
    text << "body " << names[parts[part].body];
    if (std::count_if(parts.begin(), parts.end(),
                      [&](const BodyPart &p) { return p.body == parts[part].body; }) > 1)
      text << " (its part around (" << parts[part].centre[0] << ", " << parts[part].centre[1] << ", "
           << parts[part].centre[2] << "), which touches no other)";
    return text.str();
  }



  std::string Bodies::hint_at_volumes(const unsigned int body) const
  {
    const auto n_own =
        std::count_if(parts.begin(), parts.end(), [body](const BodyPart &p) { return p.body == body; });
    if (n_own < 2 || volumes[body].size() < 2)
      return "";
    return " Its mesh is of " + std::to_string(n_own) + " parts with the volumes " + listed(volumes[body]) +
           ": if they are bodies of their own, choose that of this one with Body " + names[body] +
           "/Volumes.";
  }



  std::string Bodies::boundary_name(const types::boundary_id id) const
  {
    const auto body = static_cast<unsigned int>(
        std::upper_bound(first_boundary.begin(), first_boundary.end(), id) - first_boundary.begin() - 1);
    return "body " + names[body] + ", boundary \"" + boundaries[body][id - first_boundary[body]] + "\"";
  }
} // namespace Signorini
