// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/mortar/pair_conflicts.h>

#include <algorithm>
#include <map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::string pair_name(const std::vector<std::string> &names, const unsigned int pair)
    {
      return pair < names.size() ? "\"" + names[pair] + "\"" : "number " + std::to_string(pair + 1);
    }

    std::string describe(const NodeIndex node, const Point<3> &position)
    {
      std::ostringstream text;
      text << "node " << node << " at (" << position << ")";
      return text.str();
    }

    /// Collective. No column may be a row. The message that one is, if this rank knows one.
    std::string describe_chain(const JoinedCouplings &joined, const std::vector<std::string> &names,
                               const NodePartition &partition)
    {
      const InterfaceCoupling &coupling = joined.coupling;
      std::vector<NodeIndex>   columns;
      for (const auto &entry : coupling.entries)
        columns.push_back(entry.node);
      const NodeRequest request(partition, sorted_nodes(std::move(columns)));
      // The pair of the row that a column is, and where that is.
      struct RowThere
      {
        bool         is_row;
        unsigned int pair;
        Point<3>     position;
      };
      const std::vector<RowThere> rows = request.fetch([&](const unsigned int local) {
        const std::ptrdiff_t row = coupling.find(partition.to_global(local));
        return row < 0 ? RowThere{false, 0, Point<3>()}
                       : RowThere{true, joined.pairs[row], joined.positions[row]};
      });
      for (std::size_t row = 0; row < coupling.n_rows(); ++row)
        for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
          if (const RowThere &other =
                  rows[std::lower_bound(request.nodes().begin(), request.nodes().end(), entry->node) -
                       request.nodes().begin()];
              other.is_row)
            {
              const std::string here  = pair_name(names, joined.pairs[row]),
                                there = pair_name(names, other.pair);
              return "Contact pairs " + here + " and " + there +
                     " form a chain or a cycle: " + describe(entry->node, other.position) +
                     " carries a contact stress in " + there + " and moves others in " + here +
                     ". Swap the sides of one of the pairs, or take the common part out of one.";
            }
      return "";
    }
  } // namespace



  namespace
  {
    /// A row as it travels; its entries follow those of the row before.
    struct PackedRow
    {
      NodeIndex       node;
      unsigned int    pair, n_entries;
      double          weight, gap;
      Vector3         normal;
      Point<3>        position;
      FixedDirections fixed;
      /// First entry, set on arrival.
      std::size_t begin;

      bool operator<(const PackedRow &other) const
      {
        return std::tie(node, pair) < std::tie(other.node, other.pair);
      }
    };

    using PackedRows = std::vector<PackedRow>::const_iterator;

    /// Appends one row that stands for those of a node in several pairs. The normal is zero if they have none
    /// in common.
    void append_joined(JoinedCouplings &joined, const PackedRows first, const PackedRows last,
                       const std::vector<InterfaceCoupling::Entry> &entries)
    {
      InterfaceCoupling &coupling = joined.coupling;
      double             weight   = 0.;
      for (auto row = first; row != last; ++row)
        weight += row->weight;
      double                      gap = 0.;
      Vector3                     normal;
      std::map<NodeIndex, double> columns;
      for (auto row = first; row != last; ++row)
        {
          // One row is itself, bit by bit.
          const double share = row->weight / weight;
          gap += share * row->gap;
          normal += share * row->normal;
          for (std::size_t k = row->begin; k < row->begin + row->n_entries; ++k)
            columns[entries[k].node] += share * entries[k].weight;
        }
      const bool is_shared = std::next(first) != last;
      if (is_shared && normal * first->normal > 0.)
        normal /= normal.norm();
      else if (is_shared)
        normal = Vector3();
      for (const auto &[node, value] : columns)
        coupling.entries.push_back({node, value});
      coupling.row_start.push_back(coupling.entries.size());
      coupling.rows.push_back(first->node);
      coupling.weight.push_back(weight);
      joined.pairs.push_back(first->pair);
      joined.normals.push_back(normal);
      joined.gaps.push_back(gap);
      joined.fixed.push_back(first->fixed);
      joined.positions.push_back(first->position);
    }
  } // namespace



  JoinedCouplings join_couplings(const std::vector<PairCoupling> &pairs,
                                 const std::vector<std::string> &names, const NodePartition &partition)
  {
    const MPI_Comm                        communicator = partition.communicator();
    ListsByRank<PackedRow>                sent_rows;
    ListsByRank<InterfaceCoupling::Entry> sent_entries;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const PairCoupling      &pair = pairs[p];
        const InterfaceCoupling &c    = pair.coupling;
        for (std::size_t i = 0; i < c.n_rows(); ++i)
          {
            const unsigned int owner = partition.owner(c.rows[i]);
            sent_rows[owner].push_back({c.rows[i], p, static_cast<unsigned int>(c.end(i) - c.begin(i)),
                                        c.weight[i], pair.gaps[i], pair.normals[i], pair.positions[i],
                                        pair.fixed[i], 0});
            std::vector<InterfaceCoupling::Entry> &list = sent_entries[owner];
            list.insert(list.end(), c.begin(i), c.end(i));
          }
      }
    std::vector<PackedRow>                rows;
    std::vector<InterfaceCoupling::Entry> entries;
    ListsByRank<char>                     parcels;
    for (const auto &[rank, list] : sent_rows)
      {
        Parcel parcel;
        parcel.write(list);
        parcel.write(sent_entries.at(rank));
        parcels[rank] = parcel.bytes();
      }
    for (const auto &[rank, bytes] : send_lists(parcels, communicator))
      {
        Parcel     parcel(bytes);
        const auto some_rows    = parcel.read<PackedRow>();
        const auto some_entries = parcel.read<InterfaceCoupling::Entry>();
        rows.insert(rows.end(), some_rows.begin(), some_rows.end());
        entries.insert(entries.end(), some_entries.begin(), some_entries.end());
      }
    std::size_t begin = 0;
    for (PackedRow &row : rows)
      {
        row.begin = begin;
        begin += row.n_entries;
      }
    std::sort(rows.begin(), rows.end());
    JoinedCouplings joined;
    std::string     error;
    for (auto first = rows.begin(), last = first; first != rows.end(); first = last)
      {
        last = std::find_if(first, rows.end(), [&](const PackedRow &row) { return row.node != first->node; });
        append_joined(joined, first, last, entries);
        if (const PackedRow &other = *std::prev(last);
            !(joined.normals.back().norm_square() > 0.) && error.empty())
          error = "Contact pairs " + pair_name(names, first->pair) + " and " + pair_name(names, other.pair) +
                  " share " + describe(first->node, first->position) +
                  ", where their surfaces look opposite ways. Take it out of one of the pairs.";
      }
    throw_everywhere(error, communicator);
    throw_everywhere(describe_chain(joined, names, partition), communicator);
    return joined;
  }
} // namespace Signorini
