// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/mesh_input.h>

#include <deal.II/base/utilities.h>
#include <deal.II/physics/transformations.h>

#include <filesystem>

namespace Signorini
{
  using namespace dealii;

  void BodyParameters::add_parameters(ParameterHandler &prm)
  {
    prm.add_parameter("Mesh", mesh,
                      "A mesh file of hexahedra or tetrahedra (.msh, .inp of Abaqus, .vtk, .unv, .bdf and "
                      "whatever else gmsh reads), relative to this file, or a generated mesh: " +
                          Utilities::replace_in_string(generated_mesh_kinds(), "|", ", ") + ".");
    prm.add_parameter("Convert to hexahedra", convert_to_hexahedra,
                      "Cuts each tetrahedron of the mesh into four hexahedra.");
    prm.add_parameter("Convert to tetrahedra", convert_to_tetrahedra,
                      "Cuts each hexahedron of the mesh into twelve tetrahedra.");
    prm.add_parameter("Radius", radius, "Radius of balls and cylinders, outer radius of shells (length).");
    prm.add_parameter("Inner radius", inner_radius, "Inner radius of shells (length).");
    prm.add_parameter("Height", height, "Height of cylinders (length).");
    prm.add_parameter("Lower corner", lower_corner, "Corner of a block, \"x, y, z\" (length).");
    prm.add_parameter("Upper corner", upper_corner, "Opposite corner of a block (length).");
    prm.add_parameter("Divisions", divisions, "Cells of a block in x, y, z.");
    prm.add_parameter(
        "Boundary shapes", shapes,
        "True shapes that new nodes of boundaries move to, in the frame of the mesh: \"boundary: sphere: "
        "centre, "
        "radius; boundary: cylinder: point, axis, radius; boundary: torus: centre, axis, radius, radius of "
        "the "
        "tube; boundary: plane: point, normal; boundary: file: NAME\" (a triangulated surface, .stl, .obj, "
        ".off, "
        ".ply), with points as (x, y, z). Nodes on several such boundaries move to their common edge.");
    prm.add_parameter("Sharp edges", sharp_edges,
                      "Pairs of boundaries whose common edges stay straight: \"boundary + boundary; ...\".");
    prm.add_parameter("Snap boundary vertices", snap,
                      "Moves the vertices of the coarse mesh onto the boundary shapes, too.");
    prm.add_parameter("Translation", translation, "Moves the body after rotation, \"x, y, z\" (length).");
    prm.add_parameter("Rotation axis", rotation_axis, "Axis through the origin, \"x, y, z\".");
    prm.add_parameter("Rotation angle", rotation_angle, "Angle in degrees.");
    prm.add_parameter("Young modulus", young, "Young's modulus E > 0 (force per area).");
    prm.add_parameter("Poisson ratio", poisson, "Poisson's ratio, -1 < nu < 0.5.");
    prm.add_parameter(
        "Element", element,
        "What hexahedra are made of: displacements alone (standard), or with the mean change of volume of "
        "each cell (mean dilatation), which does not lock where Poisson's ratio is near 0.5; automatic: mean "
        "dilatation where it is above 0.4, material by material.",
        Patterns::Selection("automatic|standard|mean dilatation"));
    prm.add_parameter(
        "Volumes", volumes,
        "Physical volumes of the mesh file that belong to this body (names or ids, separated by "
        "commas); empty for all.");
    prm.add_parameter("Volume materials", volume_materials,
                      "Materials of single physical volumes, \"name: E, nu; name: E, nu\".");
  }



  namespace
  {
    std::vector<double> numbers_in(const std::string &text, const std::size_t n, const std::string &where)
    {
      std::vector<double> values;
      for (const std::string &word : Utilities::split_string_list(text, ','))
        {
          std::size_t used = 0;
          try
            {
              values.push_back(std::stod(word, &used));
            }
          catch (const std::exception &)
            {
            }
          if (used != word.size() || word.empty() || !std::isfinite(values.back()))
            throw InputError(where + ": \"" + text + "\" should be " + std::to_string(n) +
                             " numbers separated by commas.");
        }
      if (values.size() != n)
        throw InputError(where + ": \"" + text + "\" should be " + std::to_string(n) +
                         " numbers separated by commas.");
      return values;
    }

    Point<3> point_in(const std::string &text, const std::string &where)
    {
      const auto v = numbers_in(text, 3, where);
      return Point<3>(v[0], v[1], v[2]);
    }

    void check_material(const double young, const double poisson, const std::string &section,
                        const std::string &note)
    {
      const auto number = [](const double x) {
        std::ostringstream out;
        out << x;
        return out.str();
      };
      if (!(young > 0.) || !std::isfinite(young))
        throw InputError(section + "Young modulus" + note + ": " + number(young) +
                         " is not allowed; it must be positive.");
      if (!(poisson > -1. && poisson < .5))
        throw InputError(section + "Poisson ratio" + note + ": " + number(poisson) +
                         " is not allowed; it must lie between -1 and 0.5 (0.5 would be incompressible).");
    }

    /// Which volumes of a mesh a list names.
    std::vector<bool> volumes_in(const std::string &list, const VolumeMesh &mesh, const std::string &where)
    {
      std::vector<bool> listed_ones(mesh.volume_names.size(), false);
      for (const std::string &name : Utilities::split_string_list(list, ','))
        {
          const auto it = std::find(mesh.volume_names.begin(), mesh.volume_names.end(), name);
          if (it == mesh.volume_names.end())
            throw InputError(where + ": the mesh has no volume \"" + name + "\"; it has " +
                             listed(mesh.volume_names) + ".");
          listed_ones[it - mesh.volume_names.begin()] = true;
        }
      return listed_ones;
    }

    /// The cells of some volumes with their vertices, without faces; `old` has the old numbers of the
    /// vertices.
    VolumeMesh cells_of(const VolumeMesh &mesh, const std::vector<bool> &keep, std::vector<unsigned int> &old)
    {
      VolumeMesh part;
      part.volume_names = mesh.volume_names;
      part.notes        = mesh.notes;
      std::vector<unsigned int> number(mesh.vertices.size(), VolumeMesh::no_vertex);
      for (const VolumeMesh::Cell &cell : mesh.cells)
        if (keep[cell.volume])
          {
            part.cells.push_back(cell);
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              {
                unsigned int &n = number[cell.vertices[v]];
                if (n == VolumeMesh::no_vertex)
                  {
                    n = static_cast<unsigned int>(part.vertices.size());
                    part.vertices.push_back(mesh.vertices[cell.vertices[v]]);
                    old.push_back(cell.vertices[v]);
                  }
                part.cells.back().vertices[v] = n;
              }
          }
      return part;
    }

    /// Keeps the cells of some volumes only; an empty list means all. What was an inner face is "unnamed".
    void select_volumes(VolumeMesh &mesh, const std::string &list, const std::string &where)
    {
      if (Utilities::trim(list).empty())
        return;
      std::vector<unsigned int>                old;
      VolumeMesh                               part = cells_of(mesh, volumes_in(list, mesh, where), old);
      std::map<VolumeMesh::Face, unsigned int> name_of;
      for (const auto &face : mesh.faces)
        name_of[face_key(face.vertices)] = face.name;
      for (const auto &face : find_boundary_faces(part))
        {
          VolumeMesh::Face key = face.first;
          for (unsigned int &v : key)
            if (v != VolumeMesh::no_vertex)
              v = old[v];
          const auto it = name_of.find(face_key(key));
          part.faces.push_back(
              {face.first, index_of(part.boundary_names,
                                    it == name_of.end() ? "unnamed" : mesh.boundary_names[it->second])});
        }
      mesh = std::move(part);
    }

    /// How the parameters of a body are called in messages.
    std::string section_of(const BodyParameters &p)
    {
      return "Body " + p.name + "/";
    }

    GeneratedMeshParameters generator_of(const BodyParameters &p, const std::string &kind)
    {
      GeneratedMeshParameters g;
      g.kind         = kind;
      g.radius       = p.radius;
      g.inner_radius = p.inner_radius;
      g.height       = p.height;
      g.lower_corner = point_in(p.lower_corner, section_of(p) + "Lower corner");
      g.upper_corner = point_in(p.upper_corner, section_of(p) + "Upper corner");
      const auto n   = numbers_in(p.divisions, 3, section_of(p) + "Divisions");
      for (unsigned int c = 0; c < 3; ++c)
        {
          if (!(n[c] >= 1.) || n[c] != std::floor(n[c]) || n[c] > 1e6)
            throw InputError(section_of(p) + "Divisions: \"" + p.divisions +
                             "\" should be three positive integers.");
          g.divisions[c] = static_cast<unsigned int>(n[c]);
        }
      return g;
    }

    bool is_generated(const std::string &kind)
    {
      const std::string kinds = "|" + generated_mesh_kinds() + "|";
      return kinds.find("|" + kind + "|") != std::string::npos;
    }

    /// Generated, or read from a file.
    GeneratedMesh start_mesh(const BodyParameters &p, const std::string &base_folder,
                             const MPI_Comm communicator)
    {
      const std::string section = section_of(p), kind = Utilities::trim(p.mesh);
      if (is_generated(kind))
        {
          const GeneratedMeshParameters g = generator_of(p, kind);
          try
            {
              return generate_mesh(g);
            }
          catch (const InputError &e)
            {
              throw InputError(section + e.what());
            }
        }
      if (kind.find('.') == std::string::npos)
        throw InputError(section + "Mesh: \"" + kind + "\" is neither a file nor one of: " +
                         Utilities::replace_in_string(generated_mesh_kinds(), "|", ", ") + ".");
      const std::filesystem::path file(kind);
      const std::string           path =
          file.is_absolute() ? kind : (std::filesystem::path(base_folder) / file).string();
      GeneratedMesh result;
      try
        {
          result.mesh = read_volume_mesh(path, communicator);
        }
      catch (const InputError &e)
        {
          throw InputError(section + "Mesh: " + e.what());
        }
      select_volumes(result.mesh, p.volumes, section + "Volumes");
      return result;
    }

    void convert_cells(VolumeMesh &mesh, const BodyParameters &p)
    {
      if (p.convert_to_hexahedra && p.convert_to_tetrahedra)
        throw InputError(section_of(p) + "Convert to hexahedra, Convert to tetrahedra: choose one.");
      if (p.convert_to_hexahedra)
        mesh = split_into_hexahedra(mesh);
      if (p.convert_to_tetrahedra)
        mesh = split_into_tetrahedra(mesh);
    }

    Placement placement_of(const BodyParameters &p)
    {
      Placement result;
      if (p.rotation_angle != 0.)
        {
          const Tensor<1, 3> axis = point_in(p.rotation_axis, section_of(p) + "Rotation axis");
          if (!(axis.norm() > 0.))
            throw InputError(section_of(p) + "Rotation axis: it must not be zero.");
          result.rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
              Point<3>(axis / axis.norm()), p.rotation_angle * numbers::PI / 180.);
        }
      result.translation = point_in(p.translation, section_of(p) + "Translation");
      return result;
    }
  } // namespace



  Bodies::Placed Bodies::place(const BodyParameters &p, const std::string &base_folder)
  {
    const unsigned int number = n_bodies();
    names.push_back(p.name);
    check_material(p.young, p.poisson, section_of(p), "");

    Placed body;
    body.first_boundary     = number == 0 ? 0 : first_boundary.back() + boundaries.back().size();
    GeneratedMesh generated = start_mesh(p, base_folder, comm);
    body.mesh               = std::move(generated.mesh);
    body.curved             = std::move(generated.curved);
    // Before conversion: new vertices in the middles of faces would not lie on the surface.
    start_surfaces.push_back(start_surface(body));
    convert_cells(body.mesh, p);
    remarks.insert(remarks.end(), body.mesh.notes.begin(), body.mesh.notes.end());
    add_materials(body, p);
    choose_elements(p, body);

    body.placement = placement_of(p);
    first_boundary.push_back(body.first_boundary);
    read_shapes(p, body, base_folder);
    for (Point<3> &v : body.mesh.vertices)
      v = body.placement(v);
    for (Point<3> &v : start_surfaces.back().mesh.vertices)
      v = body.placement(v);
    check_shapes(body, section_of(p) + "Boundary shapes", p.snap);
    find_parts(body, number);
    if (p.snap)
      snap_vertices(body);
    boundaries.push_back(body.mesh.boundary_names);
    return body;
  }



  void Bodies::add_materials(Placed &placed, const BodyParameters &p)
  {
    const unsigned int body = n_bodies() - 1;
    const auto         add  = [&](const double young, const double poisson) {
      materials.push_back({body, young, poisson, false, n_parts()});
      return static_cast<unsigned int>(materials.size() - 1);
    };
    const auto &volumes = placed.mesh.volume_names;
    placed.material_of_volume.assign(volumes.size(), add(p.young, p.poisson));
    const std::string where = section_of(p) + "Volume materials";
    for (const std::string &entry : Utilities::split_string_list(p.volume_materials, ';'))
      {
        if (entry.empty())
          continue;
        const auto words = Utilities::split_string_list(entry, ':');
        if (words.size() != 2)
          throw InputError(where + ": \"" + entry + "\" should read \"name: E, nu\".");
        const auto it = std::find(volumes.begin(), volumes.end(), words[0]);
        if (it == volumes.end())
          throw InputError(where + ": the mesh has no volume \"" + words[0] + "\"; it has " +
                           listed(volumes) + ".");
        const auto values = numbers_in(words[1], 2, where);
        check_material(values[0], values[1], section_of(p), " of volume \"" + words[0] + "\"");
        placed.material_of_volume[it - volumes.begin()] = add(values[0], values[1]);
      }
  }
} // namespace Signorini
