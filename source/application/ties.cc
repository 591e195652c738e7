// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Tied pairs: the mortar coupling as an equality. The relative displacement û_p of a tied node is a fixed
// component of the transformed problem, and zero, because the lift has no jump at tied nodes.

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_problem.h>

namespace Signorini
{
  using namespace dealii;

  void ContactProblem::hold_by_ties()
  {
    Discretization           &d = discretization;
    std::vector<unsigned int> group(bodies.n_parts());
    for (unsigned int part = 0; part < group.size(); ++part)
      group[part] = part;
    for (const PairDefinition &definition : pair_definitions)
      if (definition.parameters.contact == "tied")
        {
          const unsigned int to = group[*parts_of(definition, 0).begin()];
          for (unsigned int i = 0; i < 2; ++i)
            for (const unsigned int part : parts_of(definition, i))
              {
                const unsigned int from = group[part];
                std::replace(group.begin(), group.end(), from, to);
              }
        }
    std::set<unsigned int> moving;
    for (const FreeMotion &motion : d.free_motions)
      moving.insert(motion.part);
    std::set<unsigned int> held;
    for (unsigned int part = 0; part < group.size(); ++part)
      if (moving.count(part) == 0)
        held.insert(group[part]);
    d.is_held_by_ties = false;
    std::vector<FreeMotion> left;
    for (const FreeMotion &motion : d.free_motions)
      if (std::count(group.begin(), group.end(), group[motion.part]) == 1)
        left.push_back(motion);
      else if (held.count(group[motion.part]) > 0)
        d.is_held_by_ties = true;
      else
        throw InputError(
            "Body " + bodies.body_name(motion.body) +
            "/Dirichlet: the conditions do not exclude rigid motions, and neither do those of any body that "
            "it is tied to. One body of a tied group must be held by conditions of its own.");
    d.free_motions = left;
  }



  void ContactProblem::tie_lift()
  {
    Discretization &d = discretization;
    if (!d.has_ties())
      return;
    std::vector<NodeIndex> columns;
    for (const auto &entry : d.coupling.entries)
      columns.push_back(entry.node);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    Vector lift;
    d.partition->reinit(lift);
    for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        lift.local_element(dim * i + c) =
            d.dirichlet.value[d.space->relevant().index_within_set(d.partition->to_global(i))][c];
    const std::vector<Vector3> values = replicate_values(*d.partition, lift, columns);
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (d.tied[p] && d.space->relevant().is_element(d.coupling.rows[p]))
        {
          Vector3 sum;
          for (const auto *entry = d.coupling.begin(p); entry != d.coupling.end(p); ++entry)
            sum += entry->weight *
                   values[std::lower_bound(columns.begin(), columns.end(), entry->node) - columns.begin()];
          d.dirichlet.value[d.space->relevant().index_within_set(d.coupling.rows[p])] +=
              d.projections[p].apply(sum);
        }
  }



  void ContactProblem::tie_unknowns(LinearSystem &system) const
  {
    const Discretization &d         = discretization;
    const NodePartition  &partition = system.matrix.partition();
    for (unsigned int i = 0; i < partition.n_local(); ++i)
      if (const std::ptrdiff_t row = d.coupling.find(partition.to_global(i)); row >= 0 && d.tied[row])
        {
          system.fixed[i] = all_fixed;
          if (i < partition.n_owned())
            for (unsigned int c = 0; c < dim; ++c)
              system.rhs.local_element(dim * i + c) = 0.;
        }
  }



  void ContactProblem::evaluate_ties()
  {
    Discretization &d = discretization;
    if (!d.has_ties())
      return;
    // The rows of tied nodes are not in the matrix: their forces are what the equilibrium lacks.
    const Vector residual = physical_residual(bodies, *d.space, *d.partition, loads, d.displacement);
    const auto   forces   = replicate_values(*d.partition, residual, d.coupling.rows);
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (d.tied[p])
        {
          d.traction[p] = d.projections[p].apply(-forces[p] / d.coupling.weight[p]);
          d.pressure[p] = d.traction[p] * d.projections[p].direction();
          d.opening[p]  = 0.;
          d.active[p]   = 1;
        }
  }
} // namespace Signorini
