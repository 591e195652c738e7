// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/galerkin_product.h>
#include <signorini/solvers/foreign_levels.h>

namespace Signorini
{
  using namespace dealii;

  IndexSet ForeignNumbering::nodes(const IndexSet &dofs) const
  {
    AssertThrow(n_components >= 1 && n_components <= dim, ExcMessage("One to three components a node."));
    AssertThrow(dofs.is_contiguous() && dofs.size() % n_components == 0 &&
                    dofs.n_elements() % n_components == 0,
                ExcMessage("The dofs of a rank must be contiguous and come node by node."));
    IndexSet result(dofs.size() / n_components);
    if (dofs.n_elements() > 0)
      {
        const auto begin = dofs.nth_index_in_set(0);
        AssertThrow(begin % n_components == 0, ExcMessage("The dofs of a rank must begin with a node."));
        result.add_range(begin / n_components, (begin + dofs.n_elements()) / n_components);
      }
    return result;
  }



  std::vector<FixedDirections> ForeignNumbering::fixed(const IndexSet &owned_dofs,
                                                       const IndexSet &prescribed) const
  {
    std::vector<FixedDirections> masks;
    for (const NodeIndex node : nodes(owned_dofs))
      {
        FixedMask mask = missing();
        for (unsigned int c = 0; c < n_components; ++c)
          if (prescribed.is_element(n_components * node + c))
            mask = static_cast<FixedMask>(mask | (1u << c));
        masks.push_back(mask);
      }
    return masks;
  }



  HalfSpaces ForeignLevels::inject(const Level &level) const
  {
    // By coarse node, which are not in the order of the fine ones.
    std::map<unsigned int, std::size_t> place;
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      {
        const std::size_t begin = level.rows.start[half_spaces.nodes[p]],
                          end   = level.rows.start[half_spaces.nodes[p] + 1];
        if (end == begin + 1 && level.rows.weights[begin] == 1. &&
            level.owned.is_element(level.rows.columns[begin]))
          place[static_cast<unsigned int>(level.owned.index_within_set(level.rows.columns[begin]))] = p;
      }
    HalfSpaces result;
    for (const auto &[node, p] : place)
      {
        result.nodes.push_back(node);
        result.normals.push_back(half_spaces.normals[p]);
        result.bounds.push_back(half_spaces.bounds[p]);
      }
    return result;
  }



  std::optional<CoarserLevel> ForeignLevels::next(const NodePartition &finer)
  {
    if (n_described == levels.size())
      return {};
    Level       &level = levels[n_described];
    CoarserLevel result;
    result.owned        = level.owned;
    result.fixed        = level.fixed;
    const NodeRows rows = import_ghost_rows(finer, level.rows);
    // Rows that can be truncated.
    std::vector<NodalTransfer::BlockRow> block_rows;
    if (n_described == 0)
      for (unsigned int i = 0; i < finer.n_local(); ++i)
        block_rows.push_back(
            {i,
             {rows.columns.begin() + rows.start[i], rows.columns.begin() + rows.start[i + 1]},
             {},
             {rows.weights.begin() + rows.start[i], rows.weights.begin() + rows.start[i + 1]}});
    result.transfer.reinit(rows, block_rows, finer.n_owned());
    half_spaces        = inject(level);
    result.half_spaces = half_spaces;
    level.rows         = NodeRows();
    ++n_described;
    return result;
  }
} // namespace Signorini
