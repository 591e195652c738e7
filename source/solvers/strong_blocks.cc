// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/strong_blocks.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A positive coupling of this part of the diagonal makes a node stretched.
    constexpr double stretched = .235;
    /// Strong couplings have this part of the most negative one.
    constexpr double strong = .5;
    /// Blocks are kept where a forward and a backward sweep by node leave at least this part of an error.
    constexpr double slow = .7;
    /// Larger blocks are cut: their factors would cost too much.
    constexpr std::size_t largest_block = 4000;
    /// Up to here factors are dense.
    constexpr std::size_t largest_dense = 24;

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
    /// Whether there are factors: a block without support (a body that only contact holds) has none, and is
    /// left to the sweeps by node.
    bool is_definite = false;

    Eigen::LLT<Eigen::MatrixXd>                                        dense;
    std::unique_ptr<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> sparse;
  };



  StrongBlocks::StrongBlocks(const NodeBlockMatrix &matrix, const SweepSchedule &all_rows)
    : matrix(matrix)
    , schedule(all_rows)
  {
    find_blocks();
    is_empty = Utilities::MPI::max(static_cast<int>(!blocks.empty()), matrix.partition().communicator()) == 0;
  }



  StrongBlocks::~StrongBlocks() = default;



  void StrongBlocks::find_blocks()
  {
    const unsigned int        n = matrix.n_rows();
    std::vector<double>       largest(n, 0.), most_negative(n, 0.);
    std::vector<bool>         is_stretched(n, false);
    std::vector<unsigned int> phase_of_row(n, 0);
    for (unsigned int phase = 0; phase < schedule.phases().size(); ++phase)
      for (const unsigned int row : schedule.phases()[phase])
        phase_of_row[row] = phase;
    // Half of the matrix and, at the end of a row, the columns of other ranks.
    for (unsigned int i = 0; i < n; ++i)
      {
        const auto see = [&](const double t, const unsigned int row) {
          largest[row]       = std::max(largest[row], t);
          most_negative[row] = std::min(most_negative[row], t);
        };
        const BlockRange lower = matrix.lower(i), upper = matrix.upper(i);
        for (std::size_t k = lower.begin; k < lower.end; ++k)
          {
            const double t = trace_of(matrix.block(k));
            see(t, i);
            see(t, matrix.column(k));
          }
        for (std::size_t k = upper.end; k > upper.begin && matrix.column(k - 1) >= n; --k)
          see(trace_of(matrix.block(k - 1)), i);
      }
    for (unsigned int i = 0; i < n; ++i)
      is_stretched[i] = largest[i] >= stretched * trace_of(matrix.block(matrix.diagonal(i)));

    block_of_row.assign(n, -1);
    place_in_block.assign(n, 0);
    std::vector<bool> visited(n, false);
    phases.resize(schedule.phases().size());
    for (unsigned int start = 0; start < n; ++start)
      if (is_stretched[start] && !visited[start])
        {
          // Along strong couplings, breadth first, so that a cut block stays in one piece.
          std::vector<unsigned int> rows = {start};
          visited[start]                 = true;
          for (std::size_t next = 0; next < rows.size() && rows.size() < largest_block; ++next)
            {
              const unsigned int i = rows[next];
              for (const BlockRange &range : {matrix.lower(i), matrix.upper(i)})
                for (std::size_t k = range.begin; k < range.end; ++k)
                  if (const unsigned int j = matrix.column(k);
                      j < n && is_stretched[j] && !visited[j] &&
                      trace_of(matrix.block(k)) <= strong * std::min(most_negative[i], most_negative[j]))
                    {
                      visited[j] = true;
                      rows.push_back(j);
                    }
            }
          if (rows.size() < 2)
            continue;
          std::sort(rows.begin(), rows.end());
          // With a node that other ranks see the block waits for the turn of this rank.
          unsigned int phase = static_cast<unsigned int>(schedule.phases().size()) - 1;
          for (const unsigned int row : rows)
            phase = std::min(phase, phase_of_row[row]);
          // Pieces of blocks that go on at another rank look better than they are.
          if (phase + 1 == schedule.phases().size() && sweep_rate(rows) < slow)
            continue;
          phases[phase].push_back(static_cast<unsigned int>(blocks.size()));
          for (unsigned int i = 0; i < rows.size(); ++i)
            {
              block_of_row[rows[i]]   = static_cast<int>(blocks.size());
              place_in_block[rows[i]] = i;
            }
          blocks.emplace_back();
          blocks.back().rows = std::move(rows);
        }
  }



  std::vector<unsigned int> StrongBlocks::rows() const
  {
    std::vector<unsigned int> result;
    for (unsigned int row = 0; row < matrix.n_rows(); ++row)
      if (block_of_row[row] >= 0)
        result.push_back(row);
    return result;
  }



  double StrongBlocks::sweep_rate(const std::vector<unsigned int> &rows) const
  {
    constexpr unsigned int                           n_sweeps = 4;
    std::vector<std::pair<const double *, unsigned>> entries;
    std::vector<std::size_t>                         start = {0};
    std::vector<Tensor<2, dim>>                      inverse(rows.size());
    std::vector<Vector3>                             error(rows.size());
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        for (const BlockRange &range : matrix.ranges(rows[i]))
          for (std::size_t k = range.begin; k < range.end; ++k)
            if (const auto it = std::lower_bound(rows.begin(), rows.end(), matrix.column(k));
                it != rows.end() && *it == matrix.column(k))
              entries.emplace_back(matrix.block(k), it - rows.begin());
        start.push_back(entries.size());
        inverse[i] = invert(read_block(matrix.block(matrix.diagonal(rows[i]))));
        // The slow motions are constant along a block; something of all others.
        for (unsigned int c = 0; c < dim; ++c)
          error[i][c] = 1. + .1 * std::sin(1. + 7. * (dim * i + c));
      }
    const auto product = [&](const std::size_t i) {
      Vector3 sum;
      for (std::size_t l = start[i]; l < start[i + 1]; ++l)
        {
          const double *const a = entries[l].first;
          const Vector3      &x = error[entries[l].second];
          for (unsigned int c = 0; c < dim; ++c)
            sum[c] += a[dim * c] * x[0] + a[dim * c + 1] * x[1] + a[dim * c + 2] * x[2];
        }
      return sum;
    };
    const auto energy = [&] {
      double sum = 0.;
      for (std::size_t i = 0; i < rows.size(); ++i)
        sum += error[i] * product(i);
      return sum;
    };
    double before = 0.;
    for (unsigned int sweep = 0; sweep < n_sweeps; ++sweep)
      {
        if (sweep + 1 == n_sweeps)
          before = energy();
        for (std::size_t i = 0; i < rows.size(); ++i)
          error[i] -= inverse[i] * product(i);
        for (std::size_t i = rows.size(); i-- > 0;)
          error[i] -= inverse[i] * product(i);
      }
    return before > 0. ? std::sqrt(std::max(0., energy() / before)) : 0.;
  }



  void StrongBlocks::drop_within(const std::vector<bool> &rows)
  {
    std::vector<bool> is_dropped(blocks.size(), false);
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        is_dropped[b] = std::all_of(blocks[b].rows.begin(), blocks[b].rows.end(),
                                    [&](const unsigned int row) { return rows[row]; });
        if (is_dropped[b])
          for (const unsigned int row : blocks[b].rows)
            block_of_row[row] = -1;
      }
    bool any = false;
    for (auto &phase : phases)
      {
        phase.erase(
            std::remove_if(phase.begin(), phase.end(), [&](const unsigned int b) { return is_dropped[b]; }),
            phase.end());
        any = any || !phase.empty();
      }
    is_empty = Utilities::MPI::max(static_cast<int>(any), matrix.partition().communicator()) == 0;
  }



  void StrongBlocks::update(const std::vector<unsigned int> &rows)
  {
    for (const unsigned int row : rows)
      if (block_of_row[row] >= 0)
        blocks[block_of_row[row]].is_current = false;
  }



  void StrongBlocks::factorize(Block &block, const HalfSpaces &half_spaces,
                               const std::vector<int>           &half_space_of_row,
                               const std::vector<unsigned char> &active)
  {
    const auto normal_of = [&](const unsigned int row) {
      const int p = half_space_of_row[row];
      return p >= 0 && active[p] ? half_spaces.normals[p] : Vector3();
    };
    const auto                          size     = static_cast<Eigen::Index>(dim * block.rows.size());
    const bool                          is_dense = block.rows.size() <= largest_dense;
    Eigen::MatrixXd                     full;
    std::vector<Eigen::Triplet<double>> entries;
    if (is_dense)
      full = Eigen::MatrixXd::Zero(size, size);
    const int index = block_of_row[block.rows[0]];
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      {
        const unsigned int row        = block.rows[i];
        const Vector3      row_normal = normal_of(row);
        for (const BlockRange &range : matrix.ranges(row))
          for (std::size_t k = range.begin; k < range.end; ++k)
            {
              const unsigned int column = matrix.column(k);
              if (column >= matrix.n_rows() || block_of_row[column] != index)
                continue;
              const std::size_t j = place_in_block[column];
              const auto        entry =
                  restrict_to_planes(matrix.block(k), row_normal, normal_of(column), row == column);
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  if (is_dense)
                    full(dim * i + c, dim * j + d) = entry[c][d];
                  else
                    entries.emplace_back(dim * i + c, dim * j + d, entry[c][d]);
            }
      }
    if (is_dense)
      {
        block.dense.compute(full);
        block.is_definite = block.dense.info() == Eigen::Success;
      }
    else
      {
        Eigen::SparseMatrix<double> sparse(size, size);
        sparse.setFromTriplets(entries.begin(), entries.end());
        if (!block.sparse)
          {
            block.sparse = std::make_unique<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>();
            block.sparse->analyzePattern(sparse);
          }
        block.sparse->factorize(sparse);
        block.is_definite = block.sparse->info() == Eigen::Success;
      }
    block.is_current = true;
  }



  void StrongBlocks::relax(Vector &v, const Vector &rhs, Block &block, const HalfSpaces &half_spaces,
                           const std::vector<int>           &half_space_of_row,
                           const std::vector<unsigned char> &active)
  {
    std::vector<unsigned char> flags;
    for (const unsigned int row : block.rows)
      if (const int p = half_space_of_row[row]; p >= 0)
        flags.push_back(active[p]);
    if (!block.is_current || flags != block.flags)
      {
        block.flags = flags;
        factorize(block, half_spaces, half_space_of_row, active);
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
        if (const int p = half_space_of_row[row]; p >= 0 && active[p])
          {
            const Vector3 &n      = half_spaces.normals[p];
            const double   normal = n[0] * s[0] + n[1] * s[1] + n[2] * s[2];
            for (unsigned int c = 0; c < dim; ++c)
              s[c] -= normal * n[c];
          }
        for (unsigned int c = 0; c < dim; ++c)
          residual[dim * i + c] = s[c];
      }
    const Eigen::VectorXd step = block.sparse ? Eigen::VectorXd(block.sparse->solve(residual))
                                              : Eigen::VectorXd(block.dense.solve(residual));

    double length = 1.;
    for (std::size_t i = 0; i < block.rows.size(); ++i)
      if (const int p = half_space_of_row[block.rows[i]]; p >= 0 && !active[p])
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



  void StrongBlocks::sweep(Vector &v, const Vector &rhs, const bool forward, const HalfSpaces &half_spaces,
                           const std::vector<int>           &half_space_of_row,
                           const std::vector<unsigned char> &active)
  {
    if (is_empty)
      return;
    for (std::size_t i = 0; i < phases.size(); ++i)
      {
        v.update_ghost_values();
        const auto &list = phases[forward ? i : phases.size() - 1 - i];
        const auto  n    = list.size();
        for (std::size_t k = 0; k < n; ++k)
          relax(v, rhs, blocks[list[forward ? k : n - 1 - k]], half_spaces, half_space_of_row, active);
      }
  }
} // namespace Signorini
