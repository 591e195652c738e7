// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/mortar/pair_conflicts.h>

#include <deal.II/base/mpi.h>

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

    /// A row that is a column of others.
    struct RowThere
    {
      unsigned int pair;
      bool         is_fixed;
      Point<3>     position;
    };

    /// S + S² + ..., power by power. Without chains nothing is copied.
    class Chains
    {
    public:
      Chains(const JoinedCouplings &joined, const std::vector<std::string> &names,
             const NodePartition &partition)
        : joined(joined)
        , names(names)
        , partition(partition)
      {
      }

      /// Collective. Goes on to the next power of S, adds it, and returns whether it has entries on any rank.
      bool follow()
      {
        std::vector<NodeIndex> columns;
        visit([&](const std::size_t, const NodeIndex node, const double) { columns.push_back(node); });
        const NodeRequest              request(partition, sorted_nodes(std::move(columns)));
        const InterfaceCoupling        others = import_rows(joined.coupling, request);
        const std::vector<RowThere>    there  = import_row_values(joined.coupling, rows_here(), request);
        std::map<std::size_t, Entries> next;
        visit([&](const std::size_t row, const NodeIndex node, const double weight) {
          const std::ptrdiff_t other = others.find(node);
          if (other < 0 || others.begin(other) == others.end(other))
            return;
          for (const auto *entry = others.begin(other); entry != others.end(other); ++entry)
            next[row][entry->node] += weight * entry->weight;
          if (const auto [link, is_new] = links.insert({row, {node, there[other]}});
              !is_new && there[other].is_fixed)
            link->second = {node, there[other]};
        });
        power    = std::move(next);
        is_first = false;
        for (const auto &[row, entries] : power)
          for (const auto &[node, weight] : entries)
            sums[row][node] += weight;
        return Utilities::MPI::max(static_cast<int>(!power.empty()), partition.communicator()) != 0;
      }

      /// The message that a column is a row with prescribed components, if this rank knows one.
      std::string describe_fixed_link() const
      {
        for (const auto &[row, link] : links)
          if (link.second.is_fixed)
            return describe_link(row, "chain in a node with prescribed displacements");
        return "";
      }

      /// The message that a power that should be zero is not, if this rank knows a row of it.
      std::string describe_cycle() const
      {
        return power.empty() ? "" : describe_link(power.begin()->first, "cycle");
      }

      /// S and what was added.
      InterfaceCoupling sum() const
      {
        const InterfaceCoupling &coupling = joined.coupling;
        InterfaceCoupling        result;
        result.rows   = coupling.rows;
        result.weight = coupling.weight;
        for (std::size_t row = 0; row < coupling.n_rows(); ++row)
          {
            if (const auto added = sums.find(row); added == sums.end())
              result.entries.insert(result.entries.end(), coupling.begin(row), coupling.end(row));
            else
              {
                Entries entries = added->second;
                for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
                  entries[entry->node] += entry->weight;
                for (const auto &[node, weight] : entries)
                  result.entries.push_back({node, weight});
              }
            result.row_start.push_back(result.entries.size());
          }
        return result;
      }

    private:
      using Entries = std::map<NodeIndex, double>;

      /// Calls f(row, column, weight) for the entries of the power at hand.
      template <typename F>
      void visit(const F &f) const
      {
        const InterfaceCoupling &coupling = joined.coupling;
        if (is_first)
          for (std::size_t row = 0; row < coupling.n_rows(); ++row)
            for (const auto *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
              f(row, entry->node, entry->weight);
        for (const auto &[row, entries] : power)
          for (const auto &[node, weight] : entries)
            f(row, node, weight);
      }

      std::vector<RowThere> rows_here() const
      {
        std::vector<RowThere> result;
        for (std::size_t row = 0; row < joined.coupling.n_rows(); ++row)
          result.push_back({joined.pairs[row], joined.fixed[row].any(), joined.positions[row]});
        return result;
      }

      std::string describe_link(const std::size_t row, const std::string &what) const
      {
        const auto &[node, there] = links.at(row);
        const std::string here = pair_name(names, joined.pairs[row]), other = pair_name(names, there.pair);
        return "Contact pairs " + here + " and " + other + " form a " + what + ": " +
               describe(node, there.position) + " carries a contact stress in " + other +
               " and moves others in " + here +
               ". Swap the sides of one of the pairs, or take the common part out of one.";
      }

      const JoinedCouplings          &joined;
      const std::vector<std::string> &names;
      const NodePartition            &partition;
      bool                            is_first = true;
      /// By row, of those that have any: the power at hand, but for the first one; the sum of these.
      std::map<std::size_t, Entries> power, sums;
      /// By row: one of its columns that is a row itself, rather one with prescribed components.
      std::map<std::size_t, std::pair<NodeIndex, RowThere>> links;
    };

    /// Collective. JoinedCouplings::chained.
    std::optional<InterfaceCoupling> follow_chains(const JoinedCouplings          &joined,
                                                   const std::vector<std::string> &names,
                                                   const NodePartition &partition, const std::size_t n_pairs)
    {
      Chains chains(joined, names, partition);
      if (!chains.follow())
        return {};
      throw_everywhere(chains.describe_fixed_link(), partition.communicator());
      // Without a cycle a chain has each pair once.
      for (std::size_t n_links = 1; chains.follow(); ++n_links)
        if (n_links > n_pairs)
          throw_everywhere(chains.describe_cycle(), partition.communicator());
      return chains.sum();
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
    joined.chained = follow_chains(joined, names, partition, pairs.size());
    return joined;
  }
} // namespace Signorini
