// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/surface_creases.h>
#include <signorini/surface/crease_edges.h>

namespace Signorini
{
  void mark_creases(ContactSurface &surface)
  {
    const SurfaceTopology   topology(surface.mesh.triangles, surface.mesh.vertices.size());
    const std::vector<bool> is_crease = find_creases(surface.mesh, topology);
    surface.crease_sides.assign(topology.triangles.size(), 0);
    for (unsigned int t = 0; t < topology.triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        if (is_crease[topology.triangle_edges[t][i]])
          surface.crease_sides[t] |= static_cast<unsigned char>(1u << i);
  }



  std::vector<bool> creases_of(const ContactSurface &surface, const SurfaceTopology &topology)
  {
    if (surface.crease_sides.size() != topology.triangles.size())
      return find_creases(surface.mesh, topology);
    std::vector<bool> result(topology.edges.size(), false);
    for (unsigned int t = 0; t < topology.triangles.size(); ++t)
      for (unsigned int i = 0; i < 3; ++i)
        if ((surface.crease_sides[t] >> i & 1u) != 0 && !topology.is_border(topology.triangle_edges[t][i]))
          result[topology.triangle_edges[t][i]] = true;
    return result;
  }
} // namespace Signorini
