// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/rotation.h>
#include <signorini/discretization/transformed_rows.h>

#include <map>

namespace Signorini
{
  namespace
  {
    /// Most nodes are no contact nodes: a look at a bit instead of a search.
    class NodeFilter
    {
    public:
      explicit NodeFilter(const std::vector<NodeIndex> &nodes)
      {
        std::size_t size = 64;
        while (size < 16 * nodes.size())
          size *= 2;
        bits.resize(size, false);
        for (const NodeIndex node : nodes)
          bits[node & (size - 1)] = true;
      }

      bool may_contain(const NodeIndex node) const
      {
        return bits[node & (bits.size() - 1)];
      }

    private:
      std::vector<bool> bits;
    };

    /// What is left of weights of interpolation, which are of the order of one, where they cancel.
    constexpr double rounding = 1e-12;

    class RowBuilder
    {
    public:
      RowBuilder(const NodeRows &rows, const ContactOfLevels &contact)
        : rows(rows)
        , contact(contact)
        , fine_nodes(contact.fine.rows)
        , coarse_nodes(contact.coarse.rows)
      {
      }

      /// Whether a local node has a row of its own.
      bool differs(const unsigned int local, const NodeIndex node) const
      {
        if (find_fine(node) >= 0)
          return true;
        for (std::size_t k = rows.start[local]; k < rows.start[local + 1]; ++k)
          if (find_coarse(rows.columns[k]) >= 0)
            return true;
        return false;
      }

      NodalTransfer::BlockRow make(const unsigned int local, const NodeIndex node)
      {
        const std::ptrdiff_t p = find_fine(node);
        if (p >= 0 && !contact.tied.empty() && contact.tied[p])
          return {local, {}, {}, {}};
        if (p >= 0 && !contact.normals.empty())
          return make_turned(local, contact.normals[p]);
        sums.clear();
        add(rows, local, 1., 0);
        if (p >= 0)
          for (const auto *entry = contact.fine.begin(p); entry != contact.fine.end(p); ++entry)
            {
              const auto q = std::lower_bound(contact.nodes.begin(), contact.nodes.end(), entry->node);
              add(contact.node_rows, q - contact.nodes.begin(), -entry->weight, contact.fine_masks[p]);
            }
        return row_of_sums(local);
      }

    private:
      std::ptrdiff_t find_fine(const NodeIndex node) const
      {
        return fine_nodes.may_contain(node) ? contact.fine.find(node) : -1;
      }

      std::ptrdiff_t find_coarse(const NodeIndex node) const
      {
        return coarse_nodes.may_contain(node) ? contact.coarse.find(node) : -1;
      }

      NodalTransfer::BlockRow make_turned(const unsigned int local, const Vector3 &normal) const
      {
        NodalTransfer::BlockRow result{local, {}, {}, {}};
        for (std::size_t k = rows.start[local]; k < rows.start[local + 1]; ++k)
          {
            const Vector3 &from = contact.coarse_normals[contact.coarse.find(rows.columns[k])];
            result.columns.push_back(rows.columns[k]);
            result.blocks.push_back(rows.weights[k] *
                                    rotation(from.norm_square() > 0. ? from : normal, normal));
          }
        return result;
      }

      /// Adds factor * (row of P) * T_coarse in the components that are not blocked.
      void add(const NodeRows &from, const std::size_t row, const double factor, const FixedMask blocked)
      {
        for (std::size_t k = from.start[row]; k < from.start[row + 1]; ++k)
          {
            add_entry(from.columns[k], factor * from.weights[k], blocked);
            if (const std::ptrdiff_t c = find_coarse(from.columns[k]); c >= 0)
              for (const auto *entry = contact.coarse.begin(c); entry != contact.coarse.end(c); ++entry)
                add_entry(entry->node, factor * from.weights[k] * entry->weight,
                          blocked | contact.coarse_masks[c]);
          }
      }

      void add_entry(const NodeIndex column, const double weight, const FixedMask blocked)
      {
        Vector3 &sum = sums[column];
        for (unsigned int c = 0; c < dim; ++c)
          if (!(blocked & (1u << c)))
            sum[c] += weight;
      }

      NodalTransfer::BlockRow row_of_sums(const unsigned int local) const
      {
        NodalTransfer::BlockRow result{local, {}, {}, {}};
        const bool              is_scalar = std::all_of(sums.begin(), sums.end(), [](const auto &entry) {
          return entry.second[0] == entry.second[1] && entry.second[0] == entry.second[2];
        });
        result.columns.reserve(sums.size());
        for (const auto &[column, diagonal] : sums)
          {
            if (std::max({std::abs(diagonal[0]), std::abs(diagonal[1]), std::abs(diagonal[2])}) <= rounding)
              continue;
            result.columns.push_back(column);
            if (is_scalar)
              result.weights.push_back(diagonal[0]);
            else
              {
                Block block;
                for (unsigned int c = 0; c < dim; ++c)
                  block[c][c] = diagonal[c];
                result.blocks.push_back(block);
              }
          }
        return result;
      }

      const NodeRows              &rows;
      const ContactOfLevels       &contact;
      const NodeFilter             fine_nodes, coarse_nodes;
      std::map<NodeIndex, Vector3> sums;
    };
  } // namespace



  std::vector<NodalTransfer::BlockRow> transformed_rows(const NodePartition &partition, const NodeRows &rows,
                                                        const ContactOfLevels &contact)
  {
    RowBuilder                           builder(rows, contact);
    std::vector<NodalTransfer::BlockRow> result;
    for (unsigned int i = 0; i < partition.n_local(); ++i)
      if (const NodeIndex node = partition.to_global(i); builder.differs(i, node))
        result.push_back(builder.make(i, node));
    return result;
  }
} // namespace Signorini
