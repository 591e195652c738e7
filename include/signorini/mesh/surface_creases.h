// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_creases_h
#define signorini_mesh_surface_creases_h

#include <signorini/mesh/contact_surface.h>

#include <vector>

namespace Signorini
{
  /// Finds the creases of a whole surface (find_creases()), once for all that is cut out of it
  /// (ContactSurface::crease_sides).
  void mark_creases(ContactSurface &surface);

  /// By edge of the topology of its triangles, whether it is a crease: of the whole that it was cut out of,
  /// if they were marked there.
  std::vector<bool> creases_of(const ContactSurface &surface, const SurfaceTopology &topology);
} // namespace Signorini

#endif
