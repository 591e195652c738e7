// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_normals_h
#define signorini_mesh_surface_normals_h

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/mesh/contact_surface.h>

#include <functional>
#include <vector>

namespace Signorini
{
  /// Outward normal of a face times its area: half the product of the diagonals, whatever way the face is cut
  /// into triangles.
  Vector3 area_vector(const ContactSurface &surface, const ContactSurface::Face &face);

  /// Unit normal of a triangle; zero if it has no area.
  Vector3 facet_normal(const ContactSurface &surface, const unsigned int triangle);

  /// Unit normal of the true surface over a triangle at a corner of it (0, 1 or 2); zero if it has none.
  Vector3 true_normal(const ContactSurface &surface, const unsigned int triangle, const unsigned int corner);

  /// Normals, of any length, that are linked by steps of less than an angle with this cosine.
  DisjointSets linked_normals(const std::vector<Vector3> &normals, const double cosine);

  /// Sets the vertex normals of a contact surface. The one rule: every face gives its normal at each of its
  /// corners, that of its shape where there is one (a curved patch of the start mesh is a shape), else its
  /// own; they are added with the areas of the faces, and at creases the sides count alike, whatever their
  /// areas. Hanging vertices without a shape have the mean of their parents. In the end normals are projected
  /// onto the free directions of the vertex.
  /// @param counts whether a face counts at a vertex of it; all of them if empty
  void set_normals(ContactSurface &surface, const SurfaceShapes &shapes,
                   const std::function<bool(unsigned int face, unsigned int vertex)> &counts = {});
} // namespace Signorini

#endif
