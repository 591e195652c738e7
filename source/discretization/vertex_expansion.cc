// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/discretization/vertex_expansion.h>

namespace Signorini
{
  using namespace dealii;

  VertexExpansion::VertexExpansion(const NodalSpace &space, const InterfaceCoupling &coupling,
                                   const std::vector<RowProjection> &projections,
                                   const RigidFaces *const           rigid)
    : space(space)
    , coupling(coupling)
    , rigid(rigid)
    , special(space.relevant().n_elements(), false)
  {
    for (std::size_t i = 0; i < special.size(); ++i)
      special[i] = space.hanging_nodes().is_constrained(space.relevant().nth_index_in_set(i));
    for (const NodeIndex row : coupling.rows)
      if (space.relevant().is_element(row))
        special[space.relevant().index_within_set(row)] = true;
    for (const RowProjection &projection : projections)
      {
        blocks.push_back(projection.block());
        is_identity.push_back(projection.is_identity());
      }
    if (rigid != nullptr)
      for (const auto &[node, dependence] : rigid->nodes())
        if (space.relevant().is_element(node))
          special[space.relevant().index_within_set(node)] = true;
  }



  void VertexExpansion::add_conforming(const NodeIndex node, const double weight,
                                       std::vector<Term> &terms) const
  {
    if (rigid != nullptr)
      if (const RigidFaces::Dependence *const dependence = rigid->find(node))
        {
          for (unsigned int k = 0; k < 2; ++k)
            terms.push_back({rigid->carrier(dependence->face, k), weight, &dependence->blocks[k]});
          return;
        }
    terms.push_back({node, weight, nullptr});
    const std::ptrdiff_t row = coupling.find(node);
    if (row < 0)
      return;
    const Block *const block = is_identity[row] ? nullptr : &blocks[row];
    for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
      terms.push_back({entry->node, weight * entry->weight, block});
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
