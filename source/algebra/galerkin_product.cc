// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/algebra/galerkin_product.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The sparsity of the owned rows of A P, with local coarse columns.
    void product_pattern(std::vector<std::size_t> &start, std::vector<unsigned int> &columns,
                         const NodeBlockMatrix &matrix, const NodalTransfer &transfer,
                         const unsigned int n_coarse)
    {
      std::vector<unsigned int> seen(n_coarse, numbers::invalid_unsigned_int);
      start.assign(1, 0);
      start.reserve(matrix.n_rows() + 1);
      columns.reserve(16 * static_cast<std::size_t>(matrix.n_rows()));
      std::vector<unsigned int> row(n_coarse + 1);
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        {
          unsigned int n = 0;
          matrix.visit_row(i, [&](const RowEntry &entry) {
            for (std::size_t l = transfer.row_begin(entry.column); l < transfer.row_end(entry.column); ++l)
              {
                // Written in any case: cheaper than a branch that is hard to predict.
                const unsigned int column = transfer.column(l);
                row[n]                    = column;
                n += seen[column] != i;
                seen[column] = i;
              }
          });
          columns.insert(columns.end(), row.begin(), row.begin() + n);
          start.push_back(columns.size());
        }
    }



    /// For each local coarse node the owned fine rows that depend on it.
    void transpose_pattern(std::vector<std::size_t> &start, std::vector<unsigned int> &rows,
                           const NodalTransfer &transfer, const unsigned int n_coarse)
    {
      start.assign(n_coarse + 1, 0);
      const std::size_t end = transfer.row_end(transfer.n_owned_rows() - 1);
      for (std::size_t k = 0; k < end; ++k)
        ++start[transfer.column(k) + 1];
      std::partial_sum(start.begin(), start.end(), start.begin());
      rows.resize(end);
      std::vector<std::size_t> next(start.begin(), start.end() - 1);
      for (unsigned int i = 0; i < transfer.n_owned_rows(); ++i)
        for (std::size_t k = transfer.row_begin(i); k < transfer.row_end(i); ++k)
          rows[next[transfer.column(k)]++] = i;
    }



    /// The sparsity of Pᵀ A P, of owned rows and of those of other ranks that owned fine rows contribute to.
    NodePattern coarse_pattern(const NodeBlockMatrix &matrix, const NodalTransfer &transfer,
                               const NodePartition &coarse)
    {
      std::vector<std::size_t>  product_start, fine_start(coarse.n_local() + 1, 0);
      std::vector<unsigned int> product_columns, fine_rows;
      if (matrix.n_rows() > 0)
        {
          product_pattern(product_start, product_columns, matrix, transfer, coarse.n_local());
          transpose_pattern(fine_start, fine_rows, transfer, coarse.n_local());
        }
      NodePattern               pattern;
      std::vector<unsigned int> seen(coarse.n_local(), numbers::invalid_unsigned_int);
      std::vector<unsigned int> columns(coarse.n_local() + 1);
      for (unsigned int row = 0; row < coarse.n_local(); ++row)
        {
          if (row >= coarse.n_owned())
            {
              if (fine_start[row] == fine_start[row + 1])
                continue;
              pattern.foreign_rows.push_back(coarse.to_global(row));
            }
          unsigned int n = 0;
          for (std::size_t l = fine_start[row]; l < fine_start[row + 1]; ++l)
            for (std::size_t k = product_start[fine_rows[l]]; k < product_start[fine_rows[l] + 1]; ++k)
              {
                columns[n] = product_columns[k];
                n += seen[product_columns[k]] != row;
                seen[product_columns[k]] = row;
              }
          for (unsigned int k = 0; k < n; ++k)
            pattern.columns.push_back(coarse.to_global(columns[k]));
          pattern.row_start.push_back(pattern.columns.size());
        }
      return pattern;
    }
  } // namespace



  void reinit_galerkin(NodeBlockMatrix &coarse_matrix, const NodeBlockMatrix &matrix, NodalTransfer &transfer,
                       const IndexSet &owned_coarse_nodes)
  {
    const MPI_Comm communicator = matrix.partition().communicator();
    const IndexSet foreign      = transfer.foreign_coarse_nodes(owned_coarse_nodes);
    const auto     coarse       = std::make_shared<NodePartition>(owned_coarse_nodes, foreign, communicator);
    transfer.localize(coarse);
    coarse_matrix.reinit(owned_coarse_nodes, coarse_pattern(matrix, transfer, *coarse), foreign,
                         communicator);
    transfer.localize(coarse_matrix.shared_partition());
  }



  namespace GalerkinKernels
  {
    constexpr unsigned int n_entries = dim * dim;

    /// A row of blocks under construction. place[column] is where the block of a coarse node begins in
    /// `blocks`; 0 stands for nodes that do not occur, and for a block of zeros.
    struct Row
    {
      std::vector<int>          place;
      std::vector<unsigned int> columns;
      std::vector<double>       blocks;
    };

    inline __attribute__((always_inline)) double *find(double *const blocks, int *const place,
                                                       unsigned int *const columns, unsigned int &n_columns,
                                                       const unsigned int column)
    {
      double *block = blocks + place[column];
      if (block == blocks)
        {
          columns[n_columns++] = column;
          place[column]        = static_cast<int>(n_entries * n_columns);
          block                = blocks + n_entries * n_columns;
          std::fill_n(block, n_entries, 0.);
        }
      return block;
    }

    /// Consecutive blocks of a row of a matrix, with their columns.
    struct Blocks
    {
      const double       *numbers;
      const unsigned int *columns;
      std::size_t         n;
    };

    /// Blocks of a matrix, all rows of a scalar transfer.
    struct Factors
    {
      Blocks              blocks;
      const std::size_t  *row_start;
      const unsigned int *p_columns;
      const double       *p_weights;
    };

    /// Writes n blocks that are in memory transposed one behind the other.
    SIGNORINI_VECTORIZED
    void copy_mirrored(double *to, const MirroredBlocks &from)
    {
      for (std::size_t m = 0; m < from.n; ++m, to += n_entries)
        {
          double a[n_entries];
          from.blocks.read(a, from.positions[m]);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              to[dim * c + d] = a[dim * d + c];
        }
    }

    /// row += Σ_k A_k P_k: blocks of a row of A times scalar rows of P. Returns the number of columns,
    /// n_columns of which were there before.
    SIGNORINI_VECTORIZED
    unsigned int multiply_scalar_rows(Row &row, unsigned int n_columns, const Factors &factors)
    {
      // Copies: what is written to the row could change what is behind a reference.
      const Factors       f       = factors;
      double *const       blocks  = row.blocks.data();
      int *const          place   = row.place.data();
      unsigned int *const columns = row.columns.data();
      for (std::size_t k = 0; k < f.blocks.n; ++k)
        for (std::size_t l = f.row_start[f.blocks.columns[k]]; l < f.row_start[f.blocks.columns[k] + 1]; ++l)
          add_scaled_block(find(blocks, place, columns, n_columns, f.p_columns[l]), f.p_weights[l],
                           f.blocks.numbers + n_entries * k);
      return n_columns;
    }

    /// A row of the coarse matrix += weight * row, also where the row is zero: cheaper than a branch that is
    /// hard to predict.
    SIGNORINI_VECTORIZED
    void add_row(double *const sums, const unsigned int *const columns, const std::size_t n,
                 const double weight, const double *const blocks, const int *const place)
    {
      for (std::size_t k = 0; k < n; ++k)
        add_scaled_block(sums + n_entries * k, weight, blocks + place[columns[k]]);
    }

    /// The same for a row that is zero nearly everywhere.
    SIGNORINI_VECTORIZED
    void add_sparse_row(double *const sums, const unsigned int *const columns, const std::size_t n,
                        const double weight, const double *const blocks, const int *const place)
    {
      for (std::size_t k = 0; k < n; ++k)
        if (place[columns[k]] != 0)
          add_scaled_block(sums + n_entries * k, weight, blocks + place[columns[k]]);
    }

    /// A row of the coarse matrix += diag(w) * row.
    SIGNORINI_VECTORIZED
    void add_row_times_diagonal(double *const sums, const unsigned int *const columns, const std::size_t n,
                                const double *const w, const double *const blocks, const int *const place)
    {
      for (std::size_t k = 0; k < n; ++k)
        add_diagonal_times_block(sums + n_entries * k, w, blocks + place[columns[k]]);
    }
  } // namespace GalerkinKernels



  namespace
  {
    /// One row of A P, truncated to the plane of the row of P, as blocks of the coarse nodes it touches.
    class ProductRow
    {
    public:
      explicit ProductRow(const unsigned int n_coarse)
      {
        row.place.assign(n_coarse, 0);
      }

      void compute(const NodeBlockMatrix &matrix, const NodalTransfer &transfer, const unsigned int i)
      {
        clear(matrix, transfer, i);
        const MirroredBlocks mirrored = matrix.mirrored_blocks(i);
        turned.resize(n_entries * mirrored.n);
        GalerkinKernels::copy_mirrored(turned.data(), mirrored);
        const auto   stored    = matrix.stored(i);
        unsigned int n_columns = 0;
        add_blocks(n_columns, blocks_of(matrix, stored[0]), transfer);
        add_blocks(n_columns, blocks_of(matrix, stored[1]), transfer);
        add_blocks(n_columns, {turned.data(), mirrored.columns, mirrored.n}, transfer);
        add_blocks(n_columns, blocks_of(matrix, stored[2]), transfer);
        row.columns.resize(n_columns);
        if (const Vector3 *const n = transfer.plane(i))
          restrict_to_plane(*n);
      }

      /// Adds weight * this row, or pᵀ times this row, to what a row of the coarse matrix has in memory.
      void add_to(NodeBlockMatrix &coarse, const unsigned int coarse_row, const double weight,
                  const Block *p) const
      {
        const auto  stored   = coarse.stored(coarse_row);
        std::size_t n_blocks = 0;
        for (const BlockRange &range : stored)
          n_blocks += range.size();
        const bool is_sparse = n_blocks > 2 * row.columns.size();
        for (const BlockRange &range : stored)
          if (p == nullptr)
            (is_sparse ? GalerkinKernels::add_sparse_row : GalerkinKernels::add_row)(
                coarse.block(range.begin), coarse.column_data() + range.begin, range.size(), weight,
                row.blocks.data(), row.place.data());
          else if (is_diagonal(*p))
            {
              const double w[dim] = {(*p)[0][0], (*p)[1][1], (*p)[2][2]};
              GalerkinKernels::add_row_times_diagonal(coarse.block(range.begin),
                                                      coarse.column_data() + range.begin, range.size(), w,
                                                      row.blocks.data(), row.place.data());
            }
          else
            for (std::size_t k = range.begin; k < range.end; ++k)
              {
                const double *const x = row.blocks.data() + row.place[coarse.column(k)];
                double *const       y = coarse.block(k);
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int d = 0; d < dim; ++d)
                    y[dim * c + d] +=
                        (*p)[0][c] * x[d] + (*p)[1][c] * x[dim + d] + (*p)[2][c] * x[2 * dim + d];
              }
      }

    private:
      static constexpr unsigned int n_entries = GalerkinKernels::n_entries;

      /// The usual blocks: some directions are fixed.
      static bool is_diagonal(const Block &block)
      {
        return block[0][1] == 0. && block[0][2] == 0. && block[1][0] == 0. && block[1][2] == 0. &&
               block[2][0] == 0. && block[2][1] == 0.;
      }

      static bool is_scalar(const NodalTransfer &transfer, const unsigned int row)
      {
        return transfer.row_blocks(row) == nullptr && transfer.plane(row) == nullptr;
      }

      /// Blocks that are split are put together in `whole`.
      GalerkinKernels::Blocks blocks_of(const NodeBlockMatrix &matrix, const BlockRange &range)
      {
        const unsigned int *const columns = matrix.column_data() + range.begin;
        const BlockNumbers        numbers = matrix.block_data();
        if (range.size() == 0 || range.begin < numbers.first_split)
          return {numbers.exact + n_entries * range.begin, columns, range.size()};
        whole.resize(n_entries * range.size());
        for (std::size_t k = range.begin; k < range.end; ++k)
          numbers.read(whole.data() + n_entries * (k - range.begin), k);
        return {whole.data(), columns, range.size()};
      }

      void add_blocks(unsigned int &n_columns, const GalerkinKernels::Blocks &blocks,
                      const NodalTransfer &transfer)
      {
        for (std::size_t k = 0; k < blocks.n;)
          {
            std::size_t end = k;
            while (end < blocks.n && is_scalar(transfer, blocks.columns[end]))
              ++end;
            if (end > k)
              n_columns = GalerkinKernels::multiply_scalar_rows(
                  row, n_columns,
                  {{blocks.numbers + n_entries * k, blocks.columns + k, end - k},
                   transfer.row_start_data(),
                   transfer.column_data(),
                   transfer.weight_data()});
            if (end < blocks.n)
              multiply_row(n_columns, blocks.columns[end], blocks.numbers + n_entries * end, transfer);
            k = end + 1;
          }
      }

      /// Forgets the last row, with room for row i.
      void clear(const NodeBlockMatrix &matrix, const NodalTransfer &transfer, const unsigned int i)
      {
        for (const unsigned int column : row.columns)
          row.place[column] = 0;
        std::size_t n_terms = 0;
        matrix.visit_row(i, [&](const RowEntry &entry) {
          n_terms += transfer.row_end(entry.column) - transfer.row_begin(entry.column);
        });
        row.columns.resize(n_terms);
        // Never made shorter: growing again would fill it with zeros.
        if (row.blocks.size() < n_entries * (n_terms + 1))
          row.blocks.resize(n_entries * (n_terms + 1));
        std::fill_n(row.blocks.begin(), n_entries, 0.);
      }

      void restrict_to_plane(const Vector3 &n)
      {
        for (std::size_t b = 1; b <= row.columns.size(); ++b)
          for (unsigned int d = 0; d < dim; ++d)
            {
              double *const x      = row.blocks.data() + n_entries * b + d;
              const double  normal = n[0] * x[0] + n[1] * x[dim] + n[2] * x[2 * dim];
              for (unsigned int c = 0; c < dim; ++c)
                x[dim * c] -= normal * n[c];
            }
      }

      /// Adds the product of a block with row j of P, which has blocks or a plane.
      void multiply_row(unsigned int &n_columns, const unsigned int j, const double *const block,
                        const NodalTransfer &transfer)
      {
        double a[n_entries];
        std::copy_n(block, n_entries, a);
        if (const Vector3 *const n = transfer.plane(j))
          for (unsigned int c = 0; c < dim; ++c)
            project_to_plane(*n, a + dim * c);
        const Block *const b = transfer.row_blocks(j);
        for (std::size_t l = transfer.row_begin(j); l < transfer.row_end(j); ++l)
          {
            double *const y = GalerkinKernels::find(row.blocks.data(), row.place.data(), row.columns.data(),
                                                    n_columns, transfer.column(l));
            if (b == nullptr)
              add_scaled_block(y, transfer.weight(l), a);
            else
              add_product(y, a, b[l - transfer.row_begin(j)]);
          }
      }

      /// y += a p, blocks.
      static void add_product(double *const y, const double *const a, const Block &p)
      {
        if (is_diagonal(p))
          {
            const double w[dim] = {p[0][0], p[1][1], p[2][2]};
            add_block_times_diagonal(y, a, w);
            return;
          }
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            y[dim * c + d] += a[dim * c] * p[0][d] + a[dim * c + 1] * p[1][d] + a[dim * c + 2] * p[2][d];
      }

      GalerkinKernels::Row row;
      /// The mirrored blocks of a row of A, and those below the diagonal where they are split.
      std::vector<double> turned, whole;
    };
  } // namespace



  void compute_galerkin(NodeBlockMatrix &coarse_matrix, const NodeBlockMatrix &matrix,
                        const NodalTransfer &transfer, const std::vector<unsigned char> &marked)
  {
    const NodePartition &coarse = coarse_matrix.partition();
    for (unsigned int i = 0; i < coarse.n_local(); ++i)
      if (const unsigned int row = coarse_matrix.row_of(i);
          row != numbers::invalid_unsigned_int && (marked.empty() || marked[i]))
        coarse_matrix.clear_row(row);

    ProductRow product(coarse.n_local());
    for (unsigned int i = 0; i < matrix.n_rows(); ++i)
      {
        bool wanted = marked.empty();
        for (std::size_t k = transfer.row_begin(i); !wanted && k < transfer.row_end(i); ++k)
          wanted = marked[transfer.column(k)];
        if (!wanted || transfer.row_begin(i) == transfer.row_end(i))
          continue;
        product.compute(matrix, transfer, i);
        const Block *b = transfer.row_blocks(i);
        for (std::size_t k = transfer.row_begin(i); k < transfer.row_end(i); ++k)
          if (marked.empty() || marked[transfer.column(k)])
            product.add_to(coarse_matrix, coarse_matrix.row_of(transfer.column(k)), transfer.weight(k),
                           b == nullptr ? nullptr : b + (k - transfer.row_begin(i)));
      }
    coarse_matrix.compress();
  }



  std::vector<unsigned char> mark_coarse_nodes(const NodalTransfer             &transfer,
                                               const std::vector<unsigned int> &fine_rows)
  {
    const NodePartition &coarse = transfer.coarse_partition();
    Vector               flags;
    coarse.reinit(flags);
    for (const unsigned int row : fine_rows)
      for (std::size_t k = transfer.row_begin(row); k < transfer.row_end(row); ++k)
        flags.local_element(dim * transfer.column(k)) = 1.;
    flags.compress(VectorOperation::add);
    flags.update_ghost_values();
    std::vector<unsigned char> marked(coarse.n_local());
    for (unsigned int i = 0; i < coarse.n_local(); ++i)
      marked[i] = flags.local_element(dim * i) > 0.;
    return marked;
  }
} // namespace Signorini
