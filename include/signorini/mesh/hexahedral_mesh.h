// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_hexahedral_mesh_h
#define signorini_mesh_hexahedral_mesh_h

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace Signorini
{
  /// A mesh of hexahedra as plain arrays, with named boundaries and volumes.
  struct HexahedralMesh
  {
    struct BoundaryFace
    {
      std::array<unsigned int, 4> vertices;
      /// Index into boundary_names.
      unsigned int name;
    };

    std::vector<dealii::Point<3>> vertices;
    /// Vertex numbers in deal.II's order (lexicographic).
    std::vector<std::array<unsigned int, 8>> cells;
    /// Index into volume_names, per cell.
    std::vector<unsigned int> cell_volume;
    std::vector<BoundaryFace> faces;
    std::vector<std::string>  boundary_names;
    std::vector<std::string>  volume_names;
    /// Remarks for the user, e.g. on mended cells.
    std::vector<std::string> notes;

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &vertices &cells &cell_volume &boundary_names &volume_names &notes;
      std::size_t                                                          n = faces.size();
      archive                                                             &n;
      faces.resize(n);
      for (BoundaryFace &face : faces)
        archive &face.vertices &face.name;
    }
  };

  /// Faces that belong to one cell only, vertices in deal.II's face order, and that cell.
  std::vector<std::pair<std::array<unsigned int, 4>, unsigned int>>
  find_boundary_faces(const HexahedralMesh &mesh);

  /// Smallest of the 8 corner Jacobians of a cell, each scaled by the product of its edge lengths: 1 for a
  /// brick, not positive for an inverted cell.
  double scaled_jacobian(const std::array<dealii::Point<3>, 8> &corners);
} // namespace Signorini

#endif
