// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_forest_closure_h
#define signorini_mesh_forest_closure_h

#include "forest_pieces.h"

#include <unordered_map>

namespace Signorini
{
  /// Bisects the own cells of a mesh until no vertex of any rank hangs. Ranks tell each other which of the
  /// edges are split whose ends both of them have. What cells there are in the end does not depend on the
  /// order in which they are bisected, nor does their order: children stand where their parents stood.
  class ForestClosure
  {
  public:
    using Name = ForestMesh::Name;

    /// A cell and how often it is to be bisected at least.
    struct Item
    {
      MarkedTetrahedron tetrahedron;
      unsigned int      bisections;
    };

    ForestClosure(const ForestMesh &mesh, const MPI_Comm communicator);

    /// Collective. Replaces cells by their children.
    void run(std::vector<Item> &cells);

    /// Collective. Names the new vertices in the order in which they come up first in the cells of all ranks.
    /// @return the first new name of each rank, and the first that is free
    std::vector<Name> name_vertices(const std::vector<Item> &cells, const Name first_free);

    /// The vertices of the mesh and the new ones, with their names. Some of the new ones may have no cells
    /// here.
    std::vector<ForestPiece::Vertex> vertices;

    /// Names of the ends of the edges in whose middles the vertices were made that this rank has named.
    std::vector<std::array<Name, 2>> parents;

  private:
    /// The middle of an edge as it is told to others. While they have no names new vertices have handles: any
    /// number that the ranks that see the vertex know, beyond all names.
    struct SplitEdge
    {
      Name middle;
      Name ends[2];
    };

    using Ranks = std::vector<unsigned int>;

    unsigned int      middle_of(const unsigned int a, const unsigned int b);
    unsigned int      add_middle(const unsigned int a, const unsigned int b, const Name handle);
    bool              has_split_edge(const Tetrahedron &cell) const;
    void              close(std::vector<Item> &cells);
    bool              exchange();
    Ranks             common_ranks(const unsigned int a, const unsigned int b) const;
    std::vector<bool> used_vertices(const std::vector<Item> &cells) const;
    std::unordered_map<unsigned int, Ranks> holders(const std::vector<bool> &is_used) const;
    std::vector<unsigned int>               vertices_to_name(const std::vector<Item>                       &cells,
                                                             const std::unordered_map<unsigned int, Ranks> &holders) const;

    const MPI_Comm     comm;
    const unsigned int rank;
    const unsigned int n_old;
    /// Of new vertices.
    std::vector<std::array<unsigned int, 2>> ends;
    /// Midpoints of split edges, and which vertices belong to one.
    std::unordered_map<std::uint64_t, unsigned int> middles;
    std::vector<bool>                               at_split_edge;
    /// Other ranks that have the vertex, or at least both ends of its edge; the same list on all of them.
    std::unordered_map<unsigned int, Ranks> others;
    /// Vertices that others have by names and handles.
    std::unordered_map<Name, unsigned int> known;
    ListsByRank<SplitEdge>                 news;
  };
} // namespace Signorini

#endif
