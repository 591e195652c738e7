// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_abaqus_input_h
#define signorini_mesh_abaqus_input_h

#include <signorini/mesh/volume_mesh.h>

#include <string>

namespace Signorini
{
  /// Reads the mesh of an Abaqus or CalculiX input file: what Deck reads, as one mesh; other keywords are
  /// passed over. The volume of a cell is named by the last ELSET that contains it. Surfaces, sets of shell
  /// faces, and sets of nodes that contain all nodes of boundary faces name boundaries, which may overlap
  /// (VolumeMesh::boundary_groups); sets of nodes are there by themselves, too. Names are compared without
  /// regard to case and kept as written first. Errors: InputError with file and line.
  VolumeMesh read_abaqus_mesh(const std::string &file);
} // namespace Signorini

#endif
