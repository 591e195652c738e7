// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/hexahedron.h>
#include <signorini/discretization/interpolation_exchange.h>
#include <signorini/discretization/level_spaces.h>
#include <signorini/solvers/level_zero_solver.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Weights of a vertex of a child cell on the vertices of its parent, [child][vertex][parent vertex].
    const std::array<std::array<std::array<double, 8>, 8>, 8> &child_weights()
    {
      static const auto weights = [] {
        std::array<std::array<std::array<double, 8>, 8>, 8> w;
        for (unsigned int child = 0; child < 8; ++child)
          for (unsigned int v = 0; v < 8; ++v)
            {
              Point<3> p;
              for (unsigned int c = 0; c < 3; ++c)
                p[c] = .5 * (((child >> c) & 1u) + ((v >> c) & 1u));
              w[child][v] = Hexahedron::shape_values(p);
            }
        return w;
      }();
      return weights;
    }



    /// The row of one fine node: parent vertex weights times the expansions of the parent's vertices.
    void combine(std::vector<std::pair<NodeIndex, double>> &row, const CellInterpolation &parent,
                 const std::array<double, 8> &weights)
    {
      row.clear();
      for (unsigned int v = 0; v < 8; ++v)
        if (weights[v] != 0.)
          for (std::size_t k = parent.start[v]; k < parent.start[v + 1]; ++k)
            {
              const auto   it = std::find_if(row.begin(), row.end(),
                                             [&](const auto &e) { return e.first == parent.nodes[k]; });
              const double w  = weights[v] * parent.weights[k];
              if (it == row.end())
                row.emplace_back(parent.nodes[k], w);
              else
                it->second += w;
            }
      std::sort(row.begin(), row.end());
    }



    /// The rows of the owned nodes of tetrahedra: themselves in the coarse mesh, or means of the rows of the
    /// ends of the edges that they were made on.
    void add_forest_rows(NodeRows &result, const NodalSpace &fine, const NodalSpace &coarse,
                         const TetrahedralForest &forest)
    {
      const VertexHistory   &history = forest.history();
      const auto             rows    = history.rows(fine.owned_forest_vertices(), coarse.tetrahedral_level());
      std::vector<NodeIndex> nodes;
      const NodeIndex        n_coarse = coarse.n_owned_forest_nodes();
      const NodeIndex        n_before = coarse.owned().n_elements() - n_coarse;
      for (NodeIndex i = 0; i < n_coarse; ++i)
        nodes.push_back(coarse.owned().nth_index_in_set(n_before + i));
      const auto columns = history.look_up(coarse.owned_forest_vertices(), nodes, rows.names);
      std::vector<std::pair<NodeIndex, double>> row;
      for (std::size_t i = 0; i + 1 < rows.start.size(); ++i)
        {
          row.clear();
          for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
            row.emplace_back(columns[k], rows.weights[k]);
          std::sort(row.begin(), row.end());
          for (const auto &[column, weight] : row)
            result.add(column, weight);
          result.finish_row();
        }
    }
  } // namespace



  NodeRows interpolation_rows(const NodalSpace &fine, const NodalSpace &coarse,
                              const TetrahedralForest *const forest)
  {
    const ParentLookup                        parents(fine, coarse);
    const NodeIndex                           n_owned = fine.owned().n_elements();
    const NodeIndex                           begin   = n_owned > 0 ? fine.owned().nth_index_in_set(0) : 0;
    std::vector<bool>                         done(n_owned, false);
    std::vector<std::size_t>                  first(n_owned, 0), last(n_owned, 0);
    std::vector<std::pair<NodeIndex, double>> entries, row;
    std::array<double, 8>                     weights;
    for (const NodalSpace::Cell &cell : fine.cells())
      if (cell.is_owned && cell.n_vertices == CellShape::hexahedron)
        {
          const auto               nodes  = fine.nodes(cell);
          const CellInterpolation *parent = nullptr;
          int                      child  = -1;
          for (unsigned int v = 0; v < 8; ++v)
            {
              const NodeIndex i = nodes[v] - begin;
              if (nodes[v] < begin || i >= n_owned || done[i])
                continue;
              done[i] = true;
              if (fine.hanging_nodes().is_constrained(nodes[v]))
                continue;
              if (parent == nullptr)
                std::tie(parent, child) = parents.find(cell);
              if (child < 0)
                {
                  weights.fill(0.);
                  weights[v] = 1.;
                }
              else
                weights = child_weights()[child][v];
              combine(row, *parent, weights);
              first[i] = entries.size();
              entries.insert(entries.end(), row.begin(), row.end());
              last[i] = entries.size();
            }
        }
    NodeRows result;
    result.columns.reserve(entries.size());
    result.weights.reserve(entries.size());
    for (NodeIndex i = 0; i < n_owned - fine.n_owned_forest_nodes(); ++i)
      {
        for (std::size_t k = first[i]; k < last[i]; ++k)
          result.add(entries[k].first, entries[k].second);
        result.finish_row();
      }
    if (forest != nullptr)
      add_forest_rows(result, fine, coarse, *forest);
    return result;
  }



  namespace
  {
    /// Carriers have nodes of their own under a mesh, and those have no place.
    std::vector<FixedDirections> without_carriers(std::vector<FixedDirections>  fixed,
                                                  const std::vector<NodeIndex> &carriers,
                                                  const IndexSet               &owned)
    {
      for (const NodeIndex node : carriers)
        if (owned.is_element(node))
          fixed[owned.index_within_set(node)] = all_fixed;
      return fixed;
    }

    bool has_oblique(const std::vector<FixedDirections> &fixed, const MPI_Comm communicator)
    {
      const bool mine = std::any_of(fixed.begin(), fixed.end(),
                                    [](const FixedDirections &f) { return !f.is_along_axes(); });
      return Utilities::MPI::max(mine ? 1 : 0, communicator) > 0;
    }
  } // namespace



  LevelSpaces::LevelSpaces(const NodalSpace &finest, std::vector<std::shared_ptr<const NodalSpace>> coarser,
                           const Bodies &bodies, const Loads &loads, const CoarseLevels coarse_levels)
  {
    const NodalSpace      *below = nullptr;
    std::vector<RigidFace> rigid;
    if (!loads.rigid_faces.empty())
      rigid = evaluate_dirichlet(finest, loads, true).rigid->faces();
    const auto add = [&](const NodalSpace &space) {
      const DirichletData          dirichlet = evaluate_dirichlet(space, loads, false, rigid);
      std::vector<FixedDirections> fixed     = fixed_of_owned(space, dirichlet);
      if (below != nullptr)
        rows.push_back(interpolation_rows(space, *below, bodies.tetrahedra()));
      else if (coarse_levels == CoarseLevels::background ||
               (coarse_levels == CoarseLevels::automatic && LevelZero().uses_amg(space.n_conforming_nodes())))
        {
          const std::vector<NodeIndex> carriers =
              dirichlet.rigid != nullptr ? dirichlet.rigid->carriers() : std::vector<NodeIndex>();
          add_background(
              background_levels(space, without_carriers(fixed, carriers, space.owned()), bodies, carriers),
              rigid);
        }
      if (dirichlet.rigid != nullptr)
        rigid_faces.push_back(dirichlet.rigid);
      if (owned_nodes.empty())
        places = node_places(bodies, space);
      owned_nodes.push_back(space.owned());
      with_rollers = with_rollers || has_oblique(fixed, space.communicator());
      masks.push_back(std::move(fixed));
      below = &space;
    };
    for (const auto &space : coarser)
      add(*space);
    add(finest);
    gather_small_levels(finest.communicator());
  }



  void LevelSpaces::gather_small_levels(const MPI_Comm communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                       rank    = Utilities::MPI::this_mpi_process(communicator);
    for (unsigned int level = 0; level + 1 < n_levels(); ++level)
      {
        const unsigned int size = SmallLevelsRule().group_size(owned_nodes[level].size(), n_ranks);
        if (size == 1)
          continue;
        MPI_Comm group;
        MPI_Comm_split(communicator, static_cast<int>(rank / size), static_cast<int>(rank), &group);
        gather_level(level, group);
        MPI_Comm_free(&group);
      }
  }



  void LevelSpaces::gather_level(const unsigned int level, const MPI_Comm group)
  {
    const auto gathered = [&](auto &list) {
      list = gather_lists(std::move(list), group, Receivers::rank_zero);
    };
    const NodeIndex        n    = owned_nodes[level].size();
    std::vector<NodeIndex> ends = {0, 0};
    if (owned_nodes[level].n_elements() > 0)
      ends = {owned_nodes[level].nth_index_in_set(0),
              owned_nodes[level].nth_index_in_set(owned_nodes[level].n_elements() - 1) + 1};
    // Ranks own consecutive ranges.
    if (ends[0] == ends[1])
      ends.clear();
    gathered(ends);
    owned_nodes[level] = IndexSet(n);
    if (!ends.empty())
      owned_nodes[level].add_range(ends.front(), ends.back());
    owned_nodes[level].compress();
    gathered(masks[level]);
    if (level > 0)
      {
        NodeRows                &mine = rows[level - 1];
        std::vector<std::size_t> lengths(mine.n_rows());
        for (std::size_t i = 0; i < lengths.size(); ++i)
          lengths[i] = mine.start[i + 1] - mine.start[i];
        gathered(lengths);
        gathered(mine.columns);
        gathered(mine.weights);
        mine.start.assign(1, 0);
        for (const std::size_t length : lengths)
          mine.start.push_back(mine.start.back() + length);
      }
    else
      {
        std::vector<std::array<double, 3>> positions;
        for (const Point<3> &p : places.positions)
          positions.push_back({{p[0], p[1], p[2]}});
        gathered(positions);
        gathered(places.parts);
        places.positions.clear();
        for (const auto &p : positions)
          places.positions.emplace_back(p[0], p[1], p[2]);
      }
  }



  void LevelSpaces::add_background(std::vector<DistributedBackgroundLevel> &&levels,
                                   const std::vector<RigidFace>             &rigid)
  {
    std::reverse(levels.begin(), levels.end());
    n_background = static_cast<unsigned int>(levels.size());
    for (DistributedBackgroundLevel &level : levels)
      {
        if (owned_nodes.empty())
          {
            places.positions = std::move(level.positions);
            places.parts.assign(level.parts.begin(), level.parts.end());
          }
        masks.emplace_back(level.owned.n_elements(), FixedDirections());
        if (!rigid.empty())
          rigid_faces.push_back(std::make_shared<const RigidFaces>(rigid, std::move(level.carriers)));
        owned_nodes.push_back(std::move(level.owned));
        rows.push_back(std::move(level.rows));
      }
  }
} // namespace Signorini
