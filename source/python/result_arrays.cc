// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "result_arrays.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/mesh/surface_piece.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// A cell as it travels.
    struct CellItem
    {
      unsigned int body, n_vertices;
      NodeIndex    nodes[CellShape::max_vertices];
    };

    std::vector<CellItem> gather_cells(const ContactModel &model, const NodalSpace &space)
    {
      // deal.II numbers the upper and lower four line by line, VTK goes round.
      static constexpr unsigned int vtk[CellShape::hexahedron] = {0, 1, 3, 2, 4, 5, 7, 6};
      std::vector<CellItem>         cells;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          {
            CellItem   item{model.bodies().body_of_material(cell.material), cell.n_vertices, {}};
            const auto nodes = space.nodes(cell);
            for (unsigned int v = 0; v < cell.n_vertices; ++v)
              item.nodes[v] = nodes[cell.n_vertices == CellShape::hexahedron ? vtk[v] : v];
            cells.push_back(item);
          }
      return gather_lists(std::move(cells), space.communicator(), Receivers::all);
    }

    /// Values of the owned nodes of all ranks, by number of node.
    std::vector<double> gather_values(const NodalSpace &space, const OutputField &field)
    {
      std::vector<double> mine;
      for (const NodeIndex node : space.owned())
        {
          const std::size_t i = space.relevant().index_within_set(node);
          mine.insert(mine.end(), field.values.begin() + i * field.n_components,
                      field.values.begin() + (i + 1) * field.n_components);
        }
      return gather_lists(std::move(mine), space.communicator(), Receivers::all);
    }
  } // namespace



  MeshArrays::MeshArrays(const ContactModel &model, const Discretization &d)
    : nodes(model.bodies().n_bodies())
    , hexahedra(nodes.size())
    , tetrahedra(nodes.size())
  {
    for (unsigned int b = 0; b < nodes.size(); ++b)
      names.push_back(model.bodies().body_name(b));
    const NodalSpace &space = d.nodal();
    for (const NodeIndex node : space.owned())
      positions.push_back(space.position(node));
    positions = gather_lists(std::move(positions), space.communicator(), Receivers::all);

    // Bodies share no nodes.
    const std::vector<CellItem> cells = gather_cells(model, space);
    std::vector<unsigned int>   body(positions.size(), numbers::invalid_unsigned_int);
    for (const CellItem &cell : cells)
      for (unsigned int v = 0; v < cell.n_vertices; ++v)
        body[cell.nodes[v]] = cell.body;
    std::vector<std::int64_t> number(positions.size(), -1);
    for (std::size_t node = 0; node < positions.size(); ++node)
      if (body[node] != numbers::invalid_unsigned_int)
        {
          number[node] = static_cast<std::int64_t>(nodes[body[node]].size());
          nodes[body[node]].push_back(node);
        }
    for (const CellItem &cell : cells)
      for (unsigned int v = 0; v < cell.n_vertices; ++v)
        (cell.n_vertices == CellShape::hexahedron ? hexahedra : tetrahedra)[cell.body].push_back(
            number[cell.nodes[v]]);
  }



  std::vector<FieldArrays> MeshArrays::body_values(const ContactModel &model, const Discretization &d,
                                                   const ContactSolution &solution) const
  {
    std::vector<FieldArrays> result(nodes.size());
    for (const OutputField &field : body_fields(model, d, solution, true))
      {
        const std::vector<double> all = gather_values(d.nodal(), field);
        const unsigned int        n   = field.n_components;
        for (unsigned int b = 0; b < nodes.size(); ++b)
          {
            OutputField part{field.name, n, {}};
            part.values.reserve(n * nodes[b].size());
            for (const std::size_t node : nodes[b])
              part.values.insert(part.values.end(), all.begin() + n * node, all.begin() + n * (node + 1));
            result[b].push_back(std::move(part));
          }
      }
    return result;
  }



  std::vector<BodyArrays> MeshArrays::bodies(const ContactModel &model, const Discretization &d,
                                             const ContactSolution &solution) const
  {
    std::vector<FieldArrays> values = body_values(model, d, solution);
    std::vector<BodyArrays>  result(nodes.size());
    for (unsigned int b = 0; b < nodes.size(); ++b)
      {
        result[b] = {names[b], {}, hexahedra[b], tetrahedra[b], std::move(values[b])};
        for (const std::size_t node : nodes[b])
          for (unsigned int c = 0; c < dim; ++c)
            result[b].nodes.push_back(positions[node][c]);
      }
    return result;
  }



  namespace
  {
    /// Vertices of the faces on which this rank works, or the parents of those that hang.
    std::vector<unsigned int> vertices_to_send(const ContactSurface &surface, const unsigned int rank,
                                               const bool parents)
    {
      const std::vector<bool> is_corner = vertices_of_worker(surface, rank);
      std::vector<bool>       is_parent(is_corner.size(), false);
      for (std::size_t v = 0; v < is_corner.size(); ++v)
        if (is_corner[v])
          for (const auto &parent : surface.hanging[v])
            is_parent[parent.first] = true;
      return Renumbering(parents ? is_parent : is_corner).kept();
    }

    /// Copies what all ranks have at some vertices to values by vertex of the whole surface.
    void gather_at(std::vector<double> &all, const OutputField &field, const ContactSurface &surface,
                   const std::vector<unsigned int> &vertices, const MPI_Comm communicator)
    {
      const unsigned int        n = field.n_components;
      std::vector<double>       mine;
      std::vector<unsigned int> numbers;
      for (const unsigned int v : vertices)
        {
          mine.insert(mine.end(), field.values.begin() + n * v, field.values.begin() + n * (v + 1));
          numbers.push_back(surface.number_of_vertex(v));
        }
      numbers = gather_lists(std::move(numbers), communicator, Receivers::all);
      mine    = gather_lists(std::move(mine), communicator, Receivers::all);
      for (std::size_t i = 0; i < numbers.size(); ++i)
        std::copy_n(mine.begin() + n * i, n, all.begin() + n * numbers[i]);
    }

    /// From values by vertex of the piece of this rank to those of the whole surface: what each rank has at
    /// the corners of the faces on which it works; elsewhere what it has at the parents of these.
    void gather_from_pieces(FieldArrays &fields, const ContactSurface &surface, const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return;
      const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
      for (OutputField &field : fields)
        {
          std::vector<double> all(field.n_components * surface.n_vertices_of_whole(), 0.);
          for (const bool parents : {true, false})
            gather_at(all, field, surface, vertices_to_send(surface, rank, parents), communicator);
          field.values = std::move(all);
        }
    }

    SurfaceArrays surface_arrays(const ContactSide &side, const MPI_Comm communicator)
    {
      const ContactSurface surface = join_pieces(side.surface, communicator, Receivers::all);
      SurfaceArrays        result;
      result.name = side.name;
      for (const Point<3> &vertex : surface.mesh.vertices)
        for (unsigned int c = 0; c < dim; ++c)
          result.vertices.push_back(vertex[c]);
      for (const ContactSurface::Face &face : surface.faces)
        result.faces.insert(result.faces.end(), face.corners.begin(), face.corners.end());
      for (const auto &triangle : surface.mesh.triangles)
        result.triangles.insert(result.triangles.end(), triangle.begin(), triangle.end());
      return result;
    }
  } // namespace



  FieldArrays pair_values(const Discretization &d, const ContactSolution &solution, const unsigned int p,
                          const bool of_mortar)
  {
    const ContactPair &pair = d.pairs[p];
    if (of_mortar && pair.obstacle)
      return {};
    FieldArrays fields = of_mortar ? mortar_fields(d, solution, p) : nonmortar_fields(d, solution, p);
    if (!of_mortar)
      fields.push_back({"area", 1, spread_rows(d.couplings[p], *pair.halo, d.couplings[p].areas)});
    gather_from_pieces(fields, of_mortar ? pair.mortar.surface : pair.nonmortar.surface,
                       d.nodal().communicator());
    return fields;
  }



  std::vector<PairArrays> pair_arrays(const Discretization &d, const ContactSolution &solution)
  {
    std::vector<PairArrays> result;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair &pair = d.pairs[p];
        const MPI_Comm     comm = d.nodal().communicator();
        result.push_back({pair.name, surface_arrays(pair.nonmortar, comm), {}});
        result.back().nonmortar.fields = pair_values(d, solution, p, false);
        if (pair.obstacle)
          continue;
        result.back().mortar        = surface_arrays(pair.mortar, comm);
        result.back().mortar.fields = pair_values(d, solution, p, true);
      }
    return result;
  }
} // namespace Signorini
