// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/discretization/background_levels.h>
#include <signorini/discretization/background_octree.h>
#include <signorini/mesh/cell_shape.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

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



    /// Disjoint sets of numbers.
    class DisjointSets
    {
    public:
      explicit DisjointSets(const std::size_t size)
        : parent(size)
      {
        std::iota(parent.begin(), parent.end(), std::size_t(0));
      }

      /// The smallest number of the set of a number.
      std::size_t find(std::size_t i)
      {
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      }

      void unite(const std::size_t i, const std::size_t j)
      {
        const std::size_t a = find(i), b = find(j);
        parent[std::max(a, b)] = std::min(a, b);
      }

    private:
      std::vector<std::size_t> parent;
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



    std::vector<std::size_t> BackgroundBuilder::find_pieces(const VertexRows &rows) const
    {
      DisjointSets                                                  sets(rows.vertices.size());
      std::vector<std::pair<BackgroundOctree::Vertex, std::size_t>> in_cell;
      for (std::size_t c = 0; c + 1 < cells.start.size(); ++c)
        {
          in_cell.clear();
          for (std::size_t k = cells.start[c]; k < cells.start[c + 1]; ++k)
            for (std::size_t e = rows.start[cells.nodes[k]]; e < rows.start[cells.nodes[k] + 1]; ++e)
              in_cell.emplace_back(rows.vertices[e], e);
          std::sort(in_cell.begin(), in_cell.end());
          for (std::size_t k = 1; k < in_cell.size(); ++k)
            if (in_cell[k].first == in_cell[k - 1].first)
              sets.unite(in_cell[k].second, in_cell[k - 1].second);
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



  namespace
  {
    /// What a rank knows of a mesh node, sent to all others.
    struct MeshNode
    {
      NodeIndex             number;
      std::array<double, 3> position;
      double                size;
      unsigned int          part, rank;

      /// By part and position: an order that does not depend on the number of ranks.
      bool operator<(const MeshNode &other) const
      {
        return std::tie(part, position, number) < std::tie(other.part, other.position, other.number);
      }
    };



    /// The two shortest edges at a node, and where they lead.
    struct ShortestEdges
    {
      std::array<double, 2> lengths = {
          {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()}};
      std::array<NodeIndex, 2> ends = {{invalid_node, invalid_node}};

      /// An edge, which may come several times.
      void add(const NodeIndex end, const double length)
      {
        if (end == ends[0] || end == ends[1] || length >= lengths[1])
          return;
        lengths[1] = length;
        ends[1]    = end;
        if (lengths[1] < lengths[0])
          {
            std::swap(lengths[0], lengths[1]);
            std::swap(ends[0], ends[1]);
          }
      }
    };

    bool is_edge(const unsigned int n_vertices, const unsigned int a, const unsigned int b)
    {
      const unsigned int difference = a ^ b;
      return n_vertices == CellShape::tetrahedron || (difference & (difference - 1)) == 0;
    }



    /// The nodes of a rank of which some component is free.
    std::vector<MeshNode> own_nodes(const NodalSpace &space, const std::vector<FixedDirections> &fixed,
                                    const Bodies &bodies, const BackgroundRule &rule)
    {
      const IndexSet            &owned = space.owned();
      std::vector<ShortestEdges> edges(owned.n_elements());
      std::vector<unsigned int>  part(owned.n_elements(), 0);
      for (const NodalSpace::Cell &cell : space.cells())
        {
          const auto nodes = space.nodes(cell);
          for (unsigned int a = 0; a < cell.n_vertices; ++a)
            if (owned.is_element(nodes[a]))
              {
                const auto i = owned.index_within_set(nodes[a]);
                part[i]      = bodies.part_of_material(cell.material);
                for (unsigned int b = 0; b < cell.n_vertices; ++b)
                  if (b != a && is_edge(cell.n_vertices, a, b))
                    edges[i].add(nodes[b], space.position(nodes[a]).distance(space.position(nodes[b])));
              }
        }
      const unsigned int    rank = Utilities::MPI::this_mpi_process(space.communicator());
      std::vector<MeshNode> result;
      std::size_t           i = 0;
      for (const NodeIndex node : owned)
        {
          const Point<3> &p = space.position(node);
          if (!fixed[i].all())
            result.push_back({node,
                              {{p[0], p[1], p[2]}},
                              rule.edge_share * (edges[i].lengths[0] + edges[i].lengths[1]),
                              part[i],
                              rank});
          ++i;
        }
      return result;
    }



    /// Places of numbers in a list, by number: no_place for those that are not in it.
    constexpr unsigned int no_place = static_cast<unsigned int>(-1);

    std::vector<unsigned int> places_of(const std::vector<NodeIndex> &numbers, const NodeIndex n)
    {
      std::vector<unsigned int> places(n, no_place);
      for (std::size_t k = 0; k < numbers.size(); ++k)
        places[numbers[k]] = static_cast<unsigned int>(k);
      return places;
    }



    /// The whole mesh, the same on all ranks.
    ConnectedNodes connect(const std::vector<MeshNode> &nodes, const std::vector<unsigned int> &places,
                           const NodalSpace &space)
    {
      ConnectedNodes mesh;
      for (const MeshNode &node : nodes)
        {
          mesh.positions.emplace_back(node.position[0], node.position[1], node.position[2]);
          mesh.sizes.push_back(node.size);
          mesh.parts.push_back(node.part);
        }
      std::vector<NodeIndex> cells;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          {
            const auto nodes_of_cell = space.nodes(cell);
            cells.insert(cells.end(), nodes_of_cell.begin(), nodes_of_cell.end());
            cells.push_back(invalid_node);
          }
      for (const NodeIndex node : gather_lists(cells, space.communicator(), Receivers::all))
        if (node == invalid_node)
          mesh.cells.start.push_back(mesh.cells.nodes.size());
        else if (places[node] != no_place)
          mesh.cells.nodes.push_back(places[node]);
      return mesh;
    }



    /// The rank of each coarse node: that of the node that depends on it most, the first of several.
    std::vector<unsigned int> ranks_of_level(const BackgroundLevel           &level,
                                             const std::vector<unsigned int> &fine_ranks)
    {
      std::vector<unsigned int> ranks(level.positions.size());
      std::vector<double>       largest(level.positions.size(), 0.);
      for (std::size_t i = 0; i < level.rows.n_rows(); ++i)
        for (std::size_t k = level.rows.start[i]; k < level.rows.start[i + 1]; ++k)
          if (const NodeIndex node = level.rows.columns[k]; level.rows.weights[k] > largest[node])
            {
              largest[node] = level.rows.weights[k];
              ranks[node]   = fine_ranks[i];
            }
      return ranks;
    }



    /// Numbers by rank; `owned` become those of this one.
    std::vector<NodeIndex> number_by_rank(const std::vector<unsigned int> &ranks, const MPI_Comm communicator,
                                          IndexSet &owned)
    {
      std::vector<NodeIndex> next(Utilities::MPI::n_mpi_processes(communicator) + 1, 0);
      for (const unsigned int rank : ranks)
        ++next[rank + 1];
      std::partial_sum(next.begin(), next.end(), next.begin());
      const unsigned int me = Utilities::MPI::this_mpi_process(communicator);
      owned.set_size(ranks.size());
      owned.add_range(next[me], next[me + 1]);
      std::vector<NodeIndex> numbers;
      for (const unsigned int rank : ranks)
        numbers.push_back(next[rank]++);
      return numbers;
    }

    /// The owners of some nodes.
    std::vector<unsigned int> ranks_of_nodes(const std::vector<NodeIndex> &nodes, const NodalSpace &space)
    {
      std::vector<unsigned int> ranks;
      for (const NodeIndex node : nodes)
        ranks.push_back(Utilities::MPI::max(
            space.owned().is_element(node) ? Utilities::MPI::this_mpi_process(space.communicator()) : 0u,
            space.communicator()));
      return ranks;
    }

    /// Adds the entries of a row, by their new numbers.
    void add_renumbered(NodeRows &rows, const NodeRows &from, const std::size_t row,
                        const std::vector<NodeIndex> &numbers)
    {
      std::vector<std::pair<NodeIndex, double>> entries;
      for (std::size_t k = from.start[row]; k < from.start[row + 1]; ++k)
        entries.emplace_back(numbers[from.columns[k]], from.weights[k]);
      std::sort(entries.begin(), entries.end());
      for (const auto &[column, weight] : entries)
        rows.add(column, weight);
    }
  } // namespace



  std::vector<DistributedBackgroundLevel>
  background_levels(const NodalSpace &space, const std::vector<FixedDirections> &fixed, const Bodies &bodies,
                    const std::vector<NodeIndex> &carriers, const BackgroundRule &rule)
  {
    const MPI_Comm        communicator = space.communicator();
    std::vector<MeshNode> nodes =
        gather_lists(own_nodes(space, fixed, bodies, rule), communicator, Receivers::all);
    std::sort(nodes.begin(), nodes.end());
    std::vector<NodeIndex>    numbers;
    std::vector<unsigned int> ranks;
    for (const MeshNode &node : nodes)
      {
        numbers.push_back(node.number);
        ranks.push_back(node.rank);
      }
    std::vector<unsigned int>               places          = places_of(numbers, space.n_nodes());
    std::vector<NodeIndex>                  carrier_numbers = carriers;
    const std::vector<unsigned int>         carrier_ranks   = ranks_of_nodes(carriers, space);
    IndexSet                                owned           = space.owned();
    std::vector<DistributedBackgroundLevel> result;
    for (const BackgroundLevel &level : make_background_levels(connect(nodes, places, space), rule))
      {
        DistributedBackgroundLevel distributed;
        ranks                               = ranks_of_level(level, ranks);
        std::vector<unsigned int> all_ranks = ranks;
        all_ranks.insert(all_ranks.end(), carrier_ranks.begin(), carrier_ranks.end());
        numbers = number_by_rank(all_ranks, communicator, distributed.owned);
        distributed.carriers.assign(numbers.begin() + ranks.size(), numbers.end());
        const NodeIndex n_nodes = numbers.size();
        numbers.resize(ranks.size());
        for (const NodeIndex node : owned)
          {
            if (const unsigned int row = places[node]; row != no_place)
              add_renumbered(distributed.rows, level.rows, row, numbers);
            else if (const auto carrier = std::find(carrier_numbers.begin(), carrier_numbers.end(), node);
                     carrier != carrier_numbers.end())
              distributed.rows.add(distributed.carriers[carrier - carrier_numbers.begin()], 1.);
            distributed.rows.finish_row();
          }
        places          = places_of(numbers, n_nodes);
        owned           = distributed.owned;
        carrier_numbers = distributed.carriers;
        for (const NodeIndex node : owned)
          {
            const bool has_place = places[node] != no_place;
            distributed.positions.push_back(has_place ? level.positions[places[node]] : Point<3>());
            distributed.parts.push_back(has_place ? level.parts[places[node]] : no_place);
          }
        result.push_back(std::move(distributed));
      }
    return result;
  }
} // namespace Signorini
