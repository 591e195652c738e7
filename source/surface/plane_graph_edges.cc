// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/surface/box_tree.h>
#include <signorini/surface/plane_graph.h>

namespace Signorini
{
  using namespace dealii;
  using On = SurfacePoint::On;

  struct PlaneGraph::Walk
  {
    unsigned int edge;
    /// 1 from its lower to its higher vertex, -1 the other way.
    int direction;
    /// The node where it ends, or none.
    unsigned int target;

    /// Where it is: at a vertex, or in a triangle that it has entered through a local edge (with the sides of
    /// the corners at the beginning and the end of that edge).
    unsigned int                   vertex = none, triangle = none, entry = none;
    std::array<Incidence::Side, 2> entry_sides;
    /// How far it has come, in its direction.
    double position = 0.;

    double forward(const double parameter) const
    {
      return direction > 0 ? parameter : 1. - parameter;
    }
  };



  Incidence::Side PlaneGraph::side(const unsigned int vertex, const unsigned int mortar_edge) const
  {
    Incidence::Side    result = incidence.of_nonmortar_vertex(vertex, mortar_edge);
    const unsigned int node   = nonmortar_vertex_node[vertex];
    if (node != none)
      {
        const SurfacePoint &place = nodes[node].mortar;
        if (place.on == On::edge && place.index == mortar_edge)
          result.sign = 0;
        else if (result.sign == 0)
          result.sign = result.distance > 0. ? 1 : -1;
      }
    return result;
  }



  bool PlaneGraph::is_reached(const Walk &walk, const unsigned int triangle) const
  {
    return walk.target != none && nodes[walk.target].nonmortar.lies_in(nonmortar, triangle);
  }



  PlaneGraph::State PlaneGraph::go_to_vertex(Walk &walk, const unsigned int vertex, const double position)
  {
    walk.vertex   = vertex;
    walk.triangle = walk.entry = none;
    walk.position              = std::max(walk.position, walk.forward(std::min(1., std::max(0., position))));
    if (nonmortar_vertex_node[vertex] == none)
      {
        nonmortar_vertex_node[vertex] = static_cast<unsigned int>(nodes.size());
        const double s                = walk.forward(walk.position);
        nodes.push_back({SurfacePoint::at_vertex(vertex), SurfacePoint::on_edge(walk.edge, s)});
        incidence.move_nonmortar_vertex(vertex, walk.edge, s);
      }
    return State::on_the_way;
  }



  PlaneGraph::State PlaneGraph::place_crossing(Walk &walk, const unsigned int edge, const double t,
                                               const double position, const int low)
  {
    if (nonmortar.is_border(edge) && !border_crossings.insert({walk.edge, edge}).second)
      return State::left;
    // Nodes follow each other along the edge, rounding or not.
    walk.position = std::max(walk.position, position);
    nodes.push_back(
        {SurfacePoint::on_edge(edge, t), SurfacePoint::on_edge(walk.edge, walk.forward(walk.position))});
    low_side.resize(nodes.size(), 0);
    low_side.back() = static_cast<signed char>(low);
    return State::on_the_way;
  }



  PlaneGraph::State PlaneGraph::add_crossing(Walk &walk, const unsigned int edge, const Incidence::Side &low,
                                             const Incidence::Side &high)
  {
    double t, s;
    if (!incidence.cross(t, s, edge, walk.edge, low, high))
      return State::lost;
    return place_crossing(walk, edge, t, walk.forward(s), low.sign);
  }



  PlaneGraph::State PlaneGraph::leave_through(Walk &walk, const unsigned int local,
                                              const Incidence::Side &begin, const Incidence::Side &end)
  {
    const unsigned int edge  = nonmortar.triangle_edges[walk.triangle][local];
    const bool         along = nonmortar.triangles[walk.triangle][local] == nonmortar.edges[edge][0];
    if (const State state = add_crossing(walk, edge, along ? begin : end, along ? end : begin);
        state != State::on_the_way)
      return state;
    const auto &beside = nonmortar.edge_triangles[edge];
    walk.triangle      = beside[0] == walk.triangle ? beside[1] : beside[0];
    walk.vertex        = none;
    // What turns away is as good as a border: behind the rim of a ball the path would come back.
    if (walk.triangle == none || !incidence.edge_faces(walk.edge, walk.forward(walk.position), walk.triangle))
      return State::left;
    walk.entry       = nonmortar.local_edge(walk.triangle, edge);
    walk.entry_sides = {{end, begin}};
    return State::on_the_way;
  }



  // Seen along the walk an edge through which it enters runs (counterclockwise) from the left to the right,
  // an edge through which it leaves from the right to the left.
  PlaneGraph::State PlaneGraph::pass_triangle(Walk &walk)
  {
    if (is_reached(walk, walk.triangle))
      return State::reached;
    const unsigned int    k        = (walk.entry + 2) % 3;
    const unsigned int    opposite = nonmortar.triangles[walk.triangle][k];
    const Incidence::Side s        = side(opposite, walk.edge);
    if (s.sign == 0)
      return go_to_vertex(walk, opposite, s.position);
    return walk.direction * s.sign > 0 ? leave_through(walk, (k + 2) % 3, walk.entry_sides[1], s)
                                       : leave_through(walk, k, s, walk.entry_sides[0]);
  }



  PlaneGraph::State PlaneGraph::pass_vertex(Walk &walk)
  {
    const unsigned int first = nonmortar.fan_start[walk.vertex], last = nonmortar.fan_start[walk.vertex + 1];
    for (unsigned int k = first; k < last; ++k)
      if (is_reached(walk, nonmortar.fan[k]))
        return State::reached;
    unsigned int    ahead = none;
    Incidence::Side ahead_sides[2];
    bool            at_border = false;
    for (unsigned int k = first; k < last; ++k)
      {
        const unsigned int t = nonmortar.fan[k], corner = nonmortar.local_corner(t, walk.vertex);
        Incidence::Side    s[2];
        for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int v = nonmortar.triangles[t][(corner + 1 + i) % 3];
            s[i]                 = side(v, walk.edge);
            if (s[i].sign == 0 && walk.forward(s[i].position) > walk.position)
              return go_to_vertex(walk, v, s[i].position);
            at_border = at_border || nonmortar.is_border(nonmortar.triangle_edges[t][(corner + 2 * i) % 3]);
          }
        if (walk.direction * s[0].sign < 0 && walk.direction * s[1].sign > 0)
          {
            ahead = t;
            std::copy(s, s + 2, ahead_sides);
          }
      }
    if (ahead == none)
      return at_border ? State::left : State::lost;
    walk.triangle = ahead;
    return leave_through(walk, (nonmortar.local_corner(ahead, walk.vertex) + 1) % 3, ahead_sides[0],
                         ahead_sides[1]);
  }



  PlaneGraph::State PlaneGraph::leave_node(Walk &walk, const SurfacePoint &start)
  {
    if (start.on == On::vertex)
      {
        walk.vertex = start.index;
        return State::on_the_way;
      }
    if (start.on == On::triangle)
      {
        walk.triangle = start.index;
        if (is_reached(walk, walk.triangle))
          return State::reached;
        Incidence::Side s[3];
        for (unsigned int i = 0; i < 3; ++i)
          s[i] = side(nonmortar.triangles[walk.triangle][i], walk.edge);
        for (unsigned int i = 0; i < 3; ++i)
          if (walk.direction * s[i].sign < 0 && walk.direction * s[(i + 1) % 3].sign > 0)
            return leave_through(walk, i, s[i], s[(i + 1) % 3]);
        for (unsigned int i = 0; i < 3; ++i)
          if (walk.direction * s[i].sign < 0 && s[(i + 1) % 3].sign == 0 &&
              walk.direction * s[(i + 2) % 3].sign > 0)
            return go_to_vertex(walk, nonmortar.triangles[walk.triangle][(i + 1) % 3],
                                s[(i + 1) % 3].position);
        return State::lost;
      }

    const auto &beside = nonmortar.edge_triangles[start.index];
    for (const unsigned int t : beside)
      if (t != none && is_reached(walk, t))
        return State::reached;
    const auto     &ends = nonmortar.edges[start.index];
    Incidence::Side s[2] = {side(ends[0], walk.edge), side(ends[1], walk.edge)};
    for (unsigned int i = 0; i < 2; ++i)
      if (s[i].sign == 0 && walk.forward(s[i].position) > 0.)
        return go_to_vertex(walk, ends[i], s[i].position);
    // It starts between the two: they lie on different sides, whatever rounding says of the nearer one.
    const unsigned int far =
        s[1].sign == 0 || (s[0].sign != 0 && std::abs(s[0].distance) > std::abs(s[1].distance)) ? 0 : 1;
    if (s[0].sign * s[1].sign >= 0)
      s[1 - far].sign = -s[far].sign;
    if (s[far].sign == 0)
      return State::lost;
    const unsigned int beside_left = walk.direction * s[0].sign > 0 ? 0 : 1;
    walk.triangle                  = beside[beside_left];
    if (walk.triangle == none)
      return State::left;
    walk.entry       = nonmortar.local_edge(walk.triangle, start.index);
    walk.entry_sides = {{s[beside_left], s[1 - beside_left]}};
    return State::on_the_way;
  }



  PlaneGraph::State PlaneGraph::walk_to_end(Walk &walk, State state)
  {
    // No straight way passes a triangle twice.
    for (std::size_t step = 0; state == State::on_the_way; ++step)
      if (step > 2 * nonmortar.triangles.size())
        return State::lost;
      else
        state = walk.vertex != none ? pass_vertex(walk) : pass_triangle(walk);
    return state;
  }



  PlaneGraph::State PlaneGraph::trace_from_node(const unsigned int edge, const int direction,
                                                const unsigned int start, const unsigned int target)
  {
    const std::size_t  n_nodes = nodes.size();
    const SurfacePoint place   = nodes[start].nonmortar;
    Walk               walk{edge, direction, target};
    const State        state = walk_to_end(walk, leave_node(walk, place));
    if (state == State::reached || (state == State::left && target == none))
      return state;
    // Strongly bent cells: the sides of vertices far from the edge mislead, the crossings themselves do not.
    Walk again{edge, direction, target};
    take_back(again, n_nodes);
    const State second = trace_by_roots(again, place);
    if (second == State::reached || state == State::lost)
      return second;
    take_back(again, n_nodes);
    Walk as_before{edge, direction, target};
    return walk_to_end(as_before, leave_node(as_before, place));
  }



  void PlaneGraph::take_back(const Walk &walk, const std::size_t n_nodes)
  {
    for (; nodes.size() > n_nodes; nodes.pop_back())
      {
        const SurfacePoint &place = nodes.back().nonmortar;
        if (place.on == On::vertex)
          nonmortar_vertex_node[place.index] = none;
        else
          border_crossings.erase({walk.edge, place.index});
      }
    low_side.resize(std::min(low_side.size(), n_nodes));
  }



  bool PlaneGraph::is_between_ends(const Incidence::Crossing &crossing, const unsigned int edge,
                                   const unsigned int mortar_edge) const
  {
    const auto sign_of = [](const Incidence::Side &s) {
      return s.sign != 0 ? s.sign : (s.distance > 0. ? 1 : -1);
    };
    constexpr double near_end = Incidence::near_end;
    const auto      &ends = nonmortar.edges[edge], &mortar_ends = mortar.edges[mortar_edge];
    if (crossing.t < near_end && sign_of(side(ends[0], mortar_edge)) != crossing.low_side)
      return false;
    if (crossing.t > 1. - near_end && sign_of(side(ends[1], mortar_edge)) == crossing.low_side)
      return false;
    if (crossing.s < near_end && incidence.of_mortar_vertex(mortar_ends[0], edge).sign != -crossing.low_side)
      return false;
    return !(crossing.s > 1. - near_end &&
             incidence.of_mortar_vertex(mortar_ends[1], edge).sign != crossing.low_side);
  }



  PlaneGraph::State PlaneGraph::trace_by_roots(Walk &walk, const SurfacePoint &start)
  {
    std::vector<unsigned int> triangles, passed;
    if (start.on == On::triangle)
      triangles.push_back(start.index);
    else if (start.on == On::edge)
      {
        passed.push_back(start.index);
        for (const unsigned int t : nonmortar.edge_triangles[start.index])
          if (t != none)
            triangles.push_back(t);
      }
    else
      for (unsigned int k = nonmortar.fan_start[start.index]; k < nonmortar.fan_start[start.index + 1]; ++k)
        {
          triangles.push_back(nonmortar.fan[k]);
          const unsigned int corner = nonmortar.local_corner(nonmortar.fan[k], start.index);
          for (const unsigned int i : {corner, (corner + 2) % 3})
            passed.push_back(nonmortar.triangle_edges[nonmortar.fan[k]][i]);
        }
    // Where on an edge that it has passed: there it does not cross it again.
    double     passed_at = start.x[0];
    const auto place_on  = [&](const unsigned int e) {
      return start.on != On::vertex || passed.size() == 1 ? passed_at
                                                           : (nonmortar.edges[e][0] == start.index ? 0. : 1.);
    };
    constexpr double rounding = 1e-9;
    for (std::size_t step = 0; step < 2 * nonmortar.triangles.size(); ++step)
      {
        for (const unsigned int t : triangles)
          if (is_reached(walk, t))
            return State::reached;
        // The next crossing of a border edge of these triangles.
        unsigned int        out = none;
        Incidence::Crossing next{0., 0., 0};
        double              nearest = 2.;
        for (const unsigned int t : triangles)
          for (const unsigned int e : nonmortar.triangle_edges[t])
            for (const auto &crossing : incidence.all_crossings(e, walk.edge))
              {
                if (!is_between_ends(crossing, e, walk.edge))
                  continue;
                const double position = walk.forward(crossing.s);
                const bool   was_here = std::find(passed.begin(), passed.end(), e) != passed.end();
                if (was_here && std::abs(crossing.t - place_on(e)) < Incidence::near_end)
                  continue;
                if (position >= walk.position + (was_here ? 1e3 : -1.) * rounding && position < nearest)
                  {
                    nearest = position;
                    next    = crossing;
                    out     = e;
                  }
              }
        if (out == none)
          return State::lost;
        if (place_crossing(walk, out, next.t, nearest, next.low_side) == State::left)
          return State::left;
        const auto        &beside  = nonmortar.edge_triangles[out];
        const unsigned int through = beside[walk.direction * next.low_side > 0 ? 0 : 1];
        if (through == none || !incidence.edge_faces(walk.edge, walk.forward(walk.position), through))
          return State::left;
        triangles = {through};
        passed    = {out};
        passed_at = next.t;
      }
    return State::lost;
  }



  void PlaneGraph::trace_mortar_edges()
  {
    // Edges are numbered by their lower vertex.
    std::vector<unsigned int> first(mortar_vertex_node.size() + 1, 0);
    for (const auto &e : mortar.edges)
      ++first[e[0] + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const unsigned int v : mortar_order)
      for (unsigned int f = first[v]; f < first[v + 1]; ++f)
        {
          if (!edge_is_needed[f])
            continue;
          const unsigned int p = mortar_vertex_node[v], q = mortar_vertex_node[mortar.edges[f][1]];
          State              state = State::left;
          if (p != none)
            state = trace_from_node(f, 1, p, q);
          if (q != none && state == State::left)
            state = trace_from_node(f, -1, q, none);
          if (state == State::lost)
            lost_edges.push_back(f);
          if (state == State::left)
            unfinished.push_back(f);
        }
    enter_at_borders();
  }



  // What comes in over the border of the nonmortar surface from outside: both ends without an image, or in
  // again after having left over a hole or a bay.
  void PlaneGraph::enter_at_borders()
  {
    if (unfinished.empty())
      return;
    const SurfaceMesh        &non = incidence.nonmortar;
    std::vector<unsigned int> border;
    std::vector<BoxTree::Box> boxes;
    for (unsigned int e = 0; e < nonmortar.edges.size(); ++e)
      if (nonmortar.is_border(e))
        {
          BoxTree::Box box{non.vertices[nonmortar.edges[e][0]], non.vertices[nonmortar.edges[e][0]]};
          box.include(non.vertices[nonmortar.edges[e][1]]);
          border.push_back(e);
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

    std::vector<std::array<double, 2>> pieces = {{{-far, far}}};
    std::vector<unsigned int>          candidates;
    while (!pieces.empty())
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
        if (candidates.size() > few && high - low > 2. * width)
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



  // Nearly parallel edges cross at an ill-conditioned place. Whether they do at all is known: not if the
  // mortar edge has an end on the other one, and not if it runs close beside it, with no ends on different
  // sides.
  bool PlaneGraph::runs_along(const unsigned int mortar_edge, const unsigned int edge) const
  {
    const auto &x         = incidence.nonmortar.vertices;
    const auto &ends      = nonmortar.edges[edge];
    int         product   = 1;
    bool        are_close = true;
    for (const unsigned int v : mortar.edges[mortar_edge])
      {
        if (mortar_vertex_node[v] != none)
          {
            const SurfacePoint &place = nodes[mortar_vertex_node[v]].nonmortar;
            if ((place.on == On::edge && place.index == edge) ||
                (place.on == On::vertex && (place.index == ends[0] || place.index == ends[1])))
              return true;
          }
        const Incidence::Side s = incidence.of_mortar_vertex(v, edge);
        product *= s.sign;
        are_close = are_close && std::abs(s.distance) < Incidence::near_end * x[ends[0]].distance(x[ends[1]]);
      }
    return are_close && product >= 0;
  }



  bool PlaneGraph::is_hidden_at(const unsigned int mortar_edge, const double s, const unsigned int edge,
                                const double t) const
  {
    const auto [p, q]      = mortar.edges[mortar_edge];
    const auto [a, b]      = nonmortar.edges[edge];
    const SurfaceMesh &non = incidence.nonmortar, &mor = incidence.mortar;
    const Point<3>     foot   = mor.vertices[p] + s * (mor.vertices[q] - mor.vertices[p]);
    const Tensor<1, 3> normal = (1. - s) * mor.vertex_normals[p] + s * mor.vertex_normals[q],
                       along = non.vertices[b] - non.vertices[a], way = non.vertices[a] + t * along - foot;
    return is_hidden(foot, normal, std::abs(way * normal) / normal.norm_square(),
                     Incidence::near_end * along.norm());
  }



  void PlaneGraph::enter_at(const unsigned int e, const unsigned int f)
  {
    const auto        &ends = nonmortar.edges[e];
    const unsigned int p = mortar.edges[f][0], q = mortar.edges[f][1];
    const unsigned int only = nonmortar.edge_triangles[e][0] != none ? 0 : 1;
    const unsigned int t    = nonmortar.edge_triangles[e][only];
    if (!incidence.vertex_faces(p, t) || !incidence.vertex_faces(q, t) || border_crossings.count({f, e}) > 0)
      return;
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
                  lost_edges.push_back(f);
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
    walk.position    = come;
    walk.triangle    = t;
    walk.entry       = nonmortar.local_edge(t, e);
    walk.entry_sides = {{s[only], s[1 - only]}};
    if (walk_to_end(walk, add_crossing(walk, e, s[0], s[1])) == State::lost)
      lost_edges.push_back(f);
  }
} // namespace Signorini
