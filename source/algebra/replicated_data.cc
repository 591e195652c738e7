// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/node_request.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/algebra/sent_lists.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct PackedRows
    {
      std::vector<unsigned int> lengths;
      std::vector<NodeIndex>    columns;
      std::vector<double>       weights;

      void append(const NodeRows &rows, const std::size_t row)
      {
        const std::size_t begin = rows.start[row], end = rows.start[row + 1];
        lengths.push_back(static_cast<unsigned int>(end - begin));
        columns.insert(columns.end(), rows.columns.begin() + begin, rows.columns.begin() + end);
        weights.insert(weights.end(), rows.weights.begin() + begin, rows.weights.begin() + end);
      }

      void unpack(NodeRows &rows) const
      {
        rows.columns.insert(rows.columns.end(), columns.begin(), columns.end());
        rows.weights.insert(rows.weights.end(), weights.begin(), weights.end());
        for (const unsigned int length : lengths)
          rows.start.push_back(rows.start.back() + length);
      }
    };

    template <typename Archive>
    void transfer(Archive &archive, PackedRows &rows)
    {
      archive(rows.lengths, rows.columns, rows.weights);
    }

    /// The part of a sorted list of nodes that this rank owns. The ranges of the ranks follow each
    /// other, so the pieces of all ranks, in the order of the ranks, make up the list.
    std::pair<std::size_t, std::size_t> owned_range(const NodePartition          &partition,
                                                    const std::vector<NodeIndex> &nodes)
    {
      const auto begin = std::lower_bound(nodes.begin(), nodes.end(), partition.first_owned());
      const auto end   = std::lower_bound(begin, nodes.end(), partition.first_owned() + partition.n_owned());
      return {begin - nodes.begin(), end - nodes.begin()};
    }
  } // namespace



  NodeRows import_ghost_rows(const NodePartition &partition, NodeRows rows)
  {
    AssertDimension(rows.n_rows(), partition.n_owned());
    if (partition.n_ranks() == 1)
      return rows;
    std::map<unsigned int, std::vector<NodeIndex>> wanted;
    for (const NodeIndex ghost : partition.ghosts())
      wanted[partition.owner(ghost)].push_back(ghost);

    std::map<unsigned int, PackedRows> answers;
    for (const auto &[rank, nodes] : send_lists(wanted, partition.communicator()))
      for (const NodeIndex node : nodes)
        answers[rank].append(rows, node - partition.first_owned());

    // Ghosts are sorted by node, so the pieces of the owners follow each other.
    for (const auto &answer : send_values(answers, partition.communicator()))
      answer.second.unpack(rows);
    AssertDimension(rows.n_rows(), partition.n_local());
    return rows;
  }



  NodeRows replicate_rows(const NodePartition &partition, const NodeRows &rows,
                          const std::vector<NodeIndex> &nodes)
  {
    const auto [begin, end] = owned_range(partition, nodes);
    PackedRows mine;
    for (std::size_t i = begin; i < end; ++i)
      mine.append(rows, nodes[i] - partition.first_owned());
    NodeRows all;
    if (partition.n_ranks() == 1)
      mine.unpack(all);
    else
      for (const PackedRows &piece : gather_values(mine, partition.communicator()))
        piece.unpack(all);
    return all;
  }



  std::vector<Vector3> replicate_values(const NodePartition &partition, const Vector &field,
                                        const std::vector<NodeIndex> &nodes)
  {
    const auto [begin, end] = owned_range(partition, nodes);
    std::vector<double> mine;
    for (std::size_t i = begin; i < end; ++i)
      for (unsigned int c = 0; c < dim; ++c)
        mine.push_back(field.local_element(dim * (nodes[i] - partition.first_owned()) + c));
    const std::vector<double> all = gather_lists(std::move(mine), partition.communicator(), Receivers::all);
    std::vector<Vector3>      values(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        values[i][c] = all[dim * i + c];
    return values;
  }



  std::vector<Vector3> import_values(const NodePartition &partition, const Vector &field,
                                     const std::vector<NodeIndex> &nodes)
  {
    return NodeRequest(partition, nodes).fetch([&](const unsigned int i) {
      Vector3 value;
      for (unsigned int c = 0; c < dim; ++c)
        value[c] = field.local_element(dim * i + c);
      return value;
    });
  }



  NodeRows import_rows(const NodePartition &partition, const NodeRows &rows,
                       const std::vector<NodeIndex> &nodes)
  {
    struct Entry
    {
      NodeIndex column;
      double    weight;
    };
    auto lists =
        NodeRequest(partition, nodes).fetch_lists<Entry>([&](std::vector<Entry> &list, const unsigned int i) {
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            list.push_back({rows.columns[k], rows.weights[k]});
        });
    NodeRows result;
    result.start = std::move(lists.start);
    for (const Entry &entry : lists.items)
      {
        result.columns.push_back(entry.column);
        result.weights.push_back(entry.weight);
      }
    return result;
  }



  std::vector<FixedDirections> import_masks(const NodePartition                &partition,
                                            const std::vector<FixedDirections> &owned,
                                            const std::vector<NodeIndex>       &nodes)
  {
    return NodeRequest(partition, nodes).fetch([&](const unsigned int i) { return owned[i]; });
  }



  std::vector<FixedDirections> replicate_masks(const NodePartition                &partition,
                                               const std::vector<FixedDirections> &owned,
                                               const std::vector<NodeIndex>       &nodes)
  {
    const auto [begin, end] = owned_range(partition, nodes);
    std::vector<FixedDirections> mine;
    for (std::size_t i = begin; i < end; ++i)
      mine.push_back(owned[nodes[i] - partition.first_owned()]);
    return gather_lists(std::move(mine), partition.communicator(), Receivers::all);
  }



  std::vector<FixedDirections> import_ghost_masks(const NodePartition                &partition,
                                                  const std::vector<FixedDirections> &owned)
  {
    Vector flags, axes;
    partition.reinit(flags);
    partition.reinit(axes);
    for (unsigned int i = 0; i < partition.n_owned(); ++i)
      {
        flags.local_element(dim * i)     = owned[i].components();
        flags.local_element(dim * i + 1) = owned[i].n_oblique_directions();
        for (unsigned int c = 0; c < dim; ++c)
          axes.local_element(dim * i + c) = owned[i].oblique_axis()[c];
      }
    flags.update_ghost_values();
    axes.update_ghost_values();
    std::vector<FixedDirections> masks(partition.n_local());
    for (unsigned int i = 0; i < partition.n_local(); ++i)
      {
        Vector3 axis;
        for (unsigned int c = 0; c < dim; ++c)
          axis[c] = axes.local_element(dim * i + c);
        masks[i] = FixedDirections(static_cast<FixedMask>(flags.local_element(dim * i)),
                                   static_cast<unsigned int>(flags.local_element(dim * i + 1)), axis);
      }
    return masks;
  }



  void import_ghost_flags(const NodePartition &partition, std::vector<unsigned char> &flags)
  {
    Vector values;
    partition.reinit(values);
    for (unsigned int row = 0; row < partition.n_owned(); ++row)
      values.local_element(dim * row) = flags[row];
    values.update_ghost_values();
    for (unsigned int node = partition.n_owned(); node < partition.n_local(); ++node)
      flags[node] = static_cast<unsigned char>(values.local_element(dim * node));
  }
} // namespace Signorini
