// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "gmsh_session.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/input_error.h>
#include <signorini/mesh/abaqus_input.h>
#include <signorini/mesh/gmsh_file.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/quadratic_tetrahedron.h>
#include <signorini/mesh/separate_process.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <filesystem>
#include <map>
#include <optional>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// gmsh's corners of a hexahedron run around the bottom, then the top; deal.II's are lexicographic.
    constexpr unsigned int gmsh_corner[8] = {0, 1, 3, 2, 4, 5, 7, 6};

    /// Our order of the nodes of a quadratic tetrahedron, as decks have it.
    constexpr unsigned int gmsh_quadratic_node[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

    /// Triangles between the nodes of a quadratic one.
    constexpr unsigned int triangles_of_quadratic[4][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};

    /// Types of elements that can be read: gmsh's number, number of nodes.
    using ElementTypes = std::map<int, unsigned int>;

    const ElementTypes cell_types = {{4, 4}, {5, 8}, {11, 10}}, face_types = {{2, 3}, {3, 4}, {9, 6}};

    std::string element_name(const int type)
    {
      std::string         name;
      int                 dimension, order, n_nodes, n_primary;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
      return name;
    }

    /// The names of the physical groups of an entity, or their ids as texts.
    std::vector<std::string> group_names(const int dimension, const int entity)
    {
      std::vector<int> groups;
      gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
      std::vector<std::string> names;
      for (const int group : groups)
        {
          // Negative where the group has the entity turned round, as Boundary{} gives them.
          const int   id = std::abs(group);
          std::string name;
          gmsh::model::getPhysicalName(dimension, id, name);
          names.push_back(name.empty() ? std::to_string(id) : name);
        }
      return names;
    }

    /// The name of a volume. A note if there are several, for cells have one.
    std::string volume_name(const int entity, const std::string &file, std::vector<std::string> &notes)
    {
      const std::vector<std::string> names = group_names(3, entity);
      if (names.empty())
        return "unnamed";
      if (names.size() > 1)
        notes.push_back("Mesh file \"" + file + "\": volume " + std::to_string(entity) +
                        " is in the physical groups " + Patterns::Tools::to_string(names) +
                        ": only the first of these names counts.");
      return names[0];
    }

    /// Elements of one entity: its number, the vertices of an element, and the node tags.
    struct Elements
    {
      int                      entity;
      unsigned int             n_vertices;
      std::vector<std::size_t> nodes;
    };

    /// Elements of some types. Others are refused.
    std::vector<Elements> elements(const int dimension, const ElementTypes &known, const std::string &file)
    {
      std::vector<Elements> result;
      gmsh::vectorpair      entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto &entity : entities)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity.second);
          for (std::size_t t = 0; t < types.size(); ++t)
            if (const auto type = known.find(types[t]); type != known.end())
              result.push_back({entity.second, type->second, nodes[t]});
            else
              throw InputError(
                  "Mesh file \"" + file + "\": elements of type \"" + element_name(types[t]) +
                  "\" are not supported; use tetrahedra with 4 nodes or hexahedra with 8. gmsh writes "
                  "them with -order 1 (Mesh.ElementOrder = 1); other cells become tetrahedra without "
                  "Recombine.");
        }
      return result;
    }

    /// gmsh's lists of an entity take the type from one element and lose those with another number of nodes.
    void check_number(const std::string &file, const std::size_t in_file, const std::size_t n_cells)
    {
      double n_tetrahedra = 0., n_hexahedra = 0.;
      gmsh::option::getNumber("Mesh.NbTetrahedra", n_tetrahedra);
      gmsh::option::getNumber("Mesh.NbHexahedra", n_hexahedra);
      const auto loaded = static_cast<std::size_t>(n_tetrahedra + n_hexahedra);
      if (loaded != n_cells)
        throw InputError("Mesh file \"" + file + "\": " + std::to_string(n_cells) + " of " +
                         std::to_string(loaded) +
                         " cells have 4 or 8 nodes, the others more. Write a mesh of first order.");
      if (in_file != unknown_number && in_file != n_cells)
        throw InputError("Mesh file \"" + file + "\": it has " + std::to_string(in_file) +
                         " cells, of which " + std::to_string(n_cells) +
                         " could be read. Are there numbers of elements that occur twice?");
    }

    /// The nodes of the open file, of which a mesh gets those that its cells use.
    class GmshNodes
    {
    public:
      explicit GmshNodes(const std::string &file)
        : file(file)
      {
        std::vector<std::size_t> tags;
        std::vector<double>      parametric;
        gmsh::model::mesh::getNodes(tags, coordinates, parametric);
        for (std::size_t i = 0; i < tags.size(); ++i)
          position[tags[i]] = i;
      }

      /// The vertex of the mesh for a node of a cell.
      unsigned int vertex(VolumeMesh &mesh, const std::size_t tag)
      {
        const auto at = position.find(tag);
        if (at == position.end())
          throw InputError("Mesh file \"" + file +
                           "\": an element refers to a node that is missing. Is the file cut off?");
        const auto [it, is_new] = number.insert({tag, static_cast<unsigned int>(mesh.vertices.size())});
        if (is_new)
          {
            mesh.vertices.emplace_back(coordinates[3 * at->second], coordinates[3 * at->second + 1],
                                       coordinates[3 * at->second + 2]);
            mesh.node_numbers.push_back(static_cast<long>(tag));
          }
        return it->second;
      }

      /// The key of a face, if all of its nodes belong to cells.
      std::optional<VolumeMesh::Face> face(const std::size_t *const tags, const unsigned int n) const
      {
        VolumeMesh::Face face;
        face.fill(VolumeMesh::no_vertex);
        for (unsigned int v = 0; v < n; ++v)
          {
            const auto it = number.find(tags[v]);
            if (it == number.end())
              return std::nullopt;
            face[v] = it->second;
          }
        return face_key(face);
      }

    private:
      const std::string                             file;
      std::vector<double>                           coordinates;
      std::unordered_map<std::size_t, std::size_t>  position;
      std::unordered_map<std::size_t, unsigned int> number;
    };

    void add_quadratic(VolumeMesh &mesh, GmshNodes &gmsh_nodes, const std::size_t *const tags,
                       const unsigned int volume)
    {
      std::array<unsigned int, 10> nodes;
      for (unsigned int v = 0; v < nodes.size(); ++v)
        nodes[v] = gmsh_nodes.vertex(mesh, tags[gmsh_quadratic_node[v]]);
      for (const auto &piece : cut_quadratic_tetrahedron(mesh.vertices, nodes))
        {
          mesh.cells.push_back({{}, 4, volume});
          std::copy(piece.begin(), piece.end(), mesh.cells.back().vertices.begin());
        }
    }

    /// Names the faces of an element with n nodes that are faces of cells.
    /// @param names indices
    void name_element(FaceNames &named, const GmshNodes &gmsh_nodes, const std::size_t *const tags,
                      const unsigned int n, const std::set<unsigned int> &names)
    {
      const auto add = [&](const std::size_t *const corners, const unsigned int n_corners) {
        if (const auto face = gmsh_nodes.face(corners, n_corners))
          named.of_face[*face].insert(names.begin(), names.end());
      };
      if (n != 6)
        return add(tags, n);
      for (const auto &triangle : triangles_of_quadratic)
        {
          const std::size_t corners[3] = {tags[triangle[0]], tags[triangle[1]], tags[triangle[2]]};
          add(corners, 3);
        }
    }

    VolumeMesh read_open_file(const std::string &file, const GmshAlias &alias)
    {
      const std::size_t n_in_file = count_volume_elements(file);
      const GmshSession session(alias);
      GmshNodes         gmsh_nodes(file);
      VolumeMesh        mesh;
      std::size_t       n_elements = 0, n_quadratic = 0;
      for (const auto &[entity, n, nodes] : elements(3, cell_types, file))
        {
          const unsigned int volume = index_of(mesh.volume_names, volume_name(entity, file, mesh.notes));
          for (std::size_t k = 0; k + n <= nodes.size(); k += n, ++n_elements)
            if (n == 10)
              {
                add_quadratic(mesh, gmsh_nodes, nodes.data() + k, volume);
                ++n_quadratic;
              }
            else
              {
                mesh.cells.push_back({{}, n, volume});
                for (unsigned int v = 0; v < n; ++v)
                  mesh.cells.back().vertices[v] =
                      gmsh_nodes.vertex(mesh, nodes[k + (n == 8 ? gmsh_corner[v] : v)]);
              }
        }
      if (mesh.cells.empty())
        throw InputError("Mesh file \"" + file + "\": it contains neither tetrahedra nor hexahedra.");
      check_number(file, n_in_file, n_elements);
      if (n_quadratic > 0)
        mesh.notes.push_back(
            "Mesh file \"" + file + "\": " + std::to_string(n_quadratic) +
            " quadratic tetrahedra are cut into eight linear ones each, which are stiffer where "
            "thin parts bend; \"Refinement/Initial global levels = 1\" shows how much.");

      FaceNames named;
      for (const auto &[entity, n, nodes] : elements(2, face_types, file))
        {
          std::set<unsigned int> names;
          for (const std::string &name : group_names(2, entity))
            names.insert(index_of(named.names, name));
          for (std::size_t k = 0; k + n <= nodes.size() && !names.empty(); k += n)
            name_element(named, gmsh_nodes, nodes.data() + k, n, names);
        }
      name_faces(mesh, find_boundary_faces(mesh), std::move(named));
      return mesh;
    }

    /// The link is this process's: it is taken away also where the reader breaks down.
    VolumeMesh read_with_gmsh(const std::string &file)
    {
      const GmshAlias alias(file);
      return read_in_separate_process<VolumeMesh>(file, "gmsh", [&] { return read_open_file(file, alias); });
    }
  } // namespace



  VolumeMesh read_volume_mesh(const std::string &file, const MPI_Comm communicator)
  {
    VolumeMesh  mesh;
    std::string error;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        try
          {
            if (!std::ifstream(file) || std::filesystem::is_directory(file))
              throw InputError("Mesh file \"" + file + "\" cannot be opened.");
            std::string extension = std::filesystem::path(file).extension().string();
            std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
            mesh = extension == ".inp" ? read_abaqus_mesh(file) : read_with_gmsh(file);
            mend_orientation(mesh, "Mesh file \"" + file + "\"");
          }
        catch (const InputError &e)
          {
            error = e.what();
            if (error.find(file) == std::string::npos)
              error = "Mesh file \"" + file + "\": " + error;
          }
        catch (const std::exception &e)
          {
            error = "Mesh file \"" + file + "\" cannot be read" +
                    (*e.what() == 0 ? std::string() : ": " + std::string(e.what())) +
                    ". Is it complete, and of a format that gmsh knows?";
          }
      }
    error = broadcast_value(error, communicator);
    if (!error.empty())
      throw InputError(error);
    return broadcast_value(mesh, communicator);
  }
} // namespace Signorini
