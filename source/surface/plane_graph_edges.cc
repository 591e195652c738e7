// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "plane_graph_walk.h"

namespace Signorini
{
  using namespace dealii;
  using On = SurfacePoint::On;

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



  PlaneGraph::State PlaneGraph::end_before(const Walk &walk)
  {
    return walk.target == none ? State::left : State::lost;
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
      {
        border_crossings.insert({walk.edge, edge});
        return State::left;
      }
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
      return walk.ends_after(s.position) ? go_to_vertex(walk, opposite, s.position) : end_before(walk);
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
        // As in leave_through().
        if (!incidence.edge_faces(walk.edge, walk.forward(walk.position), t))
          {
            at_border = true;
            continue;
          }
        for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int v = nonmortar.triangles[t][(corner + 1 + i) % 3];
            s[i]                 = side(v, walk.edge);
            if (s[i].sign == 0 && walk.passes_at(s[i].position))
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
              walk.direction * s[(i + 2) % 3].sign > 0 && walk.ends_after(s[(i + 1) % 3].position))
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
      if (s[i].sign == 0 && walk.passes_at(s[i].position))
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
    if (second == State::lost && state == State::lost)
      note_lost(walk, place);
    if (second == State::reached || state == State::lost)
      return second;
    take_back(again, n_nodes);
    Walk        as_before{edge, direction, target};
    const State third = walk_to_end(as_before, leave_node(as_before, place));
    if (third == State::lost)
      note_lost(as_before, place);
    return third;
  }



  // Outside the region vertices have not been moved to all edges that they lie on: ways end there that go on.
  void PlaneGraph::note_lost(const Walk &walk, const SurfacePoint &start)
  {
    bool       is_known    = true;
    const auto look_around = [&](const unsigned int triangle) {
      for (const unsigned int v : nonmortar.triangles[triangle])
        is_known = is_known && region.contains(v);
    };
    if (walk.vertex != none)
      for (unsigned int k = nonmortar.fan_start[walk.vertex]; k < nonmortar.fan_start[walk.vertex + 1]; ++k)
        look_around(nonmortar.fan[k]);
    else if (walk.triangle != none)
      look_around(walk.triangle);
    else if (start.on == On::edge)
      for (const unsigned int v : nonmortar.edges[start.index])
        is_known = is_known && region.contains(v);
    if (is_known)
      lost_edges.push_back(walk.edge);
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



  struct PlaneGraph::Front
  {
    const SurfaceTopology    &nonmortar;
    std::vector<unsigned int> triangles, passed;
    /// The vertex at which it begins, or none.
    unsigned int vertex = none;
    /// Where on an edge that it has passed: there it does not cross it again.
    double passed_at = 0.;

    double place_on(const unsigned int edge) const
    {
      return vertex == none ? passed_at : (nonmortar.edges[edge][0] == vertex ? 0. : 1.);
    }
  };



  PlaneGraph::Front PlaneGraph::front_at(const SurfacePoint &start) const
  {
    Front front{nonmortar, {}, {}, none, start.x[0]};
    if (start.on == On::triangle)
      front.triangles.push_back(start.index);
    else if (start.on == On::edge)
      {
        front.passed.push_back(start.index);
        for (const unsigned int t : nonmortar.edge_triangles[start.index])
          if (t != none)
            front.triangles.push_back(t);
      }
    else
      {
        front.vertex = start.index;
        for (unsigned int k = nonmortar.fan_start[start.index]; k < nonmortar.fan_start[start.index + 1]; ++k)
          {
            front.triangles.push_back(nonmortar.fan[k]);
            const unsigned int corner = nonmortar.local_corner(nonmortar.fan[k], start.index);
            for (const unsigned int i : {corner, (corner + 2) % 3})
              front.passed.push_back(nonmortar.triangle_edges[nonmortar.fan[k]][i]);
          }
      }
    return front;
  }



  bool PlaneGraph::find_next_crossing(unsigned int &edge, Incidence::Crossing &next, const Walk &walk,
                                      const Front &front) const
  {
    constexpr double rounding = 1e-9;
    double           nearest  = 2.;
    edge                      = none;
    for (const unsigned int t : front.triangles)
      for (const unsigned int e : nonmortar.triangle_edges[t])
        for (const auto &crossing : incidence.all_crossings(e, walk.edge))
          {
            if (!is_between_ends(crossing, e, walk.edge))
              continue;
            const double position = walk.forward(crossing.s);
            const bool   was_here =
                std::find(front.passed.begin(), front.passed.end(), e) != front.passed.end();
            if (was_here && std::abs(crossing.t - front.place_on(e)) < Incidence::near_end)
              continue;
            if (position >= walk.position + (was_here ? 1e3 : -1.) * rounding && position < nearest)
              {
                nearest = position;
                next    = crossing;
                edge    = e;
              }
          }
    return edge != none;
  }



  PlaneGraph::State PlaneGraph::trace_by_roots(Walk &walk, const SurfacePoint &start)
  {
    Front front = front_at(start);
    for (std::size_t step = 0; step < 2 * nonmortar.triangles.size(); ++step)
      {
        for (const unsigned int t : front.triangles)
          if (is_reached(walk, t))
            return State::reached;
        unsigned int        out;
        Incidence::Crossing next{0., 0., 0};
        if (!find_next_crossing(out, next, walk, front))
          return State::lost;
        if (place_crossing(walk, out, next.t, walk.forward(next.s), next.low_side) == State::left)
          return State::left;
        const auto        &beside  = nonmortar.edge_triangles[out];
        const unsigned int through = beside[walk.direction * next.low_side > 0 ? 0 : 1];
        if (through == none || !incidence.edge_faces(walk.edge, walk.forward(walk.position), through))
          {
            border_crossings.insert({walk.edge, out});
            return State::left;
          }
        front.triangles = {through};
        front.passed    = {out};
        front.passed_at = next.t;
        front.vertex    = none;
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
          if (state == State::left)
            unfinished.push_back(f);
        }
    enter_at_borders();
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
} // namespace Signorini
