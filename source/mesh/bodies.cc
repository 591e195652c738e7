// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "placed_body.h"

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/mesh/size_limit.h>

#include <deal.II/grid/grid_tools.h>

#include <optional>

namespace Signorini
{
  using namespace dealii;

  Bodies::Bodies(const MPI_Comm communicator, const std::vector<BodyDefinition> &definitions)
    : comm(communicator)
    , start(std::make_shared<StartNodes>())
  {
    std::vector<Placed> placed;
    for (const BodyDefinition &definition : definitions)
      placed.push_back(add_body(definition));
    create(placed);
  }



  namespace
  {
    /// Refuses what leaves the range of numbers when it is squared and multiplied with a modulus.
    void check_extent(const VolumeMesh &mesh, const std::string &section)
    {
      double width = 0., largest = 0.;
      for (const Point<3> &v : mesh.vertices)
        {
          width   = std::max(width, v.distance(mesh.vertices[0]));
          largest = std::max(largest, v.norm());
        }
      if (width > 1e-60 && largest < 1e60)
        return;
      std::ostringstream text;
      text << section << "Mesh: the body is " << width << " wide and reaches " << largest
           << " away from the origin. Choose another unit.";
      throw InputError(text.str());
    }
  } // namespace



  Bodies::Placed Bodies::add_body(const BodyDefinition &definition)
  {
    const std::string  section = "Body " + definition.name + "/";
    const unsigned int b       = n_bodies();
    names.push_back(definition.name);
    if (definition.mesh.cells.empty())
      throw InputError(section + "Mesh: it has no cells.");
    Placed body;
    body.mesh           = definition.mesh;
    body.first_boundary = static_cast<types::boundary_id>(shapes.size());
    first_boundary.push_back(body.first_boundary);
    // New vertices in the middles of faces would not lie on the surface.
    start_surfaces.push_back(start_surface(body));
    if (definition.conversion == CellConversion::to_hexahedra)
      body.mesh = split_into_hexahedra(body.mesh);
    if (definition.conversion == CellConversion::to_tetrahedra)
      body.mesh = split_into_tetrahedra(body.mesh);
    remarks.insert(remarks.end(), body.mesh.notes.begin(), body.mesh.notes.end());
    add_materials(definition, body);
    choose_elements(definition, body);
    add_shapes(definition, body);
    for (Point<3> &v : body.mesh.vertices)
      v = definition.placement(v);
    for (Point<3> &v : start_surfaces.back().mesh.vertices)
      v = definition.placement(v);
    check_extent(body.mesh, section);
    check_shapes(body, section + "Boundary shapes", definition.snap);
    find_parts(body, b);
    for (const unsigned int material : body.material_of_cell)
      stiffest = std::max(stiffest, materials[material].young);
    if (definition.snap)
      snap_vertices(body);
    boundaries.push_back(body.mesh.boundary_names);
    groups.push_back(body.mesh.boundary_groups);
    add_node_sets(body.mesh);
    return body;
  }



  void Bodies::add_materials(const BodyDefinition &definition, Placed &placed)
  {
    const std::string section = "Body " + definition.name + "/";
    const auto       &named   = placed.mesh.volume_names;
    volumes.push_back(named);
    check_material(definition.material, section);
    std::vector<IsotropicMaterial> of_volume(named.size(), definition.material);
    for (const auto &[name, material] : definition.volume_materials)
      {
        const auto it = std::find(named.begin(), named.end(), name);
        if (it == named.end())
          throw InputError(section + "Volume materials: the mesh has no volume \"" + name + "\"; it has " +
                           listed(named) + ".");
        check_material(material, section, " of volume \"" + name + "\"");
        of_volume[it - named.begin()] = material;
      }
    // The first is that of the body, whether its cells have it or not.
    const auto add = [&](const IsotropicMaterial &material, const std::size_t volume) {
      materials.push_back({material, n_bodies() - 1, false, n_parts(), static_cast<unsigned int>(volume)});
    };
    add(definition.material, named.size());
    for (std::size_t v = 0; v < named.size(); ++v)
      {
        placed.material_of_volume.push_back(static_cast<unsigned int>(materials.size()));
        add(of_volume[v], v);
      }
  }



  std::set<types::material_id> Bodies::material_ids(const unsigned int body, const std::string &volume,
                                                    const std::string &where) const
  {
    const std::vector<std::string> &names  = volumes[body];
    const auto                      number = std::find(names.begin(), names.end(), volume) - names.begin();
    if (!volume.empty() && number == static_cast<std::ptrdiff_t>(names.size()))
      throw InputError(where + ": the mesh has no volume \"" + volume + "\"; it has " + listed(names) + ".");
    std::set<types::material_id> result;
    for (types::material_id id = 0; id < materials.size(); ++id)
      if (materials[id].body == body && (volume.empty() || materials[id].volume == number))
        result.insert(id);
    return result;
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
    // The vertex among those of all bodies.
    std::vector<unsigned int> start_of;
    for (unsigned int b = 0; b < placed.size(); ++b)
      {
        const VolumeMesh &mesh = placed[b].mesh;
        if (mesh.cells[0].n_vertices != CellShape::hexahedron)
          continue;
        const unsigned int shift = static_cast<unsigned int>(vertices.size());
        vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          {
            cells.emplace_back(8);
            for (unsigned int v = 0; v < 8; ++v)
              cells.back().vertices[v] = mesh.cells[c].vertices[v] + shift;
            cells.back().material_id = placed[b].material_of_cell[c];
          }
        for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
          start_of.push_back(first_vertex[b] + v);
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
    // Coarse cells are named by their trees in the forest, which come in an order of their own.
    start->hexahedra.resize(tria->n_cells(0));
    for (const auto &cell : tria->cell_iterators_on_level(0))
      for (unsigned int v = 0; v < 8; ++v)
        start->hexahedra[cell->id().get_coarse_cell_id()][v] = start_of[cell->vertex_index(v)];

    set_given_manifolds(placed);
    set_manifolds();
  }



  void Bodies::set_given_manifolds(const std::vector<Placed> &placed)
  {
    for (const Placed &body : placed)
      for (const auto &[id, manifold] : body.manifolds)
        {
          for (const auto &cell : tria->cell_iterators_on_level(0))
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == id)
                cell->face(f)->set_all_manifold_ids(next_manifold);
          tria->set_manifold(next_manifold++, *manifold);
        }
  }



  void Bodies::create_tetrahedra(const std::vector<Placed> &placed)
  {
    std::vector<Point<3>>    vertices;
    std::vector<Tetrahedron> cells;
    std::set<unsigned int>   late;
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
        for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
          start->forest.push_back(first_vertex[b] + v);
        for (const unsigned int v : placed[b].late)
          late.insert(v + shift);
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          {
            const VolumeMesh::Cell &cell = mesh.cells[c];
            cells.emplace_back();
            cells.back().material = placed[b].material_of_cell[c];
            for (unsigned int f = 0; f < 4; ++f)
              {
                VolumeMesh::Face face;
                face.fill(VolumeMesh::no_vertex);
                for (unsigned int v = 0; v < 3; ++v)
                  face[v] = cell.vertices[CellShape::face(4, f)[v]];
                const auto it            = name_of.find(face_key(face));
                cells.back().vertices[f] = cell.vertices[f] + shift;
                cells.back().boundary[f] =
                    it == name_of.end() ? Tetrahedron::inner : first_boundary[b] + it->second;
              }
          }
      }
    if (cells.empty())
      return;
    forest = std::make_unique<TetrahedralForest>(vertices, cells, comm);
    // Vertices that are not yet where their shapes want them are marked; the start mesh names them by number.
    const auto &names_of_vertices = forest->mesh(0).vertices;
    for (unsigned int v = 0; v < names_of_vertices.size(); ++v)
      forest->vertex_marks()[v] = late.count(static_cast<unsigned int>(names_of_vertices[v])) > 0;
  }



  MeshView Bodies::mesh() const
  {
    return {tria.get(), forest.get(), forest ? forest->n_levels() - 1 : 0, start.get()};
  }



  bool Bodies::refine(const NodalSpace &space, const std::vector<bool> &marked)
  {
    AssertDimension(marked.size(), space.cells().size());
    std::uint64_t n_marked = 0, n_cells = 0;
    for (std::size_t c = 0; c < marked.size(); ++c)
      if (space.cells()[c].is_owned)
        {
          ++n_cells;
          n_marked += marked[c];
        }
    n_marked = Utilities::MPI::sum(n_marked, comm);
    n_cells  = Utilities::MPI::sum(n_cells, comm);
    if (n_marked == 0)
      return false;
    // A marked cell becomes eight.
    const double growth = 1. + 7. * static_cast<double>(n_marked) / static_cast<double>(n_cells);
    refuse_too_many_unknowns(growth * dim * static_cast<double>(space.n_nodes()));
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
        std::vector<bool> mine;
        for (; c < marked.size(); ++c)
          if (space.cells()[c].is_owned)
            mine.push_back(marked[c]);
        if (forest->refine(mine))
          follow_shapes();
      }
    return true;
  }



  namespace
  {
    /// What a user may write: groups, and boundaries that are in none.
    std::vector<std::string>
    names_to_show(const std::vector<std::string>                                       &boundaries,
                  const std::vector<std::pair<std::string, std::vector<unsigned int>>> &groups)
    {
      std::vector<std::string> result;
      std::set<unsigned int>   in_group;
      for (const auto &[name, members] : groups)
        {
          result.push_back(name);
          in_group.insert(members.begin(), members.end());
        }
      for (unsigned int i = 0; i < boundaries.size(); ++i)
        if (in_group.count(i) == 0)
          result.push_back(boundaries[i]);
      return result;
    }
  } // namespace



  unsigned int Bodies::body_index(const std::string &name, const std::string &where) const
  {
    const auto it = std::find(names.begin(), names.end(), name);
    if (it == names.end())
      throw InputError(where + ": there is no body \"" + name + "\"; the bodies are " + listed(names) + ".");
    return static_cast<unsigned int>(it - names.begin());
  }



  namespace
  {
    /// The axis of "+x", "-x", "+y", ... (0, 1 or 2, with its sign), or nothing.
    std::optional<std::pair<unsigned int, double>> parse_direction(const std::string &name)
    {
      if (name.size() != 2 || (name[0] != '+' && name[0] != '-') || name[1] < 'x' || name[1] > 'z')
        return {};
      return std::make_pair(static_cast<unsigned int>(name[1] - 'x'), name[0] == '+' ? 1. : -1.);
    }

    /// Without blanks around them.
    std::vector<std::string> split_at(const std::string &text, const std::string &between)
    {
      std::vector<std::string> parts;
      for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + between.size())
        {
          end = text.find(between, begin);
          parts.push_back(Utilities::trim(text.substr(begin, end == std::string::npos ? end : end - begin)));
        }
      return parts;
    }

    /// The boundaries of a surface that are flat and face a direction, within a tenth of a degree.
    std::set<types::boundary_id> boundaries_facing(const std::string &name, const SurfaceMesh &mesh,
                                                   const std::vector<types::boundary_id> &boundary)
    {
      const auto direction = parse_direction(name);
      if (!direction)
        return {};
      std::set<types::boundary_id> result(boundary.begin(), boundary.end());
      for (std::size_t t = 0; t < boundary.size(); ++t)
        {
          const auto &[a, b, c] = mesh.triangles[t];
          const Tensor<1, 3> normal =
              cross_product_3d(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
          if (!(direction->second * normal[direction->first] > (1. - 1e-6) * normal.norm()))
            result.erase(boundary[t]);
        }
      return result;
    }
  } // namespace



  std::set<types::boundary_id> Bodies::boundary_ids(const unsigned int body, const std::string &name,
                                                    const std::string &where) const
  {
    if (has_boundary(body, name))
      return ids_of_one_boundary(body, name, where);
    std::vector<std::string> parts;
    for (const std::string &part : split_at(name, " + "))
      // Without blanks a plus may belong to a name.
      if (const std::vector<std::string> close = split_at(part, "+");
          !has_boundary(body, part) && std::all_of(close.begin(), close.end(), [&](const std::string &one) {
            return has_boundary(body, one);
          }))
        parts.insert(parts.end(), close.begin(), close.end());
      else
        parts.push_back(part);
    std::set<types::boundary_id> ids;
    for (const std::string &part : parts)
      ids.merge(ids_of_one_boundary(body, part, where));
    return ids;
  }



  std::set<types::boundary_id> Bodies::ids_of_one_boundary(const unsigned int body, const std::string &name,
                                                           const std::string &where) const
  {
    for (const auto &[group, members] : groups[body])
      if (group == name)
        {
          std::set<types::boundary_id> ids;
          for (const unsigned int i : members)
            ids.insert(boundary_id(body, i));
          return ids;
        }
    const auto it = std::find(boundaries[body].begin(), boundaries[body].end(), name);
    if (it != boundaries[body].end())
      return {static_cast<types::boundary_id>(first_boundary[body] + (it - boundaries[body].begin()))};
    const StartSurface &start = start_surfaces[body];
    if (const auto facing = boundaries_facing(name, start.mesh, start.boundary); !facing.empty())
      return facing;
    throw InputError((where.empty() ? "Body " : where + ": body ") + names[body] + " has no boundary \"" +
                     name + "\"; it has " + listed(names_to_show(boundaries[body], groups[body])) + "." +
                     (parse_direction(name)
                          ? " Only a boundary that is flat as a whole has such a name: name that face apart."
                          : ""));
  }



  bool Bodies::has_boundary(const unsigned int body, const std::string &name) const
  {
    const auto &known = boundaries[body];
    return std::find(known.begin(), known.end(), name) != known.end() ||
           std::any_of(groups[body].begin(), groups[body].end(),
                       [&](const auto &group) { return group.first == name; });
  }



  unsigned int Bodies::node_set(const unsigned int body, const std::string &name) const
  {
    for (const auto &[set, number] : node_sets[body])
      if (set == name)
        return number;
    return StartNodes::none;
  }



  void Bodies::add_node_sets(const VolumeMesh &mesh)
  {
    first_vertex.push_back(n_vertices_of_all);
    n_vertices_of_all += static_cast<unsigned int>(mesh.vertices.size());
    start->sets_of.resize(n_vertices_of_all);
    if (!mesh.node_numbers.empty())
      {
        node_numbers.resize(first_vertex.back(), VolumeMesh::no_number);
        node_numbers.insert(node_numbers.end(), mesh.node_numbers.begin(), mesh.node_numbers.end());
      }
    node_sets.emplace_back();
    for (const auto &[name, vertices] : mesh.node_sets)
      {
        const unsigned int set = start->n_sets++;
        node_sets.back().emplace_back(name, set);
        for (const unsigned int v : std::set<unsigned int>(vertices.begin(), vertices.end()))
          start->sets_of[first_vertex.back() + v].push_back(set);
      }
  }
} // namespace Signorini
