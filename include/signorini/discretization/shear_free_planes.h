// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_shear_free_planes_h
#define signorini_discretization_shear_free_planes_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/face_conditions.h>
#include <signorini/mesh/nodal_space.h>

#include <array>
#include <vector>

namespace Signorini
{
  /// Planes in which bodies slide without friction: boundary faces that are held along their normal, but not
  /// in all directions across it, and carry no surface forces. What is cut off by symmetry ends there. Their
  /// shear is zero, which the mean over the cells on one side does not know; the mean over the cells and
  /// their mirror images does.
  class ShearFreePlanes
  {
  public:
    /// Collective. What is referred to must outlive the object.
    /// @param fixed at the relevant nodes (DirichletData::fixed)
    ShearFreePlanes(const NodalSpace &space, const Loads &loads, const std::vector<FixedDirections> &fixed);

    /// What a stress (force per area) at a relevant node is without the shear that there cannot be: itself on
    /// no such plane, and where two of them meet of which none lies across an axis of coordinates.
    Block without_shear(const NodeIndex node, const Block &stress) const;

  private:
    /// Orthonormal; what is fixed at a node (a hanging one: at its parents) comes first.
    std::array<Vector3, 3> directions(const NodeIndex node) const;
    /// The votes of a face that is held along its normal.
    void add(const NodalSpace::BoundaryFace &face, const FaceConditions &conditions, const bool is_loaded);

    const NodalSpace                   &space;
    const std::vector<FixedDirections> &fixed;
    const NodePartition                 partition;
    /// By node, for its directions 0 and 1, 1 and 2, 2 and 0: how many faces across the first, and across the
    /// second of them, say that there is no shear between these; far below zero where one says that there may
    /// be. One of the two planes is enough.
    std::array<Vector, 2> votes;
  };
} // namespace Signorini

#endif
