// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_background_octree_h
#define signorini_discretization_background_octree_h

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Signorini
{
  /// An octree of cells around some nodes, as fine as their mesh is, and the continuous trilinear functions
  /// on cuts through it (doc/algorithm.md, (39a)). Only cells with nodes in them exist, and neighbours
  /// may differ by more than one level; vertices that hang on a larger cell are eliminated.
  class BackgroundOctree
  {
  public:
    /// A vertex: three integers of 21 bits, in units of the root over 2^20.
    using Vertex = std::uint64_t;

    /// Vertices with their weights (pure numbers, positive, of sum 1).
    using Expansion = std::vector<std::pair<Vertex, double>>;

    /// @param sizes mesh sizes at the nodes (length)
    /// @param first_ratio cells of the finest cut over the mesh size
    BackgroundOctree(const std::vector<dealii::Point<3>> &nodes, const std::vector<double> &sizes,
                     const double first_ratio);

    /// Whether the cut for cells `ratio` times as large as the mesh is the root alone.
    bool is_root(const double ratio) const
    {
      return cells.front().smallest_ratio < ratio;
    }

    /// Where a vertex is.
    dealii::Point<3> position(const Vertex vertex) const;

    /// The leaves whose cells are `ratio` times as large as the mesh, and their functions: nonnegative, of
    /// sum 1; linear functions are reproduced.
    class Cut
    {
    public:
      /// The octree must outlive the object.
      /// @param ratio at least the first one
      Cut(const BackgroundOctree &tree, const double ratio);

      /// The functions at one of the octree's nodes.
      void at_node(Expansion &expansion, const unsigned int node);

      /// The functions at a vertex of this or of a finer cut.
      const Expansion &at_vertex(const Vertex vertex);

    private:
      const Expansion &expand_corner(const unsigned int cell, const unsigned int corner);

      const BackgroundOctree               &tree;
      const double                          ratio;
      std::unordered_map<Vertex, Expansion> known;
      /// Those of the corners of a cell, eight each, null where not yet asked for.
      std::vector<std::array<const Expansion *, 8>> corners;
    };

  private:
    static constexpr unsigned int depth = 20;

    using Place = std::array<std::uint32_t, 3>;

    struct Cell
    {
      /// Lowest vertex and edge in units of the root over 2^depth.
      Place         corner;
      std::uint32_t edge;
      /// The cell is a leaf, or within one, in cuts of a larger ratio than this.
      double smallest_ratio;
      /// Places of the children in `cells`; 0 where there is none.
      std::array<unsigned int, 8> children;
    };

    static constexpr unsigned int no_cell = static_cast<unsigned int>(-1);

    static Vertex vertex_at(const Place &place);
    static Place  place_of(const Vertex vertex);

    /// Divides a cell, whose nodes are those of a range of `order`, until the leaves of the finest cut.
    void divide(const unsigned int cell, const std::vector<double> &log_sizes, const unsigned int begin,
                const unsigned int end, const double first_ratio);

    /// The leaf of a cut that contains a cell of the lowest level, or no_cell.
    unsigned int find_leaf(const Place &place, const double ratio) const;

    /// The largest leaf of a cut around a vertex, or no_cell.
    unsigned int largest_leaf(const Place &vertex, const double ratio) const;

    dealii::Point<3>  origin;
    double            size;
    std::vector<Cell> cells;
    /// Positions in units of the root over 2^depth, sorted by cells.
    std::vector<dealii::Point<3>> scaled;
    /// The nodes by cells, and their cells of the lowest level with interleaved bits.
    std::vector<unsigned int>  order;
    std::vector<std::uint64_t> keys;
  };
} // namespace Signorini

#endif
