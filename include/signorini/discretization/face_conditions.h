// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_face_conditions_h
#define signorini_discretization_face_conditions_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/element.h>
#include <signorini/mesh/nodal_space.h>

namespace Signorini
{
  /// What conditions say of a boundary face as a whole: not what its nodes have from its neighbours.
  struct FaceConditions
  {
    /// @param shape of the face
    FaceConditions(const NodalSpace &space, const Loads &loads, const NodalSpace::BoundaryFace &face,
                   const ElementFace &shape);

    /// The outward unit normal, a mean.
    Vector3 normal;
    /// The directions in which they hold it.
    FixedDirections held;
  };
} // namespace Signorini

#endif
