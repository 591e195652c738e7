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

  /// Sparse matrix of 3x3 blocks, one row and column per node, distributed by rows.
  ///
  /// A row consists of its diagonal block, those below (smaller local column) and those above it, by
  /// ascending local column. In memory all diagonal blocks come first, then the lower parts of all rows, then
  /// the upper parts: a sweep that needs one part reads half the memory.
  ///
  /// A rank may also hold rows of other ranks ("foreign" rows): they collect contributions until compress()
  /// adds them to the owner's row. Products use the owned rows only.
  class NodeBlockMatrix
  {
  public:
    /// Collective. Builds the structure: the union, on the owner, of what all ranks put into a row.
    /// The diagonal is added. extra_ghosts become ghosts of the partition besides the columns.
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

    /// Blocks of all stored rows.
    std::size_t n_blocks() const
    {
      return columns.size();
    }

    /// Number of blocks in owned rows.
    std::size_t n_owned_blocks() const
    {
      return upper_start[n_rows()];
    }

    /// Position of the diagonal block of an owned row.
    std::size_t diagonal(const unsigned int row) const
    {
      return row;
    }

    /// Positions of the blocks of an owned row below (above) the diagonal.
    BlockRange lower(const unsigned int row) const
    {
      return {lower_start[row], lower_start[row + 1]};
    }

    /// Blocks of a row behind the diagonal one.
    BlockRange upper(const unsigned int row) const
    {
      return {upper_start[row], upper_start[row + 1]};
    }

    /// Positions of all blocks of a stored row: diagonal, lower, upper; the columns of a foreign row are all
    /// in the last one.
    std::array<BlockRange, 3> ranges(const unsigned int row) const
    {
      if (row < n_rows())
        return {{{row, row + std::size_t(1)}, lower(row), upper(row)}};
      return {{{0, 0}, {0, 0}, upper(row)}};
    }

    /// Positions of the blocks of an owned row on and above the diagonal, of all blocks of a foreign row.
    std::array<BlockRange, 2> upper_half(const unsigned int row) const
    {
      const auto all = ranges(row);
      return {{all[0], all[2]}};
    }

    /// Number of blocks of a stored row.
    std::size_t row_length(const unsigned int row) const
    {
      std::size_t n = 0;
      for (const BlockRange &range : ranges(row))
        n += range.size();
      return n;
    }

    /// Local node of the column of block k.
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

    /// The owned rows that have a column with the given property, ascending. The pattern is symmetric.
    template <typename Property>
    std::vector<unsigned int> rows_with_column(const Property &property) const
    {
      std::vector<bool> is_found(n_rows(), false);
      for (unsigned int row = 0; row < n_rows(); ++row)
        {
          if (property(row))
            for (const BlockRange &range : ranges(row))
              for (std::size_t k = range.begin; k < range.end && columns[k] < n_rows(); ++k)
                is_found[columns[k]] = true;
          // Columns of other ranks are the last ones.
          const BlockRange after = upper(row);
          for (std::size_t k = after.end; k > after.begin && columns[k - 1] >= n_rows() && !is_found[row];
               --k)
            is_found[row] = property(columns[k - 1]);
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

    /// Position of the block (row, local column) in a row given by row_of(). It must exist.
    std::size_t find(const unsigned int row, const unsigned int local_column) const;

    /// Sets all blocks of a row given by row_of() to zero.
    void clear_row(const unsigned int row);

    /// Collective. Adds the foreign rows to the rows of their owners and clears them.
    void compress();

    /// Overwrites the lower part of owned rows with the transposed upper part of other rows: for those who
    /// compute only half of a symmetric matrix. is_wanted[row] says which rows are overwritten; empty means
    /// all.
    void mirror_upper_part(const std::vector<unsigned char> &is_wanted);

    /// product[c] = (A src)_{row, c} for an owned row. The ghost values of src must be up to date.
    void multiply_row(double *product, const unsigned int row, const Vector &src) const;

    /// dst = A src. Updates the ghost values of src.
    void vmult(Vector &dst, const Vector &src) const;

    /// Collective. dst -= A src on owned rows, dst another vector, if the matrix is symmetric: reads the
    /// diagonal, the lower parts and what couples to ghosts. Updates the ghost values of src, and leaves
    /// those of dst alone.
    void subtract_symmetric_product(Vector &dst, const Vector &src) const;

    /// Collective. residual = rhs - A src on owned rows, in the same way.
    void symmetric_residual(Vector &residual, const Vector &src, const Vector &rhs) const;

  private:
    /// Collective. What compress() sends of the foreign rows, which are sorted by node, hence by owner, and
    /// where it puts what it receives.
    void plan_compression(const NodePattern &pattern);

    std::shared_ptr<const NodePartition> nodes;
    /// Owned rows; upper_start goes on with the foreign rows.
    std::vector<std::size_t>  lower_start, upper_start;
    std::vector<unsigned int> columns;
    std::vector<double>       values;

    void collect_ghost_columns();

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
