// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_mesh_input_h
#define signorini_mesh_mesh_input_h

#include <signorini/mesh/volume_mesh.h>

#include <mpi.h>

#include <string>

namespace Signorini
{
  /// Collective. Reads tetrahedra and hexahedra: Abaqus files (.inp) by read_abaqus_mesh(), all others with
  /// gmsh's own library (which keeps physical names and does not join coincident nodes). Rank 0 reads, all
  /// get plain arrays. Boundary faces and volumes get the names of their physical groups, or the ids as text
  /// where there is no name; faces without a group are "unnamed", those of several have all of the names
  /// (VolumeMesh::boundary_groups), volumes of several the first one, with a note. Cells of mirrored
  /// orientation are mended, with a note. Errors: InputError for missing or broken files, unsupported
  /// elements (by name), cells that are inverted or there twice, and files of which not every cell can be
  /// read.
  VolumeMesh read_volume_mesh(const std::string &file, const MPI_Comm communicator);
} // namespace Signorini

#endif
