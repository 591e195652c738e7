// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "imported_field.h"

#include <signorini/application/ties.h>

namespace Signorini
{
  using namespace dealii;

  DirichletData lift_ties(const ConstrainedSpace &constrained, const InterfaceCoupling &coupling,
                          const std::vector<RowProjection> &projections,
                          const std::vector<unsigned char> &tied)
  {
    DirichletData          dirichlet = constrained.dirichlet;
    std::vector<NodeIndex> columns;
    for (const auto &entry : coupling.entries)
      columns.push_back(entry.node);
    const NodalSpace   &space = constrained.nodal();
    const ImportedField lift(constrained.partition,
                             prescribed_displacement(space, constrained.partition, dirichlet),
                             std::move(columns));
    for (std::size_t p = 0; p < coupling.n_rows(); ++p)
      if (tied[p] && space.relevant().is_element(coupling.rows[p]))
        {
          Vector3 sum;
          for (const auto *entry = coupling.begin(p); entry != coupling.end(p); ++entry)
            sum += entry->weight * lift(entry->node);
          dirichlet.value[space.relevant().index_within_set(coupling.rows[p])] += projections[p].apply(sum);
        }
    return dirichlet;
  }



  void fix_tied_unknowns(LinearSystem &system, const Discretization &d)
  {
    const NodePartition       &partition = system.matrix.partition();
    std::vector<unsigned char> is_tied(partition.n_local(), 0);
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      if (d.owns_row(row))
        is_tied[partition.to_local(d.coupling.rows[row])] = d.tied[row];
    import_ghost_flags(partition, is_tied);
    for (unsigned int i = 0; i < partition.n_local(); ++i)
      if (is_tied[i])
        {
          system.fixed[i] = all_fixed;
          if (i < partition.n_owned())
            for (unsigned int c = 0; c < dim; ++c)
              system.rhs.local_element(dim * i + c) = 0.;
        }
  }



  void clear_tied_unknowns(Vector &v, const NodePartition &unknowns, const Discretization &d)
  {
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      if (d.tied[row] && d.owns_row(row))
        for (unsigned int c = 0; c < dim; ++c)
          v.local_element(dim * unknowns.to_local(d.coupling.rows[row]) + c) = 0.;
  }



  void set_tie_stress(ContactStress &stress, const ContactModel &model, const Discretization &d,
                      const Vector &displacement)
  {
    if (!d.has_ties())
      return;
    const Vector residual =
        physical_residual(model.bodies(), d.nodal(), d.partition(), model.loads(), displacement);
    const auto forces = import_values(d.partition(), residual, d.coupling.rows);
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (d.tied[p])
        {
          stress.traction[p] = d.projections[p].apply(-forces[p] / d.coupling.weight[p]);
          stress.pressure[p] = stress.traction[p] * d.projections[p].direction();
          stress.opening[p]  = 0.;
          stress.active[p]   = 1;
        }
  }
} // namespace Signorini
