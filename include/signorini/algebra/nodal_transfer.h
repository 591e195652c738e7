// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_nodal_transfer_h
#define signorini_algebra_nodal_transfer_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/algebra/replicated_data.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// x - n (n·x) in place, three numbers; n is a unit vector.
  inline void project_to_plane(const Vector3 &n, double *const x)
  {
    const double normal = n[0] * x[0] + n[1] * x[1] + n[2] * x[2];
    for (unsigned int c = 0; c < dim; ++c)
      x[c] -= normal * n[c];
  }



  /// Explicit prolongation from a coarse to a fine level, by node. Most rows have scalar weights
  /// (times the identity); rows at a contact interface have 3x3 blocks, so that truncation can
  /// remove directions from them.
  ///
  /// Holds the rows of all local nodes of the fine matrix, ghosts included: the Galerkin product
  /// needs them.
  class NodalTransfer
  {
  public:
    /// A row with 3x3 blocks, or with weights: for the fine local node `row`, columns (global) and one of the
    /// two for each of them.
    struct BlockRow
    {
      /// Number of the row: a local node of the fine partition.
      unsigned int           row;
      std::vector<NodeIndex> columns;
      std::vector<Block>     blocks;
      std::vector<double>    weights;
    };

    /// Scalar rows of all local fine nodes; block_rows (sorted by row) replace some of them. Those with
    /// blocks that are multiples of the identity only become scalar rows as well.
    void reinit(NodeRows rows, const std::vector<BlockRow> &block_rows, const unsigned int n_owned_fine);

    /// Truncates a row to a plane: it is (I - n nᵀ) times the original row from now on. A zero vector undoes
    /// that. n is a unit vector otherwise.
    void set_plane(const unsigned int row, const Vector3 &normal);

    /// Coarse nodes in the columns that this rank does not own.
    dealii::IndexSet foreign_coarse_nodes(const dealii::IndexSet &owned_coarse_nodes) const;

    /// Gives the columns local numbers of a partition that knows all of them.
    void localize(std::shared_ptr<const NodePartition> coarse);

    /// The nodes of the coarse level.
    const NodePartition &coarse_partition() const
    {
      return *coarse;
    }

    /// fine = P coarse. Updates the ghosts of coarse.
    void prolongate(Vector &fine, const Vector &coarse) const;

    /// coarse += P^T fine, owned rows of all ranks.
    void restrict_and_add(Vector &coarse, const Vector &fine) const;

    /// Rows of owned nodes, which come first.
    unsigned int n_owned_rows() const
    {
      return n_owned;
    }

    /// Rows of all local nodes of the fine partition.
    unsigned int n_rows() const
    {
      return static_cast<unsigned int>(row_start.size()) - 1;
    }

    /// First entry of a row.
    std::size_t row_begin(const unsigned int row) const
    {
      return row_start[row];
    }

    /// The entry behind the last one of a row.
    std::size_t row_end(const unsigned int row) const
    {
      return row_start[row + 1];
    }

    /// Local node of the coarse partition to which entry k belongs.
    unsigned int column(const std::size_t k) const
    {
      return columns[k];
    }

    /// Scalar weight of entry k (pure number).
    double weight(const std::size_t k) const
    {
      return weights[k];
    }

    /// The arrays behind row_begin(), column() and weight(), for kernels.
    const std::size_t *row_start_data() const
    {
      return row_start.data();
    }

    /// column() of all entries, as an array for kernels.
    const unsigned int *column_data() const
    {
      return columns.data();
    }

    /// weight() of all entries.
    const double *weight_data() const
    {
      return weights.data();
    }

    /// The unit normal of the plane to which a row is truncated, or nullptr.
    const Vector3 *plane(const unsigned int row) const
    {
      if (plane_of_row.empty() || plane_of_row[row] < 0)
        return nullptr;
      const Vector3 &normal = planes[plane_of_row[row]];
      return normal.norm_square() > 0. ? &normal : nullptr;
    }

    /// The blocks of a row before truncation, or nullptr for a scalar row.
    const Block *row_blocks(const unsigned int row) const
    {
      return block_start[row] == no_blocks ? nullptr : blocks.data() + block_start[row];
    }

  private:
    static constexpr unsigned int no_blocks = dealii::numbers::invalid_unsigned_int;

    void append(const BlockRow &row);

    unsigned int              n_owned = 0;
    std::vector<std::size_t>  row_start;
    std::vector<NodeIndex>    global_columns;
    std::vector<unsigned int> columns;
    std::vector<double>       weights;
    std::vector<unsigned int> block_start;
    std::vector<Block>        blocks;
    /// The place in `planes` of each row that was ever truncated, or -1; empty before the first truncation.
    std::vector<int> plane_of_row;
    /// Zero where a row is not truncated any more.
    std::vector<Vector3>                 planes;
    std::shared_ptr<const NodePartition> coarse;
  };
} // namespace Signorini

#endif
