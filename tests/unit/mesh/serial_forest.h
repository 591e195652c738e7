// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef tests_mesh_serial_forest_h
#define tests_mesh_serial_forest_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <functional>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// What TetrahedralForest is compared with: the same meshes, whole on every rank.
  ///
  /// Conforming meshes of tetrahedra, each refined from the one before by bisection (Arnold, Mukherjee,
  /// Pouly: Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000)). It takes any
  /// conforming start mesh, and the descendants of a tetrahedron have finitely many shapes.
  class SerialForest
  {
  public:
    /// The id of a face between two cells.
    static constexpr dealii::types::boundary_id inner = dealii::numbers::internal_face_boundary_id;

    /// A tetrahedron of one of the meshes.
    struct Cell
    {
      /// Positive orientation. Face f is opposite to vertex f.
      std::array<unsigned int, 4>               vertices;
      std::array<dealii::types::boundary_id, 4> boundary;
      unsigned int                              material;
      /// Number of bisections since the start mesh.
      unsigned int generation = 0;
    };

    /// A new vertex and a boundary its edge lies on.
    using BoundaryVertices = std::vector<std::pair<unsigned int, dealii::types::boundary_id>>;

    /// Cells of positive orientation, conforming (every face belongs to two cells or carries a boundary id).
    SerialForest(const std::vector<dealii::Point<3>> &vertices, const std::vector<Cell> &cells);

    /// Number of meshes.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(levels.size());
    }

    /// The cells of a mesh; level 0 is the start mesh.
    const std::vector<Cell> &cells(const unsigned int level) const
    {
      return levels[level].cells;
    }

    /// The vertices of a mesh are the first n_vertices of all.
    unsigned int n_vertices(const unsigned int level) const
    {
      return levels[level].n_vertices;
    }

    /// Positions (length) of the vertices of all meshes.
    const std::vector<dealii::Point<3>> &vertices() const
    {
      return points;
    }

    /// The edge whose midpoint a vertex was at first; twice the vertex itself for those of the start mesh.
    const std::array<unsigned int, 2> &parents(const unsigned int vertex) const
    {
      return vertex_parents[vertex];
    }

    /// Makes a new mesh: marked cells of the last one are bisected three times (each edge once), others as
    /// often as needed to have no hanging nodes. False if nothing is marked.
    bool refine(const std::vector<bool> &marked);

    /// Boundaries of the vertices that the last refinement made, sorted.
    const BoundaryVertices &new_boundary_vertices() const
    {
      return new_on_boundary;
    }

    /// Vertices may be moved.
    std::vector<dealii::Point<3>> &vertices()
    {
      return points;
    }

    /// The part of the cells of a mesh that a rank owns: from first to second.
    std::pair<std::size_t, std::size_t> owned_cells(const unsigned int level, const unsigned int rank,
                                                    const unsigned int n_ranks) const
    {
      const std::size_t n = levels[level].cells.size();
      return {n * rank / n_ranks, n * (rank + 1) / n_ranks};
    }

  private:
    /// An edge of a cell as two of its vertices' positions 0-3.
    using Edge = std::array<unsigned char, 2>;

    /// What bisection has to know about a cell.
    struct Marking
    {
      /// The marked edge of each face; the refinement edge is that of two faces.
      std::array<Edge, 4> face_edge;
      Edge                refinement_edge;
      bool                flag;
    };

    struct Level
    {
      std::vector<Cell> cells;
      unsigned int      n_vertices;
    };

    struct WorkItem
    {
      Cell         cell;
      Marking      marking;
      unsigned int bisections;
    };

    unsigned int middle_of(const unsigned int a, const unsigned int b);
    bool         has_split_edge(const Cell &cell) const;
    void         bisect(const WorkItem &parent, WorkItem (&children)[2]);
    void         order_cells(std::vector<Cell> &cells, std::vector<Marking> &markings) const;

    std::vector<dealii::Point<3>>            points;
    std::vector<std::array<unsigned int, 2>> vertex_parents;
    std::vector<Level>                       levels;
    /// Of the last mesh.
    std::vector<Marking> markings;
    /// While refining: midpoints of split edges, and which vertices belong to one.
    std::unordered_map<std::uint64_t, unsigned int> middles;
    std::vector<bool>                               at_split_edge;
    BoundaryVertices                                new_on_boundary;
  };
} // namespace Signorini

#endif
