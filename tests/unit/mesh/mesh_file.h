// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_tests_mesh_file_h
#define signorini_tests_mesh_file_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <unistd.h>

/// A text file that exists as long as the object, written by rank 0.
class TemporaryFile
{
public:
  explicit TemporaryFile(const std::string &content, const std::string &ending = ".msh")
  {
    const int  id = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, static_cast<int>(getpid()), 0);
    static int n  = 0;
    path          = "/tmp/signorini-test-" + std::to_string(id) + "-" + std::to_string(n++) + ending;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(path) << content;
    MPI_Barrier(MPI_COMM_WORLD);
  }

  ~TemporaryFile()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::remove(path.c_str());
  }

  std::string path;
};

/// A gmsh 2.2 file of the given points and elements ("type tags.. nodes.." without the number in front).
inline std::string
gmsh_text(const std::vector<dealii::Point<3>> &points, const std::vector<std::string> &elements,
          const std::string &physical_names = "")
{
  std::ostringstream text;
  text.precision(16);
  text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!physical_names.empty())
    text << "$PhysicalNames\n" << physical_names << "$EndPhysicalNames\n";
  text << "$Nodes\n" << points.size() << "\n";
  for (std::size_t i = 0; i < points.size(); ++i)
    text << i + 1 << " " << points[i] << "\n";
  text << "$EndNodes\n$Elements\n" << elements.size() << "\n";
  for (std::size_t i = 0; i < elements.size(); ++i)
    text << i + 1 << " " << elements[i] << "\n";
  text << "$EndElements\n";
  return text.str();
}

/// The corners of a unit cube in gmsh's order, moved up by z.
inline std::vector<dealii::Point<3>>
cube(const double z = 0.)
{
  std::vector<dealii::Point<3>> p;
  for (const double level : {z, z + 1.})
    for (const auto &[x, y] : {std::pair(0., 0.), std::pair(1., 0.), std::pair(1., 1.), std::pair(0., 1.)})
      p.emplace_back(x, y, level);
  return p;
}

#endif
