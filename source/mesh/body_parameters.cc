// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/parameter_choice.h>
#include <signorini/mesh/body_parameters.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/generated_mesh.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/size_limit.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/manifold_lib.h>
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
    prm.add_parameter("Radius", radius,
                      "Radius of balls and cylinders, outer radius of shells and tubes (length).");
    prm.add_parameter("Inner radius", inner_radius, "Inner radius of shells and tubes (length).");
    prm.add_parameter("Height", height,
                      "Height of cylinders, length of tubes, half cylinders and prisms along their axis.");
    prm.add_parameter("Lower corner", lower_corner, "Corner of a block, \"x, y, z\" (length).");
    prm.add_parameter("Upper corner", upper_corner, "Opposite corner of a block (length).");
    prm.add_parameter("Divisions", divisions, "Cells of a block in x, y, z.",
                      Patterns::List(Patterns::Integer(1, 1000000), 3, 3));
    prm.add_parameter(
        "Round divisions", round_divisions,
        "Cells of tubes, annuli, half cylinders and prisms in radial direction, around and along "
        "the axis; 0 where edges should be about equal.",
        Patterns::List(Patterns::Integer(0, 1000000), 3, 3));
    prm.add_parameter(
        "Corners", corners,
        "Corners of the base of a prism, convex, with the inside on the left: \"(x, y); (x, y); "
        "(x, y); ...\".");
    prm.add_parameter(
        "Grading", grading,
        "Where the cells of a generated block, tube, annulus, half cylinder or prism are small, "
        "and width of the largest / width of the smallest cells in each direction: \"(x, y, z), "
        "ratio\" in the frame of the mesh, or \"boundary, ratio\"; empty for cells of one "
        "size.");
    prm.add_parameter(
        "Boundary shapes", shapes,
        "True shapes that new nodes of boundaries move to, in the frame of the mesh: \"boundary: sphere: "
        "centre, "
        "radius; boundary: cylinder: point, axis, radius; boundary: cone: point, axis, radius there, half "
        "angle in degrees (it opens along the axis); boundary: torus: centre, axis, radius, radius of the "
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
    add_choice(
        prm, "Element", element,
        {{ElementChoice::automatic, "automatic"},
         {ElementChoice::standard, "standard"},
         {ElementChoice::mean_dilatation, "mean dilatation"}},
        "What hexahedra are made of. standard: displacements alone. mean dilatation: with the mean change of "
        "volume of each cell, which does not lock where Poisson's ratio is near 0.5. automatic: mean "
        "dilatation where it is above 0.4, material by material.");
    prm.add_parameter(
        "Volumes", volumes,
        "Physical volumes of the mesh file that belong to this body (names or ids, separated by "
        "commas); empty for all.");
    prm.add_parameter("Volume materials", volume_materials,
                      "Materials of single physical volumes, \"name: E, nu; name: E, nu\".");
  }



  namespace
  {
    /// Appends the cells of the kept volumes, with vertices numbered as they come; returns their old numbers.
    std::vector<unsigned int> copy_cells(VolumeMesh &part, const VolumeMesh &mesh,
                                         const std::vector<bool> &keep)
    {
      std::vector<unsigned int> number(mesh.vertices.size(), VolumeMesh::no_vertex), old;
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
                    if (cell.vertices[v] < mesh.node_numbers.size())
                      part.node_numbers.push_back(mesh.node_numbers[cell.vertices[v]]);
                  }
                part.cells.back().vertices[v] = n;
              }
          }
      return old;
    }

    /// The groups of boundaries of a mesh, as numbers of the boundaries of a part of it.
    std::vector<std::pair<std::string, std::vector<unsigned int>>> groups_in(const VolumeMesh &part,
                                                                             const VolumeMesh &mesh)
    {
      std::vector<std::pair<std::string, std::vector<unsigned int>>> result;
      for (const auto &[name, members] : mesh.boundary_groups)
        {
          result.emplace_back(name, std::vector<unsigned int>());
          for (const unsigned int i : members)
            if (const auto it =
                    std::find(part.boundary_names.begin(), part.boundary_names.end(), mesh.boundary_names[i]);
                it != part.boundary_names.end())
              result.back().second.push_back(static_cast<unsigned int>(it - part.boundary_names.begin()));
        }
      return result;
    }

    /// Keeps the cells of some volumes only.
    void select_volumes(VolumeMesh &mesh, const std::vector<std::string> &list, const std::string &where)
    {
      if (list.empty())
        return;
      std::vector<bool> keep(mesh.volume_names.size(), false);
      for (const std::string &name : list)
        {
          const auto it = std::find(mesh.volume_names.begin(), mesh.volume_names.end(), name);
          if (it == mesh.volume_names.end())
            throw InputError(where + ": the mesh has no volume \"" + name + "\"; it has " +
                             listed(mesh.volume_names) + ".");
          keep[it - mesh.volume_names.begin()] = true;
        }
      std::map<VolumeMesh::Face, unsigned int> name_of;
      for (const auto &face : mesh.faces)
        name_of[face_key(face.vertices)] = face.name;
      VolumeMesh part;
      part.volume_names                   = mesh.volume_names;
      part.notes                          = mesh.notes;
      const std::vector<unsigned int> old = copy_cells(part, mesh, keep);
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
      part.boundary_groups = groups_in(part, mesh);
      std::vector<unsigned int> number(mesh.vertices.size(), VolumeMesh::no_vertex);
      for (unsigned int v = 0; v < old.size(); ++v)
        number[old[v]] = v;
      for (const auto &[name, vertices] : mesh.node_sets)
        {
          part.node_sets.emplace_back(name, std::vector<unsigned int>());
          for (const unsigned int v : vertices)
            if (number[v] != VolumeMesh::no_vertex)
              part.node_sets.back().second.push_back(number[v]);
        }
      mesh = part;
    }

    /// "name: E, nu; ...".
    std::vector<std::pair<std::string, IsotropicMaterial>> parse_volume_materials(const std::string &text,
                                                                                  const std::string &where)
    {
      std::vector<std::pair<std::string, IsotropicMaterial>> result;
      for (const std::string &entry : Utilities::split_string_list(text, ';'))
        {
          if (entry.empty())
            continue;
          const auto parts = Utilities::split_string_list(entry, ':');
          if (parts.size() != 2)
            throw InputError(where + ": \"" + entry + "\" should read \"name: E, nu\".");
          const auto numbers = split_list(parts[1], ',', where);
          if (numbers.size() != 2)
            throw InputError(where + ": \"" + parts[1] + "\" should be two numbers separated by a comma.");
          result.push_back({parts[0], {parse_number(numbers[0], where), parse_number(numbers[1], where)}});
        }
      return result;
    }

    /// The sphere around the origin or the cylinder around the z axis that a generated boundary lies on.
    BoundaryGeometry round_geometry(const CurvedBoundary &curved, const VolumeMesh &mesh,
                                    const Placement &placement)
    {
      const unsigned int name = static_cast<unsigned int>(
          std::find(mesh.boundary_names.begin(), mesh.boundary_names.end(), curved.name) -
          mesh.boundary_names.begin());
      const auto face = std::find_if(mesh.faces.begin(), mesh.faces.end(),
                                     [name](const VolumeMesh::BoundaryFace &f) { return f.name == name; });
      AssertThrow(face != mesh.faces.end(), ExcInternalError());
      const Point<3>     x    = mesh.vertices[face->vertices[0]], centre(placement.translation);
      const Tensor<1, 3> axis = placement.rotation * Tensor<1, 3>({0., 0., 1.});
      if (curved.shape == CurvedBoundary::sphere)
        return {curved.name, make_sphere_shape(centre, x.norm()),
                std::make_shared<const SphericalManifold<3>>(centre)};
      return {curved.name, make_cylinder_shape(centre, axis, std::hypot(x[0], x[1])),
              std::make_shared<const CylindricalManifold<3>>(axis, centre)};
    }

    std::vector<Point<2>> parse_corners(const std::string &text)
    {
      std::vector<Point<2>> corners;
      for (const std::string &entry : split_list(text, ';', "Corners"))
        if (!entry.empty())
          {
            const bool framed  = entry.size() > 2 && entry.front() == '(' && entry.back() == ')';
            const auto numbers = split_list(framed ? entry.substr(1, entry.size() - 2) : "", ',', "Corners");
            if (numbers.size() != 2)
              throw InputError("Corners: \"" + entry + "\" should be a point in the plane, like (1, 0).");
            corners.emplace_back(parse_number(numbers[0], "Corners"), parse_number(numbers[1], "Corners"));
          }
      return corners;
    }

    MeshGrading parse_grading(const std::string &text)
    {
      MeshGrading grading;
      if (Utilities::trim(text).empty())
        return grading;
      const auto parts = split_list(text, ',', "Grading");
      if (parts.size() != 2 || parts[0].empty())
        throw InputError("Grading: \"" + text +
                         "\" should read \"(x, y, z), ratio\" or \"boundary, ratio\".");
      if (parts[0][0] == '(')
        grading.point = parse_point(parts[0], "Grading");
      else
        grading.boundary = parts[0];
      grading.ratio = parse_number(parts[1], "Grading");
      return grading;
    }

    /// Before they are made.
    void check_number_of_cells(const GeneratedMeshParameters &g, const std::string &where,
                               const MPI_Comm comm)
    {
      const bool block = g.kind == "block";
      double     n     = 1.;
      for (const unsigned int d : block ? g.divisions : g.round_divisions)
        n *= std::max(1u, d);
      refuse_too_many_cells(n, where,
                            std::string("Take fewer \"") + (block ? "Divisions" : "Round divisions") + "\".",
                            comm, 3.);
    }

    void generate(BodyDefinition &body, const BodyParameters &p, const std::string &kind, const MPI_Comm comm)
    {
      GeneratedMeshParameters g;
      g.kind         = kind;
      g.radius       = p.radius;
      g.inner_radius = p.inner_radius;
      g.height       = p.height;
      g.lower_corner = p.lower_corner;
      g.upper_corner = p.upper_corner;
      AssertDimension(p.divisions.size(), 3);
      std::copy(p.divisions.begin(), p.divisions.end(), g.divisions.begin());
      std::copy(p.round_divisions.begin(), p.round_divisions.end(), g.round_divisions.begin());
      g.corners = parse_corners(p.corners);
      g.grading = parse_grading(p.grading);
      check_number_of_cells(g, "Mesh: it", comm);
      GeneratedMesh generated = generate_mesh(g);
      body.mesh               = std::move(generated.mesh);
      for (const CurvedBoundary &curved : generated.curved)
        body.geometry.push_back(round_geometry(curved, body.mesh, body.placement));
    }

    void read_mesh(BodyDefinition &body, const BodyParameters &p, const MPI_Comm communicator,
                   const std::string &base_folder)
    {
      const std::string section = "Body " + p.name + "/";
      const std::string kind    = Utilities::trim(p.mesh);
      try
        {
          if (("|" + generated_mesh_kinds() + "|").find("|" + kind + "|") != std::string::npos)
            return generate(body, p, kind, communicator);
        }
      catch (const InputError &e)
        {
          throw InputError(section + e.what());
        }
      if (kind.find('.') == std::string::npos)
        throw InputError(section + "Mesh: \"" + kind + "\" is neither a file nor one of: " +
                         Utilities::replace_in_string(generated_mesh_kinds(), "|", ", ") + ".");
      const std::filesystem::path file(kind);
      try
        {
          body.mesh = read_volume_mesh(
              file.is_absolute() ? kind : (std::filesystem::path(base_folder) / file).string(), communicator);
        }
      catch (const InputError &e)
        {
          throw InputError(section + "Mesh: " + e.what());
        }
      select_volumes(body.mesh, p.volumes, section + "Volumes");
    }

    void add_shapes(BodyDefinition &body, const BodyParameters &p, const std::string &base_folder)
    {
      const std::string                           section = "Body " + p.name + "/";
      std::map<std::string, BoundaryShapePointer> made;
      for (const auto &[name, text] : split_named_entries(p.shapes, section + "Boundary shapes"))
        {
          const std::string where = section + "Boundary shapes, \"" + name + "\"";
          if (made.count(text) == 0)
            made[text] = make_boundary_shape(text, body.placement, base_folder, where);
          body.geometry.push_back({name, made[text], nullptr});
        }
      for (const std::string &entry : split_list(p.sharp_edges, ';', section + "Sharp edges"))
        if (!entry.empty())
          {
            const auto parts = split_list(entry, '+', section + "Sharp edges");
            if (parts.size() != 2)
              throw InputError(section + "Sharp edges: \"" + entry +
                               "\" should read \"boundary + boundary\".");
            body.sharp_edges.emplace_back(parts[0], parts[1]);
          }
    }
  } // namespace



  BodyDefinition BodyParameters::definition(const MPI_Comm communicator, const std::string &base_folder) const
  {
    const std::string section = "Body " + name + "/";
    BodyDefinition    body;
    body.name     = name;
    body.material = {young, poisson};
    body.snap     = snap;
    body.element  = element;
    if (convert_to_hexahedra && convert_to_tetrahedra)
      throw InputError(section + "Convert to hexahedra, Convert to tetrahedra: choose one.");
    body.conversion = convert_to_hexahedra    ? CellConversion::to_hexahedra
                      : convert_to_tetrahedra ? CellConversion::to_tetrahedra
                                              : CellConversion::none;
    if (rotation_angle != 0.)
      {
        if (!(rotation_axis.norm() > 0.))
          throw InputError(section + "Rotation axis: it must not be zero.");
        body.placement.rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
            Point<3>(rotation_axis / rotation_axis.norm()), rotation_angle * numbers::PI / 180.);
      }
    body.placement.translation = translation;
    read_mesh(body, *this, communicator, base_folder);
    add_shapes(body, *this, base_folder);
    body.volume_materials = parse_volume_materials(volume_materials, section + "Volume materials");
    return body;
  }



  std::vector<BodyDefinition> define_bodies(const MPI_Comm                     communicator,
                                            const std::vector<BodyParameters> &parameters,
                                            const std::string                 &base_folder)
  {
    std::vector<BodyDefinition> bodies;
    for (const BodyParameters &body : parameters)
      bodies.push_back(body.definition(communicator, base_folder));
    return bodies;
  }
} // namespace Signorini
