// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "block_cholesky.h"

#include <signorini/algebra/rank_colour.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/solvers/strong_blocks.h>
#include <signorini/solvers/sweep_rate.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Which nodes belong together in lines and planes of stretched cells (doc/measurements.md).
    struct StrongBlocksRule
    {
      /// A positive coupling of this part of the diagonal makes a node stretched: from an aspect ratio of 5
      /// to 7 on.
      double stretched = .235;
      /// Strong couplings have this part of the most negative one.
      double strong = .5;
      /// Larger blocks are cut: their factors would cost too much.
      std::size_t largest_block = 4000;
      /// Volumes, whose factors cost most, are covered by pieces of so many nodes that overlap by half: a
      /// random pair of 14,586 unknowns takes 10 and 11 iterations and 1.0 s; 17, 14 and 0.8 s with pieces of
      /// 400 that do not overlap; 9 and 10 s with one block. Shells at nu = 0.49: 24, 27, 24 iterations.
      std::size_t piece_of_volume = 200;
      /// Strong couplings of a node in its block, on the mean: a node of a plane has 8.
      double planar = 9.;
      /// Nodes of a patch. Two slabs of aspect ratio 50, 22,000 unknowns of stretched tetrahedra: 290
      /// iterations by node, 23 with patches of 24 that overlap, 179 where they do not; a random pair of
      /// 12,510 unknowns 216, 37, 86. Neighbours alone: 242 and 71.
      std::size_t patch_size = 24;
      /// Added to the diagonal blocks of patches, of themselves. Functions of background levels may depend on
      /// each other; the factors of a patch of such ones return rounding. A plate of 100 x 100 x 1 cubes, a
      /// finished mesh: no end in 313 iterations, 35 with 1e-9, 30 with 1e-7 and 1e-6.
      double patch_regularization = 1e-7;
      /// Colours of ranks for the blocks at their borders: those of further colours share a phase with
      /// others.
      unsigned int most_colours = 7;
    };
    constexpr StrongBlocksRule blocks_rule;

    double trace_of(const double *const block)
    {
      return block[0] + block[4] + block[8];
    }
  } // namespace



  struct StrongBlocks::Block
  {
    std::vector<unsigned int> rows;
    /// Active flags of the contact nodes among them, as factorized.
    std::vector<unsigned char> flags;
    bool                       is_current = false;
    /// Whether something else solves for its nodes.
    bool is_dropped = false;
    /// In which it is visited.
    unsigned int phase = 0;
    /// Whether there are factors: a block without support (a body that only contact holds) has none, and is
    /// left to the sweeps by node.
    bool is_definite = false;
    /// Damping of its rows, relative to their diagonal blocks; empty if nothing clashes.
    std::vector<double> shift;

    BlockCholesky cholesky;
  };



  StrongBlocks::StrongBlocks(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                             const Choice choice)
    : SmoothingStage(matrix)
    , sweeps(sweeps)
    , blocks_of_row(matrix.n_rows())
    , place_in_block(matrix.n_rows(), -1)
    , regularization(choice == Choice::patches ? blocks_rule.patch_regularization : 0.)
  {
    if (choice == Choice::patches)
      find_patches();
    else
      find_blocks();
    make_schedule();
  }



  StrongBlocks::~StrongBlocks() = default;



  void StrongBlocks::find_stretched(std::vector<bool> &is_stretched, std::vector<double> &most_negative) const
  {
    const unsigned int  n = matrix.n_rows();
    std::vector<double> largest(n, 0.);
    most_negative.assign(n, 0.);
    const auto see = [&](const double t, const unsigned int row) {
      largest[row]       = std::max(largest[row], t);
      most_negative[row] = std::min(most_negative[row], t);
    };
    // Half of the matrix and, at the end of a row, the columns of other ranks.
    const BlockNumbers blocks = matrix.block_data();
    for (unsigned int i = 0; i < n; ++i)
      {
        const BlockRange lower = matrix.lower(i), outer = matrix.outer(i);
        for (std::size_t k = lower.begin; k < lower.end; ++k)
          {
            const double t = blocks.trace(k);
            see(t, i);
            see(t, matrix.column(k));
          }
        for (std::size_t k = outer.begin; k < outer.end; ++k)
          see(blocks.trace(k), i);
      }
    is_stretched.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      is_stretched[i] = largest[i] >= blocks_rule.stretched * trace_of(matrix.block(matrix.diagonal(i)));
  }



  bool StrongBlocks::is_strong(const unsigned int row, const RowEntry &entry,
                               const std::vector<double> &most_negative) const
  {
    return entry.column != row &&
           entry.trace() <= blocks_rule.strong * std::min(most_negative[row], most_negative[entry.column]);
  }



  double StrongBlocks::mean_couplings(const std::vector<unsigned int> &rows,
                                      const std::vector<double>       &most_negative)
  {
    for (const unsigned int row : rows)
      place_in_block[row] = 0;
    std::size_t n = 0;
    for (const unsigned int row : rows)
      matrix.visit_row(row, [&](const RowEntry &entry) {
        if (entry.column < matrix.n_rows() && place_in_block[entry.column] == 0 &&
            is_strong(row, entry, most_negative))
          ++n;
      });
    for (const unsigned int row : rows)
      place_in_block[row] = -1;
    return static_cast<double>(n) / static_cast<double>(rows.size());
  }



  template <typename Strong>
  std::vector<unsigned int> StrongBlocks::grow_block(const unsigned int start, const std::size_t largest,
                                                     const Strong            &is_strong_to,
                                                     const std::vector<bool> &excluded)
  {
    // Breadth first, so that what is cut stays in one piece.
    std::vector<unsigned int> rows = {start};
    place_in_block[start]          = 0;
    for (std::size_t next = 0; next < rows.size() && rows.size() < largest; ++next)
      {
        const unsigned int row = rows[next];
        matrix.visit_row(row, [&](const RowEntry &entry) {
          if (is_strong_to(row, entry) && !excluded[entry.column] && place_in_block[entry.column] < 0)
            {
              place_in_block[entry.column] = 0;
              rows.push_back(entry.column);
            }
        });
      }
    for (const unsigned int row : rows)
      place_in_block[row] = -1;
    return rows;
  }



  void StrongBlocks::find_blocks()
  {
    const unsigned int  n = matrix.n_rows();
    std::vector<double> most_negative;
    std::vector<bool>   is_stretched, visited(n, false);
    find_stretched(is_stretched, most_negative);
    const std::vector<bool> nothing(n, false);
    const auto              strong = [&](const unsigned int row, const RowEntry &entry) {
      return entry.column < n && is_stretched[entry.column] && is_strong(row, entry, most_negative);
    };
    Vector zero;
    matrix.partition().reinit(zero);
    for (unsigned int start = 0; start < n; ++start)
      if (is_stretched[start] && !visited[start])
        {
          std::vector<unsigned int> rows   = grow_block(start, blocks_rule.largest_block, strong, visited);
          std::size_t               n_done = rows.size();
          if (rows.size() > blocks_rule.piece_of_volume &&
              mean_couplings(rows, most_negative) > blocks_rule.planar)
            {
              // The nodes that came last are at the border, and in the middle of another piece.
              rows   = grow_block(start, blocks_rule.piece_of_volume, strong, nothing);
              n_done = rows.size() / 2;
            }
          for (std::size_t k = 0; k < n_done; ++k)
            visited[rows[k]] = true;
          if (rows.size() < 2)
            continue;
          std::sort(rows.begin(), rows.end());
          if (sweep_rate(matrix, sweeps, rows, slow_in_blocks, zero) >= slow_in_blocks.slow)
            add_block(std::move(rows));
        }
  }



  std::vector<unsigned int> StrongBlocks::grow_patch(const unsigned int         start,
                                                     const std::vector<double> &diagonal) const
  {
    std::vector<unsigned int>      rows;
    std::map<unsigned int, double> coupling_of = {{start, 0.}};
    while (rows.size() < blocks_rule.patch_size && !coupling_of.empty())
      {
        const auto         is_less = [](const auto &a, const auto &b) { return a.second < b.second; };
        const auto         next    = std::max_element(coupling_of.begin(), coupling_of.end(), is_less);
        const unsigned int row     = next->first;
        coupling_of.erase(next);
        rows.push_back(row);
        matrix.visit_row(row, [&](const RowEntry &entry) {
          const unsigned int j = entry.column;
          if (j < matrix.n_rows() && std::find(rows.begin(), rows.end(), j) == rows.end())
            coupling_of[j] -= entry.trace() / std::sqrt(diagonal[row] * diagonal[j]);
        });
      }
    return rows;
  }



  void StrongBlocks::find_patches()
  {
    const unsigned int  n = matrix.n_rows();
    std::vector<double> diagonal(n);
    std::vector<bool>   is_inside(n, false);
    for (unsigned int i = 0; i < n; ++i)
      diagonal[i] = trace_of(matrix.block(matrix.diagonal(i)));
    for (unsigned int start = 0; start < n; ++start)
      if (!is_inside[start])
        {
          std::vector<unsigned int> rows = grow_patch(start, diagonal);
          // The nodes that came last are at the border, and in the middle of another patch.
          for (std::size_t k = 0; k < std::max<std::size_t>(1, rows.size() / 2); ++k)
            is_inside[rows[k]] = true;
          std::sort(rows.begin(), rows.end());
          add_block(std::move(rows));
        }
  }



  void StrongBlocks::add_block(std::vector<unsigned int> &&rows)
  {
    for (const unsigned int row : rows)
      blocks_of_row[row].push_back(static_cast<unsigned int>(blocks.size()));
    blocks.emplace_back();
    blocks.back().rows = std::move(rows);
  }



  SweepSchedule::Item StrongBlocks::visit_of(const unsigned int block) const
  {
    const std::vector<unsigned int> &rows      = blocks[block].rows;
    const bool                       is_border = std::any_of(
                              rows.begin(), rows.end(), [&](const unsigned int row) { return sweeps.phases().is_shared(row); });
    return {block, is_border ? border_phase : n_phases - 1, is_border};
  }



  void StrongBlocks::make_schedule()
  {
    block_rows.clear();
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (!blocks_of_row[row].empty())
        block_rows.push_back(row);
    is_empty =
        Utilities::MPI::max(static_cast<int>(!block_rows.empty()), matrix.partition().communicator()) == 0;
    if (is_empty)
      return;
    if (matrix.partition().n_ranks() > 1)
      {
        const RankColour colour = colour_rank(matrix.partition());
        n_phases                = std::min(blocks_rule.most_colours, colour.n_colours) + 1;
        border_phase            = colour.own % blocks_rule.most_colours;
      }
    std::vector<SweepSchedule::Item> items;
    phases_of_node.assign(matrix.partition().n_local(), 0);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      if (!blocks[b].is_dropped)
        {
          items.push_back(visit_of(b));
          blocks[b].phase = items.back().phase;
          for (const unsigned int row : blocks[b].rows)
            phases_of_node[row] |= static_cast<unsigned char>(1u << items.back().phase);
        }
    import_ghost_flags(matrix.partition(), phases_of_node);
    schedule = SweepSchedule(matrix.partition(), n_phases, items, phases_of_node);
    damp();
  }



  void StrongBlocks::damp()
  {
    if (matrix.partition().n_ranks() == 1)
      return;
    // By row and phase: couplings to what other ranks change at that time; how many blocks have the row.
    std::map<unsigned int, std::vector<double>> sums;
    const RelativeCouplings                     couplings(matrix);
    for (unsigned int ghost = 0; ghost < matrix.partition().ghosts().size(); ++ghost)
      if (const unsigned int flags = phases_of_node[matrix.n_rows() + ghost]; flags != 0)
        for (auto [coupling, end] = matrix.ghost_column(ghost); coupling != end; ++coupling)
          if (phases_of_node[coupling->row] & flags)
            {
              auto &sum = sums[coupling->row];
              sum.resize(n_phases);
              const double norm = couplings.bound(*coupling, ghost);
              for (unsigned int phase = 0; phase < n_phases; ++phase)
                sum[phase] += flags & (1u << phase) ? norm : 0.;
            }
    for (Block &block : blocks)
      {
        std::vector<double> shift;
        for (std::size_t i = 0; i < block.rows.size(); ++i)
          if (const auto sum = sums.find(block.rows[i]); sum != sums.end() && sum->second[block.phase] > 0.)
            {
              const auto &others = blocks_of_row[block.rows[i]];
              const auto  n      = std::count_if(others.begin(), others.end(), [&](const unsigned int other) {
                return blocks[other].phase == block.phase;
              });
              shift.resize(block.rows.size());
              shift[i] = DampingRule().shift(sum->second[block.phase], static_cast<unsigned int>(n));
            }
        block.is_current = block.is_current && shift == block.shift;
        block.shift      = std::move(shift);
      }
  }



  void StrongBlocks::drop_within(const std::vector<bool> &nodes)
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        Block &block     = blocks[b];
        block.is_dropped = std::all_of(block.rows.begin(), block.rows.end(),
                                       [&](const unsigned int row) { return nodes[row]; });
        if (block.is_dropped)
          for (const unsigned int row : block.rows)
            blocks_of_row[row].erase(std::find(blocks_of_row[row].begin(), blocks_of_row[row].end(), b));
      }
    make_schedule();
  }



  void StrongBlocks::update(const std::vector<unsigned int> &rows)
  {
    if (is_empty)
      return;
    for (const unsigned int row : rows)
      for (const unsigned int b : blocks_of_row[row])
        blocks[b].is_current = false;
    damp();
  }



  void StrongBlocks::factorize(Block &block, const ContactState &contact)
  {
    BlockCholesky::Matrix restricted_matrix(block.rows.size());
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      place_in_block[block.rows[i]] = static_cast<int>(i);
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      {
        const unsigned int row        = block.rows[i];
        const Vector3      row_normal = contact.plane(row);
        matrix.visit_row(row, [&](const RowEntry &entry) {
          const unsigned int column = entry.column;
          if (column >= matrix.n_rows() || place_in_block[column] < 0)
            return;
          const auto j = static_cast<std::size_t>(place_in_block[column]);
          if (j > i)
            return;
          auto restricted =
              restrict_to_planes(entry.block(), row_normal, contact.plane(column), row == column);
          if (row == column)
            restricted *= 1. + regularization + (block.shift.empty() ? 0. : block.shift[i]);
          restricted_matrix.set(i, j, restricted);
        });
      }
    for (const unsigned int row : block.rows)
      place_in_block[row] = -1;
    block.is_definite = block.cholesky.factorize(restricted_matrix);
    block.is_current  = true;
  }



  void StrongBlocks::relax(Vector &v, const Vector &rhs, Block &block, const ContactState &contact)
  {
    std::vector<unsigned char> flags;
    for (const unsigned int row : block.rows)
      if (const int p = contact.at(row); p >= 0)
        flags.push_back(contact.active()[p]);
    if (!block.is_current || flags != block.flags)
      {
        block.flags = flags;
        factorize(block, contact);
      }
    if (!block.is_definite)
      return;
    Eigen::VectorXd residual(dim * block.rows.size());
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      {
        const unsigned int row = block.rows[i];
        double             s[3];
        for (unsigned int c = 0; c < dim; ++c)
          s[c] = rhs.local_element(dim * row + c);
        double product[3];
        matrix.multiply_row(product, row, v);
        for (unsigned int c = 0; c < dim; ++c)
          s[c] -= product[c];
        const Vector3 n      = contact.plane(row);
        const double  normal = n[0] * s[0] + n[1] * s[1] + n[2] * s[2];
        for (unsigned int c = 0; c < dim; ++c)
          s[c] -= normal * n[c];
        for (unsigned int c = 0; c < dim; ++c)
          residual[dim * i + c] = s[c];
      }
    const Eigen::VectorXd step = block.cholesky.solve(residual);

    const HalfSpaces &half_spaces = contact.half_spaces();
    double            length      = 1.;
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      if (const int p = contact.at(block.rows[i]); p >= 0 && !contact.active()[p])
        {
          double motion = 0., room = half_spaces.bounds[p];
          for (unsigned int c = 0; c < dim; ++c)
            {
              motion += half_spaces.normals[p][c] * step[dim * i + c];
              room -= half_spaces.normals[p][c] * v.local_element(dim * block.rows[i] + c);
            }
          if (motion > 0.)
            length = std::min(length, std::max(room, 0.) / motion);
        }
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        v.local_element(dim * block.rows[i] + c) += length * step[dim * i + c];
  }



  void StrongBlocks::run(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction)
  {
    if (is_empty)
      return;
    schedule.visit_each(v, direction,
                        [&](const unsigned int block) { relax(v, rhs, blocks[block], contact); });
  }
} // namespace Signorini
