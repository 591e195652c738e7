// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_crease_normals_h
#define signorini_source_mortar_crease_normals_h

#include <signorini/mortar/edge_normals.h>

#include <map>

namespace Signorini
{
  /// By vertex on a crease of a surface that sticks out (find_creases(); less sharp than the edges of
  /// turn_edges()): of the normals between those of the facets around it the one nearest to that of the other
  /// side. A crease has all of these, as it touches with any of them; along the mean of its two sides a shaft
  /// with a chamfer would be pushed out of the hub that it fits. Vertices keep their normal where nothing is
  /// met, or more than one wall.
  std::map<unsigned int, Vector3> normals_on_creases(const ContactSurface &surface,
                                                     const PartnerSight   &partner);
} // namespace Signorini

#endif
