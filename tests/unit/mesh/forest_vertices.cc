// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Moving vertices of a distributed mesh: the same bits as on one rank.

#include <signorini/algebra/collectives.h>
#include <signorini/mesh/forest_vertices.h>
#include <signorini/mesh/tetrahedral_forest.h>

#include <gtest/gtest.h>

#include <map>

#include "start_meshes.h"

using namespace Signorini;
using dealii::ArrayView;
using dealii::Point;

namespace
{
  struct Moved
  {
    std::map<ForestMesh::Name, std::array<double, 3>> positions;
    std::vector<ForestMesh::Name>                     late;
    MovementReport                                    report;
  };

  /// Refines cubes on a communicator and presses their top down, some vertices by more than the others.
  Moved press(const MPI_Comm communicator, const double depth)
  {
    const VolumeMesh  start = cubes_of_tetrahedra(3);
    TetrahedralForest forest(start.vertices, tetrahedra_of(start), communicator);
    for (unsigned int level = 0; level < 2; ++level)
      forest.refine(std::vector<bool>(forest.mesh(level).n_owned, true));
    const ForestMesh    &mesh = forest.mesh(2);
    const ForestVertices vertices(mesh, communicator);

    std::vector<double>                        flags(mesh.vertices.size(), 0.);
    std::vector<ArrayView<const unsigned int>> cells;
    for (const Tetrahedron &cell : mesh.cells)
      {
        cells.emplace_back(cell.vertices.data(), 4);
        for (unsigned int f = 0; f < 4; ++f)
          for (const unsigned int v : CellShape::face(4, f))
            if (cell.boundary[f] != Tetrahedron::inner)
              flags[cell.vertices[v]] = 1.;
      }
    vertices.update(flags);
    std::vector<std::pair<unsigned int, Point<3>>> targets;
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      if (const Point<3> x = mesh.points[v]; vertices.owns(v) && x[2] > 3. - 1e-10)
        targets.emplace_back(v, Point<3>(x[0], x[1], x[2] - depth * (1. + x[0] * x[1])));
    std::vector<unsigned int> late;
    Moved                     result;
    result.report = move_nodes(forest.points(), targets, cells, std::vector<bool>(flags.begin(), flags.end()),
                               late, vertices);
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      result.positions[mesh.vertices[v]] = {{mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]}};
    for (const unsigned int v : late)
      result.late.push_back(mesh.vertices[v]);
    return result;
  }
} // namespace



TEST(ForestVertices, MovementDoesNotDependOnTheNumberOfRanks)
{
  bool any_late = false, any_damped = false;
  for (const double depth : {.02, .1, .14, .3})
    {
      const Moved one = press(MPI_COMM_SELF, depth), mine = press(MPI_COMM_WORLD, depth);
      std::size_t n_wrong = 0;
      for (const auto &[name, x] : mine.positions)
        n_wrong += one.positions.at(name) != x;
      EXPECT_EQ(n_wrong, 0u) << depth;
      std::vector<ForestMesh::Name> late;
      for (const auto &list : gather_values(mine.late, MPI_COMM_WORLD))
        late.insert(late.end(), list.begin(), list.end());
      std::sort(late.begin(), late.end());
      EXPECT_EQ(late, one.late) << depth;
      EXPECT_EQ(mine.report.n_moved, one.report.n_moved);
      EXPECT_EQ(mine.report.n_damped, one.report.n_damped);
      EXPECT_EQ(mine.report.quality_before, one.report.quality_before);
      EXPECT_EQ(mine.report.quality_after, one.report.quality_after);
      any_late   = any_late || !late.empty();
      any_damped = any_damped || one.report.quality_after < .99 * one.report.quality_before;
    }
  EXPECT_TRUE(any_late && any_damped);
}
