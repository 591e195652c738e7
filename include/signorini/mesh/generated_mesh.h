// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_generated_mesh_h
#define signorini_mesh_generated_mesh_h

#include <signorini/mesh/volume_mesh.h>

#include <memory>
#include <string>
#include <vector>

namespace Signorini
{
  /// Shape of a boundary that refinement has to follow, in the frame of the generated mesh.
  struct CurvedBoundary
  {
    /// Name of the boundary.
    std::string name;
    /// A sphere around the origin, or a cylinder around the z axis.
    enum Shape
    {
      sphere,
      cylinder
    } shape; ///< Which of them.
  };

  /// What a generator needs to know. Lengths in the units of the problem.
  struct GeneratedMeshParameters
  {
    /// One of generated_mesh_kinds(), and what that kind needs: radii and height of round ones, corners and
    /// numbers of cells of a block.
    std::string                 kind;
    double                      radius = 1., inner_radius = .5, height = 1.;
    dealii::Point<3>            lower_corner, upper_corner = dealii::Point<3>(1., 1., 1.);
    std::array<unsigned int, 3> divisions = {{1, 1, 1}};
  };

  /// A mesh with the boundaries that are curved.
  struct GeneratedMesh
  {
    /// As generate_mesh() describes it.
    VolumeMesh                  mesh;
    std::vector<CurvedBoundary> curved;
  };

  /// All kinds generate_mesh() knows, separated by "|".
  std::string generated_mesh_kinds();

  /// A coarse mesh of cells of near-equal edges. Balls and shells are centred at the origin; a half ball is
  /// the half z <= 0 with the flat boundary "top", quarters are x >= 0 and y >= 0 (boundaries "symmetry x",
  /// "symmetry y"), an eighth also z >= 0 ("symmetry z"). A cylinder has the axis z and lies in
  /// -height <= z <= 0 (boundaries "side", "top", "bottom"). A block has "left", "right", "front", "back",
  /// "bottom", "top" (x, y, z from low to high). Errors: InputError for sizes that make no sense.
  GeneratedMesh generate_mesh(const GeneratedMeshParameters &parameters);
} // namespace Signorini

#endif
