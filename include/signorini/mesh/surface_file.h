// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_surface_file_h
#define signorini_mesh_surface_file_h

#include <signorini/surface/surface_mesh.h>

#include <string>

namespace Signorini
{
  /// Reads a triangulated surface, vertex normals included. OFF, STL, OBJ and PLY (text or binary) through
  /// CGAL, .msh through gmsh (all surface elements of a mesh without volume elements). Polygons are split
  /// into fans; coinciding points of an STL file, which knows no vertices, become one. Errors: InputError for
  /// missing, unreadable and unknown files, and for surfaces without triangles.
  SurfaceMesh read_surface(const std::string &file);
} // namespace Signorini

#endif
