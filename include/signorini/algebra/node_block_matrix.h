// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_node_block_matrix_h
#define signorini_algebra_node_block_matrix_h

#include <signorini/algebra/block_row.h>
#include <signorini/algebra/node_partition.h>

#include <array>
#include <memory>
#include <vector>

namespace Signorini
{
  /// Rows of global column numbers, for building a NodeBlockMatrix.
  struct NodePattern
  {
    /// Owned rows first (in order), then the foreign rows.
    std::vector<std::size_t> row_start = {0};
    /// Node numbers of the columns, row by row.
    std::vector<NodeIndex> columns;
    /// Global numbers of the foreign rows (owned by other ranks), sorted.
    std::vector<NodeIndex> foreign_rows;
  };

  /// A block of a row of a NodeBlockMatrix.
  struct RowEntry
  {
    /// Local node.
    unsigned int column;
    /// The nine numbers in memory, row by row.
    const double *numbers;
    /// Whether they are those of the transposed block.
    bool is_mirrored;

    /// The block itself.
    Block block() const
    {
      const Block in_memory = read_block(numbers);
      return is_mirrored ? transpose(in_memory) : in_memory;
    }

    /// Its trace.
    double trace() const
    {
      return numbers[0] + numbers[4] + numbers[8];
    }
  };

  /// Symmetric sparse matrix of 3x3 blocks, one row and column per node, distributed by rows.
  ///
  /// Half of it is in memory: of a row the diagonal block, those below it (owned columns with a smaller
  /// number) and those whose columns are ghosts. The blocks above the diagonal are those below it in other
  /// rows, transposed ("mirrored"); a row knows where they are. Columns ascend in each of the four parts. In
  /// memory come all diagonal blocks, the lower parts of all rows, then what couples to ghosts.
  ///
  /// A rank may also hold rows of other ranks ("foreign" rows, without what their owner has mirrored): they
  /// collect contributions until compress() adds them to the owner's row. Products use the owned rows only.
  class NodeBlockMatrix
  {
  public:
    /// Collective. Builds the structure: the union, on the owner, of what all ranks put into a row. It must
    /// be symmetric; the diagonal is added. extra_ghosts become ghosts of the partition besides the columns.
    void reinit(const dealii::IndexSet &owned, const NodePattern &pattern,
                const dealii::IndexSet &extra_ghosts, const MPI_Comm communicator);

    /// The nodes of rows and columns.
    const NodePartition &partition() const
    {
      return *nodes;
    }

    /// The same, to be kept.
    std::shared_ptr<const NodePartition> shared_partition() const
    {
      return nodes;
    }

    /// Owned rows.
    unsigned int n_rows() const
    {
      return nodes->n_owned();
    }

    /// Blocks of the owned rows that are in memory.
    std::size_t n_stored_blocks() const
    {
      return outer_start[n_rows()];
    }

    /// Blocks of the owned rows.
    std::size_t n_blocks() const
    {
      return n_stored_blocks() + mirrored.size();
    }

    /// Position of the diagonal block of an owned row.
    std::size_t diagonal(const unsigned int row) const
    {
      return row;
    }

    /// Positions of the blocks of an owned row below the diagonal.
    BlockRange lower(const unsigned int row) const
    {
      return {lower_start[row], lower_start[row + 1]};
    }

    /// Positions of the blocks of an owned row whose columns are ghosts, of the blocks of a foreign row.
    BlockRange outer(const unsigned int row) const
    {
      return {outer_start[row], outer_start[row + 1]};
    }

    /// Positions of all blocks of a row that are in memory: diagonal, lower, outer.
    std::array<BlockRange, 3> stored(const unsigned int row) const
    {
      if (row < n_rows())
        return {{{row, row + std::size_t(1)}, lower(row), outer(row)}};
      return {{{0, 0}, {0, 0}, outer(row)}};
    }

    /// The blocks of an owned row above the diagonal, as numbers among all such blocks.
    BlockRange above(const unsigned int row) const
    {
      return {mirrored_start[row], mirrored_start[row + 1]};
    }

    /// The blocks of an owned row above the diagonal, for kernels.
    MirroredBlocks mirrored_blocks(const unsigned int row) const
    {
      const BlockRange range = above(row);
      return {values.data(), mirrored.data() + range.begin, mirrored_columns.data() + range.begin,
              range.size()};
    }

    /// Whether the block (row, local column) of a row given by row_of() is in memory.
    bool stores(const unsigned int row, const unsigned int local_column) const
    {
      return row < n_rows() ? local_column <= row || local_column >= n_rows()
                            : foreign_rows[row - n_rows()].stores(local_column);
    }

    /// Adds blocks to a row given by row_of(), as far as they are in memory.
    /// @param local_columns ascending; all of them must be columns of the row
    /// @param block_of number among the columns -> pointer to nine numbers
    template <typename BlockOf>
    void add_to_row(const unsigned int row, const std::vector<unsigned int> &local_columns,
                    const BlockOf &block_of)
    {
      std::size_t m   = 0;
      const auto  add = [&](const std::size_t k) {
        double *const       to   = block(k);
        const double *const from = block_of(m);
        for (unsigned int c = 0; c < 9; ++c)
          to[c] += from[c];
      };
      const auto add_up_to = [&](const unsigned int end, std::size_t k) {
        for (; m < local_columns.size() && local_columns[m] < end; ++m)
          if (stores(row, local_columns[m]))
            {
              while (columns[k] != local_columns[m])
                ++k;
              add(k);
            }
      };
      if (row < n_rows())
        {
          add_up_to(row, lower_start[row]);
          if (m < local_columns.size() && local_columns[m] == row)
            {
              add(diagonal(row));
              ++m;
            }
          while (m < local_columns.size() && local_columns[m] < n_rows())
            ++m;
        }
      add_up_to(dealii::numbers::invalid_unsigned_int, outer_start[row]);
    }

    /// Calls action(RowEntry) for all blocks of an owned row: diagonal, lower, mirrored, outer.
    template <typename Action>
    void visit_row(const unsigned int row, const Action &action) const
    {
      const auto visit = [&](const BlockRange &range) {
        for (std::size_t k = range.begin; k < range.end; ++k)
          action(RowEntry{columns[k], block(k), false});
      };
      action(RowEntry{row, block(diagonal(row)), false});
      visit(lower(row));
      for (std::size_t m = mirrored_start[row]; m < mirrored_start[row + 1]; ++m)
        action(RowEntry{mirrored_columns[m], block(mirrored[m]), true});
      visit(outer(row));
    }

    /// Number of blocks of an owned row.
    std::size_t row_length(const unsigned int row) const
    {
      return 1 + lower(row).size() + above(row).size() + outer(row).size();
    }

    /// Local node of the column of a block in memory.
    unsigned int column(const std::size_t k) const
    {
      return columns[k];
    }

    /// column() of all blocks, as an array for kernels.
    const unsigned int *column_data() const
    {
      return columns.data();
    }

    /// lower(row).begin of all owned rows, and the end of the last.
    const std::size_t *lower_start_data() const
    {
      return lower_start.data();
    }

    /// The blocks of all positions.
    const double *block_data() const
    {
      return values.data();
    }

    /// Nine numbers, row by row.
    double *block(const std::size_t k)
    {
      return values.data() + 9 * k;
    }

    /// The nine numbers of block k.
    const double *block(const std::size_t k) const
    {
      return values.data() + 9 * k;
    }

    /// The owned rows that have a column with the given property, ascending.
    template <typename Property>
    std::vector<unsigned int> rows_with_column(const Property &property) const
    {
      std::vector<bool> is_found(n_rows(), false);
      for (unsigned int row = 0; row < n_rows(); ++row)
        {
          if (property(row))
            visit_row(row, [&](const RowEntry &entry) {
              if (entry.column < n_rows())
                is_found[entry.column] = true;
            });
          for (std::size_t k = outer(row).begin; k < outer(row).end && !is_found[row]; ++k)
            is_found[row] = property(columns[k]);
        }
      std::vector<unsigned int> rows;
      for (unsigned int row = 0; row < n_rows(); ++row)
        if (is_found[row])
          rows.push_back(row);
      return rows;
    }

    /// An owned row that couples to a ghost, and the position of that block.
    struct GhostCoupling
    {
      /// The row, and where its block is.
      unsigned int row;
      std::size_t  block;
    };

    /// The owned rows that couple to a ghost (numbered from 0), ascending: its column.
    std::pair<const GhostCoupling *, const GhostCoupling *> ghost_column(const unsigned int ghost) const
    {
      return {ghost_couplings.data() + ghost_start[ghost], ghost_couplings.data() + ghost_start[ghost + 1]};
    }

    /// Number of blocks of owned rows whose columns are ghosts.
    std::size_t n_ghost_couplings() const
    {
      return ghost_couplings.size();
    }

    /// The row index (owned or foreign) in which this rank collects contributions to a local node,
    /// or dealii::numbers::invalid_unsigned_int.
    unsigned int row_of(const unsigned int local_node) const
    {
      return local_node < nodes->n_owned() ? local_node : foreign_row_of_ghost[local_node - nodes->n_owned()];
    }

    /// Position of the block (row, local column) in a row given by row_of(). It must be in memory (stores()).
    std::size_t find(const unsigned int row, const unsigned int local_column) const;

    /// Sets what a row given by row_of() has in memory to zero.
    void clear_row(const unsigned int row);

    /// Collective. Adds the foreign rows to the rows of their owners and clears them.
    void compress();

    /// product[c] = (A src)_{row, c} for an owned row. The ghost values of src must be up to date.
    void multiply_row(double *product, const unsigned int row, const Vector &src) const;

    /// Collective. dst = A src on owned rows. Updates the ghost values of src, and leaves those of dst alone.
    void vmult(Vector &dst, const Vector &src) const;

    /// Collective. dst -= A src on owned rows, dst another vector. Updates the ghost values of src, and
    /// leaves those of dst alone.
    void subtract_product(Vector &dst, const Vector &src) const;

    /// Collective. residual = rhs - A src on owned rows, in the same way.
    void symmetric_residual(Vector &residual, const Vector &src, const Vector &rhs) const;

  private:
    /// Collective. What compress() sends of the foreign rows, which are sorted by node, hence by owner, and
    /// where it puts what it receives.
    void plan_compression(const NodePattern &pattern);

    void find_foreign_rows(const NodePattern &pattern);

    void mirror_lower_parts();

    void collect_ghost_columns();

    std::shared_ptr<const NodePartition> nodes;
    /// Owned rows; outer_start goes on with the foreign rows.
    std::vector<std::size_t>  lower_start, outer_start;
    std::vector<unsigned int> columns;
    std::vector<double>       values;
    /// Row by row what is above the diagonal: columns, and positions of the transposed blocks.
    std::vector<std::size_t>  mirrored_start;
    std::vector<unsigned int> mirrored_columns, mirrored;

    /// A row of another rank: its local node, and the end of the local nodes of its owner.
    struct ForeignRow
    {
      unsigned int node, end_of_owner;

      bool stores(const unsigned int local_column) const
      {
        return local_column <= node || local_column >= end_of_owner;
      }
    };
    std::vector<ForeignRow>   foreign_rows;
    std::vector<unsigned int> foreign_row_of_ghost;
    /// Column by column.
    std::vector<std::size_t>   ghost_start = {0};
    std::vector<GhostCoupling> ghost_couplings;
    /// For each rank that gets contributions: the range of stored rows.
    std::vector<std::pair<unsigned int, std::pair<unsigned int, unsigned int>>> send_rows;
    /// For each rank that sends: the positions its blocks are added to.
    std::vector<std::pair<unsigned int, std::vector<std::size_t>>> receive_positions;
  };

  /// Collective. The largest diagonal entry of a matrix, over all ranks: a scale for its units.
  double diagonal_scale(const NodeBlockMatrix &matrix);
} // namespace Signorini

#endif
