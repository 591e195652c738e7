// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_nodal_contact_forces_h
#define signorini_source_application_nodal_contact_forces_h

#include <signorini/algebra/sent_lists.h>
#include <signorini/application/contact_solve.h>

#include <algorithm>
#include <vector>

namespace Signorini
{
  /// Collective. The forces of a contact stress on the nodes of both sides (doc/algorithm.md, (20)): calls
  /// add(local number of an owned node, force) for what each row does to it, in the order of the rows.
  template <typename Add>
  void for_contact_forces(const Discretization &d, const ContactStress &stress, const Add &add)
  {
    struct RowForce
    {
      NodeIndex node, row;
      Vector3   force;
    };
    const NodePartition  &partition = d.partition();
    ListsByRank<RowForce> parcels;
    const auto            send = [&](const NodeIndex node, const NodeIndex row, const Vector3 &force) {
      parcels[partition.owner(node)].push_back({node, row, force});
    };
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (d.owns_row(p))
        {
          const NodeIndex row   = d.coupling.rows[p];
          const Vector3   force = d.coupling.weight[p] * stress.traction[p];
          send(row, row, -force);
          for (const auto *entry = d.coupling.begin(p); entry != d.coupling.end(p); ++entry)
            send(entry->node, row, entry->weight * force);
        }
    std::vector<RowForce> forces;
    for (const auto &[rank, list] : send_lists(parcels, partition.communicator()))
      forces.insert(forces.end(), list.begin(), list.end());
    std::sort(forces.begin(), forces.end(), [](const RowForce &a, const RowForce &b) {
      return std::tie(a.node, a.row) < std::tie(b.node, b.row);
    });
    for (const RowForce &one : forces)
      add(partition.to_local(one.node), one.force);
  }
} // namespace Signorini

#endif
