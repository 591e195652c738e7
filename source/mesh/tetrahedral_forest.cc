// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "forest_closure.h"

#include <signorini/mesh/tetrahedral_forest.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  TetrahedralForest::TetrahedralForest(const std::vector<Point<3>> &vertices, const std::vector<Cell> &cells,
                                       const MPI_Comm communicator)
    : comm(communicator)
    , vertex_history(vertices.size(), communicator)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    ForestPiece        piece;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      {
        const Point<3>     &x = vertices[v];
        ForestPiece::Vertex vertex{v, {{x[0], x[1], x[2]}}, {}, 0u};
        vertex.carrier.fill(ForestMesh::none);
        vertex.carrier[0] = v;
        piece.vertices.push_back(vertex);
      }
    const std::size_t end = cells.size() * (rank + 1) / n_ranks;
    for (std::size_t c = cells.size() * rank / n_ranks; c < end; ++c)
      piece.cells.push_back({0, {cells[c], mark_longest_edges(cells[c], vertices)}});
    add_mesh(std::move(piece), {});
  }



  void TetrahedralForest::add_mesh(ForestPiece &&piece, const CellWeight &weight)
  {
    place_on_curve(piece, comm);
    ForestPiece mine = repartition(std::move(piece), weight, comm);
    markings.clear();
    markings.reserve(mine.cells.size());
    for (const ForestPiece::Cell &cell : mine.cells)
      markings.push_back(cell.tetrahedron.marking);
    meshes.push_back(std::make_unique<ForestMesh>(complete_mesh(std::move(mine), comm)));
  }



  bool TetrahedralForest::refine(const std::vector<bool> &marked, const CellWeight &weight)
  {
    const ForestMesh &last = *meshes.back();
    AssertDimension(marked.size(), last.n_owned);
    const bool any = std::find(marked.begin(), marked.end(), true) != marked.end();
    if (Utilities::MPI::max(any ? 1 : 0, comm) == 0)
      return false;
    std::vector<ForestClosure::Item> work;
    work.reserve(marked.size());
    for (std::size_t c = 0; c < marked.size(); ++c)
      work.push_back({{last.cells[last.first_owned + c], markings[c]}, marked[c] ? 3u : 0u});
    ForestPiece piece;
    {
      ForestClosure closure(last, comm);
      closure.run(work);
      const auto first_name = closure.name_vertices(work, vertex_history.n_vertices(n_levels() - 1));
      vertex_history.add_level(first_name, closure.parents);
      piece.vertices = std::move(closure.vertices);
    }
    piece.cells.reserve(work.size());
    for (const ForestClosure::Item &item : work)
      piece.cells.push_back({0, item.tetrahedron});
    work = {};
    add_mesh(std::move(piece), weight);
    return true;
  }



  std::size_t TetrahedralForest::memory_consumption() const
  {
    std::size_t bytes = vertex_history.memory_consumption() + markings.capacity() * sizeof(markings[0]);
    for (const auto &mesh : meshes)
      bytes += mesh->memory_consumption();
    return bytes;
  }
} // namespace Signorini
