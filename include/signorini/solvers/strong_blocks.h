// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_strong_blocks_h
#define signorini_solvers_strong_blocks_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/obstacle_problem.h>
#include <signorini/solvers/sweep_schedule.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Lines and planes of nodes that stretched cells couple strongly, for a block Gauss-Seidel sweep over
  /// them: sweeps node by node do not see motions that are constant along a line of flat cells.
  ///
  /// Found in the matrix: the trace of a block is a multiple of the Laplacian's entry. On cubes no entry
  /// beside the diagonal is positive; on stretched cells those along the long edges are (like a mass matrix).
  /// From an aspect ratio of 5 to 7 on a node counts as stretched; its strong couplings are the most
  /// negative ones to other such nodes. Blocks in which sweeps by node converge well are left out. Without
  /// stretched cells there are no blocks and no costs.
  class StrongBlocks
  {
  public:
    /// Collective. The matrix and the schedule must outlive the object.
    StrongBlocks(const NodeBlockMatrix &matrix, const SweepSchedule &all_rows);
    ~StrongBlocks();

    /// The owned rows that belong to a block.
    std::vector<unsigned int> rows() const;

    /// Collective. Drops the blocks that have none but the given rows: something else solves those at once.
    void drop_within(const std::vector<bool> &rows);

    /// Rows of the matrix have changed.
    void update(const std::vector<unsigned int> &rows);

    /// Collective. One sweep: minimizes over all motions of a block that keep its active nodes on their
    /// planes, as far as its other contact nodes allow. The energy never rises.
    /// @param half_space_of_row index of the half-space at each owned node, or -1
    void sweep(Vector &v, const Vector &rhs, const bool forward, const HalfSpaces &half_spaces,
               const std::vector<int> &half_space_of_row, const std::vector<unsigned char> &active);

  private:
    struct Block;

    void find_blocks();
    /// By how much a forward and a backward sweep by node reduce the energy norm of an error of a block whose
    /// surroundings are at rest, after some sweeps.
    double sweep_rate(const std::vector<unsigned int> &rows) const;
    void   factorize(Block &block, const HalfSpaces &half_spaces, const std::vector<int> &half_space_of_row,
                     const std::vector<unsigned char> &active);
    void   relax(Vector &v, const Vector &rhs, Block &block, const HalfSpaces &half_spaces,
                 const std::vector<int> &half_space_of_row, const std::vector<unsigned char> &active);

    const NodeBlockMatrix &matrix;
    const SweepSchedule   &schedule;
    /// Whether there are none on any rank.
    bool               is_empty = true;
    std::vector<Block> blocks;
    /// Blocks of each phase of the schedule.
    std::vector<std::vector<unsigned int>> phases;
    /// The block of each owned row, or -1; its place in the block.
    std::vector<int>          block_of_row;
    std::vector<unsigned int> place_in_block;
  };
} // namespace Signorini

#endif
