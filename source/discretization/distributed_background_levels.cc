// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/discretization/background_levels.h>
#include <signorini/mesh/cell_shape.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

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
