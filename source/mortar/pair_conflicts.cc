// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mortar/pair_coupling.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    void insert_conforming(std::set<NodeIndex> &nodes, const ContactSurface &surface, const unsigned int v)
    {
      if (surface.hanging[v].empty())
        nodes.insert(surface.vertex_node[v]);
      else
        for (const auto &parent : surface.hanging[v])
          nodes.insert(surface.vertex_node[parent.first]);
    }

    std::string pair_name(const std::vector<std::string> &names, const unsigned int pair)
    {
      return pair < names.size() ? "\"" + names[pair] + "\"" : "number " + std::to_string(pair + 1);
    }

    std::string describe(const NodeIndex node, const PairCoupling &pair, const std::size_t row)
    {
      std::ostringstream text;
      text << "node " << node << " at (" << pair.positions[row] << ")";
      return text.str();
    }

    /// No column may be a row.
    void check_columns(const InterfaceCoupling                                 &joined,
                       const std::vector<std::pair<unsigned int, std::size_t>> &origin,
                       const std::vector<PairCoupling> &pairs, const std::vector<std::string> &names)
    {
      for (std::size_t row = 0; row < joined.n_rows(); ++row)
        for (const auto *entry = joined.begin(row); entry != joined.end(row); ++entry)
          if (const std::ptrdiff_t other = joined.find(entry->node); other >= 0)
            {
              const auto &[p, i] = origin[other];
              throw InputError("Contact pairs " + pair_name(names, origin[row].first) + " and " +
                               pair_name(names, p) +
                               " form a chain or a cycle: " + describe(entry->node, pairs[p], i) +
                               " carries a contact stress in " + pair_name(names, p) +
                               " and moves others in " + pair_name(names, origin[row].first) +
                               ". Swap the sides of one of the pairs, or take the common part out of one.");
            }
    }
  } // namespace



  std::set<NodeIndex> touched_nonmortar_nodes(const ContactSurface           &nonmortar,
                                              const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      if (m.covered > 1e-13 * m.area)
        for (const unsigned int v : nonmortar.faces[m.face].corners)
          insert_conforming(nodes, nonmortar, v);
    return nodes;
  }



  std::set<NodeIndex> touched_mortar_nodes(const ContactSurface           &mortar,
                                           const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      for (const auto &entry : m.coupling)
        insert_conforming(nodes, mortar, entry.first);
    return nodes;
  }



  std::vector<std::set<NodeIndex>> excluded_nodes(const std::vector<std::set<NodeIndex>> &touched_nonmortar,
                                                  const std::vector<std::set<NodeIndex>> &touched_mortar)
  {
    AssertDimension(touched_nonmortar.size(), touched_mortar.size());
    std::vector<std::set<NodeIndex>> excluded(touched_nonmortar.size());
    for (std::size_t p = 0; p < excluded.size(); ++p)
      for (std::size_t q = 0; q < excluded.size(); ++q)
        {
          if (q != p)
            excluded[p].insert(touched_nonmortar[q].begin(), touched_nonmortar[q].end());
          excluded[p].insert(touched_mortar[q].begin(), touched_mortar[q].end());
        }
    return excluded;
  }



  std::vector<std::pair<unsigned int, std::size_t>> join_couplings(InterfaceCoupling               &joined,
                                                                   const std::vector<PairCoupling> &pairs,
                                                                   const std::vector<std::string>  &names)
  {
    std::vector<std::pair<NodeIndex, std::pair<unsigned int, std::size_t>>> order;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (std::size_t row = 0; row < pairs[p].coupling.n_rows(); ++row)
        order.push_back({pairs[p].coupling.rows[row], {p, row}});
    std::sort(order.begin(), order.end());
    joined = InterfaceCoupling();
    std::vector<std::pair<unsigned int, std::size_t>> origin;
    for (const auto &[node, where] : order)
      {
        const auto &[p, row]       = where;
        const InterfaceCoupling &c = pairs[p].coupling;
        if (!joined.rows.empty() && joined.rows.back() == node)
          throw InputError("Contact pairs " + pair_name(names, origin.back().first) + " and " +
                           pair_name(names, p) + " share " + describe(node, pairs[p], row) +
                           ", which carries a contact stress in both. Take it out of one of the pairs.");
        joined.rows.push_back(node);
        joined.weight.push_back(c.weight[row]);
        joined.entries.insert(joined.entries.end(), c.begin(row), c.end(row));
        joined.row_start.push_back(joined.entries.size());
        origin.push_back(where);
      }
    check_columns(joined, origin, pairs, names);
    return origin;
  }
} // namespace Signorini
