// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_node_block_matrix_h
#define signorini_algebra_node_block_matrix_h

#include <signorini/algebra/block_storage.h>
#include <signorini/algebra/block_structure.h>
#include <signorini/algebra/types.h>

#include <algorithm>
#include <vector>

namespace Signorini
{
  /// A block of a row of a NodeBlockMatrix.
  struct RowEntry
  {
    /// Local node.
    unsigned int column;
    /// Where it is in memory.
    const BlockNumbers &numbers;
    std::size_t         position; ///< Of the block in memory.
    /// Whether it is the transposed block that is there.
    bool is_mirrored;

    /// The block itself.
    Block block() const
    {
      double in_memory[9];
      numbers.read(in_memory, position);
      return is_mirrored ? transpose(read_block(in_memory)) : read_block(in_memory);
    }

    /// Its trace.
    double trace() const
    {
      return numbers.trace(position);
    }
  };

  /// Symmetric sparse matrix of 3x3 blocks, one row and column per node, distributed by rows. Half of it is
  /// in memory, where BlockStructure says. Products use the owned rows only.
  class NodeBlockMatrix : public BlockStructure
  {
  public:
    /// Collective. Zeros in the union, on the owner, of what all ranks put into a row; the diagonal is added.
    /// extra_ghosts become ghosts of the partition besides the columns. Errors: an exception where the blocks
    /// among the rows of a rank are not symmetric.
    void reinit(const dealii::IndexSet &owned, const NodePattern &pattern,
                const dealii::IndexSet &extra_ghosts, const MPI_Comm communicator);

    /// The blocks of an owned row above the diagonal, for kernels.
    MirroredBlocks mirrored_blocks(const unsigned int row) const
    {
      const MirroredPlaces places = above(row);
      return {block_data(), places.positions, places.columns, places.n};
    }

    /// Adds blocks to a row given by row_of(), as far as they are in memory.
    /// @param local_columns ascending; all of them must be columns of the row
    /// @param block_of number among the columns -> pointer to nine numbers
    template <typename BlockOf>
    void add_to_row(const unsigned int row, const std::vector<unsigned int> &local_columns,
                    const BlockOf &block_of)
    {
      const bool  is_owned = row < n_rows();
      std::size_t next     = is_owned ? lower(row).begin : outer(row).begin;
      for (std::size_t m = 0; m < local_columns.size(); ++m)
        if (const unsigned int c = local_columns[m]; is_owned && c == row)
          add_to_block(diagonal(row), block_of(m));
        else if (stores(row, c))
          {
            if (c >= n_rows())
              next = std::max(next, outer(row).begin);
            while (column(next) != c)
              ++next;
            add_to_block(next, block_of(m));
          }
    }

    /// Calls action(RowEntry) for all blocks of an owned row: diagonal, lower, mirrored, outer.
    template <typename Action>
    void visit_row(const unsigned int row, const Action &action) const
    {
      const BlockNumbers numbers = block_data();
      const auto         visit   = [&](const BlockRange &range) {
        for (std::size_t k = range.begin; k < range.end; ++k)
          action(RowEntry{column(k), numbers, k, false});
      };
      action(RowEntry{row, numbers, diagonal(row), false});
      visit(lower(row));
      const MirroredPlaces mirrored = above(row);
      for (std::size_t m = 0; m < mirrored.n; ++m)
        action(RowEntry{mirrored.columns[m], numbers, mirrored.positions[m], true});
      visit(outer(row));
    }

    /// The blocks of all positions.
    BlockNumbers block_data() const
    {
      return values.numbers();
    }

    /// Nine numbers, row by row, of a block that is not split.
    double *block(const std::size_t k)
    {
      return values.exact(k);
    }

    /// The nine numbers of block k.
    const double *block(const std::size_t k) const
    {
      return values.exact(k);
    }

    /// Splits the blocks below the diagonal (see BlockStorage), for a matrix that has no ghosts and whose
    /// numbers are in the middle of the range of single precision: others stay as they are.
    void split();

    /// Whether it is split: then diagonal blocks alone may be written.
    bool is_split() const
    {
      return values.is_split();
    }

    /// All blocks may be written again.
    void join()
    {
      values.join();
    }

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
    void add_to_block(const std::size_t k, const double *const numbers)
    {
      double *const here = values.exact(k);
      for (unsigned int i = 0; i < 9; ++i)
        here[i] += numbers[i];
    }

    BlockStorage values;
  };

  /// Collective. The largest diagonal entry of a matrix, over all ranks: a scale for its units.
  double diagonal_scale(const NodeBlockMatrix &matrix);
} // namespace Signorini

#endif
