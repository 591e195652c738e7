// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_block_structure_h
#define signorini_algebra_block_structure_h

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

  /// Which blocks a symmetric distributed matrix has, and where they are in memory.
  ///
  /// Half of them are: of a row the diagonal block, those below it (owned columns with a smaller number) and
  /// those whose columns are ghosts. The blocks above the diagonal are those below it in other rows,
  /// transposed
  /// ("mirrored"); a row knows where they are. Columns ascend in each of the four parts. In memory come all
  /// diagonal blocks, the lower parts of all rows, then what couples to ghosts.
  ///
  /// A rank may also hold rows of other ranks ("foreign" rows, without what their owner has mirrored), for
  /// contributions that are added to the owner's row.
  class BlockStructure
  {
  public:
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

    /// All blocks in memory, those of foreign rows too.
    std::size_t n_positions() const
    {
      return columns.size();
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

    /// Columns of mirrored blocks, and positions of those that they mirror.
    struct MirroredPlaces
    {
      const unsigned int *positions; ///< Positions of the stored blocks, n of them.
      const unsigned int *columns;   ///< Local columns of the mirrored blocks, n of them.
      std::size_t         n;         ///< Number of blocks.
    };

    /// The blocks of an owned row above the diagonal.
    MirroredPlaces above(const unsigned int row) const
    {
      const std::size_t begin = mirrored_start[row];
      return {mirrored.data() + begin, mirrored_columns.data() + begin, mirrored_start[row + 1] - begin};
    }

    /// Whether the block (row, local column) of a row given by row_of() is in memory.
    bool stores(const unsigned int row, const unsigned int local_column) const
    {
      return row < n_rows() ? local_column <= row || local_column >= n_rows()
                            : foreign_rows[row - n_rows()].stores(local_column);
    }

    /// Number of blocks of an owned row.
    std::size_t row_length(const unsigned int row) const
    {
      return 1 + lower(row).size() + above(row).n + outer(row).size();
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

    /// The owned rows that have a column with the given property, ascending.
    template <typename Property>
    std::vector<unsigned int> rows_with_column(const Property &property) const
    {
      std::vector<bool> is_found(n_rows(), false);
      for (unsigned int row = 0; row < n_rows(); ++row)
        {
          if (property(row))
            {
              is_found[row] = true;
              for (std::size_t k = lower(row).begin; k < lower(row).end; ++k)
                is_found[columns[k]] = true;
              for (std::size_t m = mirrored_start[row]; m < mirrored_start[row + 1]; ++m)
                is_found[mirrored_columns[m]] = true;
            }
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

  protected:
    /// Collective. See NodeBlockMatrix::reinit().
    void make_structure(const dealii::IndexSet &owned, const NodePattern &pattern,
                        const dealii::IndexSet &extra_ghosts, const MPI_Comm communicator);

    /// For each rank that gets contributions: the range of stored rows.
    std::vector<std::pair<unsigned int, std::pair<unsigned int, unsigned int>>> send_rows;
    /// For each rank that sends: the positions its blocks are added to.
    std::vector<std::pair<unsigned int, std::vector<std::size_t>>> receive_positions;

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
  };
} // namespace Signorini

#endif
