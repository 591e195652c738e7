// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The distributed forest against the serial one, on communicators of all sizes that there are ranks for.

#include <signorini/algebra/collectives.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/mesh/tetrahedral_forest.h>

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "serial_forest.h"
#include "start_meshes.h"

using namespace Signorini;
using dealii::Point;

namespace
{
  using Forest   = TetrahedralForest;
  using Position = std::array<double, 3>;

  /// Calls test(communicator) on the first 1, 2, ... ranks, powers of two beyond four.
  template <typename Test>
  void for_all_sizes(const Test &test)
  {
    const int rank    = static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    const int n_ranks = static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    for (int n = 1; n <= n_ranks; n += n < 4 ? 1 : n)
      {
        MPI_Comm part;
        MPI_Comm_split(MPI_COMM_WORLD, rank < n ? 0 : MPI_UNDEFINED, rank, &part);
        if (rank < n)
          {
            SCOPED_TRACE(std::to_string(n) + " ranks, rank " + std::to_string(rank));
            test(part);
            MPI_Comm_free(&part);
          }
        MPI_Barrier(MPI_COMM_WORLD);
      }
  }

  Position position(const Point<3> &p)
  {
    return {{p[0], p[1], p[2]}};
  }

  SerialForest serial_forest(const VolumeMesh &mesh)
  {
    std::vector<SerialForest::Cell> cells;
    for (const Tetrahedron &cell : tetrahedra_of(mesh))
      cells.push_back({cell.vertices, cell.boundary, cell.material, cell.generation});
    return SerialForest(mesh.vertices, cells);
  }

  std::vector<bool> own_part(const std::vector<bool> &marked, const ForestMesh &mesh)
  {
    std::vector<bool> mine;
    for (std::size_t c = 0; c < mesh.n_owned; ++c)
      mine.push_back(marked[mesh.cell_numbers[mesh.first_owned + c]]);
    return mine;
  }

  /// Cells, bit by bit and in the same order, ghost cells and numbers of vertices.
  void expect_same(const ForestMesh &mesh, const SerialForest &serial, const unsigned int level,
                   const MPI_Comm communicator)
  {
    const auto        &all  = serial.cells(level);
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    ASSERT_EQ(mesh.n_global_cells(), all.size());
    ASSERT_EQ(mesh.first_cell[rank + 1] - mesh.first_cell[rank], mesh.n_owned);

    std::vector<bool> near(serial.n_vertices(level), false);
    for (std::uint64_t c = mesh.first_cell[rank]; c < mesh.first_cell[rank + 1]; ++c)
      for (const unsigned int v : all[c].vertices)
        near[v] = true;
    std::vector<std::uint64_t> numbers(serial.n_vertices(level), std::uint64_t(-1)), expected;
    std::uint64_t              n = 0;
    for (std::uint64_t c = 0; c < all.size(); ++c)
      {
        bool is_near = false;
        for (const unsigned int v : all[c].vertices)
          {
            if (numbers[v] == std::uint64_t(-1))
              numbers[v] = n++;
            is_near = is_near || near[v];
          }
        if (is_near)
          expected.push_back(c);
      }
    ASSERT_EQ(mesh.cell_numbers, expected);
    EXPECT_EQ(mesh.first_vertex.back(), serial.n_vertices(level));

    std::size_t n_wrong = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto &cell  = mesh.cells[c];
        const auto &other = all[mesh.cell_numbers[c]];
        bool        same  = cell.boundary == other.boundary && cell.material == other.material &&
                    cell.generation == other.generation && mesh.is_owned(c) == (mesh.owner(c) == rank);
        for (unsigned int i = 0; i < 4; ++i)
          same = same && mesh.vertex_numbers[cell.vertices[i]] == numbers[other.vertices[i]] &&
                 position(mesh.points[cell.vertices[i]]) == position(serial.vertices()[other.vertices[i]]);
        n_wrong += !same;
      }
    EXPECT_EQ(n_wrong, 0u);
  }

  /// Names of vertices of all ranks and meshes, as vertices of the serial forest.
  std::map<ForestMesh::Name, unsigned int> serial_vertices(const Forest &forest, const SerialForest &serial)
  {
    std::vector<std::array<std::uint64_t, 2>> mine;
    for (unsigned int l = 0; l < forest.n_levels(); ++l)
      for (std::size_t c = 0; c < forest.mesh(l).cells.size(); ++c)
        for (unsigned int i = 0; i < 4; ++i)
          mine.push_back({{forest.mesh(l).vertices[forest.mesh(l).cells[c].vertices[i]],
                           serial.cells(l)[forest.mesh(l).cell_numbers[c]].vertices[i]}});
    std::map<ForestMesh::Name, unsigned int> result;
    for (const auto &list : gather_values(mine, forest.communicator()))
      for (const auto &[name, vertex] : list)
        {
          const auto it = result.insert({name, static_cast<unsigned int>(vertex)}).first;
          EXPECT_EQ(it->second, vertex);
        }
    return result;
  }

  std::map<unsigned int, double> serial_row(const SerialForest &serial, const unsigned int vertex,
                                            const unsigned int coarse)
  {
    if (vertex < serial.n_vertices(coarse))
      return {{vertex, 1.}};
    std::map<unsigned int, double> row;
    for (const unsigned int parent : serial.parents(vertex))
      for (const auto &[v, weight] : serial_row(serial, parent, coarse))
        row[v] += .5 * weight;
    return row;
  }

  bool halves_twice(const SerialForest &serial, const unsigned int coarse, const unsigned int fine)
  {
    for (unsigned int v = serial.n_vertices(coarse); v < serial.n_vertices(fine); ++v)
      for (const unsigned int parent : serial.parents(v))
        if (parent >= serial.n_vertices(coarse))
          return true;
    return false;
  }

  /// Interpolation to coarser meshes and what the vertices are on.
  void expect_same_history(const Forest &forest, const SerialForest &serial)
  {
    const auto        &history = forest.history();
    const auto         vertex  = serial_vertices(forest, serial);
    const unsigned int finest  = forest.n_levels() - 1;
    const ForestMesh  &mesh    = forest.mesh(finest);
    EXPECT_EQ(vertex.size(), serial.vertices().size());
    for (unsigned int coarse = 0; coarse < finest; ++coarse)
      {
        EXPECT_EQ(history.n_vertices(coarse), serial.n_vertices(coarse));
        for (unsigned int fine = coarse + 1; fine <= finest; ++fine)
          EXPECT_EQ(history.halves_twice(coarse, fine), halves_twice(serial, coarse, fine));
        const auto  rows    = history.rows(mesh.vertices, coarse);
        std::size_t n_wrong = 0;
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
          {
            std::map<unsigned int, double> row;
            for (std::size_t k = rows.start[v]; k < rows.start[v + 1]; ++k)
              row[vertex.at(rows.names[k])] = rows.weights[k];
            n_wrong += row != serial_row(serial, vertex.at(mesh.vertices[v]), coarse);
            if (coarse > 0)
              continue;
            std::set<unsigned int> corners;
            for (const unsigned int corner : mesh.carriers[v])
              if (corner != ForestMesh::none)
                corners.insert(corner);
            std::set<unsigned int> expected;
            for (const auto &entry : row)
              expected.insert(entry.first);
            n_wrong += corners != expected;
          }
        EXPECT_EQ(n_wrong, 0u) << "mesh " << coarse;
      }
  }

  /// All lists of a space.
  std::size_t bytes_of(const NodalSpace &space)
  {
    const auto  bytes = [](const auto &list) { return list.capacity() * sizeof(list[0]); };
    std::size_t nodes = 0;
    for (const auto &cell : space.cells())
      nodes += space.nodes(cell).size();
    return bytes(space.cells()) + nodes * sizeof(NodeIndex) + bytes(space.boundary_faces()) +
           bytes(space.inner_faces()) + bytes(space.start_vertices()) + bytes(space.node_sets()) +
           bytes(space.owned_forest_vertices()) + space.relevant().n_elements() * sizeof(Point<3>) +
           space.owned().memory_consumption() + space.relevant().memory_consumption() +
           space.hanging_nodes().memory_consumption();
  }

  void compare(const VolumeMesh &start, const unsigned int n_refinements, const unsigned int one_of)
  {
    for_all_sizes([&](const MPI_Comm communicator) {
      SerialForest serial = serial_forest(start);
      Forest       forest(start.vertices, tetrahedra_of(start), communicator);
      expect_same(forest.mesh(0), serial, 0, communicator);
      std::mt19937 random(1);
      for (unsigned int level = 1; level <= n_refinements; ++level)
        {
          std::vector<bool> marked(serial.cells(level - 1).size());
          for (std::size_t c = 0; c < marked.size(); ++c)
            marked[c] = random() % one_of == 0;
          marked[random() % marked.size()] = true;
          ASSERT_TRUE(serial.refine(marked));
          ASSERT_TRUE(forest.refine(own_part(marked, forest.mesh(level - 1))));
          expect_same(forest.mesh(level), serial, level, communicator);
        }
      EXPECT_FALSE(forest.refine(std::vector<bool>(forest.mesh(n_refinements).n_owned, false)));
      expect_same_history(forest, serial);
    });
  }
} // namespace



TEST(DistributedForest, RandomMarksOnACube)
{
  compare(cubes_of_tetrahedra(), 5, 10);
}



TEST(DistributedForest, FewMarks)
{
  compare(cubes_of_tetrahedra(3), 12, 1000000);
}



TEST(DistributedForest, Uniform)
{
  compare(regular_tetrahedron(), 4, 1);
}



TEST(DistributedForest, UnstructuredMesh)
{
  compare(unstructured_tetrahedra(), 2, 50);
}



TEST(DistributedForest, PartsThatHangTogetherByAVertex)
{
  compare(hanging_by_a_vertex(), 4, 3);
}



TEST(DistributedForest, LookUpFindsValuesOfAllRanks)
{
  for_all_sizes([](const MPI_Comm communicator) {
    const VolumeMesh start = cubes_of_tetrahedra(2);
    Forest           forest(start.vertices, tetrahedra_of(start), communicator);
    for (unsigned int level = 0; level < 2; ++level)
      forest.refine(std::vector<bool>(forest.mesh(level).n_owned, true));
    const unsigned int            rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    const ForestMesh             &mesh = forest.mesh(2);
    std::vector<ForestMesh::Name> names;
    std::vector<NodeIndex>        values;
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      if (mesh.owns_vertex(rank, v))
        {
          names.push_back(mesh.vertices[v]);
          values.push_back(static_cast<NodeIndex>(mesh.vertex_numbers[v]));
        }
    const auto found = forest.history().look_up(names, values, mesh.vertices);
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      EXPECT_EQ(found[v], mesh.vertex_numbers[v]);
  });
}



TEST(DistributedForest, WeightsAreBalanced)
{
  for_all_sizes([](const MPI_Comm communicator) {
    const VolumeMesh   start   = cubes_of_tetrahedra(4);
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    Forest             forest(start.vertices, tetrahedra_of(start), communicator);
    // All of one: as many cells as can be.
    forest.refine(std::vector<bool>(forest.mesh(0).n_owned, true));
    const std::uint64_t n = forest.mesh(1).n_global_cells();
    EXPECT_EQ(forest.mesh(1).first_cell[rank], n * rank / n_ranks);
    // Cells that are refined weigh ten times as much.
    std::vector<bool> marked(forest.mesh(1).n_owned);
    for (std::size_t c = 0; c < marked.size(); ++c)
      marked[c] = forest.mesh(1).cell_numbers[forest.mesh(1).first_owned + c] < n / 4;
    const CellWeight weight = [](const Tetrahedron &cell) { return cell.generation > 3 ? 10u : 1u; };
    forest.refine(marked, weight);
    const ForestMesh &mesh = forest.mesh(2);
    std::uint64_t     mine = 0;
    for (std::size_t c = 0; c < mesh.n_owned; ++c)
      mine += weight(mesh.cells[mesh.first_owned + c]);
    const std::uint64_t all = dealii::Utilities::MPI::sum(mine, communicator);
    EXPECT_LE(mine, all / n_ranks + 10);
    EXPECT_GE(mine + 10, all / n_ranks);
  });
}



TEST(DistributedForest, MarksOfVerticesStay)
{
  for_all_sizes([](const MPI_Comm communicator) {
    const VolumeMesh start = cubes_of_tetrahedra(2);
    Forest           forest(start.vertices, tetrahedra_of(start), communicator);
    for (unsigned int level = 0; level < 3; ++level)
      {
        const ForestMesh &mesh = forest.mesh(level);
        for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
          {
            const bool is_new = level > 0 && mesh.vertices[v] >= forest.history().n_vertices(level - 1);
            EXPECT_EQ(mesh.is_marked[v], level > 0 && !is_new && mesh.vertices[v] % 3 == 1);
            forest.vertex_marks()[v] = mesh.vertices[v] % 3 == 1;
          }
        forest.refine(std::vector<bool>(mesh.n_owned, true));
      }
  });
}



// As many cells a rank on any number of ranks: what a rank holds must not grow with their number, but for
// ghosts (in a chain of cubes on a curve: two cross sections) and a few numbers for each rank.
TEST(DistributedForest, MemoryOfARankDoesNotGrowWithTheirNumber)
{
  // 24,576 cells a rank on the finest mesh.
  std::size_t on_one_rank = 0;
  for_all_sizes([&](const MPI_Comm communicator) {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const VolumeMesh   start   = cubes_of_tetrahedra(4 * n_ranks);
    Forest             forest(start.vertices, tetrahedra_of(start), communicator);
    for (unsigned int level = 0; level < 3; ++level)
      forest.refine(std::vector<bool>(forest.mesh(level).n_owned, true));
    std::size_t n_ghosts = 0;
    for (unsigned int level = 0; level < 4; ++level)
      n_ghosts += forest.mesh(level).cells.size() - forest.mesh(level).n_owned;
    n_ghosts = dealii::Utilities::MPI::max(n_ghosts, communicator);

    std::size_t bytes = forest.memory_consumption();
    for (unsigned int level = 0; level < 4; ++level)
      bytes += bytes_of(NodalSpace(communicator, {nullptr, &forest, level, nullptr}, true));
    bytes = dealii::Utilities::MPI::max(bytes, communicator);
    if (n_ranks == 1)
      on_one_rank = bytes;
    on_one_rank = dealii::Utilities::MPI::max(on_one_rank, communicator);
    EXPECT_LE(bytes, 1.05 * on_one_rank + 250. * n_ghosts + 1000. * n_ranks);
    EXPECT_LE(n_ghosts, 20000u);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      RecordProperty("bytes_on_" + std::to_string(n_ranks) + "_ranks", std::to_string(bytes));
  });
}
