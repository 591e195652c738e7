// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_cell_shape_h
#define signorini_mesh_cell_shape_h

#include <deal.II/base/array_view.h>

namespace Signorini
{
  /// The two shapes of cells, told apart by their number of vertices: 4 for tetrahedra, 8 for hexahedra (in
  /// deal.II's lexicographic order).
  namespace CellShape
  {
    /// Numbers of vertices: of the two kinds of cells, and the largest of a cell and of a face.
    constexpr unsigned int tetrahedron = 4, hexahedron = 8, max_vertices = 8, max_face_vertices = 4;

    /// Number of faces of a cell with so many vertices.
    inline unsigned int n_faces(const unsigned int n_vertices)
    {
      return n_vertices == tetrahedron ? 4 : 6;
    }

    /// Vertices of a face, counterclockwise seen from outside of a cell of positive orientation. Face f of a
    /// tetrahedron is opposite to vertex f; faces of hexahedra are numbered as in deal.II.
    inline dealii::ArrayView<const unsigned int> face(const unsigned int n_vertices, const unsigned int f)
    {
      static constexpr unsigned int triangles[4][3]      = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
      static constexpr unsigned int quadrilaterals[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
      return n_vertices == tetrahedron ? dealii::ArrayView<const unsigned int>(triangles[f], 3)
                                       : dealii::ArrayView<const unsigned int>(quadrilaterals[f], 4);
    }
  } // namespace CellShape
} // namespace Signorini

#endif
