// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gmsh_session.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/surface_file.h>

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

    SurfaceMesh read_gmsh(const std::string &file)
    {
      SurfaceMesh mesh;
      try
        {
          const GmshSession        session(file);
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
  } // namespace



  SurfaceMesh read_surface(const std::string &file)
  {
    if (!std::filesystem::is_regular_file(file))
      throw InputError("Surface " + file + ": there is no such file.");
    std::string extension = std::filesystem::path(file).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
    SurfaceMesh mesh;
    if (extension == ".off" || extension == ".stl" || extension == ".obj" || extension == ".ply")
      {
        if (extension == ".stl" && has_infinite_coordinates(file))
          throw InputError("Surface " + file + ": a vertex has no finite coordinates.");
        mesh = read_polygons(file);
      }
    else if (extension == ".msh")
      mesh = read_gmsh(file);
    else
      throw InputError("Surface " + file +
                       ": the kind of file is known by .off, .stl, .obj, .ply or .msh, not by \"" +
                       extension + "\".");
    if (mesh.triangles.empty())
      throw InputError("Surface " + file + ": there are no triangles in it.");
    for (const Point<3> &p : mesh.vertices)
      if (!std::isfinite(p.norm()))
        throw InputError("Surface " + file + ": a vertex has no finite coordinates.");
    mesh.compute_vertex_normals();
    return mesh;
  }
} // namespace Signorini
