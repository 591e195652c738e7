// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_tetrahedron_bisection_h
#define signorini_mesh_tetrahedron_bisection_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// A tetrahedron of a mesh that is refined by bisection.
  struct Tetrahedron
  {
    /// The id of a face between two cells.
    static constexpr dealii::types::boundary_id inner = dealii::numbers::internal_face_boundary_id;

    /// Positive orientation. Face f is opposite to vertex f.
    std::array<unsigned int, 4>               vertices;
    std::array<dealii::types::boundary_id, 4> boundary;
    unsigned int                              material;
    /// Number of bisections since the start mesh.
    unsigned int generation = 0;
  };

  /// What bisection has to know about a cell (Arnold, Mukherjee, Pouly: Locally adapted tetrahedral meshes
  /// using bisection, SIAM J. Sci. Comput. 22 (2000)).
  struct BisectionMarking
  {
    /// An edge of a cell as two of its vertices' positions 0-3.
    using Edge = std::array<unsigned char, 2>;

    /// The marked edge of each face; the refinement edge is that of two faces.
    std::array<Edge, 4> face_edge;
    Edge                refinement_edge;
    bool                flag;
  };

  /// A cell and how it will be bisected.
  struct MarkedTetrahedron
  {
    /// Both.
    Tetrahedron      cell;
    BisectionMarking marking;
  };

  /// The marking of a cell of a start mesh: longest edges, by a strict order that is the same for all cells
  /// (length, then the numbers of the ends).
  BisectionMarking mark_longest_edges(const Tetrahedron &cell, const std::vector<dealii::Point<3>> &vertices);

  /// The two halves of a cell.
  /// @param middle vertex in the middle of its refinement edge
  std::array<MarkedTetrahedron, 2> bisect(const MarkedTetrahedron &parent, const unsigned int middle);

  /// The mean ratio 12 (3 volume)^(2/3) / (sum of the squared edges) (Liu, Joe 1994): 1 for a regular
  /// tetrahedron, not positive for an inverted one.
  double tetrahedron_quality(const std::array<dealii::Point<3>, 4> &corners);
} // namespace Signorini

#endif
