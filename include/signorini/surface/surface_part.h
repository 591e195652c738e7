// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_surface_surface_part_h
#define signorini_surface_surface_part_h

#include <cstddef>
#include <vector>

namespace Signorini
{
  /// Some items of a list, numbered anew in their old order: what is compared by number stays as it is.
  class Renumbering
  {
  public:
    /// An item that is left out.
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    /// @param is_kept by item
    explicit Renumbering(const std::vector<bool> &is_kept)
      : place(is_kept.size(), none)
    {
      for (unsigned int i = 0; i < is_kept.size(); ++i)
        if (is_kept[i])
          {
            place[i] = static_cast<unsigned int>(items.size());
            items.push_back(i);
          }
    }

    /// The new number of an item, or none.
    unsigned int operator[](const unsigned int item) const
    {
      return place[item];
    }

    /// The old numbers of those that are kept, ascending.
    const std::vector<unsigned int> &kept() const
    {
      return items;
    }

    /// Those of a list of values by item that are kept.
    template <typename T>
    std::vector<T> select(const std::vector<T> &values) const
    {
      std::vector<T> result;
      result.reserve(items.size());
      for (const unsigned int i : items)
        result.push_back(values[i]);
      return result;
    }

  private:
    std::vector<unsigned int> place, items;
  };

  /// What the items of a list take, without what they point to.
  template <typename T>
  std::size_t list_bytes(const std::vector<T> &list)
  {
    return list.capacity() * sizeof(T);
  }

  /// A part of a triangulated surface: it has all corners of its triangles.
  struct SurfacePart
  {
    /// What it has of the whole.
    Renumbering vertices, triangles;
  };
} // namespace Signorini

#endif
