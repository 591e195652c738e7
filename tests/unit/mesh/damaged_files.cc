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
        EXPECT_LT(time.cpu_time(), 5.) << entry.path();
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
  // A block of -1 elements, of binary files: type, number, tags.
  std::string head = "$MeshFormat\n2.2 1 8\n";
  const auto  add  = [&head](const int number) {
    head.append(reinterpret_cast<const char *>(&number), sizeof(int));
  };
  add(1);
  head += "\n$EndMeshFormat\n$Elements\n5\n";
  for (const int number : {4, -1, 2})
    add(number);
  const TemporaryFile file(head);
  const std::string   error = mesh_error(file.path);
  EXPECT_NE(error.find("count of -1"), std::string::npos) << error;
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
