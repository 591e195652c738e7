// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_disjoint_sets_h
#define signorini_algebra_disjoint_sets_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// Disjoint sets of numbers, each called by its smallest one, in whatever order they are put together
  /// (boost::disjoint_sets calls them by any).
  class DisjointSets
  {
  public:
    /// Every number below `size` is a set of its own.
    explicit DisjointSets(const std::size_t size)
      : parent(size)
    {
      std::iota(parent.begin(), parent.end(), std::size_t(0));
    }

    /// The smallest number of the set of a number.
    std::size_t find(std::size_t i)
    {
      while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
      return i;
    }

    /// Puts the sets of two numbers together.
    void unite(const std::size_t i, const std::size_t j)
    {
      const std::size_t a = find(i), b = find(j);
      parent[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::size_t> parent;
  };

  /// The same for a few of very many numbers.
  template <typename Number>
  class SparseDisjointSets
  {
  public:
    /// The smallest number of the set of a number.
    Number find(const Number number)
    {
      Number result = number;
      for (auto it = parent.find(result); it != parent.end(); it = parent.find(result))
        result = it->second;
      if (result != number)
        parent[number] = result;
      return result;
    }

    /// Puts the sets of two numbers together.
    void unite(const Number i, const Number j)
    {
      const Number a = find(i), b = find(j);
      if (a != b)
        parent[std::max(a, b)] = std::min(a, b);
    }

  private:
    /// Of numbers that are not the smallest of their sets.
    std::unordered_map<Number, Number> parent;
  };
} // namespace Signorini

#endif
