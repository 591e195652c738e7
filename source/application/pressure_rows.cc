// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The contact nodes of both sides with what acts on them, for pressure.csv.

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/pair_fields.h>
#include <signorini/mortar/contact_forces.h>

#include <algorithm>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Collective. The rows of all ranks, by rising node, on rank 0.
    std::vector<PressureRow> gather_by_node(std::vector<PressureRow> rows, const MPI_Comm comm)
    {
      rows = gather_lists(std::move(rows), comm, Receivers::rank_zero);
      std::stable_sort(rows.begin(), rows.end(),
                       [](const PressureRow &a, const PressureRow &b) { return a.node < b.node; });
      return rows;
    }

    /// Collective. A rank may have rows at nodes that it does not know otherwise: their numbers in the mesh
    /// file are those that the owners of the nodes give.
    void set_numbers_in_file(std::vector<PressureRow> &rows, const Bodies &bodies, const Discretization &d)
    {
      if (!bodies.has_node_numbers())
        return;
      std::vector<NodeIndex> nodes;
      for (const PressureRow &row : rows)
        nodes.push_back(row.node);
      const NodeRequest       request(d.partition(), sorted_nodes(std::move(nodes)));
      const std::vector<long> numbers = request.fetch([&](const unsigned int local) {
        const NodeIndex node = d.partition().to_global(local);
        return bodies.node_number(d.nodal().start_vertices()[d.nodal().relevant().index_within_set(node)]);
      });
      for (PressureRow &row : rows)
        row.mesh_node = numbers[std::lower_bound(request.nodes().begin(), request.nodes().end(), row.node) -
                                request.nodes().begin()];
    }

    /// What one row of a pair does to a node of the mortar side, or the sum of several.
    struct MortarShare
    {
      double area = 0., pressure = 0., recovered = 0., gap = 0.;
      bool   is_active = false;
    };

    using MortarShares = std::unordered_map<NodeIndex, MortarShare>;

    MortarShares mortar_shares(const Discretization &d, const ContactStress &stress, const unsigned int p)
    {
      const PairCoupling &coupling  = d.couplings[p];
      const auto          recovered = recover_pressure(d.pairs[p].nonmortar.surface, *d.pairs[p].halo,
                                                       d.pairs[p].moments, coupling, stress.pressure);
      MortarShares        shares;
      for (std::size_t i = 0; i < stress.pressure.size(); ++i)
        for (const auto *entry = coupling.coupling.begin(i); entry != coupling.coupling.end(i); ++entry)
          if (!std::binary_search(coupling.r_nodes.begin(), coupling.r_nodes.end(), entry->node))
            {
              const double weight = entry->weight * coupling.coupling.weight[i];
              MortarShare &share  = shares[entry->node];
              share.area += weight;
              share.pressure += weight * stress.pressure[i];
              share.recovered += weight * recovered[coupling.vertices[i]];
              share.gap += weight * coupling.mean_gap(i, stress.opening[i]);
              share.is_active = share.is_active || stress.active[i] != 0;
            }
      return shares;
    }

    /// Sums of shares and the first place and normal, by node.
    std::vector<PressureRow> sum_by_node(const std::vector<PressureRow> &parts)
    {
      std::vector<PressureRow> rows;
      for (const PressureRow &part : parts)
        if (rows.empty() || rows.back().node != part.node)
          rows.push_back(part);
        else
          {
            PressureRow &row = rows.back();
            row.area += part.area;
            row.pressure += part.pressure;
            row.recovered_pressure += part.recovered_pressure;
            row.gap += part.gap;
            row.active = row.active || part.active;
          }
      return rows;
    }

    /// From sums to means. Nodes that next to nothing faces have a mean of rounding: they are left out.
    void divide_by_area(std::vector<PressureRow> &rows)
    {
      double largest = 0.;
      for (const PressureRow &row : rows)
        largest = std::max(largest, row.area);
      rows.erase(std::remove_if(rows.begin(), rows.end(),
                                [largest](const PressureRow &row) { return !(row.area > 1e-6 * largest); }),
                 rows.end());
      for (PressureRow &row : rows)
        for (double *const sum : {&row.pressure, &row.recovered_pressure, &row.gap})
          *sum /= row.area;
    }
  } // namespace



  std::vector<PressureRow> pressure_rows(const Bodies &bodies, const Discretization &d,
                                         const ContactStress &all, const unsigned int p)
  {
    const PairCoupling      &coupling  = d.couplings[p];
    const ContactStress      stress    = stress_of_pair(d, all, p);
    const auto               recovered = recover_pressure(d.pairs[p].nonmortar.surface, *d.pairs[p].halo,
                                                          d.pairs[p].moments, coupling, stress.pressure);
    std::vector<PressureRow> rows;
    for (std::size_t i = 0; i < stress.pressure.size(); ++i)
      {
        PressureRow row{coupling.positions[i],
                        coupling.areas[i],
                        stress.pressure[i],
                        recovered[coupling.vertices[i]],
                        coupling.mean_gap(i, stress.opening[i]),
                        stress.active[i] != 0};
        row.pair   = p;
        row.node   = coupling.coupling.rows[i];
        row.normal = coupling.normals[i];
        rows.push_back(row);
      }
    set_numbers_in_file(rows, bodies, d);
    return gather_by_node(std::move(rows), d.nodal().communicator());
  }



  std::vector<PressureRow> mortar_pressure_rows(const Bodies &bodies, const Discretization &d,
                                                const ContactStress &all, const unsigned int p)
  {
    if (d.pairs[p].obstacle)
      return {};
    const ContactSurface    &surface = d.pairs[p].mortar.surface;
    const MortarShares       shares  = mortar_shares(d, stress_of_pair(d, all, p), p);
    std::vector<PressureRow> parts;
    for (std::size_t v = 0; v < surface.vertex_node.size(); ++v)
      if (const auto it = shares.find(surface.vertex_node[v]);
          it != shares.end() && surface.hanging[v].empty())
        {
          const MortarShare &share  = it->second;
          const Vector3     &normal = surface.mesh.vertex_normals[v];
          PressureRow        row{surface.mesh.vertices[v], share.area, share.pressure,
                          share.recovered,          share.gap,  share.is_active};
          row.pair   = p;
          row.node   = it->first;
          row.normal = normal;
          parts.push_back(row);
        }
    set_numbers_in_file(parts, bodies, d);
    std::vector<PressureRow> rows = sum_by_node(gather_by_node(std::move(parts), d.nodal().communicator()));
    divide_by_area(rows);
    return rows;
  }
} // namespace Signorini
