// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "multiplier_nodes.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/surface/crease_edges.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  MultiplierNodes::MultiplierNodes(const ContactSurface &surface, const SurfaceHalo &halo,
                                   const std::vector<FaceMoments> &moments, const NodesOfOtherPairs &others,
                                   const DroppingRule &rule)
    : surface(surface)
    , halo(halo)
    , moments(moments)
    , states(surface.vertex_node.size())
  {
    std::vector<double> covered(states.size(), 0.), full(covered);
    for (const FaceMoments &m : moments)
      for (unsigned int a = 0; a < 4; ++a)
        {
          const unsigned int v = surface.faces[m.face].corners[a];
          if (surface.faces[m.face].leaves(a))
            {
              full[v] += surface.faces[m.face].sees_flank(a) ? m.full[a] : 0.;
              continue;
            }
          full[v] += m.full[a];
          if (!is_empty(m))
            for (unsigned int b = 0; b < 4; ++b)
              covered[v] += m.mass[4 * a + b];
        }
    const std::vector<bool> well          = well_covered(rule);
    std::vector<bool>       on_sharp_edge = std::vector<bool>(states.size(), false);
    if (rule.drops_sharp_edges)
      on_sharp_edge = vertices_on_sharp_edges(surface, [&](const unsigned int face, const unsigned int v) {
        return well[face] && !surface.faces[face].leaves_vertex(v);
      });
    for (std::size_t v = 0; v < surface.has_partner_normal.size(); ++v)
      if (surface.has_partner_normal[v])
        on_sharp_edge[v] = false;
    const std::vector<bool> of_none = with_normal_of_none();
    for (unsigned int v = 0; v < states.size(); ++v)
      {
        State &state             = states[v];
        state.is_covered         = covered[v] > 0.;
        state.is_touched         = covered[v] > empty_share * full[v];
        state.covered            = covered[v];
        state.lies_on_sharp_edge = rule.drops_sharp_edges && of_none[v];
        state.share              = full[v] > 0. ? covered[v] / full[v] : 0.;
        if (is_hanging(v))
          continue;
        if (surface.vertex_fixed[v].all())
          drop(v, DroppedNode::fixed);
        else if (others.excluded.count(surface.vertex_node[v]) > 0)
          drop(v, DroppedNode::other_pair);
        else if (others.ceded.count(surface.vertex_node[v]) > 0)
          {
            drop(v, DroppedNode::other_pair);
            state.is_ceded = true;
          }
        else if (free_normal(v) < rule.smallest_free_normal)
          drop(v, DroppedNode::normal_fixed);
        else if (on_sharp_edge[v])
          drop(v, DroppedNode::sharp_edge);
        else if (state.is_touched && others.kept.count(surface.vertex_node[v]) > 0)
          state.is_protected = true;
        else if (!(covered[v] > 0.) || covered[v] < rule.smallest_share * full[v])
          drop(v, DroppedNode::thin_cover);
      }
    halo.update(states);
  }



  std::vector<bool> MultiplierNodes::well_covered(const DroppingRule &rule) const
  {
    std::vector<bool> result(surface.faces.size(), false);
    for (const FaceMoments &m : moments)
      result[m.face] = m.covered > rule.smallest_share * m.area;
    return result;
  }



  std::vector<bool> MultiplierNodes::with_normal_of_none() const
  {
    const double      smallest_cosine = std::cos(CreaseEdgeRule().sharp * numbers::PI / 180.);
    std::vector<bool> is_covered(surface.faces.size(), false), is_seen(states.size(), false), result(is_seen);
    for (const FaceMoments &m : moments)
      is_covered[m.face] = !is_empty(m);
    // On an edge that stands on the other side its normal is right.
    for (std::size_t v = 0; v < surface.has_partner_normal.size(); ++v)
      is_seen[v] = surface.has_partner_normal[v];
    for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
      if (const ContactSurface::Face &face = surface.faces[surface.triangle_face[t]];
          is_covered[surface.triangle_face[t]])
        for (const unsigned int v : surface.mesh.triangles[t])
          if (!face.leaves_vertex(v))
            {
              const bool is_of_facet =
                  surface.mesh.vertex_normals[v] * facet_normal(surface, t) >= smallest_cosine;
              result[v]  = !is_of_facet && (result[v] || !is_seen[v]);
              is_seen[v] = true;
            }
    return result;
  }



  void MultiplierNodes::drop(const unsigned int v, const DroppedNode::Reason why)
  {
    states[v].in_r   = true;
    states[v].reason = why;
  }



  bool MultiplierNodes::drop_rows(const std::vector<unsigned int> &rows)
  {
    for (const unsigned int v : rows)
      drop(v, DroppedNode::large_row);
    if (Utilities::MPI::sum(rows.size(), halo.communicator()) == 0)
      return false;
    halo.update(states);
    return true;
  }



  bool MultiplierNodes::is_reported(const unsigned int v) const
  {
    return states[v].in_r && !is_hanging(v) && states[v].is_touched;
  }



  bool MultiplierNodes::all_in_r(const std::vector<unsigned int> &vertices) const
  {
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](const unsigned int v) { return states[v].in_r; });
  }



  std::vector<unsigned int> MultiplierNodes::parents(const unsigned int v) const
  {
    std::vector<unsigned int> result;
    for (const auto &parent : surface.hanging[v])
      result.push_back(parent.first);
    return result;
  }



  std::vector<unsigned int> MultiplierNodes::corners(const FaceMoments &m) const
  {
    const auto &list = surface.faces[m.face].corners;
    return {list.begin(), list.end()};
  }



  void MultiplierNodes::update_hanging()
  {
    for (unsigned int v = 0; v < states.size(); ++v)
      if (is_hanging(v))
        states[v].in_r = all_in_r(parents(v));
  }



  double MultiplierNodes::free_normal(const unsigned int v) const
  {
    return project_free(surface.vertex_fixed[v], surface.mesh.vertex_normals[v]).norm();
  }



  bool MultiplierNodes::may_return(const unsigned int v) const
  {
    const State &state = states[v];
    return state.in_r && !is_hanging(v) && state.is_covered &&
           (state.reason == DroppedNode::thin_cover || state.reason == DroppedNode::large_row ||
            state.reason == DroppedNode::sharp_edge ||
            (state.reason == DroppedNode::normal_fixed && free_normal(v) >= RowProjection::smallest_share));
  }



  bool MultiplierNodes::any_may_return(const std::vector<unsigned int> &vertices) const
  {
    return std::any_of(vertices.begin(), vertices.end(), [&](const unsigned int v) { return may_return(v); });
  }



  /// One of the vertices that a place could get a multiplier from: the parents of a hanging vertex, the
  /// corners of a face. The vertices of a place follow each other.
  struct MultiplierNodes::NeedyPlace
  {
    /// Hanging vertices are looked at before faces.
    bool         is_face;
    unsigned int index;
    /// Whether the place needs one at all.
    bool         is_covered;
    unsigned int vertex;
    bool         is_hanging, may_return;
    double       share;

    std::pair<bool, unsigned int> place() const
    {
      return {is_face, index};
    }

    /// Of the places of all ranks, one after the other and again until nothing changes: the best covered
    /// vertex of each that is still without. All vertices are in R at first. The same on all ranks.
    static std::set<unsigned int> vertices_to_return(std::vector<NeedyPlace> list)
    {
      std::stable_sort(list.begin(), list.end(),
                       [](const auto &a, const auto &b) { return a.place() < b.place(); });
      std::set<unsigned int> returned, helped;
      const auto             is_in_r = [&](const NeedyPlace &v) {
        return v.is_hanging ? helped.count(v.vertex) == 0 : returned.count(v.vertex) == 0;
      };
      for (bool changed = true; changed;)
        {
          changed = false;
          for (auto first = list.begin(), last = first; first != list.end(); first = last)
            {
              while (last != list.end() && last->place() == first->place())
                ++last;
              const bool        is_needy = std::all_of(first, last, is_in_r);
              const NeedyPlace *best     = nullptr;
              for (auto v = first; v != last; ++v)
                if (v->may_return && (best == nullptr || v->share > best->share))
                  best = &*v;
              const bool is_helped = is_needy && first->is_covered && best != nullptr;
              if (is_helped)
                {
                  returned.insert(best->vertex);
                  changed = true;
                }
              if (!first->is_face && (is_helped || !is_needy))
                helped.insert(first->index);
            }
        }
      return returned;
    }
  };



  void MultiplierNodes::add_place(std::vector<NeedyPlace> &places, const bool is_face,
                                  const unsigned int index, const bool is_covered,
                                  const std::vector<unsigned int> &vertices) const
  {
    for (const unsigned int v : vertices)
      places.push_back({is_face, index, is_covered, v, is_hanging(v), may_return(v), share(v)});
  }



  /// Hanging vertices without a parent in K and faces without a function, of this rank, where that can be
  /// changed.
  std::vector<MultiplierNodes::NeedyPlace> MultiplierNodes::needy_places() const
  {
    std::vector<NeedyPlace> places;
    for (unsigned int h = 0; h < states.size(); ++h)
      if (halo.owns(h) && is_hanging(h) && states[h].in_r && states[h].is_covered &&
          any_may_return(parents(h)))
        add_place(places, false, h, true, parents(h));
    for (const FaceMoments &m : moments)
      {
        if (!halo.owns_face(m.face) || is_empty(m) || surface.faces[m.face].flank_corners != 0)
          continue;
        const std::vector<unsigned int> vertices = corners(m);
        if (!all_in_r(vertices) || !any_may_return(vertices))
          continue;
        add_place(places, true, m.face, true, vertices);
        for (const unsigned int h : vertices)
          if (is_hanging(h))
            add_place(places, false, h, states[h].is_covered, parents(h));
      }
    return places;
  }



  void MultiplierNodes::complete()
  {
    update_hanging();
    const auto all = gather_lists(needy_places(), halo.communicator(), Receivers::all);
    for (const unsigned int v : NeedyPlace::vertices_to_return(all))
      {
        states[v].in_r         = false;
        states[v].is_protected = true;
      }
    update_hanging();
  }



  std::vector<DroppedNode> MultiplierNodes::report() const
  {
    std::vector<DroppedNode> list;
    for (unsigned int v = 0; v < states.size(); ++v)
      if (halo.owns(v) && is_reported(v))
        list.push_back({surface.vertex_node[v], surface.mesh.vertices[v], states[v].reason, share(v)});
    return list;
  }



  std::vector<PairCoupling::CededNode> MultiplierNodes::ceded_nodes() const
  {
    std::vector<PairCoupling::CededNode> list;
    for (unsigned int v = 0; v < states.size(); ++v)
      if (halo.owns(v) && states[v].is_ceded)
        list.push_back({surface.vertex_node[v], states[v].covered});
    return list;
  }



  std::vector<PairCoupling::LostFace> MultiplierNodes::lost_faces() const
  {
    std::vector<PairCoupling::LostFace> result;
    for (const FaceMoments &m : moments)
      {
        if (!halo.owns_face(m.face) || !(m.covered > 0.) || surface.faces[m.face].flank_corners != 0)
          continue;
        std::map<NodeIndex, unsigned int> nodes;
        for (const unsigned int v : corners(m))
          if (!is_hanging(v))
            nodes[surface.vertex_node[v]] = v;
          else
            for (const unsigned int parent : parents(v))
              nodes[surface.vertex_node[parent]] = parent;
        if (std::any_of(nodes.begin(), nodes.end(), [&](const auto &node) { return is_row(node.second); }))
          continue;
        // Other pairs and the rule are to blame before conditions.
        DroppedNode::Reason reason = DroppedNode::fixed;
        for (const auto &[node, v] : nodes)
          if (const DroppedNode::Reason why = states[v].reason;
              is_reported(v) && why != DroppedNode::fixed && why != DroppedNode::normal_fixed)
            reason = why;
        result.push_back({m.face, reason});
      }
    return result;
  }
} // namespace Signorini
