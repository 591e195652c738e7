// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/vertex_expansion.h>

namespace Signorini
{
  using namespace dealii;

  VertexExpansion::VertexExpansion(const NodalSpace &space, const InterfaceCoupling &coupling,
                                   const std::vector<RowProjection> &projections)
    : space(space)
    , coupling(coupling)
    , projections(projections)
    , special(space.relevant().n_elements(), false)
  {
    for (std::size_t i = 0; i < special.size(); ++i)
      special[i] = space.hanging_nodes().is_constrained(space.relevant().nth_index_in_set(i));
    for (const NodeIndex row : coupling.rows)
      if (space.relevant().is_element(row))
        special[space.relevant().index_within_set(row)] = true;
  }



  void VertexExpansion::add_conforming(const NodeIndex node, const double weight,
                                       std::vector<Term> &terms) const
  {
    terms.push_back({node, weight, nullptr});
    const std::ptrdiff_t row = coupling.find(node);
    if (row < 0)
      return;
    const RowProjection *const projection = projections[row].is_identity() ? nullptr : &projections[row];
    for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
      terms.push_back({entry->node, weight * entry->weight, projection});
  }



  void VertexExpansion::expand(const NodeIndex node, std::vector<Term> &terms) const
  {
    terms.clear();
    if (const auto *parents = space.hanging_nodes().get_constraint_entries(node))
      for (const auto &[parent, weight] : *parents)
        add_conforming(parent, weight, terms);
    else
      add_conforming(node, 1., terms);
  }
} // namespace Signorini
