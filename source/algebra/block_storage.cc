// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_storage.h>

#include <cmath>
#include <new>

namespace Signorini
{
  namespace
  {
    constexpr std::size_t n_entries = 9;
    /// What kernels read behind the last number that is split.
    constexpr std::size_t n_behind = 8;

    /// Zero where single precision has fewer digits: nothing beside the numbers that a matrix is split for.
    float to_single(const double x)
    {
      return std::abs(x) < std::numeric_limits<float>::min() ? 0.f : static_cast<float>(x);
    }

    /// For put_together(): exact. (By std::ilogb() and std::ldexp() splitting took ten sweeps.)
    std::int32_t remainder(const double x, const float rounded)
    {
      constexpr std::uint64_t exponent = 0x7ff0000000000000, twice_of_one = 0x7fe0000000000000;
      if (rounded == 0.f || !std::isfinite(rounded))
        return 0;
      const double  y = rounded;
      std::uint64_t bits;
      std::memcpy(&bits, &y, sizeof(bits));
      bits = twice_of_one - (bits & exponent);
      double inverse_power;
      std::memcpy(&inverse_power, &bits, sizeof(bits));
      return static_cast<std::int32_t>((x - y) / unit_of_remainders * inverse_power);
    }

    template <typename Pointer>
    Pointer *checked(Pointer *const memory)
    {
      if (memory == nullptr)
        throw std::bad_alloc();
      return memory;
    }
  } // namespace



  std::size_t BlockStorage::n_bytes_of(const std::size_t first_split, const std::size_t n_blocks)
  {
    if (first_split >= n_blocks)
      return n_exact_bytes(n_blocks);
    return n_exact_bytes(first_split) + (n_entries * (n_blocks - first_split) + n_behind) * sizeof(float);
  }



  BlockStorage::BlockStorage(const BlockStorage &other)
    : n_blocks(other.n_blocks)
    , first_split(other.first_split)
    , remainders(other.remainders)
  {
    if (other.memory == nullptr)
      return;
    const std::size_t n = n_bytes_of(first_split, n_blocks);
    memory.reset(checked(static_cast<unsigned char *>(std::malloc(n))));
    std::memcpy(memory.get(), other.memory.get(), n);
  }



  BlockStorage &BlockStorage::operator=(const BlockStorage &other)
  {
    return *this = BlockStorage(other);
  }



  void BlockStorage::reinit(const std::size_t n)
  {
    *this    = BlockStorage();
    n_blocks = n;
    memory.reset(checked(static_cast<unsigned char *>(std::calloc(n_exact_bytes(n), 1))));
  }



  void BlockStorage::split(const std::size_t first)
  {
    Assert(!is_split(), dealii::ExcInternalError());
    if (first >= n_blocks)
      return;
    const std::size_t n = n_entries * (n_blocks - first);
    remainders.assign(n + n_behind, 0);
    const unsigned char *from = memory.get() + n_entries * sizeof(double) * first;
    unsigned char       *to   = memory.get() + n_exact_bytes(first);
    // A block takes the place of what was read before: half its length, and behind the first one a number
    // more.
    for (std::size_t k = 0; k < n; k += n_entries)
      {
        double exact[n_entries];
        float  rounded[n_entries];
        std::memcpy(exact, from, sizeof(exact));
        for (std::size_t c = 0; c < n_entries; ++c)
          {
            rounded[c]        = to_single(exact[c]);
            remainders[k + c] = remainder(exact[c], rounded[c]);
          }
        std::memcpy(to, rounded, sizeof(rounded));
        from += sizeof(exact);
        to += sizeof(rounded);
      }
    std::memset(to, 0, n_behind * sizeof(float));
    std::memset(memory.get() + n_exact_bytes(first) - sizeof(double), 0, sizeof(double));
    first_split              = first;
    unsigned char *const all = memory.release();
    // Made shorter, it stays where it is.
    memory.reset(checked(static_cast<unsigned char *>(std::realloc(all, n_bytes_of(first, n_blocks)))));
  }



  void BlockStorage::join()
  {
    if (!is_split())
      return;
    BlockStorage       joined;
    const BlockNumbers here = numbers();
    joined.reinit(n_blocks);
    for (std::size_t k = 0; k < n_blocks; ++k)
      here.read(joined.exact(k), k);
    *this = std::move(joined);
  }
} // namespace Signorini
