// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/disjoint_sets.h>
#include <signorini/discretization/background_levels.h>
#include <signorini/discretization/background_octree.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Functions on the octrees at the nodes of a level, one row per node; a vertex is one of the octree of
    /// the node's part.
    struct VertexRows
    {
      std::vector<std::size_t>              start = {0};
      std::vector<BackgroundOctree::Vertex> vertices;
      std::vector<double>                   weights;
    };



    class BackgroundBuilder
    {
    public:
      BackgroundBuilder(const ConnectedNodes &mesh, const BackgroundRule &rule);

      /// All levels, the finest first.
      std::vector<BackgroundLevel> build();

    private:
      bool is_root(const double ratio) const
      {
        return std::all_of(trees.begin(), trees.end(),
                           [ratio](const BackgroundOctree &tree) { return tree.is_root(ratio); });
      }

      /// The functions of a cut at the present nodes.
      VertexRows expand(const double ratio) const;

      /// The pieces of the supports of functions that cells connect: the piece of each entry by its first
      /// one.
      std::vector<std::size_t> find_pieces(const VertexRows &rows) const;

      /// A level with a node for each piece, and their vertices.
      BackgroundLevel make_level(const VertexRows                      &rows,
                                 std::vector<BackgroundOctree::Vertex> &vertices) const;

      /// Makes a level, whose nodes are at vertices, that of the present nodes.
      void descend(const BackgroundLevel &level, std::vector<BackgroundOctree::Vertex> &&vertices);

      const BackgroundRule          rule;
      std::vector<BackgroundOctree> trees;
      /// Of the present nodes: their octrees, and what they were in the mesh.
      std::vector<unsigned int> tree_of_node, part_of_node;
      NodeGroups                cells;
      /// Numbers of mesh nodes in their octrees; empty when the present nodes are at vertices.
      std::vector<unsigned int>             numbers;
      std::vector<BackgroundOctree::Vertex> vertices;
    };



    BackgroundBuilder::BackgroundBuilder(const ConnectedNodes &mesh, const BackgroundRule &rule)
      : rule(rule)
      , part_of_node(mesh.parts)
      , cells(mesh.cells)
    {
      std::vector<unsigned int> known = mesh.parts;
      std::sort(known.begin(), known.end());
      known.erase(std::unique(known.begin(), known.end()), known.end());
      std::vector<std::vector<Point<3>>> positions(known.size());
      std::vector<std::vector<double>>   sizes(known.size());
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        {
          const std::size_t tree =
              std::lower_bound(known.begin(), known.end(), mesh.parts[i]) - known.begin();
          tree_of_node.push_back(static_cast<unsigned int>(tree));
          numbers.push_back(static_cast<unsigned int>(positions[tree].size()));
          positions[tree].push_back(mesh.positions[i]);
          sizes[tree].push_back(mesh.sizes[i]);
        }
      for (std::size_t tree = 0; tree < known.size(); ++tree)
        trees.emplace_back(positions[tree], sizes[tree], rule.first_ratio);
    }



    VertexRows BackgroundBuilder::expand(const double ratio) const
    {
      VertexRows                         rows;
      BackgroundOctree::Expansion        expansion;
      std::vector<BackgroundOctree::Cut> cuts;
      for (const BackgroundOctree &tree : trees)
        cuts.emplace_back(tree, ratio);
      for (std::size_t i = 0; i < tree_of_node.size(); ++i)
        {
          BackgroundOctree::Cut &cut = cuts[tree_of_node[i]];
          if (vertices.empty())
            cut.at_node(expansion, numbers[i]);
          else
            expansion = cut.at_vertex(vertices[i]);
          for (const auto &[vertex, weight] : expansion)
            {
              rows.vertices.push_back(vertex);
              rows.weights.push_back(weight);
            }
          rows.start.push_back(rows.vertices.size());
        }
      return rows;
    }



    /// Who came first with a vertex, among the few of a cell.
    class FirstWithVertex
    {
    public:
      /// Forgets all; there is room for a number of vertices.
      void clear(const std::size_t n_vertices)
      {
        std::size_t size = 64;
        while (size < 2 * n_vertices)
          size *= 2;
        if (size > slots.size())
          slots.assign(size, {});
        ++round;
      }

      /// The first entry with the vertex; `entry` where it is new.
      std::size_t operator()(const BackgroundOctree::Vertex vertex, const std::size_t entry)
      {
        // The upper half of Fibonacci hashing: codes of neighbours differ in few bits.
        std::size_t k = (vertex * 0x9E3779B97F4A7C15ull) >> 32;
        for (;; ++k)
          {
            Slot &slot = slots[k & (slots.size() - 1)];
            if (slot.round == round && slot.vertex != vertex)
              continue;
            if (slot.round != round)
              slot = {vertex, round, entry};
            return slot.first;
          }
      }

    private:
      struct Slot
      {
        BackgroundOctree::Vertex vertex = 0;
        std::size_t              round = 0, first = 0;
      };
      std::vector<Slot> slots;
      std::size_t       round = 0;
    };



    std::vector<std::size_t> BackgroundBuilder::find_pieces(const VertexRows &rows) const
    {
      DisjointSets    sets(rows.vertices.size());
      FirstWithVertex first;
      for (std::size_t c = 0; c + 1 < cells.start.size(); ++c)
        {
          std::size_t n_entries = 0;
          for (std::size_t k = cells.start[c]; k < cells.start[c + 1]; ++k)
            n_entries += rows.start[cells.nodes[k] + 1] - rows.start[cells.nodes[k]];
          first.clear(n_entries);
          for (std::size_t k = cells.start[c]; k < cells.start[c + 1]; ++k)
            for (std::size_t e = rows.start[cells.nodes[k]]; e < rows.start[cells.nodes[k] + 1]; ++e)
              if (const std::size_t other = first(rows.vertices[e], e); other != e)
                sets.unite(e, other);
        }
      std::vector<std::size_t> pieces(rows.vertices.size());
      for (std::size_t e = 0; e < pieces.size(); ++e)
        pieces[e] = sets.find(e);
      return pieces;
    }



    BackgroundLevel BackgroundBuilder::make_level(const VertexRows                      &rows,
                                                  std::vector<BackgroundOctree::Vertex> &new_vertices) const
    {
      const std::vector<std::size_t> pieces = find_pieces(rows);
      BackgroundLevel                level;
      std::vector<NodeIndex>         number(pieces.size());
      for (std::size_t i = 0; i < tree_of_node.size(); ++i)
        {
          for (std::size_t e = rows.start[i]; e < rows.start[i + 1]; ++e)
            {
              if (pieces[e] == e)
                {
                  number[e] = level.positions.size();
                  level.positions.push_back(trees[tree_of_node[i]].position(rows.vertices[e]));
                  level.parts.push_back(part_of_node[i]);
                  new_vertices.push_back(rows.vertices[e]);
                }
              level.rows.add(number[pieces[e]], rows.weights[e]);
            }
          level.rows.finish_row();
        }
      return level;
    }



    /// Whether two rows have a column in common.
    bool have_common_column(const NodeRows &rows, const unsigned int i, const unsigned int j)
    {
      const auto begin = rows.columns.begin();
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (std::find(begin + rows.start[j], begin + rows.start[j + 1], rows.columns[k]) !=
            begin + rows.start[j + 1])
          return true;
      return false;
    }



    /// What holds a level together: nodes that a finer one depends on, and, where finer nodes of a cell
    /// depend on different ones (a cell that spans a leaf without nodes of its own), one of each.
    NodeGroups connect_level(const NodeRows &rows, const NodeGroups &finer_cells)
    {
      NodeGroups cells;
      const auto finish = [&] { cells.start.push_back(cells.nodes.size()); };
      // Nodes that depend on the same ones say the same; neighbours in the numbering often do.
      std::vector<NodeIndex> group, last;
      for (std::size_t i = 0; i < rows.n_rows(); ++i)
        {
          group.assign(rows.columns.begin() + rows.start[i], rows.columns.begin() + rows.start[i + 1]);
          std::sort(group.begin(), group.end());
          if (group == last)
            continue;
          for (const NodeIndex node : group)
            cells.nodes.push_back(static_cast<unsigned int>(node));
          finish();
          last = group;
        }
      for (std::size_t c = 0; c + 1 < finer_cells.start.size(); ++c)
        for (std::size_t k = finer_cells.start[c] + 1; k < finer_cells.start[c + 1]; ++k)
          if (const unsigned int i = finer_cells.nodes[k - 1], j = finer_cells.nodes[k];
              !have_common_column(rows, i, j))
            {
              for (const unsigned int node : {i, j})
                cells.nodes.push_back(static_cast<unsigned int>(rows.columns[rows.start[node]]));
              finish();
            }
      return cells;
    }



    void BackgroundBuilder::descend(const BackgroundLevel                  &level,
                                    std::vector<BackgroundOctree::Vertex> &&new_vertices)
    {
      std::vector<unsigned int> trees_of_level(level.positions.size());
      for (std::size_t i = 0; i < level.rows.n_rows(); ++i)
        for (std::size_t k = level.rows.start[i]; k < level.rows.start[i + 1]; ++k)
          trees_of_level[level.rows.columns[k]] = tree_of_node[i];
      cells        = connect_level(level.rows, cells);
      tree_of_node = std::move(trees_of_level);
      part_of_node = level.parts;
      vertices     = std::move(new_vertices);
    }



    std::vector<BackgroundLevel> BackgroundBuilder::build()
    {
      std::vector<BackgroundLevel> levels;
      for (double ratio = rule.first_ratio; tree_of_node.size() > rule.smallest_level; ratio *= 2.)
        {
          std::vector<BackgroundOctree::Vertex> new_vertices;
          BackgroundLevel                       level = make_level(expand(ratio), new_vertices);
          if (level.positions.size() <= rule.largest_growth * tree_of_node.size())
            {
              descend(level, std::move(new_vertices));
              levels.push_back(std::move(level));
            }
          if (is_root(ratio))
            break;
        }
      return levels;
    }
  } // namespace



  std::vector<BackgroundLevel> make_background_levels(const ConnectedNodes &mesh, const BackgroundRule &rule)
  {
    return mesh.positions.empty() ? std::vector<BackgroundLevel>() : BackgroundBuilder(mesh, rule).build();
  }
} // namespace Signorini
