// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mesh_extruded_mesh_h
#define signorini_source_mesh_extruded_mesh_h

#include <signorini/mesh/generated_mesh.h>

#include <functional>

namespace Signorini
{
  // The part of generate_mesh() for tubes, half cylinders and prisms: plane figures of quadrilaterals, drawn
  // out along the z axis, 0 <= z <= height.

  using HexahedronCorners = std::array<dealii::Point<3>, 8>;

  /// What a generator hands to generate_mesh(): cells, a length to compare distances with, and the functions
  /// that vanish on the boundaries, the first that fits counts.
  struct ShapedCells
  {
    std::vector<HexahedronCorners>                                                       cells;
    double                                                                               size;
    std::vector<std::pair<std::string, std::function<double(const dealii::Point<3> &)>>> boundaries;
    std::vector<CurvedBoundary>                                                          curved;
  };

  /// Whether the word is part of the kind's name.
  bool kind_has(const GeneratedMeshParameters &p, const char *word);

  /// Vanishes where the coordinate has this value.
  std::function<double(const dealii::Point<3> &)> coordinate_plane(unsigned int axis, double value);

  /// Errors: InputError that calls the value by this name.
  void require_positive(double value, const std::string &name);

  /// Whether a kind is one of those.
  bool is_extruded(const std::string &kind);

  /// Errors: InputError for sizes that make no sense.
  ShapedCells extruded_cells(const GeneratedMeshParameters &parameters);
} // namespace Signorini

#endif
