// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_shear_free_planes_h
#define signorini_discretization_shear_free_planes_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/algebra/node_request.h>
#include <signorini/discretization/face_conditions.h>
#include <signorini/mesh/nodal_space.h>

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

    /// What a stress (force per area) at a relevant node is without the shear that there cannot be on any of
    /// the planes: the nearest one without. Where two planes meet that are not orthogonal it has no
    /// direction across their common line.
    Block without_shear(const NodeIndex node, const Block &stress) const;

  private:
    /// A plane at a node, and what the faces in it are held in: there is no shear in what is free.
    struct Plane
    {
      Vector3         normal;
      FixedDirections held;
    };
    /// What a face says to one of its nodes.
    struct Vote
    {
      NodeIndex node;
      Plane     plane;
    };

    /// What is fixed at a node; at a hanging one what is at its parents.
    FixedDirections fixed_at(const NodeIndex node) const;
    /// Of this rank's cells, to the ranks that own the nodes.
    ListsByRank<Vote> votes(const Loads &loads, const NodePartition &partition) const;

    const NodalSpace                   &space;
    const std::vector<FixedDirections> &fixed;
    /// Of the relevant nodes.
    NodeRequest::Lists<Plane> planes;
  };
} // namespace Signorini

#endif
