// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/gmsh_session.h>
#include <signorini/mesh/mesh_input.h>

#include <deal.II/base/mpi.h>


namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// gmsh's corners of a hexahedron run around the bottom, then the top; deal.II's are lexicographic.
    constexpr unsigned int gmsh_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};

    constexpr int gmsh_hexahedron = 5, gmsh_quadrilateral = 3;

    std::string element_name(const int type)
    {
      std::string         name;
      int                 dimension, order, n_nodes, n_primary;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
      return name;
    }

    /// The name of the physical group of an entity, its id as text, or `fallback`.
    std::string group_name(const int dimension, const int entity, const std::string &fallback)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
      if (groups.empty())
        return fallback;
      std::string name;
      gmsh::model::getPhysicalName(dimension, groups[0], name);
      return name.empty() ? std::to_string(std::abs(groups[0])) : name;
    }

    unsigned int index_of(std::vector<std::string> &names, const std::string &name)
    {
      const auto it = std::find(names.begin(), names.end(), name);
      if (it != names.end())
        return static_cast<unsigned int>(it - names.begin());
      names.push_back(name);
      return static_cast<unsigned int>(names.size()) - 1;
    }

    /// Elements of one type of all entities of a dimension: entity and node tags. Other types are refused.
    std::vector<std::pair<int, std::vector<std::size_t>>> elements(const int dimension, const int wanted,
                                                                   const std::string &file)
    {
      std::vector<std::pair<int, std::vector<std::size_t>>> result;
      gmsh::vectorpair                                      entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto &entity : entities)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity.second);
          for (std::size_t t = 0; t < types.size(); ++t)
            if (types[t] == wanted)
              result.emplace_back(entity.second, nodes[t]);
            else
              throw InputError("Mesh file \"" + file + "\": elements of type \"" + element_name(types[t]) +
                               "\" are not supported; use hexahedra with 8 nodes.");
        }
      return result;
    }

    HexahedralMesh read_with_gmsh(const std::string &file)
    {
      const GmshSession session(file);
      HexahedralMesh    mesh;

      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(tags, coordinates, parametric);
      std::unordered_map<std::size_t, std::size_t> position;
      for (std::size_t i = 0; i < tags.size(); ++i)
        position[tags[i]] = i;
      std::unordered_map<std::size_t, unsigned int> number;
      const auto                                    vertex = [&](const std::size_t tag) {
        const auto at = position.find(tag);
        if (at == position.end())
          throw InputError("Mesh file \"" + file +
                                                              "\": an element refers to a node that is missing. Is the file cut off?");
        const auto [it, is_new] = number.insert({tag, static_cast<unsigned int>(mesh.vertices.size())});
        if (is_new)
          mesh.vertices.emplace_back(coordinates[3 * at->second], coordinates[3 * at->second + 1],
                                                                        coordinates[3 * at->second + 2]);
        return it->second;
      };

      for (const auto &[entity, nodes] : elements(3, gmsh_hexahedron, file))
        {
          const unsigned int volume = index_of(mesh.volume_names, group_name(3, entity, "unnamed"));
          for (std::size_t k = 0; k + 8 <= nodes.size(); k += 8)
            {
              mesh.cells.emplace_back();
              for (unsigned int v = 0; v < 8; ++v)
                mesh.cells.back()[v] = vertex(nodes[k + gmsh_corner[v]]);
              mesh.cell_volume.push_back(volume);
            }
        }
      if (mesh.cells.empty())
        throw InputError("Mesh file \"" + file + "\": it contains no hexahedra.");

      std::map<std::array<unsigned int, 4>, std::string> named;
      for (const auto &[entity, nodes] : elements(2, gmsh_quadrilateral, file))
        for (std::size_t k = 0; k + 4 <= nodes.size(); k += 4)
          {
            std::array<unsigned int, 4> key;
            bool                        known = true;
            for (unsigned int v = 0; v < 4; ++v)
              {
                const auto it = number.find(nodes[k + v]);
                known         = known && it != number.end();
                key[v]        = known ? it->second : 0;
              }
            std::sort(key.begin(), key.end());
            if (known)
              named[key] = group_name(2, entity, "unnamed");
          }
      for (const auto &face : find_boundary_faces(mesh))
        {
          std::array<unsigned int, 4> key = face.first;
          std::sort(key.begin(), key.end());
          const auto it = named.find(key);
          mesh.faces.push_back(
              {face.first, index_of(mesh.boundary_names, it == named.end() ? "unnamed" : it->second)});
        }
      return mesh;
    }

    /// Turns mirrored cells over; refuses twisted ones.
    void mend_orientation(HexahedralMesh &mesh, const std::string &file)
    {
      std::size_t n_mended = 0;
      for (auto &cell : mesh.cells)
        {
          std::array<Point<3>, 8> corners;
          const auto              quality = [&]() {
            for (unsigned int v = 0; v < 8; ++v)
              corners[v] = mesh.vertices[cell[v]];
            return scaled_jacobian(corners);
          };
          if (quality() > 0.)
            continue;
          for (unsigned int v = 0; v < 4; ++v)
            std::swap(cell[v], cell[v + 4]);
          if (!(quality() > 0.))
            {
              std::ostringstream message;
              message << "Mesh file \"" << file << "\": inverted or degenerate cell near (" << corners[0]
                      << "). Mend the mesh.";
              throw InputError(message.str());
            }
          ++n_mended;
        }
      if (n_mended > 0)
        mesh.notes.push_back("Mesh file \"" + file + "\": " + std::to_string(n_mended) +
                             " cells of mirrored orientation mended.");
    }
  } // namespace



  HexahedralMesh read_hexahedral_mesh(const std::string &file, const MPI_Comm communicator)
  {
    HexahedralMesh mesh;
    std::string    error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        try
          {
            if (!std::ifstream(file))
              throw InputError("Mesh file \"" + file + "\" cannot be opened.");
            mesh = read_with_gmsh(file);
            mend_orientation(mesh, file);
          }
        catch (const InputError &e)
          {
            error = e.what();
          }
        catch (const std::exception &e)
          {
            error = "Mesh file \"" + file + "\" cannot be read: " + e.what();
          }
        catch (...)
          {
            // gmsh throws plain strings and numbers as well.
            error =
                "Mesh file \"" + file + "\" cannot be read. Is it complete, and of a format that gmsh knows?";
          }
      }
    error = Utilities::MPI::broadcast(communicator, error, 0);
    if (!error.empty())
      throw InputError(error);
    return Utilities::MPI::broadcast(communicator, mesh, 0);
  }
} // namespace Signorini
