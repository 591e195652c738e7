// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Structured cube problems with known answers (doc/verification.md): the solvers see plain rows and blocks,
// no mesh. Nodes are numbered layer by layer, so every rank owns a slab.

#ifndef tests_unit_solvers_cube_problem_h
#define tests_unit_solvers_cube_problem_h

#include <signorini/algebra/rotation.h>
#include <signorini/solvers/multigrid_hierarchy.h>

#include <deal.II/base/mpi.h>

#include <signorini/discretization/hexahedron.h>

namespace CubeProblem
{
  using namespace Signorini;
  using namespace dealii;

  /// A grid of n^3 cells on the unit cube, its nodes distributed in slabs.
  struct Grid
  {
    /// With a stride other than 1, prime to (n + 1)^3, numbers are scattered: every node has neighbours on
    /// most of the ranks.
    explicit Grid(const unsigned int n, const unsigned int stride = 1)
      : n(n)
      , owned((n + 1) * (n + 1) * (n + 1))
      , place(owned.size())
      , number(owned.size())
    {
      const unsigned int size = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const NodeIndex    all  = (n + 1) * (n + 1) * (n + 1);
      owned.add_range(all * rank / size, all * (rank + 1) / size);
      for (NodeIndex p = 0; p < all; ++p)
        place[number[p] = p * stride % all] = p;
    }

    NodeIndex node(const unsigned int i, const unsigned int j, const unsigned int k) const
    {
      return number[(k * (n + 1) + j) * (n + 1) + i];
    }

    std::array<unsigned int, 3> index(const NodeIndex numbered) const
    {
      const NodeIndex node = place[numbered];
      return {{static_cast<unsigned int>(node % (n + 1)), static_cast<unsigned int>(node / (n + 1) % (n + 1)),
               static_cast<unsigned int>(node / ((n + 1) * (n + 1)))}};
    }

    /// u = 0 on z = 1.
    std::vector<FixedDirections> fixed() const
    {
      std::vector<FixedDirections> masks;
      for (const NodeIndex p : owned)
        masks.push_back(index(p)[2] == n ? all_fixed : 0);
      return masks;
    }

    unsigned int n;
    IndexSet     owned;

  private:
    /// In the order of layers, by number and the opposite.
    std::vector<NodeIndex> place, number;
  };

  /// Stiffness of E = 1; cells belong to the rank of their first node. The cube may be flattened.
  inline NodeBlockMatrix stiffness(const Grid &grid, const double height = 1., const double nu = .3)
  {
    const unsigned int n     = grid.n;
    const NodeIndex    begin = grid.owned.nth_index_in_set(0), size = grid.owned.n_elements();
    std::map<NodeIndex, std::set<NodeIndex>> rows;
    std::vector<std::array<NodeIndex, 8>>    cells;
    for (const NodeIndex first : grid.owned)
      {
        const auto [i, j, k] = grid.index(first);
        if (i == n || j == n || k == n)
          continue;
        cells.emplace_back();
        for (unsigned int v = 0; v < 8; ++v)
          cells.back()[v] = grid.node(i + (v & 1), j + (v >> 1 & 1), k + (v >> 2));
        for (const NodeIndex a : cells.back())
          rows[a].insert(cells.back().begin(), cells.back().end());
      }
    NodePattern pattern;
    for (const NodeIndex p : grid.owned)
      {
        pattern.columns.insert(pattern.columns.end(), rows[p].begin(), rows[p].end());
        pattern.row_start.push_back(pattern.columns.size());
      }
    for (const auto &[p, columns] : rows)
      if (p < begin || p >= begin + size)
        {
          pattern.foreign_rows.push_back(p);
          pattern.columns.insert(pattern.columns.end(), columns.begin(), columns.end());
          pattern.row_start.push_back(pattern.columns.size());
        }
    NodeBlockMatrix matrix;
    matrix.reinit(grid.owned, pattern, IndexSet(grid.owned.size()), MPI_COMM_WORLD);

    Hexahedron::Corners corners;
    for (unsigned int v = 0; v < 8; ++v)
      corners[v] = Point<3>((v & 1) / double(n), (v >> 1 & 1) / double(n), height * (v >> 2) / double(n));
    std::array<double, 576> k;
    Hexahedron::stiffness(k, corners, {1., nu});
    for (const auto &cell : cells)
      for (unsigned int a = 0; a < 8; ++a)
        for (unsigned int b = 0; b < 8; ++b)
          {
            const auto        &p      = matrix.partition();
            const unsigned int row    = matrix.row_of(p.to_local(cell[a]));
            const unsigned int column = p.to_local(cell[b]);
            if (matrix.stores(row, column))
              for (unsigned int c = 0; c < 9; ++c)
                matrix.block(matrix.find(row, column))[c] += k[9 * (8 * a + b) + c];
          }
    matrix.compress();
    return matrix;
  }

  /// Trilinear interpolation of the owned nodes of a grid from the grid with half the cells.
  inline NodeRows interpolation(const Grid &fine, const Grid &coarse)
  {
    NodeRows rows;
    for (const NodeIndex p : fine.owned)
      {
        const auto index = fine.index(p);
        for (unsigned int v = 0; v < 8; ++v)
          {
            double                      weight = 1.;
            std::array<unsigned int, 3> parent;
            for (unsigned int c = 0; c < 3; ++c)
              {
                const bool odd = index[c] % 2, upper = v >> c & 1;
                weight *= odd ? .5 : (upper ? 0. : 1.);
                parent[c] = index[c] / 2 + upper;
              }
            if (weight > 0.)
              rows.add(coarse.node(parent[0], parent[1], parent[2]), weight);
          }
        rows.finish_row();
      }
    return rows;
  }

  /// Unit normals of z = 0 as a function of x and y.
  using Normals = std::function<Vector3(double, double)>;

  inline Vector3 downwards(const double, const double)
  {
    Vector3 normal;
    normal[2] = -1.;
    return normal;
  }

  /// Problem S1: rigid paraboloid under the face z = 0.
  inline HalfSpaces paraboloid(const Grid &grid)
  {
    HalfSpaces half_spaces;
    for (const NodeIndex p : grid.owned)
      if (const auto [i, j, k] = grid.index(p); k == 0)
        {
          const double x = i / double(grid.n) - .5, y = j / double(grid.n) - .5;
          half_spaces.nodes.push_back(static_cast<unsigned int>(p - grid.owned.nth_index_in_set(0)));
          half_spaces.normals.push_back(downwards(x, y));
          half_spaces.bounds.push_back(x * x + y * y - .05);
        }
    return half_spaces;
  }

  /// The contact nodes of a grid, z = 0.
  inline LevelInterface contact_interface(const Grid &grid)
  {
    LevelInterface result;
    for (unsigned int i = 0; i <= grid.n; ++i)
      for (unsigned int j = 0; j <= grid.n; ++j)
        result.contact_nodes.push_back(grid.node(i, j, 0));
    std::sort(result.contact_nodes.begin(), result.contact_nodes.end());
    return result;
  }

  /// Their normals on this rank.
  inline HalfSpaces contact(const Grid &grid, const Normals &normals)
  {
    HalfSpaces result;
    for (const NodeIndex p : grid.owned)
      if (const auto index = grid.index(p); index[2] == 0)
        {
          result.nodes.push_back(static_cast<unsigned int>(p - grid.owned.nth_index_in_set(0)));
          result.normals.push_back(normals(index[0] / double(grid.n), index[1] / double(grid.n)));
        }
    return result;
  }

  /// Grids with half, a quarter, ... of the cells. Rows of the nodes on z = 0 are block rows so that they can
  /// be truncated, turned from normal to normal.
  class Levels : public LevelSource
  {
  public:
    Levels(const unsigned int n, const Normals &normals)
      : n(n)
      , m(n)
      , normals(normals)
    {
    }

    std::optional<CoarserLevel> next(const NodePartition &finer) override
    {
      if (m <= 2)
        return {};
      const Grid     fine(m), coarse(m / 2);
      const NodeRows rows      = import_ghost_rows(finer, interpolation(fine, coarse));
      const auto     normal_of = [&](const Grid &grid, const NodeIndex p) {
        const auto index = grid.index(p);
        return normals(index[0] / double(grid.n), index[1] / double(grid.n));
      };
      std::vector<NodalTransfer::BlockRow> block_rows;
      for (unsigned int i = 0; i < finer.n_local(); ++i)
        if (finer.to_global(i) < (m + 1) * (m + 1))
          {
            NodalTransfer::BlockRow row{i, {}, {}, {}};
            for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
              {
                row.columns.push_back(rows.columns[k]);
                row.blocks.push_back(rows.weights[k] * rotation(normal_of(coarse, rows.columns[k]),
                                                                normal_of(fine, finer.to_global(i))));
              }
            block_rows.push_back(row);
          }
      CoarserLevel result;
      result.transfer.reinit(rows, block_rows, finer.n_owned());
      result.owned   = coarse.owned;
      result.fixed   = coarse.fixed();
      result.contact = contact(coarse, normals);
      if (m / 2 > 2)
        result.interface = contact_interface(coarse);
      m /= 2;
      return result;
    }

    LevelZero level_zero(const NodePartition &) override
    {
      LevelZero result;
      result.contact = contact(Grid(n), normals);
      return result;
    }

  private:
    const unsigned int n;
    unsigned int       m;
    const Normals      normals;
  };

  /// The finest level of a Galerkin hierarchy with base 2.
  inline HierarchyParts finest_level(const unsigned int n)
  {
    const Grid     grid(n);
    HierarchyParts parts;
    parts.matrix    = stiffness(grid);
    parts.fixed     = grid.fixed();
    parts.interface = contact_interface(grid);
    return parts;
  }

  /// Galerkin hierarchy with base 2. With a problem and a start it is built truncated at the active set that
  /// they let expect.
  inline MultigridHierarchy hierarchy(const unsigned int n, const Normals &normals = downwards,
                                      const ObstacleProblem *const   problem = nullptr,
                                      const Signorini::Vector *const start   = nullptr)
  {
    Levels         levels(n, normals);
    HierarchyParts parts = finest_level(n);
    parts.levels         = &levels;
    parts.problem        = problem;
    parts.start          = start;
    return MultigridHierarchy(std::move(parts));
  }

  /// Gives the coarser levels of hierarchy(n) their half-spaces.
  inline void set_coarse_half_spaces(MultigridHierarchy                            &hierarchy,
                                     const std::function<HalfSpaces(const Grid &)> &half_spaces)
  {
    for (unsigned int l = 0, n = 2; l + 1 < hierarchy.n_levels(); ++l, n *= 2)
      hierarchy.level(l).half_spaces = half_spaces(Grid(n));
  }
} // namespace CubeProblem

#endif
