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

    struct CancellationRule
    {
      /// Weights of interpolation are of the order of one; what is left below this where they cancel is no
      /// entry of the transfer. 0 to 1e-4 take as many iterations (hertz.prm, the knee).
      double rounding = 1e-12;
    };

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
        if (find_fine(node) >= 0 || fixed(contact.fixed, local).any())
          return true;
        if (contact.fine_rigid != nullptr &&
            (contact.fine_rigid->find(node) != nullptr || contact.fine_rigid->find_carrier(node) >= 0))
          return true;
        for (std::size_t k = rows.start[local]; k < rows.start[local + 1]; ++k)
          if (find_coarse(rows.columns[k]) >= 0 || find_rigid(rows.columns[k]) != nullptr)
            return true;
        return false;
      }

      NodalTransfer::BlockRow make(const unsigned int local, const NodeIndex node)
      {
        if (contact.fine_rigid != nullptr)
          {
            // Rigid faces move as they do on the coarser level.
            if (const int carrier = contact.fine_rigid->find_carrier(node); carrier >= 0)
              return {local, {contact.coarse_rigid->carriers()[carrier]}, {}, {1.}};
            if (contact.fine_rigid->find(node) != nullptr)
              return {local, {}, {}, {}};
          }
        const std::ptrdiff_t p = find_fine(node);
        if (p >= 0 && !contact.tied.empty() && contact.tied[p])
          return {local, {}, {}, {}};
        if (p >= 0 && contact.relative_only)
          return make_turned(local, contact.fine_projections[p]);
        sums.clear();
        add(rows, local, 1., Factor(RowProjection(), fixed(contact.fixed, local)));
        if (p >= 0)
          for (const auto *entry = contact.fine.begin(p); entry != contact.fine.end(p); ++entry)
            {
              const auto q = std::lower_bound(contact.nodes.begin(), contact.nodes.end(), entry->node) -
                             contact.nodes.begin();
              add(contact.node_rows, q, -entry->weight,
                  Factor(contact.fine_projections[p], fixed(contact.node_fixed, q)));
            }
        return row_of_sums(local);
      }

    private:
      /// A_p E_q, with a look at whether it is the identity.
      struct Factor
      {
        explicit Factor(const RowProjection &projection, const FixedDirections &fixed)
          : is_identity(projection.is_identity() && !fixed.any())
          , block(fixed.any() ? projection.block() * fixed.free_block() : projection.block())
        {
        }

        /// The product with a block.
        Factor(const Factor &left, const Block &right)
          : is_identity(false)
          , block(left.is_identity ? right : left.block * right)
        {
        }

        bool  is_identity;
        Block block;
      };

      const RigidFaces::Dependence *find_rigid(const NodeIndex coarse) const
      {
        return contact.coarse_rigid == nullptr ? nullptr : contact.coarse_rigid->find(coarse);
      }

      static FixedDirections fixed(const std::vector<FixedDirections> &masks, const std::size_t i)
      {
        return masks.empty() ? FixedDirections() : masks[i];
      }

      std::ptrdiff_t find_fine(const NodeIndex node) const
      {
        return fine_nodes.may_contain(node) ? contact.fine.find(node) : -1;
      }

      std::ptrdiff_t find_coarse(const NodeIndex node) const
      {
        return coarse_nodes.may_contain(node) ? contact.coarse.find(node) : -1;
      }

      NodalTransfer::BlockRow make_turned(const unsigned int local, const RowProjection &fine) const
      {
        NodalTransfer::BlockRow result{local, {}, {}, {}};
        for (std::size_t k = rows.start[local]; k < rows.start[local + 1]; ++k)
          {
            const RowProjection &coarse = contact.coarse_projections[contact.coarse.find(rows.columns[k])];
            const Vector3       &to     = fine.normal(),
                          &from         = coarse.normal().norm_square() > 0. ? coarse.normal() : to;
            const Block turn            = rotation(from, to);
            result.columns.push_back(rows.columns[k]);
            result.blocks.push_back(rows.weights[k] * (fine.is_identity() ? turn : fine.block() * turn));
          }
        return result;
      }

      /// Adds weight * left * (row of P) * T_coarse.
      void add(const NodeRows &from, const std::size_t row, const double weight, const Factor &left)
      {
        for (std::size_t k = from.start[row]; k < from.start[row + 1]; ++k)
          {
            const double w = weight * from.weights[k];
            if (const RigidFaces::Dependence *const rigid = find_rigid(from.columns[k]))
              {
                for (unsigned int carrier = 0; carrier < 2; ++carrier)
                  add_entry(contact.coarse_rigid->carrier(rigid->face, carrier), w,
                            Factor(left, rigid->blocks[carrier]));
                continue;
              }
            add_entry(from.columns[k], w, left);
            const std::ptrdiff_t c = find_coarse(from.columns[k]);
            if (c < 0)
              continue;
            const RowProjection &coarse = contact.coarse_projections[c];
            Factor               product(coarse, {});
            if (!left.is_identity)
              {
                product.block       = left.block * product.block;
                product.is_identity = false;
              }
            for (const auto *entry = contact.coarse.begin(c); entry != contact.coarse.end(c); ++entry)
              add_entry(entry->node, w * entry->weight, product);
          }
      }

      void add_entry(const NodeIndex column, const double weight, const Factor &factor)
      {
        Block &sum = sums[column];
        if (factor.is_identity)
          for (unsigned int c = 0; c < dim; ++c)
            sum[c][c] += weight;
        else
          sum += weight * factor.block;
      }

      static bool is_multiple_of_identity(const Block &block)
      {
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            if (block[c][d] != (c == d ? block[0][0] : 0.))
              return false;
        return true;
      }

      NodalTransfer::BlockRow row_of_sums(const unsigned int local) const
      {
        NodalTransfer::BlockRow result{local, {}, {}, {}};
        const bool              is_scalar = std::all_of(sums.begin(), sums.end(), [](const auto &entry) {
          return is_multiple_of_identity(entry.second);
        });
        result.columns.reserve(sums.size());
        for (const auto &[column, block] : sums)
          {
            if (block.norm() <= CancellationRule().rounding)
              continue;
            result.columns.push_back(column);
            if (is_scalar)
              result.weights.push_back(block[0][0]);
            else
              result.blocks.push_back(block);
          }
        return result;
      }

      const NodeRows            &rows;
      const ContactOfLevels     &contact;
      const NodeFilter           fine_nodes, coarse_nodes;
      std::map<NodeIndex, Block> sums;
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
