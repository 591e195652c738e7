// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/node_request.h>
#include <signorini/mortar/contact_forces.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Side = ContactForces::Side;

    /// All conforming nodes of a surface, sorted, without force.
    Side nodes_of(const ContactSurface &surface)
    {
      Side side;
      for (unsigned int v = 0; v < surface.vertex_node.size(); ++v)
        if (surface.hanging[v].empty())
          side.nodes.push_back({surface.vertex_node[v], surface.mesh.vertices[v], Vector3()});
      std::sort(side.nodes.begin(), side.nodes.end(),
                [](const auto &a, const auto &b) { return a.node < b.node; });
      return side;
    }

    void add(Side &side, const NodeIndex node, const Vector3 &force)
    {
      const auto it = std::lower_bound(side.nodes.begin(), side.nodes.end(), node,
                                       [](const auto &entry, const NodeIndex n) { return entry.node < n; });
      Assert(it != side.nodes.end() && it->node == node, ExcInternalError());
      it->force += force;
    }

    /// Leaves out nodes without force and sums up.
    void finish(Side &side)
    {
      side.nodes.erase(std::remove_if(side.nodes.begin(), side.nodes.end(),
                                      [](const auto &entry) { return entry.force.norm_square() == 0.; }),
                       side.nodes.end());
      for (const auto &entry : side.nodes)
        {
          side.force += entry.force;
          side.moment += cross_product_3d(Vector3(entry.position), entry.force);
        }
    }
  } // namespace



  ContactForces compute_contact_forces(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                       const PairCoupling &pair, const std::vector<Vector3> &traction)
  {
    AssertDimension(traction.size(), pair.coupling.n_rows());
    ContactForces result{nodes_of(nonmortar), nodes_of(mortar)};
    for (std::size_t row = 0; row < pair.coupling.n_rows(); ++row)
      {
        const Vector3 force = pair.coupling.weight[row] * traction[row];
        add(result.nonmortar, pair.coupling.rows[row], -force);
        // Entries toward R hold -D_kr/D_kk: their force acts on the nonmortar side.
        for (const auto *entry = pair.coupling.begin(row); entry != pair.coupling.end(row); ++entry)
          if (std::binary_search(pair.r_nodes.begin(), pair.r_nodes.end(), entry->node))
            add(result.nonmortar, entry->node, entry->weight * force);
          else
            add(result.mortar, entry->node, entry->weight * force);
      }
    finish(result.nonmortar);
    finish(result.mortar);
    return result;
  }



  namespace
  {
    /// A mean over the covered faces around a vertex.
    struct VertexMean
    {
      void add(const double value, const double w)
      {
        sum += value;
        weight += w;
        n_terms += 1.;
      }

      double sum = 0., weight = 0., n_terms = 0.;
    };

    /// Calls visit(moments of a face, a, b) for all pairs of corners of the covered faces.
    template <typename Visit>
    void for_each_corner_pair(const ContactSurface &surface, const std::vector<FaceMoments> &moments,
                              const Visit &visit)
    {
      for (const FaceMoments &m : moments)
        if (m.covered > 0.)
          for (unsigned int a = 0; a < surface.faces[m.face].n_corners; ++a)
            for (unsigned int b = 0; b < surface.faces[m.face].n_corners; ++b)
              if (!surface.faces[m.face].leaves(a) && !surface.faces[m.face].leaves(b))
                visit(m, a, b);
    }

    /// How much the multiplier of corner b counts in the mean of corner a on the covered part of a face
    /// (area): ∫φ_a φ_b, or on triangles ∫φ_a times the share of b in the mean over the face.
    double weight_in_mean(const ContactSurface &surface, const FaceMoments &m, const unsigned int a,
                          const unsigned int b)
    {
      if (surface.faces[m.face].n_corners != 3)
        return m.mass[4 * a + b];
      // Turned cells have negative areas, which may cancel others.
      std::array<double, 3> integrals;
      for (unsigned int c = 0; c < 3; ++c)
        integrals[c] = std::max(0., m.mass[4 * c] + m.mass[4 * c + 1] + m.mass[4 * c + 2]);
      const double sum = integrals[0] + integrals[1] + integrals[2];
      return sum > 0. ? integrals[a] * integrals[b] / sum : 0.;
    }
  } // namespace



  std::vector<double> recover_pressure(const ContactSurface &nonmortar, const SurfaceHalo &halo,
                                       const std::vector<FaceMoments> &moments, const PairCoupling &pair,
                                       const std::vector<double> &pressure)
  {
    struct Nodal
    {
      double value        = 0.;
      bool   has_pressure = false;
    };
    const std::size_t  n = nonmortar.mesh.vertices.size();
    std::vector<Nodal> nodal(n);
    for (std::size_t row = 0; row < pressure.size(); ++row)
      nodal[pair.vertices[row]] = {pressure[row], true};
    halo.update(nodal);
    for (std::size_t v = 0; v < n; ++v)
      if (!nonmortar.hanging[v].empty())
        {
          nodal[v] = {0., true};
          for (const auto &[parent, share] : nonmortar.hanging[v])
            nodal[v].value += share * nodal[parent].value;
        }
    std::vector<VertexMean> own(n), patch(n);
    for_each_corner_pair(nonmortar, moments,
                         [&](const FaceMoments &m, const unsigned int a, const unsigned int b) {
                           const auto &corners = nonmortar.faces[m.face].corners;
                           if (nodal[corners[b]].has_pressure)
                             {
                               const double weight = weight_in_mean(nonmortar, m, a, b);
                               own[corners[a]].add(weight * nodal[corners[b]].value, weight);
                             }
                         });
    halo.update(own);
    for_each_corner_pair(nonmortar, moments,
                         [&](const FaceMoments &m, const unsigned int a, const unsigned int b) {
                           const auto &corners = nonmortar.faces[m.face].corners;
                           patch[corners[a]].add(own[corners[b]].sum, own[corners[b]].weight);
                         });
    // A vertex that only a sliver of the covered part touches has a multiplier that means nothing by itself.
    const double        smallest_share = RecoveryRule().smallest_share;
    std::vector<double> recovered(n, 0.);
    for (std::size_t v = 0; v < n; ++v)
      if (patch[v].weight > 0. && own[v].weight * patch[v].n_terms < smallest_share * patch[v].weight)
        recovered[v] = patch[v].sum / patch[v].weight;
      else if (own[v].weight > 0.)
        recovered[v] = own[v].sum / own[v].weight;
    halo.update(recovered);
    return recovered;
  }



  namespace
  {
    /// What rows bring to a node of the mortar side, times area.
    template <typename Value>
    struct NodeShare
    {
      NodeIndex node;
      Value     sum  = Value();
      double    area = 0.;
    };

    /// What the rows of this rank bring to the nodes of a surface, by rising node.
    template <typename Value>
    std::vector<NodeShare<Value>> shares_of_rows(const std::vector<NodeIndex> &nodes,
                                                 const PairCoupling &pair, const std::vector<Value> &of_rows)
    {
      std::vector<NodeShare<Value>> result;
      for (const NodeIndex node : nodes)
        result.push_back({node});
      for (std::size_t row = 0; row < of_rows.size(); ++row)
        for (const auto *entry = pair.coupling.begin(row); entry != pair.coupling.end(row); ++entry)
          if (const auto it = std::lower_bound(nodes.begin(), nodes.end(), entry->node);
              it != nodes.end() && *it == entry->node)
            {
              const double      weight = entry->weight * pair.coupling.weight[row];
              NodeShare<Value> &share  = result[it - nodes.begin()];
              share.sum += weight * of_rows[row];
              share.area += weight;
            }
      return result;
    }

    /// Collective. The sums over all ranks, by owned node.
    template <typename Value>
    std::unordered_map<unsigned int, NodeShare<Value>>
    sums_of_owners(const std::vector<NodeShare<Value>> &shares, const NodePartition &partition)
    {
      ListsByRank<NodeShare<Value>> parcels;
      for (const NodeShare<Value> &part : shares)
        if (part.area != 0.)
          parcels[partition.owner(part.node)].push_back(part);
      std::unordered_map<unsigned int, NodeShare<Value>> sums;
      for (const auto &[sender, list] : send_lists(parcels, partition.communicator()))
        for (const NodeShare<Value> &part : list)
          {
            NodeShare<Value> &sum = sums[partition.to_local(part.node)];
            sum.sum += part.sum;
            sum.area += part.area;
          }
      return sums;
    }

    template <typename Value>
    std::vector<Value> means_at_vertices(const ContactSurface &mortar, const PairCoupling &pair,
                                         const std::vector<Value> &of_rows, const NodePartition &partition)
    {
      const std::size_t      n = mortar.mesh.vertices.size();
      std::vector<NodeIndex> nodes;
      for (unsigned int v = 0; v < n; ++v)
        if (mortar.hanging[v].empty())
          nodes.push_back(mortar.vertex_node[v]);
      std::sort(nodes.begin(), nodes.end());
      const auto sums    = sums_of_owners(shares_of_rows(nodes, pair, of_rows), partition);
      double     largest = 0.;
      for (const auto &entry : sums)
        largest = std::max(largest, entry.second.area);
      largest                         = Utilities::MPI::max(largest, partition.communicator());
      const std::vector<Value> values = NodeRequest(partition, nodes).fetch([&](const unsigned int local) {
        const auto it = sums.find(local);
        return it != sums.end() && it->second.area > 1e-6 * largest ? it->second.sum / it->second.area
                                                                    : Value();
      });
      std::vector<Value>       means(n, Value());
      for (std::size_t v = 0; v < n; ++v)
        if (mortar.hanging[v].empty())
          means[v] =
              values[std::lower_bound(nodes.begin(), nodes.end(), mortar.vertex_node[v]) - nodes.begin()];
      for (std::size_t v = 0; v < n; ++v)
        for (const auto &[parent, share] : mortar.hanging[v])
          means[v] += share * means[parent];
      return means;
    }
  } // namespace



  std::vector<Vector3> mortar_means(const ContactSurface &mortar, const PairCoupling &pair,
                                    const std::vector<Vector3> &of_rows, const NodePartition &partition)
  {
    return means_at_vertices(mortar, pair, of_rows, partition);
  }



  std::vector<double> mortar_means(const ContactSurface &mortar, const PairCoupling &pair,
                                   const std::vector<double> &of_rows, const NodePartition &partition)
  {
    return means_at_vertices(mortar, pair, of_rows, partition);
  }
} // namespace Signorini
