// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/face_conditions.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Whether the set of nodes that a condition holds has the nodes of a face (hanging ones aside).
    bool has_all_nodes(const NodalSpace &space, const DirichletCondition &condition,
                       const NodalSpace::BoundaryFace &face)
    {
      if (condition.node_set == StartNodes::none)
        return false;
      const NodalSpace::Cell &cell = space.cells()[face.cell];
      const auto             &set  = space.node_sets()[condition.node_set];
      for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
        if (const NodeIndex node = space.nodes(cell)[v];
            !space.hanging_nodes().is_constrained(node) && !std::binary_search(set.begin(), set.end(), node))
          return false;
      return true;
    }
  } // namespace



  FaceConditions::FaceConditions(const NodalSpace &space, const Loads &loads,
                                 const NodalSpace::BoundaryFace &face, const ElementFace &shape)
  {
    Point<3> centre;
    for (unsigned int q = 0; q < shape.n_points(); ++q)
      {
        const auto point = shape.point(q);
        centre += Vector3(point.position) / shape.n_points();
        normal += point.area;
      }
    normal /= normal.norm();
    for (const RigidFaceCondition &rigid : loads.rigid_faces)
      if (rigid.ids.count(face.id) > 0)
        held = all_fixed;
    if (held.all())
      return;
    std::vector<Vector3> directions;
    for (const DirichletCondition &condition : loads.dirichlet)
      if (condition.ids.count(face.id) > 0 || has_all_nodes(space, condition, face))
        {
          const auto axes = condition.frame.axes(centre, normal);
          for (unsigned int c = 0; c < dim; ++c)
            if (condition.components[c])
              directions.push_back(axes[c]);
        }
    held = FixedDirections::span(directions);
  }
} // namespace Signorini
