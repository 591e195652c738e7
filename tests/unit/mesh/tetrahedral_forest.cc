// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/tetrahedral_forest.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "start_meshes.h"

using namespace Signorini;
using dealii::Point;
namespace Parallel = dealii::Utilities::MPI;

namespace
{
  const ForestMesh &last(const TetrahedralForest &forest)
  {
    return forest.mesh(forest.n_levels() - 1);
  }

  TetrahedralForest forest_of(const VolumeMesh &mesh)
  {
    return TetrahedralForest(mesh.vertices, tetrahedra_of(mesh), MPI_COMM_WORLD);
  }

  std::array<Point<3>, 4> corners(const ForestMesh &mesh, const std::size_t c)
  {
    const auto &v = mesh.cells[c].vertices;
    return {{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]}};
  }

  double worst_quality(const ForestMesh &mesh)
  {
    double worst = 1.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      worst = std::min(worst, tetrahedron_quality(corners(mesh, c)));
    return Parallel::min(worst, MPI_COMM_WORLD);
  }

  double volume(const ForestMesh &mesh)
  {
    double sum = 0.;
    for (std::size_t c = mesh.first_owned; c < mesh.first_owned + mesh.n_owned; ++c)
      {
        const auto x = corners(mesh, c);
        sum += cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) / 6.;
      }
    return Parallel::sum(sum, MPI_COMM_WORLD);
  }

  /// Every face of an own cell belongs to two cells that are seen or is on the boundary, whose area is
  /// returned.
  double check_conformity(const ForestMesh &mesh)
  {
    std::map<std::array<unsigned int, 3>, unsigned int> n_cells;
    const auto face = [&](const std::size_t c, const unsigned int f) {
      std::array<unsigned int, 3> key;
      for (unsigned int i = 0; i < 3; ++i)
        key[i] = mesh.cells[c].vertices[CellShape::face(4, f)[i]];
      std::sort(key.begin(), key.end());
      return key;
    };
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int f = 0; f < 4; ++f)
        ++n_cells[face(c, f)];
    double area = 0.;
    for (std::size_t c = mesh.first_owned; c < mesh.first_owned + mesh.n_owned; ++c)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const auto key      = face(c, f);
          const bool is_inner = mesh.cells[c].boundary[f] == Tetrahedron::inner;
          EXPECT_EQ(n_cells[key], is_inner ? 2u : 1u);
          if (!is_inner)
            area += .5 * cross_product_3d(mesh.points[key[1]] - mesh.points[key[0]],
                                          mesh.points[key[2]] - mesh.points[key[0]])
                             .norm();
        }
    return Parallel::sum(area, MPI_COMM_WORLD);
  }

  void refine_all(TetrahedralForest &forest)
  {
    ASSERT_TRUE(forest.refine(std::vector<bool>(last(forest).n_owned, true)));
  }
} // namespace



TEST(TetrahedronQuality, KnownValues)
{
  const auto forest = forest_of(regular_tetrahedron());
  EXPECT_NEAR(worst_quality(forest.mesh(0)), 1., 1e-14);
  const std::array<Point<3>, 4> corner = {
      {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)}};
  // Volume 1/6, squared edges 3 * 1 + 3 * 2.
  EXPECT_NEAR(tetrahedron_quality(corner), 12. * std::pow(.5, 2. / 3.) / 9., 1e-14);
  EXPECT_LT(tetrahedron_quality({{corner[1], corner[0], corner[2], corner[3]}}), 0.);
}



// deal.II 9.4.1 goes through 0.86, 0.67, 0.46, 0.29, 0.17.
TEST(TetrahedralForest, UniformRefinementKeepsQuality)
{
  auto forest = forest_of(regular_tetrahedron());
  for (unsigned int level = 1; level <= 5; ++level)
    {
      refine_all(forest);
      EXPECT_EQ(last(forest).n_global_cells(), std::uint64_t(1) << (3 * level));
      EXPECT_GT(worst_quality(last(forest)), .46) << "level " << level;
      EXPECT_NEAR(volume(last(forest)), 8. / 3., 1e-12);
    }
  check_conformity(last(forest));
}



TEST(TetrahedralForest, UnstructuredMeshSixLevels)
{
  auto         forest = forest_of(unstructured_tetrahedra());
  const double start = worst_quality(forest.mesh(0)), space = volume(forest.mesh(0));
  const double area = check_conformity(forest.mesh(0));
  for (unsigned int level = 1; level <= 6; ++level)
    {
      // Refine toward the first contact.
      const ForestMesh &mesh = last(forest);
      std::vector<bool> marked;
      for (std::size_t c = mesh.first_owned; c < mesh.first_owned + mesh.n_owned; ++c)
        marked.push_back(corners(mesh, c)[1].norm() < 1.5 * std::pow(.5, level));
      ASSERT_TRUE(forest.refine(marked));
      EXPECT_GE(worst_quality(last(forest)), .5 * start) << "level " << level;
      EXPECT_NEAR(volume(last(forest)), space, 1e-12 * space);
      EXPECT_NEAR(check_conformity(last(forest)), area, 1e-12 * area);
    }
  EXPECT_GT(forest.mesh(6).n_global_cells(), forest.mesh(0).n_global_cells());
}



TEST(TetrahedralForest, RandomMarks)
{
  auto         forest = forest_of(cubes_of_tetrahedra());
  const double start  = worst_quality(forest.mesh(0));
  for (unsigned int level = 1; level <= 5; ++level)
    {
      const ForestMesh &mesh = last(forest);
      std::vector<bool> marked(mesh.n_owned);
      for (std::size_t c = 0; c < marked.size(); ++c)
        marked[c] = std::mt19937(level + 10 * mesh.cell_numbers[mesh.first_owned + c])() % 10 == 0 ||
                    mesh.cell_numbers[mesh.first_owned + c] == 0;
      ASSERT_TRUE(forest.refine(marked));
      EXPECT_NEAR(check_conformity(last(forest)), 6., 1e-12);
      EXPECT_NEAR(volume(last(forest)), 1., 1e-12);
      EXPECT_GE(worst_quality(last(forest)), .5 * start);
    }
}



TEST(VolumeMesh, SplitsKeepVolumeAndNames)
{
  const VolumeMesh mesh      = unstructured_tetrahedra();
  const VolumeMesh hexahedra = split_into_hexahedra(mesh);
  EXPECT_EQ(hexahedra.cells.size(), 4 * mesh.cells.size());
  EXPECT_EQ(hexahedra.faces.size(), 3 * mesh.faces.size());
  double worst = 1.;
  for (const auto &cell : hexahedra.cells)
    worst = std::min(worst, scaled_jacobian(hexahedra.corners(cell)));
  EXPECT_GT(worst, 0.);
  // The same faces as those that belong to one cell only.
  std::map<VolumeMesh::Face, unsigned int> named;
  for (const auto &face : hexahedra.faces)
    named[face_key(face.vertices)] = face.name;
  const auto found = find_boundary_faces(hexahedra);
  EXPECT_EQ(found.size(), named.size());
  for (const auto &face : found)
    EXPECT_EQ(named.count(face_key(face.first)), 1u);
}
