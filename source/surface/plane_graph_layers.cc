// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Surfaces in several layers over each other: partners are the nearest.

#include "plane_graph_walk.h"

#include <signorini/surface/box_tree.h>
#include <signorini/surface/normal_projection.h>

namespace Signorini
{
  using namespace dealii;

  const BoxTree &PlaneGraph::tree_of_mortar_triangles()
  {
    if (!mortar_tree)
      mortar_tree = std::make_unique<BoxTree>(tree_of_triangles(incidence.mortar));
    return *mortar_tree;
  }



  bool PlaneGraph::is_hidden(const Point<3> &foot, const Tensor<1, 3> &normal, const double distance,
                             const double margin) const
  {
    std::vector<unsigned int> candidates;
    nonmortar_tree->find_along_line(candidates, foot, normal);
    return std::any_of(candidates.begin(), candidates.end(), [&](const unsigned int t) {
      std::array<double, 3> w;
      double                eta;
      constexpr double      rounding = 1e-9;
      return incidence.faces(t, normal) &&
             NormalProjection::intersect_line(w, eta, foot, normal, corners_of(incidence.nonmortar, t)) &&
             *std::min_element(w.begin(), w.end()) >= -rounding && std::abs(eta) + margin < distance;
    });
  }



  bool PlaneGraph::may_lie_over_itself() const
  {
    Tensor<1, 3> mean;
    for (const Tensor<1, 3> &normal : incidence.mortar_normal)
      mean += normal;
    if (std::any_of(incidence.mortar_normal.begin(), incidence.mortar_normal.end(),
                    [&](const Tensor<1, 3> &normal) { return !(normal * mean > 0.); }))
      return true;
    // All that is connected with the first triangle.
    std::vector<bool>         is_known(mortar.triangles.size(), false);
    std::vector<unsigned int> front = {0};
    std::size_t               n     = 1;
    is_known[0]                     = true;
    while (!front.empty())
      {
        const unsigned int t = front.back();
        front.pop_back();
        for (const unsigned int e : mortar.triangle_edges[t])
          for (const unsigned int other : mortar.edge_triangles[e])
            if (other != none && !is_known[other])
              {
                is_known[other] = true;
                ++n;
                front.push_back(other);
              }
      }
    return n < mortar.triangles.size();
  }



  bool PlaneGraph::is_behind(const Point<3> &foot, const Tensor<1, 3> &normal, const double eta,
                             const double margin)
  {
    const double reach = std::abs(eta) - margin;
    if (!(reach > 0.))
      return false;
    std::vector<unsigned int> candidates;
    const Point<3>            place = foot + eta * normal;
    tree_of_mortar_triangles().find_along_segment(candidates, place - reach * normal, place + reach * normal);
    return std::any_of(candidates.begin(), candidates.end(), [&](const unsigned int m) {
      std::array<double, 3> w;
      double                distance;
      constexpr double      rounding = 1e-9;
      return incidence.mortar_normal[m] * normal > 0. &&
             NormalProjection::intersect_line(w, distance, place, normal, corners_of(incidence.mortar, m)) &&
             *std::min_element(w.begin(), w.end()) >= -rounding && std::abs(distance) < reach;
    });
  }



  bool PlaneGraph::is_hidden_at(const unsigned int mortar_edge, const double s, const unsigned int edge,
                                const double t)
  {
    const auto [p, q]      = mortar.edges[mortar_edge];
    const auto [a, b]      = nonmortar.edges[edge];
    const SurfaceMesh &non = incidence.nonmortar, &mor = incidence.mortar;
    const Point<3>     foot   = mor.vertices[p] + s * (mor.vertices[q] - mor.vertices[p]);
    const Tensor<1, 3> normal = (1. - s) * mor.vertex_normals[p] + s * mor.vertex_normals[q],
                       along = non.vertices[b] - non.vertices[a], way = non.vertices[a] + t * along - foot;
    const double eta = (way * normal) / normal.norm_square(), margin = Incidence::near_end * along.norm();
    return is_hidden(foot, normal, std::abs(eta), margin) ||
           (has_layers && is_behind(foot, normal, eta, margin));
  }
} // namespace Signorini
