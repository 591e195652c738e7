// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_extraction_h
#define signorini_mesh_surface_extraction_h

#include <signorini/algebra/node_partition.h>
#include <signorini/mesh/contact_surface.h>
#include <signorini/mesh/nodal_space.h>

#include <functional>
#include <set>

namespace Signorini
{
  /// Collective. The boundary faces with given ids, gathered on all ranks.
  /// @param fixed prescribed components of a relevant node
  /// @param region a face belongs to the surface if a corner or the centre lies in the region; empty for all
  /// @param shapes true shapes of the boundaries, where there are any
  ContactSurface extract_contact_surface(const NodalSpace                                         &space,
                                         const std::set<dealii::types::boundary_id>               &ids,
                                         const std::function<FixedDirections(const NodeIndex)>    &fixed,
                                         const std::function<bool(const dealii::Point<3> &point)> &region,
                                         const SurfaceShapes &shapes = {});

  /// Collective. Values of a nodal field at the vertices of a surface, of which every rank may have a piece.
  std::vector<Vector3> vertex_values(const ContactSurface &surface, const NodePartition &partition,
                                     const Vector &field);
} // namespace Signorini

#endif
