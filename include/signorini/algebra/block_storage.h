// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_block_storage_h
#define signorini_algebra_block_storage_h

#include <signorini/algebra/block_row.h>

#include <deal.II/base/exceptions.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <vector>

namespace Signorini
{
  /// Memory for the numbers of 3x3 blocks, in double precision at first. Those behind a position may be split
  /// into numbers in single precision and what is missing then (put_together()): the former are what sweeps
  /// in single precision read, which need no copy then, and nothing is lost but numbers that single precision
  /// has not (below 1e-38).
  class BlockStorage
  {
  public:
    BlockStorage() = default;
    /// A copy is split where the other one is.
    BlockStorage(const BlockStorage &other);
    /// Leaves nothing to read in the other one.
    BlockStorage(BlockStorage &&) = default;
    /// As the constructors.
    BlockStorage &operator=(const BlockStorage &other);
    /// As the constructors.
    BlockStorage &operator=(BlockStorage &&) = default;
    ~BlockStorage()                          = default;

    /// Zeros, in double precision.
    void reinit(const std::size_t n_blocks);

    /// Nine numbers of a block that is not split, and those behind it.
    double *exact(const std::size_t k)
    {
      Assert(k < first_split, dealii::ExcInternalError());
      return reinterpret_cast<double *>(memory.get()) + 9 * k;
    }

    /// The same, to be read.
    const double *exact(const std::size_t k) const
    {
      Assert(k < first_split, dealii::ExcInternalError());
      return reinterpret_cast<const double *>(memory.get()) + 9 * k;
    }

    /// For kernels.
    BlockNumbers numbers() const
    {
      return {reinterpret_cast<const double *>(memory.get()), first_split, rounded(), remainders.data()};
    }

    /// Splits the blocks from a position on. They lie in place until then: at no time there is more than all
    /// of them in double precision and their remainders.
    void split(const std::size_t first);

    /// Whether blocks are split.
    bool is_split() const
    {
      return first_split < n_blocks;
    }

    /// All in double precision again.
    void join();

    /// Bytes in memory of all numbers.
    std::size_t n_bytes() const
    {
      return n_bytes_of(first_split, n_blocks) + remainders.size() * sizeof(std::int32_t);
    }

  private:
    struct Free
    {
      void operator()(unsigned char *const p) const
      {
        std::free(p);
      }
    };

    static std::size_t n_bytes_of(const std::size_t first_split, const std::size_t n_blocks);

    const float *rounded() const
    {
      return is_split() ? reinterpret_cast<const float *>(memory.get() + n_exact_bytes(first_split))
                        : nullptr;
    }

    /// Kernels read a number behind the last block.
    static std::size_t n_exact_bytes(const std::size_t n)
    {
      return (9 * n + 1) * sizeof(double);
    }

    std::size_t n_blocks = 0, first_split = std::numeric_limits<std::size_t>::max();
    /// Of std::calloc(): it can be given back in part. Doubles, and behind them floats.
    std::unique_ptr<unsigned char, Free> memory;
    std::vector<std::int32_t>            remainders;
  };
} // namespace Signorini

#endif
