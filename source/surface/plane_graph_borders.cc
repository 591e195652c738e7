// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Mortar edges that come in over the border of the nonmortar surface, or of what of it faces them.

#include "plane_graph_walk.h"

#include <signorini/surface/box_tree.h>

namespace Signorini
{
  using namespace dealii;

  // Whether the nonmortar triangles face all normals of the mortar surface (1), none of them (-1), or some.
  std::vector<signed char> PlaneGraph::find_facing() const
  {
    const auto  &normals = incidence.mortar.vertex_normals;
    Tensor<1, 3> mean;
    for (const Tensor<1, 3> &n : normals)
      mean += n;
    std::vector<signed char> result(nonmortar.triangles.size(), 0);
    if (!(mean.norm() > 0.))
      return result;
    mean /= mean.norm();
    const auto angle_to = [](const Tensor<1, 3> &n, const Tensor<1, 3> &direction) {
      return n.norm() > 0. ? std::acos(std::max(-1., std::min(1., n * direction / n.norm()))) : 0.;
    };
    double widest = 0.;
    for (const Tensor<1, 3> &n : normals)
      widest = std::max(widest, angle_to(n, mean));
    constexpr double rounding = 1e-6;
    const double     bound    = std::acos(-Incidence::facing_cosine);
    for (unsigned int t = 0; t < result.size(); ++t)
      {
        const double angle = angle_to(incidence.nonmortar_normal[t], -mean);
        result[t] = angle + widest < bound - rounding ? 1 : (angle - widest > bound + rounding ? -1 : 0);
      }
    return result;
  }



  // The border of the nonmortar surface, and of what of it may face a mortar edge: the rim of a ball as the
  // other side sees it.
  std::vector<unsigned int> PlaneGraph::edges_to_enter_at() const
  {
    const std::vector<signed char> facing      = find_facing();
    const auto                    &normals     = incidence.nonmortar_normal;
    const auto                     is_straight = [&](const unsigned int a, const unsigned int b) {
      return cross_product_3d(normals[a], normals[b]).norm() <= 1e-9 * (normals[a] * normals[b]);
    };
    std::vector<unsigned int> result;
    for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
      if (const auto [a, b] = nonmortar.edge_triangles[e];
          nonmortar.is_border(e) || facing[b] != facing[a] || (facing[a] == 0 && !is_straight(a, b)))
        result.push_back(e);
    return result;
  }



  // What comes in from outside: both ends without an image, or in again after having left over a hole or a
  // bay.
  void PlaneGraph::enter_at_borders()
  {
    if (unfinished.empty())
      return;
    const SurfaceMesh              &non    = incidence.nonmortar;
    const std::vector<unsigned int> border = edges_to_enter_at();
    std::vector<BoxTree::Box>       boxes;
    for (const unsigned int e : border)
      {
        BoxTree::Box box{non.vertices[nonmortar.edges[e][0]], non.vertices[nonmortar.edges[e][0]]};
        box.include(non.vertices[nonmortar.edges[e][1]]);
        boxes.push_back(box);
      }
    if (border.empty())
      return;
    BoxTree::Box all = boxes[0];
    for (const BoxTree::Box &box : boxes)
      for (const Point<3> &p : {box.low, box.high})
        all.include(p);
    const BoxTree                                      tree(boxes);
    std::vector<std::pair<unsigned int, unsigned int>> meetings;
    std::vector<unsigned int>                          found;
    for (const unsigned int f : unfinished)
      {
        found.clear();
        find_below_curtain(found, tree, all, f);
        for (const unsigned int i : found)
          meetings.emplace_back(border[i], f);
      }
    std::sort(meetings.begin(), meetings.end());
    meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
    for (const auto &[e, f] : meetings)
      enter_at(e, f);
  }



  // The curtain of a mortar edge, the points along its normals at any distance, in pieces: each is halved as
  // long as its box is much longer than the curtain is wide and still meets more than a few boxes.
  void PlaneGraph::find_below_curtain(std::vector<unsigned int> &found, const BoxTree &tree,
                                      const BoxTree::Box &all, const unsigned int f) const
  {
    const auto [v, w]     = mortar.edges[f];
    const Point<3>     &p = incidence.mortar.vertices[v], &q = incidence.mortar.vertices[w];
    const Tensor<1, 3> &n = incidence.mortar.vertex_normals[v], &m = incidence.mortar.vertex_normals[w];
    // As far as the boxes are away, along normals that are shortest in the middle of the edge.
    const double distance = all.low.distance(all.high) + std::max(p.distance(all.low), q.distance(all.low));
    constexpr double       shortest = .1;
    const double           far      = distance / std::max(shortest, .5 * (n + m).norm());
    constexpr unsigned int few      = 4;
    // Halving saves time where few boxes are near the curtain. Boxes of damaged surfaces may be as large as
    // everything and coordinates lose their digits on the way there: then it saves nothing, and must end.
    constexpr unsigned int most_pieces = 10000;

    std::vector<std::array<double, 2>> pieces = {{{-far, far}}};
    std::vector<unsigned int>          candidates;
    for (unsigned int n_pieces = 0; !pieces.empty(); ++n_pieces)
      {
        const auto [low, high] = pieces.back();
        pieces.pop_back();
        BoxTree::Box box{p + low * n, p + low * n};
        for (const Point<3> &x : {p + high * n, q + low * m, q + high * m})
          box.include(x);
        tree.find_overlapping(candidates, box, few + 1);
        if (candidates.empty())
          continue;
        const double width = p.distance(q) + std::max(std::abs(low), std::abs(high)) * (m - n).norm();
        if (candidates.size() > few && high - low > 2. * width && n_pieces < most_pieces)
          {
            const double middle = .5 * (low + high);
            pieces.push_back({{low, middle}});
            pieces.push_back({{middle, high}});
            continue;
          }
        if (candidates.size() > few)
          tree.find_overlapping(candidates, box);
        found.insert(found.end(), candidates.begin(), candidates.end());
      }
  }



  void PlaneGraph::enter_at(const unsigned int e, const unsigned int f)
  {
    const auto [p, q] = mortar.edges[f];
    std::array<bool, 2> faces, may_face;
    for (unsigned int side = 0; side < 2; ++side)
      {
        const unsigned int t   = nonmortar.edge_triangles[e][side];
        const bool         one = t != none && incidence.vertex_faces(p, t),
                   other       = t != none && incidence.vertex_faces(q, t);
        faces[side]            = one && other;
        may_face[side]         = one || other;
      }
    if (border_crossings.count({f, e}) > 0)
      return;
    // Where the edge crosses may tell more.
    const bool is_open = !nonmortar.is_border(e);
    for (unsigned int side = 0; side < 2; ++side)
      if ((is_open ? may_face[side] : faces[side]) && !faces[1 - side])
        enter_at(e, f, side);
  }



  void PlaneGraph::enter_at(const unsigned int e, const unsigned int f, const unsigned int only)
  {
    const auto           &ends = nonmortar.edges[e];
    const unsigned int    p = mortar.edges[f][0], q = mortar.edges[f][1];
    const unsigned int    t    = nonmortar.edge_triangles[e][only];
    const Incidence::Side s[2] = {side(ends[0], f), side(ends[1], f)};
    for (unsigned int i = 0; i < 2; ++i)
      if (s[i].sign == 0)
        {
          // Over a corner of the border.
          if (s[i].position > 0. && s[i].position < 1. && nonmortar_vertex_node[ends[i]] == none &&
              !is_hidden_at(f, s[i].position, e, i))
            for (const int direction : {1, -1})
              {
                Walk walk{f, direction, mortar_vertex_node[direction > 0 ? q : p]};
                walk.position = walk.forward(s[i].position);
                if (walk_to_end(walk, go_to_vertex(walk, ends[i], s[i].position)) == State::lost)
                  note_lost(walk, SurfacePoint::at_vertex(ends[i]));
              }
          return;
        }
    if (s[0].sign == s[1].sign || runs_along(f, e))
      return;
    // Inwards.
    const int  direction = (only == 0 ? s[0].sign : s[1].sign) > 0 ? 1 : -1;
    double     at_e, at_f;
    const bool crosses = incidence.cross(at_e, at_f, e, f, s[0], s[1]);
    Walk       walk{f, direction, mortar_vertex_node[direction > 0 ? q : p]};
    // Right at an end of the mortar edge the side on which that end lies decides, as where its vertex was
    // placed.
    const double come   = walk.forward(at_f);
    const auto   inside = [&](const unsigned int v) {
      return (only == 0 ? 1 : -1) * incidence.of_mortar_vertex(v, e).sign;
    };
    if (!crosses || (come < Incidence::near_end && inside(direction > 0 ? p : q) >= 0) ||
        (come > 1. - Incidence::near_end && inside(direction > 0 ? q : p) <= 0))
      return;
    if (is_hidden_at(f, at_f, e, at_e))
      return;
    if (!nonmortar.is_border(e) && (!incidence.edge_faces(f, at_f, t) ||
                                    incidence.edge_faces(f, at_f, nonmortar.edge_triangles[e][1 - only]) ||
                                    !border_crossings.insert({f, e}).second))
      return;
    walk.position    = come;
    walk.triangle    = t;
    walk.entry       = nonmortar.local_edge(t, e);
    walk.entry_sides = {{s[only], s[1 - only]}};
    if (walk_to_end(walk, add_crossing(walk, e, s[0], s[1])) == State::lost)
      note_lost(walk, SurfacePoint::on_edge(e, at_e));
  }
} // namespace Signorini
