// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_strong_blocks_h
#define signorini_solvers_strong_blocks_h

#include <signorini/solvers/projected_gauss_seidel.h>
#include <signorini/solvers/smoother.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Blocks of nodes for a block Gauss-Seidel sweep: lines and planes of nodes that stretched cells couple
  /// strongly, or patches all over the mesh. Sweeps node by node do not see motions that are constant along a
  /// line of flat cells.
  ///
  /// Lines and planes are found in the matrix: the trace of a block is a multiple of the Laplacian's entry.
  /// On cubes no entry beside the diagonal is positive; on stretched cells those along the long edges are
  /// (like a mass matrix). From an aspect ratio of 5 to 7 on a node counts as stretched; its strong couplings
  /// are the most negative ones to other such nodes. Blocks in which sweeps by node converge well are left
  /// out. Without stretched cells there are no blocks and no costs.
  ///
  /// Patches grow along the strongest couplings and overlap. They see what lines and planes do not: thin
  /// slabs, stretched tetrahedra, Poisson's ratios near 1/2; a sweep costs some ten times one by node.
  class StrongBlocks : public SmoothingStage
  {
  public:
    /// Which nodes make up a block.
    enum class Choice
    {
      stretched_cells,
      patches
    };

    /// Collective. Matrix and sweeps must outlive the object.
    StrongBlocks(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                 const Choice choice = Choice::stretched_cells);
    ~StrongBlocks() override;

    /// Whether there are none on any rank.
    bool empty() const
    {
      return is_empty;
    }

    /// Collective. Drops the blocks that have none but the given local nodes: something else solves those at
    /// once.
    void drop_within(const std::vector<bool> &nodes);

    /// Collective. One sweep: minimizes over all motions of a block that keep its active nodes on their
    /// planes, as far as its other contact nodes allow.
    void run(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) override;

    /// Those that belong to a block.
    const std::vector<unsigned int> &rows() const override
    {
      return block_rows;
    }

    void update(const std::vector<unsigned int> &rows) override;

  private:
    struct Block;

    void find_stretched(std::vector<bool> &is_stretched, std::vector<double> &most_negative) const;
    void find_blocks();
    /// A node and those that it is coupled to strongly, by way of others too; those that come first are
    /// nearest. @param is_strong_to of a row and an entry of it
    template <typename Strong>
    std::vector<unsigned int> grow_block(const unsigned int start, const std::size_t largest,
                                         const Strong &is_strong_to, const std::vector<bool> &excluded);
    /// Whether an entry of a row couples two nodes strongly.
    bool is_strong(const unsigned int row, const RowEntry &entry,
                   const std::vector<double> &most_negative) const;
    /// Strong couplings of a node to others in a list, on the mean.
    double mean_couplings(const std::vector<unsigned int> &rows, const std::vector<double> &most_negative);
    void   find_patches();
    /// The nodes of a patch, from one node on.
    std::vector<unsigned int> grow_patch(const unsigned int start, const std::vector<double> &diagonal) const;
    void                      add_block(std::vector<unsigned int> &&rows);
    /// Collective. After blocks were added or dropped.
    void make_schedule();
    /// Blocks with rows that other ranks see are visited rank after rank, by colours of ranks: damped against
    /// each other, as rows are, patches lose too much (46 iterations on two ranks instead of 28 on a slab).
    SweepSchedule::Item visit_of(const unsigned int block) const;
    /// Collective. By how much the diagonals of blocks grow that clash with blocks of other ranks.
    void damp();
    void factorize(Block &block, const ContactState &contact);
    void relax(Vector &v, const Vector &rhs, Block &block, const ContactState &contact);

    const ProjectedGaussSeidel &sweeps;
    bool                        is_empty = true;
    std::vector<Block>          blocks;
    /// The phases of a run; the one of this rank's blocks with shared rows. The last one is for all others.
    unsigned int n_phases = 1, border_phase = 0;
    /// Of blocks; those that were dropped are not in it.
    SweepSchedule schedule;
    /// For each local node the phases in which a block changes it, bit c for phase c.
    std::vector<unsigned char> phases_of_node;
    /// Of each owned row; blocks may overlap.
    std::vector<std::vector<unsigned int>> blocks_of_row;
    /// Of each owned row in the block at hand, or -1.
    std::vector<int>          place_in_block;
    std::vector<unsigned int> block_rows;
    /// Added to the diagonal blocks of what is factorized, of themselves.
    double regularization;
  };
} // namespace Signorini

#endif
