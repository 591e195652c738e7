// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_mesh_input_h
#define signorini_mesh_mesh_input_h

#include <signorini/mesh/hexahedral_mesh.h>

#include <mpi.h>

#include <string>

namespace Signorini
{
  /// Collective. Reads hexahedra from a file with gmsh's own library (which keeps physical names and does not
  /// join coincident nodes): rank 0 reads, all get plain arrays. Boundary faces and volumes get the names of
  /// their physical groups, or the ids as text where there is no name; faces without a group are "unnamed".
  /// Cells of mirrored orientation are mended, with a note.
  /// Errors: InputError for missing or broken files, unsupported elements (by name) and inverted cells.
  HexahedralMesh read_hexahedral_mesh(const std::string &file, const MPI_Comm communicator);
} // namespace Signorini

#endif
