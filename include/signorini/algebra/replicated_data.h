// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_replicated_data_h
#define signorini_algebra_replicated_data_h

#include <signorini/algebra/fixed_directions.h>
#include <signorini/algebra/node_partition.h>

#include <vector>

namespace Signorini
{
  /// Sparse rows with global columns and scalar weights (a weight w stands for w times the identity).
  struct NodeRows
  {
    /// Row i has the entries start[i] ... start[i + 1] - 1 of columns and weights (pure numbers).
    std::vector<std::size_t> start = {0};
    std::vector<NodeIndex>   columns;
    std::vector<double>      weights;

    /// Number of finished rows.
    std::size_t n_rows() const
    {
      return start.size() - 1;
    }

    /// Appends an entry to the row that is being written.
    void add(const NodeIndex column, const double weight)
    {
      columns.push_back(column);
      weights.push_back(weight);
    }

    /// Ends the row that is being written.
    void finish_row()
    {
      start.push_back(columns.size());
    }

    /// Appends a copy of row `row` of another object.
    void append(const NodeRows &other, const std::size_t row)
    {
      columns.insert(columns.end(), other.columns.begin() + other.start[row],
                     other.columns.begin() + other.start[row + 1]);
      weights.insert(weights.end(), other.weights.begin() + other.start[row],
                     other.weights.begin() + other.start[row + 1]);
      finish_row();
    }
  };

  /// Collective. Rows of all local nodes of a partition (owned, then ghosts), given those of the owned ones.
  NodeRows import_ghost_rows(const NodePartition &partition, NodeRows owned_rows);

  /// Collective. The rows of a list of nodes (sorted, the same on all ranks), on all ranks.
  NodeRows replicate_rows(const NodePartition &partition, const NodeRows &owned_rows,
                          const std::vector<NodeIndex> &nodes);

  /// Collective. Values of a field at a list of nodes (sorted, the same on all ranks), on all ranks.
  std::vector<Vector3> replicate_values(const NodePartition &partition, const Vector &field,
                                        const std::vector<NodeIndex> &nodes);

  /// Collective. Values of a field, rows, and fixed masks at a list of nodes, sorted, of which every rank has
  /// its own.
  std::vector<Vector3>         import_values(const NodePartition &partition, const Vector &field,
                                             const std::vector<NodeIndex> &nodes);
  NodeRows                     import_rows(const NodePartition &partition, const NodeRows &owned_rows,
                                           const std::vector<NodeIndex> &nodes);
  std::vector<FixedDirections> import_masks(const NodePartition                &partition,
                                            const std::vector<FixedDirections> &owned,
                                            const std::vector<NodeIndex>       &nodes);

  /// Collective. Fixed masks of a list of nodes (sorted, the same on all ranks), on all ranks.
  /// `owned` holds the masks of the owned nodes.
  std::vector<FixedDirections> replicate_masks(const NodePartition                &partition,
                                               const std::vector<FixedDirections> &owned,
                                               const std::vector<NodeIndex>       &nodes);

  /// Collective. Fixed masks of all local nodes, given those of the owned ones.
  std::vector<FixedDirections> import_ghost_masks(const NodePartition                &partition,
                                                  const std::vector<FixedDirections> &owned);

  /// Collective. Gives the ghosts of a list by local node what their owners have there.
  void import_ghost_flags(const NodePartition &partition, std::vector<unsigned char> &flags);
} // namespace Signorini

#endif
