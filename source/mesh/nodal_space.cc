// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>

#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The hanging vertex in the middle of an edge of a cell, or invalid_node.
    NodeIndex hanging_vertex(const DoFHandler<3>::active_cell_iterator &cell, const unsigned int line)
    {
      if (!cell->line(line)->has_children())
        return invalid_node;
      return cell->line(line)->child(0)->vertex_dof_index(1, 0, 0);
    }

    /// The line of a hexahedron between two of its vertices.
    unsigned int line_between(const unsigned int a, const unsigned int b)
    {
      for (unsigned int l = 0; l < GeometryInfo<3>::lines_per_cell; ++l)
        {
          const unsigned int v0 = GeometryInfo<3>::line_to_cell_vertices(l, 0);
          const unsigned int v1 = GeometryInfo<3>::line_to_cell_vertices(l, 1);
          if ((v0 == a && v1 == b) || (v0 == b && v1 == a))
            return l;
        }
      Assert(false, ExcInternalError());
      return 0;
    }
  } // namespace



  /// The nodes of the hexahedra as deal.II numbers them.
  struct NodalSpace::Hexahedra
  {
    explicit Hexahedra(const parallel::distributed::Triangulation<3> &mesh)
      : fe(1)
      , dofs(mesh)
    {
      dofs.distribute_dofs(fe);
      DoFTools::extract_locally_relevant_dofs(dofs, relevant);
      constraints.reinit(relevant);
      DoFTools::make_hanging_node_constraints(dofs, constraints);
      constraints.close();
    }

    const FE_Q<3>             fe;
    DoFHandler<3>             dofs;
    IndexSet                  relevant;
    AffineConstraints<double> constraints;
  };



  /// From the numbers of each kind to those of both: on every rank the nodes of hexahedra come first.
  struct NodalSpace::Numbering
  {
    explicit Numbering(const unsigned int n_ranks)
      : hexahedral_begin(n_ranks + 1, 0)
      , tetrahedral_begin(n_ranks + 1, 0)
    {
    }

    static std::size_t rank_of(const std::vector<NodeIndex> &begin, const NodeIndex n)
    {
      return std::upper_bound(begin.begin(), begin.end(), n) - begin.begin() - 1;
    }

    NodeIndex of_hexahedra(const NodeIndex n) const
    {
      return tetrahedral_begin.back() == 0 ? n : n + tetrahedral_begin[rank_of(hexahedral_begin, n)];
    }

    NodeIndex of_tetrahedra(const NodeIndex n) const
    {
      return hexahedral_begin.back() == 0 ? n : n + hexahedral_begin[rank_of(tetrahedral_begin, n) + 1];
    }

    /// Appends the hanging nodes and their parents.
    void add_constrained(std::vector<NodeIndex> &nodes, const Hexahedra &part) const
    {
      for (const auto &line : part.constraints.get_lines())
        {
          nodes.push_back(of_hexahedra(line.index));
          for (const auto &entry : line.entries)
            nodes.push_back(of_hexahedra(entry.first));
        }
    }

    void copy_constraints(AffineConstraints<double> &constraints, const Hexahedra &part) const
    {
      for (const auto &line : part.constraints.get_lines())
        {
          const NodeIndex node = of_hexahedra(line.index);
          constraints.add_line(node);
          for (const auto &[parent, weight] : line.entries)
            constraints.add_entry(node, of_hexahedra(parent), weight);
        }
    }

    std::vector<NodeIndex> hexahedral_begin, tetrahedral_begin;
  };



  NodalSpace::NodalSpace(const MPI_Comm communicator, const MeshView &mesh, const bool with_inner_faces)
    : comm(communicator)
    , with_inner_faces(with_inner_faces)
  {
    const unsigned int               rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int               n_ranks = Utilities::MPI::n_mpi_processes(comm);
    std::unique_ptr<const Hexahedra> hexahedra;
    if (mesh.hexahedra != nullptr)
      hexahedra = std::make_unique<Hexahedra>(*mesh.hexahedra);

    Numbering numbering(n_ranks);
    if (hexahedra)
      {
        const auto counts = gather_values(hexahedra->dofs.n_locally_owned_dofs(), comm);
        std::partial_sum(counts.begin(), counts.end(), numbering.hexahedral_begin.begin() + 1);
        n_cells_of_all += mesh.hexahedra->n_global_active_cells();
      }
    if (mesh.tetrahedra != nullptr)
      {
        const ForestMesh &part = mesh.tetrahedra->mesh(mesh.tetrahedral_level);
        std::copy(part.first_vertex.begin(), part.first_vertex.end(), numbering.tetrahedral_begin.begin());
        n_cells_of_all += part.n_global_cells();
        forest_level = mesh.tetrahedral_level;
      }
    const NodeIndex begin = numbering.hexahedral_begin[rank] + numbering.tetrahedral_begin[rank];
    const NodeIndex end   = numbering.hexahedral_begin[rank + 1] + numbering.tetrahedral_begin[rank + 1];
    owned_nodes.set_size(numbering.hexahedral_begin[n_ranks] + numbering.tetrahedral_begin[n_ranks]);
    owned_nodes.add_range(begin, end);

    std::vector<Point<3>> corner_points;
    if (hexahedra)
      add_hexahedra(corner_points, mesh, *hexahedra, numbering);
    if (mesh.tetrahedra != nullptr)
      add_tetrahedra(corner_points, mesh, numbering);
    std::vector<NodeIndex> relevant;
    for (const NodeIndex node : cell_nodes)
      if (node < begin || node >= end)
        relevant.push_back(node);
    if (hexahedra)
      numbering.add_constrained(relevant, *hexahedra);
    std::sort(relevant.begin(), relevant.end());
    relevant.erase(std::unique(relevant.begin(), relevant.end()), relevant.end());
    relevant_nodes = owned_nodes;
    relevant_nodes.add_indices(relevant.begin(), relevant.end());
    relevant_nodes.compress();
    constraints.reinit(relevant_nodes);
    if (hexahedra)
      numbering.copy_constraints(constraints, *hexahedra);
    constraints.close();
    set_positions(corner_points);
    if (mesh.start != nullptr)
      find_start_nodes(mesh);
    node_of_vertex = {};

    NodeIndex hanging = 0;
    for (const auto &line : constraints.get_lines())
      hanging += owned_nodes.is_element(line.index);
    n_conforming = n_nodes() - Utilities::MPI::sum(hanging, comm);
  }



  void NodalSpace::add_hexahedra(std::vector<Point<3>> &corner_points, const MeshView &mesh,
                                 const Hexahedra &part, const Numbering &numbering)
  {
    using Iterator = DoFHandler<3>::active_cell_iterator;
    std::vector<unsigned int> number(mesh.hexahedra->n_active_cells(), numbers::invalid_unsigned_int);
    std::vector<Iterator>     seen;
    for (const auto &cell : part.dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          number[cell->active_cell_index()] = static_cast<unsigned int>(cell_list.size());
          const CellId id                   = cell->id();
          Cell         data{id.get_coarse_cell_id(),
                    1,
                    static_cast<unsigned int>(cell_nodes.size()),
                    8,
                    cell->is_locally_owned(),
                    static_cast<unsigned char>(cell->level()),
                    cell->material_id()};
          for (const std::uint8_t child : id.get_child_indices())
            data.path = data.path << 3 | child;
          cell_list.push_back(data);
          seen.push_back(cell);
          for (unsigned int v = 0; v < 8; ++v)
            {
              cell_nodes.push_back(numbering.of_hexahedra(cell->vertex_dof_index(v, 0)));
              corner_points.push_back(cell->vertex(v));
            }
        }

    for (unsigned int c = 0; c < seen.size(); ++c)
      for (const unsigned int f : seen[c]->face_indices())
        if (const Iterator &cell = seen[c]; cell->face(f)->at_boundary())
          {
            BoundaryFace data{c, static_cast<unsigned char>(f), cell->face(f)->boundary_id(), {}};
            data.hanging.fill(invalid_node);
            const auto corners = CellShape::face(8, f);
            for (unsigned int v = 0; v < 4 && cell_list[c].is_owned; ++v)
              if (const NodeIndex node = hanging_vertex(cell, line_between(corners[v], corners[(v + 1) % 4]));
                  node != invalid_node)
                data.hanging[v] = numbering.of_hexahedra(node);
            boundary.push_back(data);
          }
        else if (const auto neighbor = cell->neighbor(f); with_inner_faces && neighbor->is_active())
          {
            // Smaller cells see their larger neighbours; of equal ones that with the smaller number counts.
            const unsigned int other = number[neighbor->active_cell_index()];
            if (other != numbers::invalid_unsigned_int && (neighbor->level() < cell->level() || c < other) &&
                (cell_list[c].is_owned || cell_list[other].is_owned))
              inner.push_back({c, other, static_cast<unsigned char>(f)});
          }
  }



  void NodalSpace::add_tetrahedra(std::vector<Point<3>> &corner_points, const MeshView &mesh,
                                  const Numbering &numbering)
  {
    const unsigned int  rank       = Utilities::MPI::this_mpi_process(comm);
    const unsigned int  first_cell = static_cast<unsigned int>(cell_list.size());
    const ForestMesh   &part       = mesh.tetrahedra->mesh(mesh.tetrahedral_level);
    const std::uint64_t first_name = mesh.hexahedra != nullptr ? mesh.hexahedra->n_global_coarse_cells() : 0;
    node_of_vertex.reserve(part.vertices.size());
    owned_vertices.resize(part.first_vertex[rank + 1] - part.first_vertex[rank]);
    for (unsigned int v = 0; v < part.vertices.size(); ++v)
      {
        node_of_vertex.push_back(numbering.of_tetrahedra(static_cast<NodeIndex>(part.vertex_numbers[v])));
        if (part.owns_vertex(rank, v))
          owned_vertices[part.vertex_numbers[v] - part.first_vertex[rank]] = part.vertices[v];
      }
    for (std::size_t c = 0; c < part.cells.size(); ++c)
      {
        const Tetrahedron &cell = part.cells[c];
        cell_list.push_back({first_name + part.cell_numbers[c], 1,
                             static_cast<unsigned int>(cell_nodes.size()), 4, part.is_owned(c),
                             static_cast<unsigned char>(cell.generation / 3), cell.material});
        for (const unsigned int v : cell.vertices)
          {
            cell_nodes.push_back(node_of_vertex[v]);
            corner_points.push_back(part.points[v]);
          }
        for (unsigned char f = 0; f < 4; ++f)
          if (cell.boundary[f] != Tetrahedron::inner)
            {
              boundary.push_back({static_cast<unsigned int>(first_cell + c), f, cell.boundary[f], {}});
              boundary.back().hanging.fill(invalid_node);
            }
      }
    if (with_inner_faces)
      add_inner_faces(part, first_cell);
  }



  void NodalSpace::add_inner_faces(const ForestMesh &mesh, const unsigned int first_cell)
  {
    // By nodes: their order does not depend on the number of ranks.
    std::vector<std::pair<std::array<NodeIndex, 3>, std::pair<unsigned int, unsigned char>>> faces;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned char f = 0; f < 4; ++f)
        if (mesh.cells[c].boundary[f] == Tetrahedron::inner)
          {
            std::array<NodeIndex, 3> key;
            for (unsigned int i = 0; i < 3; ++i)
              key[i] = node_of_vertex[mesh.cells[c].vertices[CellShape::face(4, f)[i]]];
            std::sort(key.begin(), key.end());
            faces.push_back({key, {first_cell + c, f}});
          }
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 0; i + 1 < faces.size(); ++i)
      if (faces[i].first == faces[i + 1].first)
        {
          const auto [cell, face]  = faces[i].second;
          const unsigned int other = faces[i + 1].second.first;
          if (cell_list[cell].is_owned || cell_list[other].is_owned)
            inner.push_back({cell, other, face});
        }
  }



  void NodalSpace::set_positions(const std::vector<Point<3>> &corner_points)
  {
    positions.resize(relevant_nodes.n_elements());
    for (std::size_t k = 0; k < cell_nodes.size(); ++k)
      positions[relevant_nodes.index_within_set(cell_nodes[k])] = corner_points[k];
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        const NodePartition partition(owned_nodes, relevant_nodes, comm);
        Vector              field;
        partition.reinit(field);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            field.local_element(dim * i + c) = position(partition.to_global(i))[c];
        field.update_ghost_values();
        for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            positions[relevant_nodes.index_within_set(partition.to_global(i))][c] =
                field.local_element(dim * i + c);
      }
    // The constraints are closed: parents are conforming nodes.
    for (const auto &line : constraints.get_lines())
      {
        Point<3> mean;
        for (const auto &[parent, weight] : line.entries)
          mean += weight * position(parent);
        positions[relevant_nodes.index_within_set(line.index)] = mean;
      }
  }
} // namespace Signorini
