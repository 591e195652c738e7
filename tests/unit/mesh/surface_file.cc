// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/surface/contact_mapping.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

using namespace Signorini;

namespace
{
  /// The unit square of two triangles with normals to +z, in each format.
  const std::map<std::string, std::string> squares = {
      {"square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"},
      {"quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
      {"square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n"},
      {"square.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
       "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 "
       "1 2\n3 0 2 "
       "3\n"},
      {"square.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 "
                     "0\nendloop\nendfacet\n"
                     "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 "
                     "0\nendloop\nendfacet\nendsolid s\n"},
      {"square.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
       "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n"}};

  std::string written(const std::string &name, const std::string &text)
  {
    const std::string file =
        (std::filesystem::temp_directory_path() / ("signorini-" + std::to_string(getpid()) + "-" + name))
            .string();
    std::ofstream(file) << text;
    return file;
  }
} // namespace

TEST(SurfaceFile, ReadsAllFormats)
{
  for (const auto &[name, text] : squares)
    {
      const std::string file = written(name, text);
      const SurfaceMesh mesh = read_surface(file);
      std::filesystem::remove(file);
      EXPECT_EQ(mesh.vertices.size(), 4u) << name;
      ASSERT_EQ(mesh.triangles.size(), 2u) << name;
      EXPECT_NEAR(triangle_area(mesh, 0) + triangle_area(mesh, 1), 1., 1e-15) << name;
      for (const auto &normal : mesh.vertex_normals)
        EXPECT_NEAR(normal[2], 1., 1e-15) << name;
    }
}

TEST(SurfaceFile, RefusesWhatItCannotRead)
{
  const auto expect_error = [](const std::string &name, const std::string &text, const std::string &word) {
    const std::string file = written(name, text);
    try
      {
        read_surface(file);
        ADD_FAILURE() << name << ": no error";
      }
    catch (const InputError &e)
      {
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
      }
    std::filesystem::remove(file);
  };
  EXPECT_THROW(read_surface("missing.off"), InputError);
  // Longer than a name may be.
  EXPECT_THROW(read_surface(std::string(5000, 'x') + ".off"), InputError);
  expect_error("x.vrml", "text", "known by");
  expect_error("empty.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no triangles");
  expect_error("cut.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1", "cannot be read");
  expect_error("wrong.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 7\n", "cannot be read");
  expect_error("text.ply", "not a ply file\n", "cannot be read");
  expect_error("cut.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1", "");
}
