// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "result_arrays.h"

#include <signorini/algebra/gathered_lists.h>

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
    /// Replaces the values by those that each rank has at the corners of the faces on which it works.
    void gather_at_corners(FieldArrays &fields, const ContactSurface &surface, const MPI_Comm communicator)
    {
      const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return;
      std::set<unsigned int> corners;
      for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
        if (surface.faces[surface.triangle_face[t]].worker == rank)
          corners.insert(surface.mesh.triangles[t].begin(), surface.mesh.triangles[t].end());
      const std::vector<unsigned int> all = gather_lists(
          std::vector<unsigned int>(corners.begin(), corners.end()), communicator, Receivers::all);
      for (OutputField &field : fields)
        {
          const unsigned int  n = field.n_components;
          std::vector<double> mine;
          for (const unsigned int vertex : corners)
            mine.insert(mine.end(), field.values.begin() + n * vertex,
                        field.values.begin() + n * (vertex + 1));
          const std::vector<double> values = gather_lists(std::move(mine), communicator, Receivers::all);
          for (std::size_t i = 0; i < all.size(); ++i)
            std::copy_n(values.begin() + n * i, n, field.values.begin() + n * all[i]);
        }
    }

    SurfaceArrays surface_arrays(const ContactSide &side)
    {
      SurfaceArrays result;
      result.name = side.name;
      for (const Point<3> &vertex : side.surface.mesh.vertices)
        for (unsigned int c = 0; c < dim; ++c)
          result.vertices.push_back(vertex[c]);
      for (const ContactSurface::Face &face : side.surface.faces)
        result.faces.insert(result.faces.end(), face.corners.begin(), face.corners.end());
      for (const auto &triangle : side.surface.mesh.triangles)
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
    gather_at_corners(fields, of_mortar ? pair.mortar.surface : pair.nonmortar.surface,
                      d.nodal().communicator());
    return fields;
  }



  std::vector<PairArrays> pair_arrays(const Discretization &d, const ContactSolution &solution)
  {
    std::vector<PairArrays> result;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair &pair = d.pairs[p];
        result.push_back({pair.name, surface_arrays(pair.nonmortar), {}});
        result.back().nonmortar.fields = pair_values(d, solution, p, false);
        if (pair.obstacle)
          continue;
        result.back().mortar        = surface_arrays(pair.mortar);
        result.back().mortar.fields = pair_values(d, solution, p, true);
      }
    return result;
  }
} // namespace Signorini
