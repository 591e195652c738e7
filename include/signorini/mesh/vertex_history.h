// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_vertex_history_h
#define signorini_mesh_vertex_history_h

#include <signorini/algebra/types.h>
#include <signorini/mesh/forest_mesh.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// Which edges the vertices of a TetrahedralForest halve: distributed, every vertex at home on one rank,
  /// the one that named it, for good.
  class VertexHistory
  {
  public:
    /// A number that a vertex has on all meshes and ranks.
    using Name = ForestMesh::Name;

    /// Vertices of a start mesh, in equal parts on the ranks.
    VertexHistory(const Name n_vertices, const MPI_Comm communicator);

    /// Collective. Adds the vertices of a refinement.
    /// @param first_name first new name of each rank, and the first that is free
    /// @param parents names of the ends of the edges of those of this rank
    void add_level(const std::vector<Name> &first_name, const std::vector<std::array<Name, 2>> &parents);

    /// The vertices of a mesh are the first n_vertices().
    Name n_vertices(const unsigned int level) const
    {
      return first_names[level].back();
    }

    /// Whether edges of mesh `coarse` were halved more than once, one after the other, up to mesh `fine`.
    bool halves_twice(const unsigned int coarse, const unsigned int fine) const;

    /// Collective. Values that each rank has for some vertices, asked for by others.
    /// @param names vertices with values of this rank; no vertex has values on two ranks
    std::vector<NodeIndex> look_up(const std::vector<Name> &names, const std::vector<NodeIndex> &values,
                                   const std::vector<Name> &wanted) const;

    /// Vertices of a coarser mesh whose weighted means others are at first: row i has the entries start[i]
    /// ... start[i + 1] - 1.
    struct Rows
    {
      /// As above; weights are pure numbers.
      std::vector<std::size_t> start = {0};
      std::vector<Name>        names;
      std::vector<double>      weights;
    };

    /// Collective. The rows of vertices of any mesh.
    Rows rows(const std::vector<Name> &vertices, const unsigned int coarse) const;

    /// Bytes of all lists.
    std::size_t memory_consumption() const;

  private:
    using Parents = std::array<Name, 2>;

    unsigned int                      level_of(const Name vertex) const;
    unsigned int                      home(const Name vertex) const;
    std::size_t                       slot(const Name vertex) const;
    std::unordered_map<Name, Parents> fetch(const std::vector<Name> &vertices) const;
    std::unordered_map<Name, Parents> fetch_ancestors(const std::vector<Name> &vertices,
                                                      const Name               n_coarse) const;

    const MPI_Comm     comm;
    const unsigned int rank;
    /// By mesh: first name of each rank, and the first that is free.
    std::vector<std::vector<Name>> first_names;
    /// By mesh: place of the first vertex at home here in the list of parents.
    std::vector<std::size_t> first_slot;
    std::vector<Parents>     parent_names;
    /// By mesh: the latest mesh to which parents of its vertices are new.
    std::vector<unsigned int> latest_parent;
  };
} // namespace Signorini

#endif
