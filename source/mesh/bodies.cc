// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/expression.h>
#include <signorini/mesh/mesh_input.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>
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

    /// Keeps the cells of some volumes only.
    void select_volumes(VolumeMesh &mesh, const std::string &list, const std::string &where)
    {
      if (Utilities::trim(list).empty())
        return;
      std::vector<bool> keep(mesh.volume_names.size(), false);
      for (const std::string &name : Utilities::split_string_list(list, ','))
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
      part.volume_names = mesh.volume_names;
      part.notes        = mesh.notes;
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
                  }
                part.cells.back().vertices[v] = n;
              }
          }
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
      mesh = part;
    }
  } // namespace



  Bodies::Bodies(const MPI_Comm communicator, const std::vector<BodyParameters> &parameters,
                 const std::string &base_folder)
    : comm(communicator)
  {
    std::vector<Placed> placed(parameters.size());
    types::boundary_id  next_boundary = 0;
    for (unsigned int b = 0; b < parameters.size(); ++b)
      {
        const BodyParameters &p       = parameters[b];
        const std::string     section = "Body " + p.name + "/";
        names.push_back(p.name);
        check_material(p.young, p.poisson, section, "");

        Placed &body            = placed[b];
        body.first_boundary     = next_boundary;
        const std::string kinds = "|" + generated_mesh_kinds() + "|";
        const std::string kind  = Utilities::trim(p.mesh);
        if (kinds.find("|" + kind + "|") != std::string::npos)
          {
            GeneratedMeshParameters g;
            g.kind         = kind;
            g.radius       = p.radius;
            g.inner_radius = p.inner_radius;
            g.height       = p.height;
            g.lower_corner = point_in(p.lower_corner, section + "Lower corner");
            g.upper_corner = point_in(p.upper_corner, section + "Upper corner");
            const auto n   = numbers_in(p.divisions, 3, section + "Divisions");
            for (unsigned int c = 0; c < 3; ++c)
              {
                if (!(n[c] >= 1.) || n[c] != std::floor(n[c]) || n[c] > 1e6)
                  throw InputError(section + "Divisions: \"" + p.divisions +
                                   "\" should be three positive integers.");
                g.divisions[c] = static_cast<unsigned int>(n[c]);
              }
            try
              {
                GeneratedMesh generated = generate_mesh(g);
                body.mesh               = std::move(generated.mesh);
                body.curved             = std::move(generated.curved);
              }
            catch (const InputError &e)
              {
                throw InputError(section + e.what());
              }
          }
        else if (kind.find('.') == std::string::npos)
          throw InputError(section + "Mesh: \"" + kind + "\" is neither a file nor one of: " +
                           Utilities::replace_in_string(generated_mesh_kinds(), "|", ", ") + ".");
        else
          {
            const std::filesystem::path file(kind);
            const std::string           path =
                file.is_absolute() ? kind : (std::filesystem::path(base_folder) / file).string();
            try
              {
                body.mesh = read_volume_mesh(path, communicator);
              }
            catch (const InputError &e)
              {
                throw InputError(section + "Mesh: " + e.what());
              }
            select_volumes(body.mesh, p.volumes, section + "Volumes");
          }
        // New vertices in the middles of faces would not lie on the surface.
        start_surfaces.push_back(start_surface(body));
        if (p.convert_to_hexahedra && p.convert_to_tetrahedra)
          throw InputError(section + "Convert to hexahedra, Convert to tetrahedra: choose one.");
        if (p.convert_to_hexahedra)
          body.mesh = split_into_hexahedra(body.mesh);
        if (p.convert_to_tetrahedra)
          body.mesh = split_into_tetrahedra(body.mesh);
        remarks.insert(remarks.end(), body.mesh.notes.begin(), body.mesh.notes.end());

        // Materials: one per body, and one for each volume with its own.
        materials.push_back({b, p.young, p.poisson, false, n_parts()});
        body.material_of_volume.assign(body.mesh.volume_names.size(),
                                       static_cast<unsigned int>(materials.size() - 1));
        for (const std::string &entry : Utilities::split_string_list(p.volume_materials, ';'))
          {
            if (entry.empty())
              continue;
            const std::string where = section + "Volume materials";
            const auto        parts = Utilities::split_string_list(entry, ':');
            if (parts.size() != 2)
              throw InputError(where + ": \"" + entry + "\" should read \"name: E, nu\".");
            const auto it = std::find(body.mesh.volume_names.begin(), body.mesh.volume_names.end(), parts[0]);
            if (it == body.mesh.volume_names.end())
              throw InputError(where + ": the mesh has no volume \"" + parts[0] + "\"; it has " +
                               listed(body.mesh.volume_names) + ".");
            const auto values = numbers_in(parts[1], 2, where);
            check_material(values[0], values[1], section, " of volume \"" + parts[0] + "\"");
            materials.push_back({b, values[0], values[1], false, n_parts()});
            body.material_of_volume[it - body.mesh.volume_names.begin()] =
                static_cast<unsigned int>(materials.size() - 1);
          }
        choose_elements(p, body);

        if (p.rotation_angle != 0.)
          {
            const Tensor<1, 3> axis = point_in(p.rotation_axis, section + "Rotation axis");
            if (!(axis.norm() > 0.))
              throw InputError(section + "Rotation axis: it must not be zero.");
            body.placement.rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
                Point<3>(axis / axis.norm()), p.rotation_angle * numbers::PI / 180.);
          }
        body.placement.translation = point_in(p.translation, section + "Translation");
        first_boundary.push_back(body.first_boundary);
        read_shapes(p, body, base_folder);
        for (Point<3> &v : body.mesh.vertices)
          v = body.placement(v);
        for (Point<3> &v : start_surfaces.back().mesh.vertices)
          v = body.placement(v);
        check_shapes(body, section + "Boundary shapes", p.snap);
        find_parts(body, b);
        if (p.snap)
          snap_vertices(body);
        boundaries.push_back(body.mesh.boundary_names);
        next_boundary += body.mesh.boundary_names.size();
      }
    create(placed);
  }



  void Bodies::create(const std::vector<Placed> &placed)
  {
    for (unsigned int b = 0; b < placed.size(); ++b)
      {
        const VolumeMesh  &mesh   = placed[b].mesh;
        const unsigned int n      = mesh.cells[0].n_vertices;
        const std::string  prefix = "Body " + names[b] + ": ";
        if (std::any_of(mesh.cells.begin(), mesh.cells.end(),
                        [&](const VolumeMesh::Cell &cell) { return cell.n_vertices != n; }))
          throw InputError(prefix + "the mesh has both tetrahedra and hexahedra; use one kind for each body "
                                    "(or Convert to hexahedra).");
      }
    create_hexahedra(placed);
    create_tetrahedra(placed);
  }



  void Bodies::create_hexahedra(const std::vector<Placed> &placed)
  {
    std::vector<Point<3>>    vertices;
    std::vector<CellData<3>> cells;
    SubCellData              faces;
    for (unsigned int b = 0; b < placed.size(); ++b)
      {
        const VolumeMesh &mesh = placed[b].mesh;
        if (mesh.cells[0].n_vertices != CellShape::hexahedron)
          continue;
        const unsigned int shift = static_cast<unsigned int>(vertices.size());
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (const VolumeMesh::Cell &cell : mesh.cells)
          {
            cells.emplace_back(8);
            for (unsigned int v = 0; v < 8; ++v)
              cells.back().vertices[v] = cell.vertices[v] + shift;
            cells.back().material_id = placed[b].material_of_cell[&cell - mesh.cells.data()];
          }
        for (const auto &face : mesh.faces)
          {
            faces.boundary_quads.emplace_back(4);
            for (unsigned int v = 0; v < 4; ++v)
              faces.boundary_quads.back().vertices[v] = face.vertices[v] + shift;
            faces.boundary_quads.back().boundary_id = first_boundary[b] + face.name;
          }
      }
    if (cells.empty())
      return;
    tria = std::make_unique<parallel::distributed::Triangulation<3>>(
        comm, Triangulation<3>::MeshSmoothing::none,
        parallel::distributed::Triangulation<3>::Settings::default_setting);
    // deal.II wants neighbouring cells to agree on the direction of edges.
    GridTools::consistently_order_cells(cells);
    try
      {
        tria->create_triangulation(vertices, cells, faces);
      }
    catch (const std::exception &)
      {
        throw InputError(
            "The meshes of the bodies cannot be joined to a triangulation: are there cells that share "
            "a face with more than one other cell, or distorted cells?");
      }

    for (unsigned int b = 0; b < placed.size(); ++b)
      for (const CurvedBoundary &curved : placed[b].curved)
        {
          const std::set<types::boundary_id> ids = boundary_ids(b, curved.name);
          for (const auto &cell : tria->cell_iterators_on_level(0))
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary() && ids.count(cell->face(f)->boundary_id()) > 0)
                cell->face(f)->set_all_manifold_ids(next_manifold);
          const Placement &placement = placed[b].placement;
          const Point<3>   centre(placement.translation);
          if (curved.shape == CurvedBoundary::sphere)
            tria->set_manifold(next_manifold, SphericalManifold<3>(centre));
          else
            tria->set_manifold(next_manifold, CylindricalManifold<3>(
                                                  placement.rotation * Tensor<1, 3>({0., 0., 1.}), centre));
          ++next_manifold;
        }
    set_manifolds();
  }



  void Bodies::create_tetrahedra(const std::vector<Placed> &placed)
  {
    std::vector<Point<3>>                vertices;
    std::vector<TetrahedralForest::Cell> cells;
    for (unsigned int b = 0; b < placed.size(); ++b)
      {
        const VolumeMesh &mesh = placed[b].mesh;
        if (mesh.cells[0].n_vertices != CellShape::tetrahedron)
          continue;
        std::map<VolumeMesh::Face, unsigned int> name_of;
        for (const auto &face : mesh.faces)
          name_of[face_key(face.vertices)] = face.name;
        const unsigned int shift = static_cast<unsigned int>(vertices.size());
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (const unsigned int v : placed[b].late)
          for (const auto &face : mesh.faces)
            if (std::find(face.vertices.begin(), face.vertices.end(), v) != face.vertices.end())
              late_vertices[v + shift].insert(first_boundary[b] + face.name);
        for (const VolumeMesh::Cell &cell : mesh.cells)
          {
            cells.emplace_back();
            cells.back().material = placed[b].material_of_cell[&cell - mesh.cells.data()];
            for (unsigned int f = 0; f < 4; ++f)
              {
                VolumeMesh::Face face;
                face.fill(VolumeMesh::no_vertex);
                for (unsigned int v = 0; v < 3; ++v)
                  face[v] = cell.vertices[CellShape::face(4, f)[v]];
                const auto it            = name_of.find(face_key(face));
                cells.back().vertices[f] = cell.vertices[f] + shift;
                cells.back().boundary[f] =
                    it == name_of.end() ? TetrahedralForest::inner : first_boundary[b] + it->second;
              }
          }
      }
    if (!cells.empty())
      forest = std::make_unique<TetrahedralForest>(vertices, cells);
  }



  MeshView Bodies::mesh() const
  {
    return {tria.get(), forest.get(), forest ? forest->n_levels() - 1 : 0};
  }



  bool Bodies::refine(const NodalSpace &space, const std::vector<bool> &marked)
  {
    AssertDimension(marked.size(), space.cells().size());
    bool any = false;
    for (std::size_t c = 0; c < marked.size(); ++c)
      any = any || (marked[c] && space.cells()[c].is_owned);
    if (Utilities::MPI::max(static_cast<int>(any), comm) == 0)
      return false;
    std::size_t c = 0;
    last_movement = MovementReport();
    if (tria)
      {
        // The space has the cells in this order, hexahedra first.
        for (const auto &cell : tria->active_cell_iterators())
          if (!cell->is_artificial())
            {
              if (cell->is_locally_owned() && marked[c])
                cell->set_refine_flag();
              ++c;
            }
        tria->prepare_coarsening_and_refinement();
        tria->execute_coarsening_and_refinement();
        if (std::find(is_user_shape.begin(), is_user_shape.end(), true) != is_user_shape.end())
          assess_hexahedra();
      }
    if (forest)
      {
        std::vector<char> mine;
        for (; c < marked.size(); ++c)
          if (space.cells()[c].is_owned)
            mine.push_back(marked[c]);
        std::vector<bool> all;
        for (const auto &part : Utilities::MPI::all_gather(comm, mine))
          all.insert(all.end(), part.begin(), part.end());
        if (forest->refine(all))
          follow_shapes();
      }
    return true;
  }



  unsigned int Bodies::body_index(const std::string &name, const std::string &where) const
  {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end())
      throw InputError(where + ": there is no body \"" + name + "\"; the bodies are " + listed(names) + ".");
    return static_cast<unsigned int>(it - names.begin());
  }



  std::set<types::boundary_id> Bodies::boundary_ids(const unsigned int body, const std::string &name,
                                                    const std::string &where) const
  {
    const auto it = std::find(boundaries[body].begin(), boundaries[body].end(), name);
    if (it == boundaries[body].end())
      throw InputError((where.empty() ? "Body " : where + ": body ") + names[body] + " has no boundary \"" +
                       name + "\"; it has " + listed(boundaries[body]) + ".");
    return {static_cast<types::boundary_id>(first_boundary[body] + (it - boundaries[body].begin()))};
  }
} // namespace Signorini
