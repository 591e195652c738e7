// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "node_conditions.h"

#include <signorini/algebra/dense_matrix.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The area vector of a face, outward.
    Vector3 face_area(const NodalSpace &space, const NodalSpace::BoundaryFace &face)
    {
      const NodalSpace::Cell &cell    = space.cells()[face.cell];
      const auto              nodes   = space.nodes(cell);
      const auto              corners = CellShape::face(cell.n_vertices, face.face);
      const auto              point = [&](const unsigned int v) { return space.position(nodes[corners[v]]); };
      return corners.size() == 3 ? .5 * cross_product_3d(point(1) - point(0), point(2) - point(0))
                                 : .5 * cross_product_3d(point(2) - point(0), point(3) - point(1));
    }

    struct NormalRule
    {
      /// Faces whose normals are nearer to each other than this (cosine: 30 degrees) are one smooth boundary
      /// at a node; else it is an edge, which is held along both normals.
      double smooth = .866;
    };

    void set_duals(HeldNode &node)
    {
      const Eigen::Index n = static_cast<Eigen::Index>(node.holds.size());
      Eigen::MatrixXd    gram(n, n);
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index l = 0; l < n; ++l)
          gram(k, l) = node.holds[k].direction * node.holds[l].direction;
      const Eigen::MatrixXd duals = inverse(gram);
      for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index l = 0; l < n; ++l)
          node.holds[k].dual += duals(k, l) * node.holds[l].direction;
    }
  } // namespace



  NodeConditions::NodeConditions(const NodalSpace &space, const Loads &loads)
    : space(space)
    , loads(loads)
  {
    std::map<types::boundary_id, std::vector<int>> conditions_of;
    for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
      for (const types::boundary_id id : loads.dirichlet[i].ids)
        conditions_of[id].push_back(i);
    for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
      if (const auto it = conditions_of.find(face.id); it != conditions_of.end())
        add(face, it->second);
    for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
      if (loads.dirichlet[i].node_set != StartNodes::none)
        for (const NodeIndex node : space.node_sets()[loads.dirichlet[i].node_set])
          entry(node, i);
    for (unsigned int i = 0; i < loads.dirichlet.size(); ++i)
      if (loads.dirichlet[i].start_vertex != StartNodes::none)
        for (std::size_t r = 0; r < space.start_vertices().size(); ++r)
          if (space.start_vertices()[r] == loads.dirichlet[i].start_vertex)
            entry(space.relevant().nth_index_in_set(r), i);
  }



  std::map<std::size_t, std::array<int, 3>> NodeConditions::plain() const
  {
    std::map<std::size_t, std::array<int, 3>> result;
    for (const auto &[i, node] : nodes)
      if (!node.is_held)
        {
          std::array<int, 3> &latest = result.insert({i, {{-1, -1, -1}}}).first->second;
          for (const auto &[condition, faces] : node.conditions)
            for (unsigned int c = 0; c < dim; ++c)
              if (loads.dirichlet[condition].components[c])
                latest[c] = std::max(latest[c], condition);
        }
    return result;
  }



  std::map<std::size_t, HeldNode> NodeConditions::held() const
  {
    std::map<std::size_t, HeldNode> result;
    for (const auto &[i, node] : nodes)
      if (node.is_held && space.owned().is_element(space.relevant().nth_index_in_set(i)))
        result[i] = hold(node, space.position(space.relevant().nth_index_in_set(i)));
    return result;
  }



  void NodeConditions::add(const NodalSpace::BoundaryFace &face, const std::vector<int> &conditions)
  {
    const NodalSpace::Cell &cell = space.cells()[face.cell];
    const Vector3           area = face_area(space, face);
    for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
      if (const NodeIndex node = space.nodes(cell)[v]; !space.hanging_nodes().is_constrained(node))
        for (const int condition : conditions)
          entry(node, condition).push_back({area, face.id});
  }



  std::vector<NodeConditions::Face> &NodeConditions::entry(const NodeIndex node, const int condition)
  {
    Node &found   = nodes[space.relevant().index_within_set(node)];
    found.is_held = found.is_held || !loads.dirichlet[condition].frame.is_cartesian();
    return found.conditions[condition];
  }



  std::vector<std::pair<int, Vector3>> NodeConditions::normals(const Node &node, const Point<3> &x) const
  {
    constexpr NormalRule                 rule;
    std::vector<std::pair<int, Vector3>> result;
    for (const auto &[condition, faces] : node.conditions)
      {
        const DirichletCondition &c = loads.dirichlet[condition];
        if (!c.frame.needs_normal() || !c.components[0])
          continue;
        std::vector<Face> sorted = faces;
        std::sort(sorted.begin(), sorted.end());
        for (const Face &face : sorted)
          {
            const auto    shape = c.shapes.find(face.id);
            const Vector3 area  = shape == c.shapes.end() || shape->second == nullptr
                                      ? face.area
                                      : face.area.norm() * shape->second->normal(x, face.area);
            const auto    piece = std::find_if(result.begin(), result.end(), [&](const auto &other) {
              return other.second * area > rule.smooth * other.second.norm() * area.norm();
            });
            if (piece == result.end())
              result.emplace_back(condition, area);
            else
              {
                piece->first = condition;
                piece->second += area;
              }
          }
      }
    for (auto &[condition, sum] : result)
      sum /= sum.norm();
    return result;
  }



  HeldNode NodeConditions::hold(const Node &node, const Point<3> &x) const
  {
    std::vector<HeldNode::Hold> all;
    for (const auto &[condition, normal] : normals(node, x))
      all.push_back({condition, 0, normal, {}});
    for (const auto &[condition, faces] : node.conditions)
      if (const DirichletCondition &c = loads.dirichlet[condition]; !c.frame.needs_normal())
        {
          const auto axes = c.frame.axes(x, Vector3());
          for (unsigned int k = 0; k < dim; ++k)
            if (c.components[k])
              all.push_back({condition, k, axes[k], {}});
        }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto &a, const auto &b) { return a.condition > b.condition; });
    HeldNode             result;
    std::vector<Vector3> kept;
    for (const HeldNode::Hold &one : all)
      if (!FixedDirections::span(kept).contains(one.direction))
        {
          result.holds.push_back(one);
          kept.push_back(one.direction);
        }
    set_duals(result);
    return result;
  }
} // namespace Signorini
