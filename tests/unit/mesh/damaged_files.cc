// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "mesh_file.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/timer.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

using namespace dealii;
using namespace Signorini;

namespace
{
  /// Processor time for a file (seconds).
#ifdef SIGNORINI_SANITIZED
  constexpr double longest = 50.;
#else
  constexpr double longest = 5.;
#endif

  /// Files that were fatal once (tests/fuzz): read or refused, and soon. Returns how many there are.
  unsigned int read_all(const std::string &kind, const std::function<void(const std::string &file)> &read)
  {
    unsigned int n = 0;
    for (const auto &entry :
         std::filesystem::directory_iterator(SIGNORINI_SOURCE_DIR "/tests/fuzz/found/" + kind))
      {
        Timer time;
        try
          {
            read(entry.path().string());
          }
        catch (const InputError &e)
          {
            const std::string text = e.what();
            EXPECT_NE(text.find(entry.path().filename().string()), std::string::npos) << text;
            EXPECT_LT(text.size(), 1000u);
          }
        EXPECT_LT(time.cpu_time(), longest) << entry.path();
        ++n;
      }
    return n;
  }

  std::string mesh_error(const std::string &file)
  {
    try
      {
        read_volume_mesh(file, MPI_COMM_WORLD);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "none";
  }
} // namespace



TEST(DamagedFiles, MeshesThatBroughtGmshDown)
{
  EXPECT_GE(read_all("mesh", [](const std::string &file) { read_volume_mesh(file, MPI_COMM_WORLD); }), 6u);
}



// They also make surfaces whose coordinates are as different as numbers can be: mapping those ends, too.
TEST(DamagedFiles, SurfacesThatBroughtCgalAndTheMappingDown)
{
  const SurfaceMesh roof = read_surface(SIGNORINI_SOURCE_DIR "/tests/fuzz/corpus/surface/roof.off");
  EXPECT_GE(read_all("surface",
                     [&roof](const std::string &file) {
                       const SurfaceMesh surface = read_surface(file);
                       for (const SurfaceMesh *const other : {&roof, &surface})
                         {
                           const ContactMapping mapping(surface, *other);
                           assess_mapping(mapping, surface, *other);
                           const ContactMapping back(*other, surface);
                         }
                     }),
            8u);
}



// gmsh runs what it does not take for a mesh.
TEST(DamagedFiles, NoFileIsRunAsScript)
{
  for (const std::string ending : {".msh", ".geo", ".txt", ".msh2", ".pos"})
    {
      const TemporaryFile witness(""), script("SystemCall \"rm -f " + witness.path + "\";\n", ending);
      const std::string   error = mesh_error(script.path);
      EXPECT_NE(error.find("does not begin with $MeshFormat"), std::string::npos) << error;
      EXPECT_TRUE(std::filesystem::exists(witness.path)) << ending;
    }
  const TemporaryFile witness(""), script("SystemCall \"rm -f " + witness.path + "\";\n");
  EXPECT_THROW(read_surface(script.path), InputError);
  EXPECT_TRUE(std::filesystem::exists(witness.path));
}



// Counts below zero led back in the file.
TEST(DamagedFiles, CountsMakeSense)
{
  const std::string tetrahedron = "4 2 7 1 1 2 3 4", good = gmsh_text(cube(), {tetrahedron});
  const auto        with = [&](const std::string &old, const std::string &now) {
    std::string text = good;
    return text.replace(text.find(old), old.size(), now);
  };
  for (const std::string &text : {with("$Elements\n1\n", "$Elements\n-1\n"), with(" 4 2 7", " 4 -2 7")})
    {
      const TemporaryFile file(text);
      const std::string   error = mesh_error(file.path);
      EXPECT_NE(error.find("count of -"), std::string::npos) << error;
    }
}



// Elements of binary files stand in blocks: type, number, tags of each; then number, tags and nodes of the
// elements.
TEST(DamagedFiles, BinaryElementsAreAsManyAsAnnounced)
{
  const auto elements = [](const unsigned int announced, const std::vector<int> &numbers,
                           const std::string &end = "$EndElements\n") {
    std::string text = "$MeshFormat\n2.2 1 8\n";
    const auto  add  = [&text](const int number) {
      text.append(reinterpret_cast<const char *>(&number), sizeof(int));
    };
    add(1);
    text += "\n$EndMeshFormat\n$Elements\n" + std::to_string(announced) + "\n";
    for (const int number : numbers)
      add(number);
    return text + end;
  };
  const std::vector<int> one                         = {4, 1, 2, 1, 1, 1, 1, 2, 3, 4},
                         two                         = {4, 2, 2, 1, 1, 1, 1, 2, 3, 4, 2, 1, 1, 1, 2, 3, 5},
                         too_long                    = {4, 1, 2, 1, 1, 1, 1, 2, 3, 4, 7};
  const std::pair<std::string, const char *> cases[] = {
      {elements(5, {4, -1, 2}), "count of -1"},
      {elements(5, one, ""), "ends within its elements"},
      {elements(1, two), "announces 1 elements and has 2"},
      {elements(1, too_long), "goes on after the 1 elements"}};
  for (const auto &[text, words] : cases)
    {
      const TemporaryFile file(text);
      const std::string   error = mesh_error(file.path);
      EXPECT_NE(error.find(words), std::string::npos) << error;
    }
}



TEST(DamagedFiles, SurfacesDoNotAnnounceMoreThanTheyHave)
{
  for (const char *const name : {"announces.off", "announces.ply"})
    try
      {
        read_surface(SIGNORINI_SOURCE_DIR "/tests/fuzz/found/surface/" + std::string(name));
        ADD_FAILURE() << name;
      }
    catch (const InputError &e)
      {
        EXPECT_NE(std::string(e.what()).find("announces"), std::string::npos) << e.what();
      }
}



// gmsh runs FILE.opt beside a file that it opens, and hands files of some endings to a shell.
TEST(DamagedFiles, ScriptsBesideAMeshAreNotRun)
{
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    GTEST_SKIP() << "one rank reads the files";
  const TemporaryFile marker("", ".marker");
  std::filesystem::remove(marker.path);
  const std::string volume  = gmsh_text(cube(), {"5 2 7 1 1 2 3 4 5 6 7 8"}),
                    surface = gmsh_text(cube(), {"3 2 7 1 1 2 3 4"});
  for (const std::string ending : {".msh", ".gz", ".geo"})
    {
      const TemporaryFile mesh(volume, ending), boundary(surface),
          script("SystemCall \"touch " + marker.path + "\";\n");
      for (const std::string &file : {mesh.path, boundary.path})
        std::filesystem::copy_file(script.path, file + ".opt");
      EXPECT_EQ(read_volume_mesh(mesh.path, MPI_COMM_WORLD).cells.size(), 1u);
      EXPECT_EQ(read_surface(boundary.path).triangles.size(), 2u);
      EXPECT_FALSE(std::filesystem::exists(marker.path)) << ending;
      for (const std::string &file : {mesh.path, boundary.path})
        std::filesystem::remove(file + ".opt");
    }
}



TEST(DamagedFiles, NoFolderForLinksIsOneMessage)
{
  const TemporaryFile mesh(gmsh_text(cube(), {"5 2 7 1 1 2 3 4 5 6 7 8"}));
  const char *const   before = std::getenv("TMPDIR");
  const std::string   kept   = before == nullptr ? "" : before;
  setenv("TMPDIR", "/no/such/folder", 1);
  EXPECT_NE(mesh_error(mesh.path).find("TMPDIR"), std::string::npos) << mesh_error(mesh.path);
  before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", kept.c_str(), 1);
}
