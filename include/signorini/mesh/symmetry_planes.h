// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_symmetry_planes_h
#define signorini_mesh_symmetry_planes_h

#include <signorini/mesh/contact_surface.h>

namespace Signorini
{
  /// What tells a symmetry plane from other prescribed components at the border of a surface. Pure numbers.
  struct SymmetryPlaneRule
  {
    /// Border edges lie in the plane if they leave it by no more than this part of their length. Whatever is
    /// below changes the angle between normal and border by no more than that.
    double planarity = 1e-6;
    /// Facets whose normals have a smaller product with the normal of the vertex lie beyond a crease.
    double crease = .5;
    /// Facets whose normals differ by less are coplanar: files have eight digits and more.
    double flatness = 1e-6;
    /// The largest cosine of directions that are at right angles, and of one across a normal; the smallest of
    /// those that are the same.
    double right_angle = .02, across = .5, same = .999;
  };

  /// Projects the normals of a surface, however they were computed, onto the symmetry planes that it ends at:
  /// the mesh of half a body sees the facets of one side only, its normals lean out of the plane by half the
  /// angle between facets (0.14 % of the force on the Hertz problem). Vertices with a projected parent get
  /// the mean of their parents.
  ///
  /// A prescribed component c alone says nothing about the direction of the surface, so a normal n keeps it
  /// unless border edges with this component prescribed meet at the vertex, all of them in the plane x_c =
  /// const, and n_c is no more than what c differs by between the facets near the vertex (two rings; all
  /// touch the plane where the surface is one cell wide: then it must not be flat). On a flat surface facets
  /// do not differ, and an inclined one stays inclined; near a symmetry plane of a smooth surface they differ
  /// by at least twice n_c.
  void project_onto_symmetry_planes(ContactSurface &surface, const SymmetryPlaneRule &rule = {});

  /// Collective. How many planes of symmetry, at right angles to each other, a part of a surface is cut off
  /// by: directions across its normals that are prescribed at some of its vertices, ends of border edges in
  /// the plane across them; all vertices where they are prescribed lie in one plane. (In plane strain they
  /// lie in two.)
  /// @param is_part by vertex
  unsigned int count_symmetry_planes(const ContactSurface &surface, const std::vector<bool> &is_part,
                                     const MPI_Comm communicator, const SymmetryPlaneRule &rule = {});
} // namespace Signorini

#endif
