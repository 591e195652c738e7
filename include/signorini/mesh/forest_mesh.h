// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_forest_mesh_h
#define signorini_mesh_forest_mesh_h

#include <signorini/mesh/tetrahedron_bisection.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace Signorini
{
  /// What a cell weighs in the partition.
  using CellWeight = std::function<unsigned int(const Tetrahedron &cell)>;

  /// What a rank sees of a mesh of a TetrahedralForest: its own cells, a contiguous piece of a space-filling
  /// curve, and as ghosts all others that share a vertex with one of them.
  ///
  /// Vertices have names that are the same on all ranks, on any number of ranks and in all meshes of the
  /// forest: those of mesh l are 0 ... n_vertices(l) - 1.
  struct ForestMesh
  {
    /// A name of a vertex.
    using Name = std::uint64_t;
    /// The corners of the smallest edge, face or cell of the start mesh that a vertex is on at first,
    /// ascending, then `none`.
    using Carrier = std::array<unsigned int, 4>;
    /// No corner.
    static constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /// Own and ghost cells in the order of the curve; their vertices count in the lists below.
    std::vector<Tetrahedron> cells;
    /// Numbers of these cells among those of all ranks along the curve.
    std::vector<std::uint64_t> cell_numbers;
    /// The own cells are cells[first_owned] ... cells[first_owned + n_owned - 1].
    std::size_t first_owned = 0, n_owned = 0;
    /// Number of the first cell of each rank, and of all cells.
    std::vector<std::uint64_t> first_cell;

    /// Names of the vertices of these cells, ascending.
    std::vector<Name> vertices;
    /// Where they are (length), and on what of the start mesh they were made.
    std::vector<dealii::Point<3>> points;
    std::vector<Carrier>          carriers;
    /// Marks that go with vertices from mesh to mesh; new ones have none.
    std::vector<bool> is_marked;
    /// Numbers of the vertices in the order in which they come up first along the curve. A vertex belongs to
    /// the first rank that has one of its cells: number of the first vertex of each rank, and of all
    /// vertices.
    std::vector<std::uint64_t> vertex_numbers;
    std::vector<std::uint64_t> first_vertex;

    /// Number of cells of all ranks.
    std::uint64_t n_global_cells() const
    {
      return first_cell.back();
    }

    /// Whether cells[c] belongs to this rank.
    bool is_owned(const std::size_t c) const
    {
      return c - first_owned < n_owned;
    }

    /// The rank that cells[c] belongs to.
    unsigned int owner(const std::size_t c) const;

    /// Whether vertices[v] belongs to a rank.
    bool owns_vertex(const unsigned int rank, const unsigned int v) const
    {
      return vertex_numbers[v] >= first_vertex[rank] && vertex_numbers[v] < first_vertex[rank + 1];
    }

    /// The place of a vertex in the list, or `none`.
    unsigned int find(const Name vertex) const;

    /// Bytes of all lists.
    std::size_t memory_consumption() const;
  };
} // namespace Signorini

#endif
