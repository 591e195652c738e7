// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/contact_spots.h>

#include <map>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A node and the first one of those that it is joined with.
    struct JoinedPair
    {
      NodeIndex node, first;
    };

    /// The active corners of a face, and for those that hang their active parents.
    std::vector<unsigned int> active_vertices(const ContactSurface &surface, const ContactSurface::Face &face,
                                              const std::vector<bool> &is_active)
    {
      std::vector<unsigned int> result;
      const auto                add = [&](const unsigned int v) {
        if (is_active[v])
          result.push_back(v);
      };
      for (unsigned int a = 0; a < face.n_corners; ++a)
        {
          const unsigned int v = face.corners[a];
          add(v);
          for (const auto &[parent, weight] : surface.hanging[v])
            if (weight != 0.)
              add(parent);
        }
      return result;
    }

    /// Collective. Joins the active nodes of every face; nodes of the faces of several ranks join what these
    /// have found.
    SparseDisjointSets<NodeIndex> join_active_nodes(const ContactPair       &pair,
                                                    const std::vector<bool> &is_active, const MPI_Comm comm)
    {
      const ContactSurface         &surface = pair.nonmortar.surface;
      SparseDisjointSets<NodeIndex> joined;
      std::set<NodeIndex>           of_others, own;
      for (unsigned int v = 0; v < surface.vertex_node.size(); ++v)
        if (pair.halo->owns(v))
          own.insert(surface.vertex_node[v]);
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        if (pair.halo->owns_face(f))
          {
            const auto vertices = active_vertices(surface, surface.faces[f], is_active);
            for (const unsigned int v : vertices)
              {
                joined.unite(surface.vertex_node[vertices[0]], surface.vertex_node[v]);
                if (!pair.halo->owns(v))
                  of_others.insert(surface.vertex_node[v]);
              }
          }
      std::vector<JoinedPair> shared;
      for (const NodeIndex node : of_others)
        shared.push_back({node, joined.find(node)});
      shared = gather_lists(std::move(shared), comm, Receivers::all);
      // The owner of a node joins what it has itself.
      std::vector<JoinedPair> of_owners;
      for (const JoinedPair &one : shared)
        if (own.count(one.node) > 0)
          of_owners.push_back({one.node, joined.find(one.node)});
      for (const auto &list : {shared, gather_lists(std::move(of_owners), comm, Receivers::all)})
        for (const auto &[node, first] : list)
          joined.unite(node, first);
      return joined;
    }

    /// What a rank knows of a spot.
    struct PartOfSpot
    {
      NodeIndex   first;
      ContactSpot part;
    };

    /// Collective. By face: whether it, if it is one of this rank, or a face beside it has an active corner.
    std::vector<bool> faces_near_contact(const ContactPair &pair, const std::vector<bool> &is_active)
    {
      const ContactSurface      &surface = pair.nonmortar.surface;
      std::vector<unsigned char> is_near(is_active.begin(), is_active.end());
      for (const ContactSurface::Face &face : surface.faces)
        if (!active_vertices(surface, face, is_active).empty())
          for (const unsigned int v : face.corners)
            is_near[v] = 1;
      // The owner of a vertex knows all faces around it.
      pair.halo->update(is_near);
      const std::vector<bool> is_known(is_near.begin(), is_near.end());
      std::vector<bool>       result;
      for (const ContactSurface::Face &face : surface.faces)
        result.push_back(!active_vertices(surface, face, is_known).empty());
      return result;
    }
  } // namespace



  ContactSpots find_contact_spots(const ContactPair &pair, const PairCoupling &coupling,
                                  const std::vector<double> &pressure, const std::vector<bool> &is_active,
                                  const std::vector<LeastGap> &gaps)
  {
    const MPI_Comm                   comm    = pair.halo->communicator();
    const ContactSurface            &surface = pair.nonmortar.surface;
    SparseDisjointSets<NodeIndex>    joined  = join_active_nodes(pair, is_active, comm);
    std::map<NodeIndex, ContactSpot> parts;
    for (std::size_t row = 0; row < coupling.vertices.size(); ++row)
      if (is_active[coupling.vertices[row]])
        {
          ContactSpot &spot = parts[joined.find(coupling.coupling.rows[row])];
          spot.load += coupling.areas[row] * pressure[row];
          spot.area += coupling.areas[row];
        }
    ContactSpots            result;
    const std::vector<bool> is_near = faces_near_contact(pair, is_active);
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      if (pair.halo->owns_face(f))
        {
          if (const auto vertices = active_vertices(surface, surface.faces[f], is_active); !vertices.empty())
            parts[joined.find(surface.vertex_node[vertices[0]])].gap.add(gaps[f].value(), gaps[f].place());
          else if (!is_near[f])
            result.elsewhere.add(gaps[f].value(), gaps[f].place());
        }
    std::vector<PartOfSpot> list;
    for (const auto &[first, part] : parts)
      list.push_back({first, part});
    parts.clear();
    for (const auto &[first, part] : gather_lists(std::move(list), comm, Receivers::all))
      {
        ContactSpot &spot = parts[first];
        spot.load += part.load;
        spot.area += part.area;
        spot.gap.add(part.gap.value(), part.gap.place());
      }
    for (const auto &[first, spot] : parts)
      result.spots.push_back(spot);
    result.elsewhere.reduce(comm);
    return result;
  }
} // namespace Signorini
