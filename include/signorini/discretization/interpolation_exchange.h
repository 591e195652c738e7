// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_interpolation_exchange_h
#define signorini_discretization_interpolation_exchange_h

#include <signorini/mesh/nodal_space.h>

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// A hexahedron of a coarse space as a fine one sees it: for each of its 8 vertices the conforming nodes
  /// and weights it depends on (hanging vertices resolved).
  struct CellInterpolation
  {
    /// Vertex v depends on nodes[start[v]] ... nodes[start[v + 1] - 1], with these weights.
    std::array<unsigned int, 9> start;
    std::vector<NodeIndex>      nodes;
    std::vector<double>         weights;
  };

  /// For messages between ranks.
  template <typename Archive>
  void transfer(Archive &archive, CellInterpolation &cell)
  {
    archive(cell.start, cell.nodes, cell.weights);
  }

  /// Finds, for owned hexahedra of a fine space, the cell of a coarse space that contains them: the same cell
  /// or its parent. Cells that live on another rank are looked up through a directory: the rank that a
  /// hash of the cell's name points to knows the owner.
  class ParentLookup
  {
  public:
    /// Collective.
    ParentLookup(const NodalSpace &fine, const NodalSpace &coarse);

    /// The coarse cell and which child of it the given owned fine cell is (-1: the same cell).
    std::pair<const CellInterpolation *, int> find(const NodalSpace::Cell &cell) const;

    /// A cell's name: coarse cell and path of children, with a leading 1.
    struct Key
    {
      /// As NodalSpace::Cell has it.
      std::uint64_t coarse_cell, path;

      /// Whether it is the same cell.
      bool operator==(const Key &other) const
      {
        return coarse_cell == other.coarse_cell && path == other.path;
      }
    };

    /// Spreads names over tables and ranks.
    struct Hash
    {
      /// The same number on all ranks.
      std::size_t operator()(const Key &key) const
      {
        // Multiplicative mixing (constants of splitmix64).
        std::uint64_t h = key.path * 0x9e3779b97f4a7c15ull ^ key.coarse_cell * 0xbf58476d1ce4e5b9ull;
        h ^= h >> 29;
        return h * 0x94d049bb133111ebull >> 8;
      }
    };

  private:
    void collect_own_cells(const NodalSpace &coarse);

    /// Collective. As the directory: by rank that asks for cells, their names and owners.
    std::map<unsigned int, std::vector<std::pair<Key, unsigned int>>>
    answer_for_owners(const NodalSpace &fine) const;
    /// Collective. The owners send the cells.
    void fetch_remote_cells(const NodalSpace &fine);

    std::unordered_map<Key, unsigned int, Hash> index;
    std::vector<CellInterpolation>              cells;
  };

  /// For messages between ranks.
  template <typename Archive>
  void transfer(Archive &archive, ParentLookup::Key &key)
  {
    archive(key.coarse_cell, key.path);
  }
} // namespace Signorini

#endif
