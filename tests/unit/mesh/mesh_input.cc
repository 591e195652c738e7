// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "expect_in.h"
#include "mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/mesh_input.h>

#include <gtest/gtest.h>

#include <gmsh.h>

using namespace dealii;
using namespace Signorini;

namespace
{
  const char *const hexahedron = "5 2 7 1 1 2 3 4 5 6 7 8";
  const char *const bottom     = "3 2 11 1 1 2 3 4";
  const char *const names      = "2\n2 11 \"bottom\"\n3 7 \"bone\"\n";

  std::string error_of(const std::string &content)
  {
    const TemporaryFile file(content);
    try
      {
        read_volume_mesh(file.path, MPI_COMM_WORLD);
      }
    catch (const InputError &e)
      {
        EXPECT_NE(std::string(e.what()).find(file.path), std::string::npos) << e.what();
        return e.what();
      }
    ADD_FAILURE() << "no error";
    return "";
  }
} // namespace



TEST(MeshInput, KeepsPhysicalNames)
{
  const TemporaryFile file(gmsh_text(cube(), {bottom, hexahedron}, names));
  const auto          mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.cells.size(), 1u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  ASSERT_EQ(mesh.volume_names, std::vector<std::string>{"bone"});
  ASSERT_EQ(mesh.faces.size(), 6u);
  unsigned int n_bottom = 0;
  for (const auto &face : mesh.faces)
    if (mesh.boundary_names[face.name] == "bottom")
      {
        ++n_bottom;
        for (const unsigned int v : face.vertices)
          EXPECT_EQ(mesh.vertices[v][2], 0.);
      }
    else
      EXPECT_EQ(mesh.boundary_names[face.name], "unnamed");
  EXPECT_EQ(n_bottom, 1u);
}



TEST(MeshInput, TakesIdsWhereThereAreNoNames)
{
  const TemporaryFile file(gmsh_text(cube(), {bottom, hexahedron}));
  const auto          mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.volume_names, std::vector<std::string>{"7"});
  EXPECT_NE(std::find(mesh.boundary_names.begin(), mesh.boundary_names.end(), "11"),
            mesh.boundary_names.end());
}



// The Boundary{} of gmsh 4.13 is oriented, so that its list without that of a part still has the part.
TEST(MeshInput, SurfacesOfSeveralGroupsHaveAllNames)
{
  const TemporaryFile file(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
      "$PhysicalNames\n5\n2 4 \"skin\"\n2 5 \"foot\"\n3 1 \"ball\"\n3 2 \"copper\"\n3 3 "
      "\"iron\"\n$EndPhysicalNames\n"
      "$Entities\n0 0 2 1\n1 0 0 0 1 1 0 2 -4 5 0\n2 0 0 0 1 1 1 1 4 0\n1 0 0 0 1 1 1 2 2 3 0\n$EndEntities\n"
      "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
      "$Elements\n3 5 1 5\n2 1 2 1\n1 1 3 2\n2 2 2 3\n2 1 2 4\n3 2 3 4\n4 1 4 3\n3 1 4 1\n5 1 2 3 "
      "4\n$EndElements\n");
  const auto mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  ASSERT_EQ(mesh.faces.size(), 4u);
  std::map<std::string, std::set<double>> heights;
  for (const auto &[name, boundaries] : mesh.boundary_groups)
    for (const auto &face : mesh.faces)
      if (std::count(boundaries.begin(), boundaries.end(), face.name) > 0)
        {
          double height = 0.;
          for (unsigned int v = 0; v < 3; ++v)
            height += mesh.vertices[face.vertices[v]][2];
          heights[name].insert(height);
        }
  EXPECT_EQ(heights["foot"], std::set<double>{0.});
  EXPECT_EQ(heights["skin"], (std::set<double>{0., 1.}));
  EXPECT_EQ(heights.size(), 2u);
  EXPECT_EQ(mesh.volume_names, std::vector<std::string>{"copper"});
  ASSERT_EQ(mesh.notes.size(), 1u);
  expect_in(mesh.notes[0], "copper, iron");
}



// A tetrahedron with ten nodes, the middles of its edges a little off, and one of its sides with six: eight
// and four, that cover the same, without notes of mirrored ones.
TEST(MeshInput, CutsQuadraticTetrahedra)
{
  std::vector<Point<3>> points = {{0., 0., 0.}, {1., 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  // In the order of gmsh.
  for (const auto &[a, b] :
       {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2), std::pair(0, 3), std::pair(2, 3), std::pair(1, 3)})
    points.push_back(points[a] + .5 * (points[b] - points[a]));
  points[5] += Point<3>(.05, .05, 0.) - Point<3>();
  const TemporaryFile file(
      gmsh_text(points, {"9 2 11 1 1 2 3 5 6 7", "11 2 7 1 1 2 3 4 5 6 7 8 9 10"}, names));
  const auto mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.cells.size(), 8u);
  EXPECT_EQ(mesh.vertices.size(), 10u);
  double volume = 0.;
  for (const auto &cell : mesh.cells)
    {
      EXPECT_EQ(cell.n_vertices, 4u);
      const auto &v = cell.vertices;
      const auto  x = [&](const unsigned int i) { return mesh.vertices[v[i]] - mesh.vertices[v[0]]; };
      volume += std::abs(cross_product_3d(x(1), x(2)) * x(3)) / 6.;
    }
  // A third of the shift along the normal of the slanted side times the area of its triangles around that
  // middle.
  const double bulge = .1 / std::sqrt(3.) * (.75 * .5 * std::sqrt(3.)) / 3.;
  EXPECT_NEAR(volume, 1. / 6. + bulge, 1e-14);
  std::size_t n_bottom = 0;
  for (const auto &face : mesh.faces)
    n_bottom += mesh.boundary_names[face.name] == "bottom";
  EXPECT_EQ(n_bottom, 4u);
  ASSERT_EQ(mesh.notes.size(), 1u);
  expect_in(mesh.notes[0], "1 quadratic tetrahedra are cut into eight");
}



TEST(MeshInput, DoesNotJoinCoincidentNodes)
{
  auto       points = cube();
  const auto upper  = cube(1.);
  points.insert(points.end(), upper.begin(), upper.end());
  const TemporaryFile file(gmsh_text(points, {"5 2 7 1 1 2 3 4 5 6 7 8", "5 2 8 2 9 10 11 12 13 14 15 16"}));
  const auto          mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  EXPECT_EQ(mesh.vertices.size(), 16u);
  EXPECT_EQ(mesh.faces.size(), 12u);
  EXPECT_EQ(mesh.volume_names.size(), 2u);
}



TEST(MeshInput, ReadsOtherVersionsAndBinaryFiles)
{
  const TemporaryFile text(gmsh_text(cube(), {bottom, hexahedron}, names));
  for (const double version : {2.2, 4.1})
    for (const double binary : {0., 1.})
      {
        const TemporaryFile file("");
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          {
            gmsh::initialize();
            gmsh::option::setNumber("General.Terminal", 0);
            gmsh::open(text.path);
            gmsh::option::setNumber("Mesh.MshFileVersion", version);
            gmsh::option::setNumber("Mesh.Binary", binary);
            gmsh::write(file.path);
            gmsh::finalize();
          }
        MPI_Barrier(MPI_COMM_WORLD);
        const auto mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
        EXPECT_EQ(mesh.cells.size(), 1u) << version << " " << binary;
        EXPECT_EQ(mesh.volume_names, std::vector<std::string>{"bone"}) << version << " " << binary;
        EXPECT_EQ(std::count(mesh.boundary_names.begin(), mesh.boundary_names.end(), "bottom"), 1);
      }
}



// What gmsh writes in other formats comes back: tetrahedra, and boundaries where the format has them.
TEST(MeshInput, ReadsOtherFormats)
{
  const std::string original = SIGNORINI_SOURCE_DIR "/prm/hertz/half_sphere_on_cube.msh";
  const VolumeMesh  expected = read_volume_mesh(original, MPI_COMM_WORLD);
  for (const std::string ending : {".vtk", ".unv", ".bdf", ".msh"})
    {
      const TemporaryFile file("", ending);
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          gmsh::initialize();
          gmsh::option::setNumber("General.Terminal", 0);
          gmsh::open(original);
          gmsh::write(file.path);
          gmsh::finalize();
        }
      MPI_Barrier(MPI_COMM_WORLD);
      const VolumeMesh mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
      EXPECT_EQ(mesh.cells.size(), expected.cells.size()) << ending;
      EXPECT_EQ(mesh.vertices.size(), expected.vertices.size()) << ending;
      EXPECT_EQ(mesh.faces.size(), expected.faces.size()) << ending;
      // gmsh keeps no groups in .vtk and .bdf.
      if (ending == ".unv" || ending == ".msh")
        {
          EXPECT_EQ(mesh.volume_names.size(), expected.volume_names.size()) << ending;
        }
    }
}



TEST(MeshInput, TurnsMirroredCellsOver)
{
  const TemporaryFile file(gmsh_text(cube(), {"5 2 7 1 5 6 7 8 1 2 3 4"}));
  const auto          mesh = read_volume_mesh(file.path, MPI_COMM_WORLD);
  ASSERT_EQ(mesh.notes.size(), 1u);
  EXPECT_NEAR(scaled_jacobian(mesh.corners(mesh.cells[0])), 1., 1e-14);
}



TEST(MeshInput, RefusesWhatItCannotUse)
{
  auto points = cube();
  points[7]   = Point<3>(.2, .2, -.5);
  expect_in(error_of(gmsh_text(points, {hexahedron})), "inverted");
  expect_in(error_of(gmsh_text(cube(), {"6 2 7 1 1 2 3 5 6 7"})), "Prism");
  expect_in(error_of(gmsh_text(cube(), {bottom})), "neither tetrahedra nor hexahedra");
  expect_in(error_of(gmsh_text(cube(), {"4 2 7 1 1 2 3 4"})), "degenerate");
  expect_in(error_of(gmsh_text(cube(), {hexahedron, hexahedron, hexahedron})), "twice");
  const std::vector<Point<3>> fan = {Point<3>(),           Point<3>(1., 0., 0.), Point<3>(0., 1., 0.),
                                     Point<3>(0., 0., 1.), Point<3>(0., 0., 2.), Point<3>(0., 0., -1.)};
  expect_in(error_of(gmsh_text(fan, {"4 2 7 1 1 2 3 4", "4 2 7 1 1 2 3 5", "4 2 7 1 1 2 3 6"})),
            "belongs to 3 cells");
  std::vector<Point<3>> quadratic(20);
  std::string           nodes = "17 2 7 1";
  for (unsigned int i = 0; i < 20; ++i)
    {
      quadratic[i] = Point<3>(.1 * i, .2 * i * i, .3);
      nodes += " " + std::to_string(i + 1);
    }
  expect_in(error_of(gmsh_text(quadratic, {nodes})), "Hexahedron 20");
  const std::string good = gmsh_text(cube(), {bottom, hexahedron});
  error_of(good.substr(0, good.size() / 2));
  error_of("this is not a mesh\n");
  EXPECT_THROW(read_volume_mesh("/nonexistent/file.msh", MPI_COMM_WORLD), InputError);
}



// gmsh leaves cells out without a word; the file itself says how many there are.
TEST(MeshInput, LosesNoCells)
{
  std::vector<Point<3>> points = {Point<3>(), Point<3>(1., 0., 0.), Point<3>(0., 1., 0.),
                                  Point<3>(0., 0., 1.), Point<3>(1., 1., 1.)};
  for (const auto &[a, b] :
       {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2), std::pair(0, 3), std::pair(2, 3), std::pair(1, 3)})
    points.push_back(points[a] + .5 * (points[b] - points[a]));
  const std::string first = "4 2 7 1 1 2 3 4", second = "4 2 7 1 2 3 4 5",
                    quadratic = "11 2 7 1 1 2 3 4 6 7 8 9 10 11";
  // Of another order, or one that has another type than nodes.
  expect_in(error_of(gmsh_text(points, {quadratic, second})), "nodes");
  expect_in(error_of(gmsh_text(points, {second, quadratic})), "nodes");
  error_of(gmsh_text(points, {first, "4 2 7 1 2 3 4 5 6 7 8 9 10 11"}));
  error_of(gmsh_text(points, {"4 2 7 1 1 2 3", second}));
  // Another number of them.
  const std::string good = gmsh_text(points, {first, second});
  const auto        with = [](std::string text, const std::string &old, const std::string &now) {
    return text.replace(text.find(old), old.size(), now);
  };
  expect_in(error_of(with(good, "$Elements\n2\n", "$Elements\n1\n")), "announces 1 elements and has 2");
  error_of(with(good, "$Elements\n2\n", "$Elements\n3\n"));
  // A number of an element twice, or a cell.
  expect_in(error_of(with(good, "\n2 4 2", "\n1 4 2")), "1");
  expect_in(error_of(gmsh_text(points, {first, second, second})), "twice");
  const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 "
                           "0 0\n1 0 0\n0 1 0\n0 0 "
                           "1\n1 1 1\n$EndNodes\n$Elements\n";
  for (const char *const block :
       {"1 2 1 2\n3 1 4 1", "1 1 1 2\n3 1 4 1", "1 1 1 2\n3 1 4 2", "1 3 1 2\n3 1 4 2"})
    error_of(head + block + "\n1 1 2 3 4\n2 2 3 4 5\n$EndElements\n");
}



TEST(MeshInput, AbaqusFilesLoseNoCells)
{
  const std::string nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n";
  const auto        error = [&](const std::string &text) {
    const TemporaryFile file(nodes + text, ".inp");
    try
      {
        read_volume_mesh(file.path, MPI_COMM_WORLD);
      }
    catch (const InputError &e)
      {
        return std::string(e.what());
      }
    return std::string("none");
  };
  EXPECT_EQ(error("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n"), "none");
  expect_in(error("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n1, 2, 3, 4, 5\n"), "element 1 is there twice");
  expect_in(error("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n2, 2, 3, 4, 1\n"), "twice");
  expect_in(error("*NODE\n3, 0, 2, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"), "node 3 is there twice");
  expect_in(error("*ELEMENT, TYPE=C3D5\n1, 1, 2, 3, 4, 5\n"), "C3D5");
  expect_in(error("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4, 5, 1, 2, 3, 4, 5\n"), "too many nodes");
}
