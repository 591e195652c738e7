// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gmsh_session.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/gmsh_file.h>
#include <signorini/mesh/separate_process.h>
#include <signorini/mesh/surface_file.h>

#include <CGAL/IO/OFF/File_header_OFF.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace Signorini
{
  using dealii::Point;

  namespace
  {
    void add_polygon(SurfaceMesh &mesh, const std::vector<std::size_t> &corners, const std::string &file)
    {
      for (const std::size_t v : corners)
        if (v >= mesh.vertices.size())
          throw InputError("Surface " + file + ": a face refers to vertex " + std::to_string(v) +
                           ", but there are only " + std::to_string(mesh.vertices.size()) + ".");
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        {
          const std::array<unsigned int, 3> t = {{static_cast<unsigned int>(corners[0]),
                                                  static_cast<unsigned int>(corners[i]),
                                                  static_cast<unsigned int>(corners[i + 1])}};
          if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            mesh.triangles.push_back(t);
        }
    }

    /// Whether an STL file has coordinates that are no finite numbers: CGAL, which joins equal points, would
    /// take them for equal to any.
    bool has_infinite_coordinates(const std::string &file)
    {
      std::ifstream         in(file, std::ios::binary);
      const std::string     content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
      constexpr std::size_t header = 84, record = 50;
      std::uint32_t         n = 0;
      if (content.size() >= header)
        std::memcpy(&n, content.data() + 80, 4);
      if (content.size() == header + record * n)
        {
          for (std::size_t t = 0; t < n; ++t)
            {
              float x[9];
              std::memcpy(x, content.data() + header + record * t + 12, sizeof(x));
              if (!std::all_of(x, x + 9, [](const float f) { return std::isfinite(f); }))
                return true;
            }
          return false;
        }
      std::istringstream text(content);
      std::string        word;
      while (text >> word)
        if (word == "vertex")
          for (unsigned int c = 0; c < 3; ++c)
            if (text >> word)
              {
                std::transform(word.begin(), word.end(), word.begin(), ::tolower);
                if (word.find("nan") != std::string::npos || word.find("inf") != std::string::npos)
                  return true;
              }
      return false;
    }

    /// What the head of a PLY file says of its elements, all kinds together.
    double announced_in_ply(std::istream &in)
    {
      double      sum = 0.;
      std::string line, word, kind;
      while (std::getline(in, line) && line.compare(0, 10, "end_header") != 0)
        {
          std::istringstream words(line);
          double             n = 0.;
          if (words >> word >> kind >> n && word == "element")
            sum += n;
        }
      return sum;
    }

    double announced_in_off(std::istream &in)
    {
      CGAL::File_header_OFF header;
      in >> header;
      return in ? static_cast<double>(header.size_of_vertices()) +
                      static_cast<double>(header.size_of_facets())
                : 0.;
    }

    /// CGAL makes room for what the head of a file announces before it reads the rest.
    void check_announced(const std::string &file, const std::string &extension)
    {
      std::ifstream in(file, std::ios::binary);
      const double  n    = extension == ".ply"   ? announced_in_ply(in)
                           : extension == ".off" ? announced_in_off(in)
                                                 : 0.;
      const auto    size = static_cast<double>(std::filesystem::file_size(file));
      if (n <= size)
        return;
      std::ostringstream message;
      message << "Surface " << file << ": it announces " << n << " vertices and faces, and has only " << size
              << " bytes. Was it cut off or edited? Write it again.";
      throw InputError(message.str());
    }

    /// What is packed between processes.
    using Arrays = std::pair<std::vector<Point<3>>, std::vector<std::array<unsigned int, 3>>>;

    SurfaceMesh read_polygons(const std::string &file)
    {
      using Kernel = CGAL::Simple_cartesian<double>;
      std::vector<Kernel::Point_3>          points;
      std::vector<std::vector<std::size_t>> polygons;
      bool                                  done = false;
      // Some readers talk on the standard error; what counts is said below.
      std::ostringstream    words;
      std::streambuf *const standard_error = std::cerr.rdbuf(words.rdbuf());
      try
        {
          done = CGAL::IO::read_polygon_soup(file, points, polygons);
        }
      catch (const std::exception &)
        {
        }
      std::cerr.rdbuf(standard_error);
      if (!done)
        throw InputError("Surface " + file + ": the file cannot be read as what its name says.");
      SurfaceMesh mesh;
      mesh.vertices.reserve(points.size());
      for (const auto &p : points)
        mesh.vertices.emplace_back(p.x(), p.y(), p.z());
      mesh.triangles.reserve(polygons.size());
      for (const auto &polygon : polygons)
        add_polygon(mesh, polygon, file);
      return mesh;
    }

    SurfaceMesh read_gmsh(const std::string &file, const GmshAlias &alias)
    {
      SurfaceMesh mesh;
      try
        {
          count_volume_elements(file);
          const GmshSession        session(alias);
          std::vector<std::size_t> tags;
          std::vector<double>      coordinates, parametric;
          gmsh::model::mesh::getNodes(tags, coordinates, parametric);
          std::unordered_map<std::size_t, std::size_t> number;
          for (std::size_t i = 0; i < tags.size(); ++i)
            {
              number[tags[i]] = i;
              mesh.vertices.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
            }
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(types, elements, nodes, 2);
          for (std::size_t k = 0; k < types.size(); ++k)
            {
              std::string         name;
              int                 dimension, order, n_nodes, n_primary;
              std::vector<double> local;
              gmsh::model::mesh::getElementProperties(types[k], name, dimension, order, n_nodes, local,
                                                      n_primary);
              for (std::size_t e = 0; e < elements[k].size(); ++e)
                {
                  std::vector<std::size_t> corners;
                  for (int i = 0; i < n_primary; ++i)
                    corners.push_back(number.at(nodes[k][e * n_nodes + i]));
                  add_polygon(mesh, corners, file);
                }
            }
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (...)
        {
          // gmsh throws strings and numbers.
          throw InputError("Surface " + file + ": gmsh cannot read the file.");
        }
      return mesh;
    }

    Arrays read_separately(const std::string &file, const bool is_gmsh)
    {
      const auto arrays = [](const SurfaceMesh &mesh) { return Arrays(mesh.vertices, mesh.triangles); };
      try
        {
          if (!is_gmsh)
            return read_in_separate_process<Arrays>(file, "CGAL",
                                                    [&] { return arrays(read_polygons(file)); });
          // The link is this process's: it is taken away also where the reader breaks down.
          const GmshAlias alias(file);
          return read_in_separate_process<Arrays>(file, "gmsh",
                                                  [&] { return arrays(read_gmsh(file, alias)); });
        }
      catch (const InputError &e)
        {
          const std::string text = e.what();
          throw InputError(text.find(file) == std::string::npos ? "Surface " + file + ": " + text : text);
        }
      catch (const std::exception &)
        {
          throw InputError("Surface " + file + ": the file cannot be read as what its name says.");
        }
    }
  } // namespace



  SurfaceMesh read_surface(const std::string &file)
  {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      throw InputError("Surface " + file + ": there is no such file.");
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
    const bool is_gmsh = extension == ".msh";
    if (!is_gmsh && extension != ".off" && extension != ".stl" && extension != ".obj" && extension != ".ply")
      throw InputError("Surface " + file +
                       ": the kind of file is known by .off, .stl, .obj, .ply or .msh, not by \"" +
                       extension + "\".");
    check_announced(file, extension);
    if (extension == ".stl" && has_infinite_coordinates(file))
      throw InputError("Surface " + file + ": a vertex has no finite coordinates.");
    SurfaceMesh mesh;
    std::tie(mesh.vertices, mesh.triangles) = read_separately(file, is_gmsh);
    if (mesh.triangles.empty())
      throw InputError("Surface " + file + ": there are no triangles in it.");
    for (const Point<3> &p : mesh.vertices)
      if (!std::isfinite(p.norm()))
        throw InputError("Surface " + file + ": a vertex has no finite coordinates.");
    mesh.compute_vertex_normals();
    return mesh;
  }
} // namespace Signorini
