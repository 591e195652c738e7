// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_mesh_input_h
#define signorini_mesh_mesh_input_h

#include <signorini/mesh/volume_mesh.h>

#include <mpi.h>

#include <map>
#include <string>

namespace Signorini
{
  /// Collective. Reads tetrahedra and hexahedra: Abaqus files (.inp) by read_abaqus_mesh(), all others with
  /// gmsh's own library (which keeps physical names and does not join coincident nodes). Rank 0 reads, all
  /// get plain arrays. Boundary faces and volumes get the names of their physical groups, or the ids as text
  /// where there is no name; faces without a group are "unnamed". Cells of mirrored orientation are mended,
  /// with a note. Errors: InputError for missing or broken files, unsupported elements (by name), cells
  /// that are inverted or there twice, and files of which not every cell can be read.
  VolumeMesh read_volume_mesh(const std::string &file, const MPI_Comm communicator);

  /// The index of a name, appended if new.
  unsigned int index_of(std::vector<std::string> &names, const std::string &name);

  /// Makes the boundary faces of a mesh, given the names of some of them by face_key(); others are "unnamed".
  void name_faces(VolumeMesh &mesh, const std::map<VolumeMesh::Face, std::string> &named);
} // namespace Signorini

#endif
