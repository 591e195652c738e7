// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_tetrahedral_forest_h
#define signorini_mesh_tetrahedral_forest_h

#include <signorini/mesh/forest_mesh.h>
#include <signorini/mesh/vertex_history.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Conforming meshes of tetrahedra, each refined from the one before by bisection (Arnold, Mukherjee,
  /// Pouly: Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22 (2000)). It takes any
  /// conforming start mesh, and the descendants of a tetrahedron have finitely many shapes.
  ///
  /// Distributed: of every mesh a rank holds its own cells and a layer of ghosts (ForestMesh), each mesh
  /// partitioned on its own. Cells, their order and the names of the vertices do not depend on the number of
  /// ranks. Only what the constructor is given is the same on all ranks.
  class TetrahedralForest
  {
  public:
    /// A tetrahedron of one of the meshes.
    using Cell = Tetrahedron;
    /// A name of a vertex.
    using Name = ForestMesh::Name;

    /// Collective. Cells of positive orientation, conforming (every face belongs to two cells or carries a
    /// boundary id).
    TetrahedralForest(const std::vector<dealii::Point<3>> &vertices, const std::vector<Cell> &cells,
                      const MPI_Comm communicator);

    /// Number of meshes.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(meshes.size());
    }

    /// What this rank sees of a mesh; level 0 is the start mesh.
    const ForestMesh &mesh(const unsigned int level) const
    {
      return *meshes[level];
    }

    /// Which edges the vertices halve.
    const VertexHistory &history() const
    {
      return vertex_history;
    }

    /// Collective. Makes a new mesh: marked cells of the last one are bisected three times (each edge once),
    /// others as often as needed to have no hanging nodes. Then the cells are distributed anew. False if
    /// nothing is marked on any rank.
    /// @param marked the own cells, in their order
    /// @param weight of the new cells, one if empty
    bool refine(const std::vector<bool> &marked, const CellWeight &weight = {});

    /// Positions of the vertices of the last mesh, which may be moved, those of ghosts like their owners'.
    std::vector<dealii::Point<3>> &points()
    {
      return meshes.back()->points;
    }

    /// Marks of the vertices of the last mesh, which may be set: they stay with vertices through refinements.
    std::vector<bool> &vertex_marks()
    {
      return meshes.back()->is_marked;
    }

    /// The ranks that share the meshes.
    MPI_Comm communicator() const
    {
      return comm;
    }

    /// Bytes of all lists of this rank.
    std::size_t memory_consumption() const;

  private:
    void add_mesh(struct ForestPiece &&piece, const CellWeight &weight);

    const MPI_Comm comm;
    VertexHistory  vertex_history;
    /// Their addresses stay.
    std::vector<std::unique_ptr<ForestMesh>> meshes;
    /// Of the own cells of the last mesh.
    std::vector<BisectionMarking> markings;
  };
} // namespace Signorini

#endif
