// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Which nodes of a space are vertices of the start meshes, or belong to sets of these.

#include <signorini/mesh/nodal_space.h>

#include <algorithm>
#include <iterator>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Sets = std::vector<unsigned int>;

    Sets common(const Sets &a, const Sets &b)
    {
      Sets result;
      std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
      return result;
    }

    /// Where a vertex of a cell is in its coarse cell: from 0 to 2^level in each direction.
    struct PlaceInCoarseCell
    {
      PlaceInCoarseCell(const std::uint64_t path, const unsigned int level, const unsigned int vertex)
        : end(std::uint64_t(1) << level)
      {
        for (unsigned int c = 0; c < 3; ++c)
          {
            for (unsigned int l = 0; l < level; ++l)
              place[c] = 2 * place[c] + (path >> (3 * (level - 1 - l) + c) & 1);
            place[c] += vertex >> c & 1;
          }
      }

      /// Whether a corner of the coarse cell belongs to the smallest edge, face or cell that the place is in.
      bool depends_on(const unsigned int corner) const
      {
        for (unsigned int c = 0; c < 3; ++c)
          if (place[c] == ((corner >> c & 1) ? 0 : end))
            return false;
        return true;
      }

      /// The corner of the coarse cell that the place is, or 8.
      unsigned int corner() const
      {
        unsigned int result = 0;
        for (unsigned int c = 0; c < 3; ++c)
          if (place[c] == end)
            result |= 1u << c;
          else if (place[c] != 0)
            return 8;
        return result;
      }

      std::array<std::uint64_t, 3> place = {{0, 0, 0}};
      std::uint64_t                end;
    };
  } // namespace



  void NodalSpace::find_start_nodes(const MeshView &mesh)
  {
    start_vertex.assign(relevant_nodes.n_elements(), StartNodes::none);
    nodes_of_set.assign(mesh.start->n_sets, {});
    std::vector<bool> is_done(relevant_nodes.n_elements(), false);
    if (mesh.hexahedra != nullptr)
      add_start_nodes_of_hexahedra(*mesh.start, is_done);
    if (mesh.tetrahedra != nullptr)
      add_start_nodes_of_tetrahedra(*mesh.start, mesh);
    for (std::vector<NodeIndex> &nodes : nodes_of_set)
      std::sort(nodes.begin(), nodes.end());
  }



  void NodalSpace::add_to_sets(const NodeIndex node, const Sets &sets)
  {
    if (relevant_nodes.is_element(node) && !constraints.is_constrained(node))
      for (const unsigned int set : sets)
        nodes_of_set[set].push_back(node);
  }



  void NodalSpace::add_start_nodes_of_hexahedra(const StartNodes &start, std::vector<bool> &is_done)
  {
    for (const Cell &cell : cell_list)
      if (cell.n_vertices == CellShape::hexahedron)
        for (unsigned int v = 0; v < 8; ++v)
          {
            const PlaceInCoarseCell place(cell.path, cell.level, v);
            const unsigned int      corner = place.corner();
            if (corner == 8 && start.n_sets == 0)
              continue;
            const NodeIndex   node = nodes(cell)[v];
            const std::size_t i    = relevant_nodes.index_within_set(node);
            if (is_done[i])
              continue;
            is_done[i]           = true;
            const auto &vertices = start.hexahedra[cell.coarse_cell];
            if (corner < 8)
              start_vertex[i] = vertices[corner];
            if (start.n_sets == 0)
              continue;
            Sets sets;
            bool is_first = true;
            for (unsigned int k = 0; k < 8; ++k)
              if (place.depends_on(k))
                {
                  const Sets &other = start.sets_of[vertices[k]];
                  sets              = is_first ? other : common(sets, other);
                  is_first          = false;
                }
            add_to_sets(node, sets);
          }
  }



  void NodalSpace::add_start_nodes_of_tetrahedra(const StartNodes &start, const MeshView &mesh)
  {
    const ForestMesh &part = mesh.tetrahedra->mesh(mesh.tetrahedral_level);
    for (unsigned int v = 0; v < part.vertices.size(); ++v)
      {
        const ForestMesh::Carrier &carrier = part.carriers[v];
        const NodeIndex            node    = node_of_vertex[v];
        if (carrier[1] == ForestMesh::none && relevant_nodes.is_element(node))
          start_vertex[relevant_nodes.index_within_set(node)] = start.forest[carrier[0]];
        if (start.n_sets == 0)
          continue;
        Sets sets = start.sets_of[start.forest[carrier[0]]];
        for (unsigned int i = 1; i < carrier.size() && carrier[i] != ForestMesh::none; ++i)
          sets = common(sets, start.sets_of[start.forest[carrier[i]]]);
        add_to_sets(node, sets);
      }
  }
} // namespace Signorini
