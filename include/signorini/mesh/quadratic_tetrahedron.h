// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_quadratic_tetrahedron_h
#define signorini_mesh_quadratic_tetrahedron_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// The eight linear tetrahedra of a quadratic one, by vertices: four at its corners, four around the
  /// shortest diagonal of the octahedron between them. Their faces on its border do not depend on the
  /// diagonal.
  /// @param vertices of the mesh
  /// @param nodes numbers of the corners, then of the nodes between corners 01, 12, 02, 03, 13, 23
  std::array<std::array<unsigned int, 4>, 8>
  cut_quadratic_tetrahedron(const std::vector<dealii::Point<3>> &vertices,
                            const std::array<unsigned int, 10>  &nodes);
} // namespace Signorini

#endif
