// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/interface_rows.h>
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



  namespace
  {
    /// That a pair touches a node on one of its sides.
    struct Touch
    {
      NodeIndex    node;
      unsigned int pair;
      bool         is_mortar;

      bool operator<(const Touch &other) const
      {
        return std::tie(node, pair, is_mortar) < std::tie(other.node, other.pair, other.is_mortar);
      }
    };

    /// Whether one of the touches takes the multiplier from a node of a pair's nonmortar side.
    bool is_excluded(const std::vector<Touch> &touches, const NodeIndex node, const unsigned int pair)
    {
      for (auto t = std::lower_bound(touches.begin(), touches.end(), Touch{node, 0, false});
           t != touches.end() && t->node == node; ++t)
        if (t->is_mortar || t->pair != pair)
          return true;
      return false;
    }
  } // namespace



  // Nodes meet on some rank, whichever it is.
  std::vector<std::set<NodeIndex>> excluded_nodes(const std::vector<std::set<NodeIndex>> &touched_nonmortar,
                                                  const std::vector<std::set<NodeIndex>> &touched_mortar,
                                                  const MPI_Comm                          communicator)
  {
    AssertDimension(touched_nonmortar.size(), touched_mortar.size());
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const auto meeting_at = [&](const NodeIndex node) { return static_cast<unsigned int>(node % n_ranks); };
    ListsByRank<Touch> parcels;
    for (unsigned int p = 0; p < touched_nonmortar.size(); ++p)
      {
        for (const NodeIndex node : touched_nonmortar[p])
          parcels[meeting_at(node)].push_back({node, p, false});
        for (const NodeIndex node : touched_mortar[p])
          parcels[meeting_at(node)].push_back({node, p, true});
      }
    const auto         arrived = send_lists(parcels, communicator);
    std::vector<Touch> touches;
    for (const auto &[sender, list] : arrived)
      touches.insert(touches.end(), list.begin(), list.end());
    std::sort(touches.begin(), touches.end());
    ListsByRank<Touch> answers;
    for (const auto &[sender, list] : arrived)
      for (const Touch &touch : list)
        if (!touch.is_mortar && is_excluded(touches, touch.node, touch.pair))
          answers[sender].push_back(touch);
    std::vector<std::set<NodeIndex>> excluded(touched_nonmortar.size());
    for (const auto &[sender, list] : send_lists(answers, communicator))
      for (const Touch &touch : list)
        excluded[touch.pair].insert(touch.node);
    return excluded;
  }



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
    JoinedCouplings    joined;
    InterfaceCoupling &coupling = joined.coupling;
    std::string        error;
    for (const PackedRow &row : rows)
      {
        if (error.empty() && !coupling.rows.empty() && coupling.rows.back() == row.node)
          error = "Contact pairs " + pair_name(names, joined.pairs.back()) + " and " +
                  pair_name(names, row.pair) + " share " + describe(row.node, row.position) +
                  ", which carries a contact stress in both. Take it out of one of the pairs.";
        coupling.rows.push_back(row.node);
        coupling.weight.push_back(row.weight);
        coupling.entries.insert(coupling.entries.end(), entries.begin() + row.begin,
                                entries.begin() + row.begin + row.n_entries);
        coupling.row_start.push_back(coupling.entries.size());
        joined.pairs.push_back(row.pair);
        joined.normals.push_back(row.normal);
        joined.gaps.push_back(row.gap);
        joined.fixed.push_back(row.fixed);
        joined.positions.push_back(row.position);
      }
    throw_everywhere(error, communicator);
    throw_everywhere(describe_chain(joined, names, partition), communicator);
    return joined;
  }
} // namespace Signorini
