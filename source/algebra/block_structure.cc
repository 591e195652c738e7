// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_structure.h>
#include <signorini/algebra/sent_lists.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Packs foreign rows for their owners: node, length, columns.
    ListsByRank<NodeIndex> pack_foreign_rows(const NodePattern &pattern, const unsigned int n_owned,
                                             const NodePartition &numbering)
    {
      ListsByRank<NodeIndex> packets;
      for (std::size_t f = 0; f < pattern.foreign_rows.size(); ++f)
        {
          auto             &packet = packets[numbering.owner(pattern.foreign_rows[f])];
          const std::size_t begin  = pattern.row_start[n_owned + f];
          const std::size_t end    = pattern.row_start[n_owned + f + 1];
          packet.push_back(pattern.foreign_rows[f]);
          packet.push_back(static_cast<NodeIndex>(end - begin));
          packet.insert(packet.end(), pattern.columns.begin() + begin, pattern.columns.begin() + end);
        }
      return packets;
    }

    /// Columns by owned row, besides those of a rank's own pattern.
    using Additions = std::map<unsigned int, std::vector<NodeIndex>>;

    /// Collective. What other ranks put into the rows of this one.
    Additions receive_additions(const NodePattern &pattern, const NodePartition &numbering)
    {
      Additions additions;
      if (numbering.n_ranks() == 1)
        return additions;
      for (const auto &[rank, packet] :
           send_lists(pack_foreign_rows(pattern, numbering.n_owned(), numbering), numbering.communicator()))
        for (std::size_t i = 0; i < packet.size(); i += 2 + packet[i + 1])
          {
            auto &row = additions[static_cast<unsigned int>(packet[i] - numbering.first_owned())];
            row.insert(row.end(), packet.begin() + i + 2, packet.begin() + i + 2 + packet[i + 1]);
          }
      return additions;
    }

    /// Foreign rows, columns of other ranks, and the extra ones.
    IndexSet find_ghosts(const NodePattern &pattern, const Additions &additions, const IndexSet &extra_ghosts,
                         const NodePartition &numbering)
    {
      std::vector<NodeIndex> nodes(pattern.foreign_rows);
      const auto             add = [&](const std::vector<NodeIndex> &columns) {
        std::copy_if(columns.begin(), columns.end(), std::back_inserter(nodes),
                                 [&](const NodeIndex column) { return !numbering.owns(column); });
      };
      add(pattern.columns);
      for (const auto &[row, columns] : additions)
        add(columns);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      IndexSet ghosts(numbering.n_global());
      ghosts.add_indices(nodes.begin(), nodes.end());
      ghosts.add_indices(extra_ghosts);
      ghosts.compress();
      return ghosts;
    }

    /// The local columns of all rows in the order of the matrix, and where the parts of the rows begin.
    struct SplitRows
    {
      template <typename ForeignRows>
      SplitRows(const NodePattern &pattern, const Additions &additions, const NodePartition &nodes,
                const ForeignRows &foreign_rows)
        : nodes(nodes)
      {
        const unsigned int        n_owned = nodes.n_owned();
        std::vector<unsigned int> outer;
        columns.reserve(n_owned + pattern.columns.size() / 2);
        for (unsigned int r = 0; r < n_owned; ++r)
          columns.push_back(r);
        lower_start = {n_owned};
        for (std::size_t r = 0; r + 1 < pattern.row_start.size(); ++r)
          {
            collect(pattern, additions, r);
            if (r < n_owned)
              split_owned(static_cast<unsigned int>(r), outer);
            else
              std::copy_if(row.begin(), row.end(), std::back_inserter(outer), [&](const unsigned int column) {
                return foreign_rows[r - n_owned].stores(column);
              });
            outer_start.push_back(outer.size());
          }
        for (std::size_t &start : outer_start)
          start += columns.size();
        columns.insert(columns.end(), outer.begin(), outer.end());
      }

      std::vector<std::size_t>  lower_start, outer_start = {0};
      std::vector<unsigned int> columns;

    private:
      /// Makes `row` the local columns of a row, with the diagonal.
      void collect(const NodePattern &pattern, const Additions &additions, const std::size_t r)
      {
        row.clear();
        for (std::size_t k = pattern.row_start[r]; k < pattern.row_start[r + 1]; ++k)
          row.push_back(nodes.to_local(pattern.columns[k]));
        const unsigned int n_owned  = nodes.n_owned();
        const bool         is_owned = r < n_owned;
        if (const auto it = additions.find(r); is_owned && it != additions.end())
          for (const NodeIndex column : it->second)
            row.push_back(nodes.to_local(column));
        row.push_back(is_owned ? r : nodes.to_local(pattern.foreign_rows[r - n_owned]));
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
      }

      void split_owned(const unsigned int r, std::vector<unsigned int> &outer)
      {
        const auto diagonal = std::lower_bound(row.begin(), row.end(), r);
        const auto ghosts   = std::lower_bound(diagonal, row.end(), nodes.n_owned());
        columns.insert(columns.end(), row.begin(), diagonal);
        lower_start.push_back(columns.size());
        n_above += ghosts - diagonal - 1;
        outer.insert(outer.end(), ghosts, row.end());
      }

      const NodePartition      &nodes;
      std::vector<unsigned int> row;

    public:
      /// Blocks above the diagonal: as many as below.
      std::size_t n_above = 0;
    };
  } // namespace



  void BlockStructure::make_structure(const IndexSet &owned, const NodePattern &pattern,
                                      const IndexSet &extra_ghosts, const MPI_Comm communicator)
  {
    const NodePartition numbering(owned, IndexSet(owned.size()), communicator);
    AssertDimension(pattern.row_start.size(), numbering.n_owned() + pattern.foreign_rows.size() + 1);
    const Additions additions = receive_additions(pattern, numbering);
    nodes = std::make_shared<NodePartition>(owned, find_ghosts(pattern, additions, extra_ghosts, numbering),
                                            communicator);

    find_foreign_rows(pattern);
    SplitRows rows(pattern, additions, *nodes, foreign_rows);
    AssertThrow(rows.n_above == rows.lower_start.back() - n_rows(),
                ExcMessage("The structure of a matrix is not symmetric."));
    lower_start = std::move(rows.lower_start);
    outer_start = std::move(rows.outer_start);
    columns     = std::move(rows.columns);

    mirror_lower_parts();
    collect_ghost_columns();
    plan_compression(pattern);
  }



  void BlockStructure::find_foreign_rows(const NodePattern &pattern)
  {
    const unsigned int            n_owned = nodes->n_owned();
    const std::vector<NodeIndex> &ghosts  = nodes->ghosts();
    foreign_rows.clear();
    foreign_row_of_ghost.assign(ghosts.size(), numbers::invalid_unsigned_int);
    for (std::size_t f = 0; f < pattern.foreign_rows.size(); ++f)
      {
        const unsigned int owner = nodes->owner(pattern.foreign_rows[f]);
        const unsigned int node  = nodes->to_local(pattern.foreign_rows[f]);
        // Ghosts are sorted, and what a rank owns is a range.
        const auto end = std::partition_point(ghosts.begin(), ghosts.end(), [&](const NodeIndex ghost) {
          return nodes->owner(ghost) <= owner;
        });
        foreign_rows.push_back({node, n_owned + static_cast<unsigned int>(end - ghosts.begin())});
        foreign_row_of_ghost[node - n_owned] = n_owned + f;
      }
  }



  void BlockStructure::mirror_lower_parts()
  {
    // Positions are kept in 32 bits: blocks of 300 GB on one rank.
    AssertThrow(columns.size() <= numbers::invalid_unsigned_int,
                ExcMessage("More than 4.29e9 blocks of a matrix on one rank: use more ranks."));
    const unsigned int n = n_rows();
    mirrored_start.assign(n + 1, 0);
    for (std::size_t k = n; k < lower_start[n]; ++k)
      ++mirrored_start[columns[k] + 1];
    std::partial_sum(mirrored_start.begin(), mirrored_start.end(), mirrored_start.begin());
    mirrored_columns.resize(mirrored_start[n]);
    mirrored.resize(mirrored_start[n]);
    std::vector<std::size_t> next(mirrored_start.begin(), mirrored_start.end() - 1);
    for (unsigned int row = 0; row < n; ++row)
      for (std::size_t k = lower_start[row]; k < lower_start[row + 1]; ++k)
        {
          const std::size_t m = next[columns[k]]++;
          mirrored_columns[m] = row;
          mirrored[m]         = static_cast<unsigned int>(k);
        }
  }



  void BlockStructure::collect_ghost_columns()
  {
    const auto for_all = [&](const auto &action) {
      for (unsigned int row = 0; row < n_rows(); ++row)
        for (std::size_t k = outer_start[row]; k < outer_start[row + 1]; ++k)
          action(row, k, columns[k] - n_rows());
    };
    ghost_start.assign(nodes->ghosts().size() + 1, 0);
    for_all(
        [&](const unsigned int, const std::size_t, const unsigned int ghost) { ++ghost_start[ghost + 1]; });
    std::partial_sum(ghost_start.begin(), ghost_start.end(), ghost_start.begin());
    ghost_couplings.resize(ghost_start.back());
    std::vector<std::size_t> next(ghost_start);
    for_all([&](const unsigned int row, const std::size_t k, const unsigned int ghost) {
      ghost_couplings[next[ghost]++] = {row, k};
    });
  }



  void BlockStructure::plan_compression(const NodePattern &pattern)
  {
    const unsigned int n_owned = nodes->n_owned();
    send_rows.clear();
    ListsByRank<NodeIndex> headers;
    for (std::size_t f = 0; f < pattern.foreign_rows.size(); ++f)
      {
        const unsigned int rank = nodes->owner(pattern.foreign_rows[f]);
        if (send_rows.empty() || send_rows.back().first != rank)
          send_rows.push_back({rank, {n_owned + f, n_owned + f}});
        send_rows.back().second.second = n_owned + f + 1;
        auto &header                   = headers[rank];
        header.push_back(pattern.foreign_rows[f]);
        header.push_back(outer(n_owned + f).size());
        for (std::size_t k = outer_start[n_owned + f]; k < outer_start[n_owned + f + 1]; ++k)
          header.push_back(nodes->to_global(columns[k]));
      }
    receive_positions.clear();
    if (nodes->n_ranks() == 1)
      return;
    for (const auto &[rank, header] : send_lists(headers, nodes->communicator()))
      {
        receive_positions.push_back({rank, {}});
        for (std::size_t i = 0; i < header.size(); i += 2 + header[i + 1])
          for (std::size_t k = 0; k < header[i + 1]; ++k)
            receive_positions.back().second.push_back(
                find(header[i] - nodes->first_owned(), nodes->to_local(header[i + 2 + k])));
      }
  }



  std::size_t BlockStructure::find(const unsigned int row, const unsigned int local_column) const
  {
    if (row < n_rows() && local_column == row)
      return diagonal(row);
    const BlockRange range = row < n_rows() && local_column < row ? lower(row) : outer(row);
    const auto       end   = columns.begin() + range.end;
    const auto       it    = std::lower_bound(columns.begin() + range.begin, end, local_column);
    Assert(it != end && *it == local_column, ExcInternalError());
    return it - columns.begin();
  }
} // namespace Signorini
