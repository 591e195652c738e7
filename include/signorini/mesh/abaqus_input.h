// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_abaqus_input_h
#define signorini_mesh_abaqus_input_h

#include <signorini/mesh/volume_mesh.h>

#include <string>

namespace Signorini
{
  /// Reads the mesh of an Abaqus input file: NODE, ELEMENT (C3D4, C3D8 and its variants), ELSET, NSET,
  /// SURFACE (TYPE=ELEMENT); other keywords are passed over. The volume of a cell is named by the last ELSET
  /// that contains it, a boundary face by the first SURFACE, or else the smallest NSET that contains all its
  /// nodes. Names are compared without regard to case and kept as written first. At most one PART, without a
  /// moved INSTANCE. Errors: InputError with file and line.
  VolumeMesh read_abaqus_mesh(const std::string &file);
} // namespace Signorini

#endif
