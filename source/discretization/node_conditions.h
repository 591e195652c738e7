// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_node_conditions_h
#define signorini_discretization_node_conditions_h

#include <signorini/discretization/boundary_conditions.h>

#include <array>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace Signorini
{
  /// Conditions at the nodes of a mesh, as the faces show them that this rank can see.
  class NodeConditions
  {
  public:
    /// The arguments must outlive the object.
    NodeConditions(const NodalSpace &space, const Loads &loads);

    /// By relevant index: the latest condition of each component (or -1) at the nodes whose conditions are
    /// all along the axes of coordinates.
    std::map<std::size_t, std::array<int, 3>> plain() const;

    /// By relevant index: the other nodes that this rank owns.
    std::map<std::size_t, HeldNode> held() const;

  private:
    /// A face at a node: its area vector and boundary.
    struct Face
    {
      Vector3                    area;
      dealii::types::boundary_id id;

      bool operator<(const Face &other) const
      {
        return std::tie(id, area[0], area[1], area[2]) <
               std::tie(other.id, other.area[0], other.area[1], other.area[2]);
      }
    };

    struct Node
    {
      bool                             is_held = false;
      std::map<int, std::vector<Face>> conditions;
    };

    void add(const NodalSpace::BoundaryFace &face, const std::vector<int> &conditions);

    /// The faces of a condition at a node; none where it holds a set of nodes.
    std::vector<Face> &entry(const NodeIndex node, const int condition);

    /// Of the conditions along normals: one direction for each smooth piece of boundary, with the latest of
    /// its conditions.
    std::vector<std::pair<int, Vector3>> normals(const Node &node, const dealii::Point<3> &x) const;

    HeldNode hold(const Node &node, const dealii::Point<3> &x) const;

    const NodalSpace           &space;
    const Loads                &loads;
    std::map<std::size_t, Node> nodes;
  };
} // namespace Signorini

#endif
