// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/mesh/cell_shape.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/tetrahedral_forest.h>
#include <signorini/mesh/volume_mesh.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

using namespace Signorini;
using dealii::Point;

namespace
{
  std::array<Point<3>, 4> corners(const TetrahedralForest &forest, const TetrahedralForest::Cell &cell)
  {
    const auto &x = forest.vertices();
    return {{x[cell.vertices[0]], x[cell.vertices[1]], x[cell.vertices[2]], x[cell.vertices[3]]}};
  }

  double worst_quality(const TetrahedralForest &forest, const unsigned int level)
  {
    double worst = 1.;
    for (const auto &cell : forest.cells(level))
      worst = std::min(worst, tetrahedron_quality(corners(forest, cell)));
    return worst;
  }

  double volume(const TetrahedralForest &forest, const unsigned int level)
  {
    double sum = 0.;
    for (const auto &cell : forest.cells(level))
      {
        const auto x = corners(forest, cell);
        sum += cross_product_3d(x[1] - x[0], x[2] - x[0]) * (x[3] - x[0]) / 6.;
      }
    return sum;
  }

  /// Every face belongs to two cells or has a boundary id, and areas of the boundaries stay.
  std::map<dealii::types::boundary_id, double> check_conformity(const TetrahedralForest &forest)
  {
    std::map<std::array<unsigned int, 3>, unsigned int> n_inner;
    std::map<dealii::types::boundary_id, double>        areas;
    for (const auto &cell : forest.cells(forest.n_levels() - 1))
      for (unsigned int f = 0; f < 4; ++f)
        {
          std::array<unsigned int, 3> key;
          for (unsigned int i = 0; i < 3; ++i)
            key[i] = cell.vertices[CellShape::face(4, f)[i]];
          const auto &x = forest.vertices();
          if (cell.boundary[f] != TetrahedralForest::inner)
            areas[cell.boundary[f]] +=
                .5 * cross_product_3d(x[key[1]] - x[key[0]], x[key[2]] - x[key[0]]).norm();
          else
            {
              std::sort(key.begin(), key.end());
              ++n_inner[key];
            }
        }
    for (const auto &entry : n_inner)
      EXPECT_EQ(entry.second, 2u);
    return areas;
  }

  TetrahedralForest forest_of(const VolumeMesh &mesh)
  {
    std::map<VolumeMesh::Face, unsigned int> names;
    for (const auto &face : find_boundary_faces(mesh))
      names[face_key(face.first)] = 7;
    std::vector<TetrahedralForest::Cell> cells;
    for (const auto &cell : mesh.cells)
      {
        cells.emplace_back();
        cells.back().material = 0;
        for (unsigned int f = 0; f < 4; ++f)
          {
            VolumeMesh::Face face;
            face.fill(VolumeMesh::no_vertex);
            for (unsigned int i = 0; i < 3; ++i)
              face[i] = cell.vertices[CellShape::face(4, f)[i]];
            cells.back().vertices[f] = cell.vertices[f];
            cells.back().boundary[f] =
                names.count(face_key(face)) > 0 ? names[face_key(face)] : TetrahedralForest::inner;
          }
      }
    return TetrahedralForest(mesh.vertices, cells);
  }

  TetrahedralForest regular_tetrahedron()
  {
    VolumeMesh mesh;
    mesh.vertices     = {Point<3>(1, 1, 1), Point<3>(1, -1, -1), Point<3>(-1, 1, -1), Point<3>(-1, -1, 1)};
    mesh.cells        = {{{{0, 1, 2, 3, 0, 0, 0, 0}}, 4, 0}};
    mesh.volume_names = {"all"};
    mend_orientation(mesh, "test");
    return forest_of(mesh);
  }

  VolumeMesh unstructured()
  {
    return read_volume_mesh(SIGNORINI_SOURCE_DIR "/prm/hertz/half_sphere_on_cube.msh", MPI_COMM_WORLD);
  }
} // namespace



TEST(TetrahedronQuality, KnownValues)
{
  const auto forest = regular_tetrahedron();
  EXPECT_NEAR(worst_quality(forest, 0), 1., 1e-14);
  const std::array<Point<3>, 4> corner = {
      {Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 1, 0), Point<3>(0, 0, 1)}};
  // Volume 1/6, squared edges 3 * 1 + 3 * 2.
  EXPECT_NEAR(tetrahedron_quality(corner), 12. * std::pow(.5, 2. / 3.) / 9., 1e-14);
  EXPECT_LT(tetrahedron_quality({{corner[1], corner[0], corner[2], corner[3]}}), 0.);
}



// deal.II 9.4.1 goes through 0.86, 0.67, 0.46, 0.29, 0.17.
TEST(TetrahedralForest, UniformRefinementKeepsQuality)
{
  auto forest = regular_tetrahedron();
  for (unsigned int level = 1; level <= 5; ++level)
    {
      ASSERT_TRUE(forest.refine(std::vector<bool>(forest.cells(level - 1).size(), true)));
      EXPECT_EQ(forest.cells(level).size(), std::size_t(1) << (3 * level));
      EXPECT_GT(worst_quality(forest, level), .46) << "level " << level;
      EXPECT_NEAR(volume(forest, level), 8. / 3., 1e-12);
    }
  check_conformity(forest);
}



TEST(TetrahedralForest, UnstructuredMeshSixLevels)
{
  auto         forest = forest_of(unstructured());
  const double start = worst_quality(forest, 0), space = volume(forest, 0);
  const auto   areas = check_conformity(forest);
  for (unsigned int level = 1; level <= 6; ++level)
    {
      // Refine toward the first contact.
      std::vector<bool> marked;
      for (const auto &cell : forest.cells(level - 1))
        marked.push_back((forest.vertices()[cell.vertices[0]] +
                          Point<3>(forest.vertices()[cell.vertices[1]] - forest.vertices()[cell.vertices[0]]))
                             .norm() < 1.5 * std::pow(.5, level));
      ASSERT_TRUE(forest.refine(marked));
      EXPECT_GE(worst_quality(forest, level), .5 * start) << "level " << level;
      EXPECT_NEAR(volume(forest, level), space, 1e-12 * space);
      for (const auto &[id, area] : check_conformity(forest))
        EXPECT_NEAR(area, areas.at(id), 1e-12 * area);
    }
  EXPECT_GT(forest.cells(6).size(), forest.cells(0).size());
}



TEST(TetrahedralForest, RandomMarks)
{
  std::mt19937 random(1);
  auto         forest = forest_of(split_into_tetrahedra([] {
    VolumeMesh cube;
    for (unsigned int v = 0; v < 8; ++v)
      cube.vertices.emplace_back(v & 1, v >> 1 & 1, v >> 2);
    cube.cells        = {{{{0, 1, 2, 3, 4, 5, 6, 7}}, 8, 0}};
    cube.volume_names = {"all"};
    return cube;
  }()));
  const double start  = worst_quality(forest, 0);
  for (unsigned int level = 1; level <= 5; ++level)
    {
      std::vector<bool> marked(forest.cells(level - 1).size());
      for (std::size_t c = 0; c < marked.size(); ++c)
        marked[c] = random() % 10 == 0;
      marked[0] = true;
      ASSERT_TRUE(forest.refine(marked));
      const auto areas = check_conformity(forest);
      EXPECT_NEAR(areas.at(7), 6., 1e-12);
      EXPECT_NEAR(volume(forest, forest.n_levels() - 1), 1., 1e-12);
      EXPECT_GE(worst_quality(forest, forest.n_levels() - 1), .5 * start);
      // Midpoints of edges of the mesh before, or of edges that came with this refinement.
      for (unsigned int v = forest.n_vertices(forest.n_levels() - 2); v < forest.vertices().size(); ++v)
        {
          EXPECT_LT(forest.parents(v)[0], v);
          EXPECT_LT(forest.parents(v)[1], v);
        }
    }
}



TEST(VolumeMesh, SplitsKeepVolumeAndNames)
{
  const VolumeMesh mesh      = unstructured();
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
