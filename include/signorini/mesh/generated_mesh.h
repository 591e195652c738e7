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

  /// Where the cells of a generated mesh are small: they grow with the distance from a point, or from a
  /// boundary.
  struct MeshGrading
  {
    /// In the frame of the mesh.
    dealii::Point<3> point;
    /// Instead of the point, if not empty.
    std::string boundary;
    /// Width of the largest cells / width of the smallest, in each direction.
    double ratio = 1.;
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
    /// Cells of tubes, half cylinders and prisms in radial direction, around, and along the axis; 0 for cells
    /// of near-equal edges.
    std::array<unsigned int, 3> round_divisions = {{0, 0, 0}};
    /// Of the base of a prism, convex, with the inside on the left.
    std::vector<dealii::Point<2>> corners;
    MeshGrading                   grading;
  };

  /// A mesh with the boundaries that are curved.
  struct GeneratedMesh
  {
    /// As generate_mesh() describes it.
    VolumeMesh                  mesh;
    std::vector<CurvedBoundary> curved;
  };

  /// n + 1 places from 0 to 1, whose distances grow linearly with the distance from one of them.
  /// @param centre in [0,1]
  /// @param ratio largest distance / smallest
  std::vector<double> graded_places(const unsigned int n, const double centre, const double ratio);

  /// All kinds generate_mesh() knows, separated by "|".
  std::string generated_mesh_kinds();

  /// A coarse mesh of cells of near-equal edges. Balls and shells are centred at the origin; a half ball is
  /// the half z <= 0 with the flat boundary "top", quarters are x >= 0 and y >= 0 (boundaries "symmetry x",
  /// "symmetry y"), an eighth also z >= 0 ("symmetry z"). A cylinder has the axis z and lies in
  /// -height <= z <= 0 (boundaries "side", "top", "bottom"). A block has "left", "right", "front", "back",
  /// "bottom", "top" (x, y, z from low to high).
  ///
  /// Tubes, half cylinders and prisms have the axis z and lie in 0 <= z <= height (boundaries "start",
  /// "end"). Tubes and annuli (tubes of one layer of cells) have "inner" and "outer"; the half of one is y >=
  /// 0
  /// ("symmetry y"), a quarter also x >= 0 ("symmetry x"). A half cylinder is the half y <= 0 with "outer"
  /// and "flat", the half of one also x >= 0 ("symmetry x"). The sides of a prism are "side 1" (from the
  /// first corner to the second), "side 2", ... Errors: InputError for sizes that make no sense.
  GeneratedMesh generate_mesh(const GeneratedMeshParameters &parameters);
} // namespace Signorini

#endif
