// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// What other ranks have to tell about a mesh whose cells have their owners: ghost cells, numbers of vertices.

#include "forest_pieces.h"

#include <signorini/algebra/collectives.h>
#include <signorini/mesh/cell_shape.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  using Name = ForestMesh::Name;

  unsigned int ForestMesh::owner(const std::size_t c) const
  {
    return static_cast<unsigned int>(std::upper_bound(first_cell.begin(), first_cell.end(), cell_numbers[c]) -
                                     first_cell.begin() - 1);
  }



  unsigned int ForestMesh::find(const Name vertex) const
  {
    const auto it = std::lower_bound(vertices.begin(), vertices.end(), vertex);
    return it == vertices.end() || *it != vertex ? none : static_cast<unsigned int>(it - vertices.begin());
  }



  std::size_t ForestMesh::memory_consumption() const
  {
    const auto bytes = [](const auto &list) { return list.capacity() * sizeof(list[0]); };
    return bytes(cells) + bytes(cell_numbers) + bytes(first_cell) + bytes(vertices) + bytes(points) +
           bytes(carriers) + is_marked.capacity() / 8 + bytes(vertex_numbers) + bytes(first_vertex);
  }



  namespace
  {
    std::vector<std::uint64_t> partial_sums(const std::uint64_t mine, const MPI_Comm communicator)
    {
      std::vector<std::uint64_t> first = {0};
      for (const std::uint64_t n : gather_values(mine, communicator))
        first.push_back(first.back() + n);
      return first;
    }

    void make_unique(std::vector<unsigned int> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    /// Vertices that may have cells of other ranks: those of faces that only one cell of this rank has.
    /// Around any other vertex the cells of this rank close up.
    std::vector<unsigned int> border_vertices(const ForestPiece &piece)
    {
      std::vector<std::array<unsigned int, 3>> faces;
      faces.reserve(4 * piece.cells.size());
      for (const ForestPiece::Cell &cell : piece.cells)
        for (unsigned int f = 0; f < 4; ++f)
          {
            std::array<unsigned int, 3> face;
            for (unsigned int i = 0; i < 3; ++i)
              face[i] = cell.tetrahedron.cell.vertices[CellShape::face(4, f)[i]];
            std::sort(face.begin(), face.end());
            faces.push_back(face);
          }
      std::sort(faces.begin(), faces.end());
      std::vector<unsigned int> result;
      for (std::size_t i = 0, j; i < faces.size(); i = j)
        {
          for (j = i + 1; j < faces.size() && faces[j] == faces[i];)
            ++j;
          if (j == i + 1)
            result.insert(result.end(), faces[i].begin(), faces[i].end());
        }
      make_unique(result);
      return result;
    }

    /// By vertex of the piece the other ranks that have cells at it: a directory knows, in which rank
    /// (name modulo number of ranks) keeps the entry of a vertex.
    std::vector<std::vector<unsigned int>> other_ranks(const ForestPiece &piece, const MPI_Comm communicator)
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      ListsByRank<Name>  told;
      for (const unsigned int v : border_vertices(piece))
        told[piece.vertices[v].name % n_ranks].push_back(piece.vertices[v].name);
      std::vector<std::pair<Name, unsigned int>> entries;
      for (const auto &[rank, names] : send_lists(told, communicator))
        for (const Name name : names)
          entries.emplace_back(name, rank);
      std::sort(entries.begin(), entries.end());
      ListsByRank<std::array<std::uint64_t, 2>> answers;
      for (std::size_t i = 0, j; i < entries.size(); i = j)
        {
          for (j = i; j < entries.size() && entries[j].first == entries[i].first;)
            ++j;
          for (std::size_t a = i; a < j; ++a)
            for (std::size_t b = i; b < j; ++b)
              if (a != b)
                answers[entries[a].second].push_back({{entries[b].first, entries[b].second}});
        }
      std::vector<std::vector<unsigned int>> ranks(piece.vertices.size());
      for (const auto &answer : send_lists(answers, communicator))
        for (const auto &[name, rank] : answer.second)
          {
            const auto it = std::lower_bound(piece.vertices.begin(), piece.vertices.end(), name,
                                             [](const auto &v, const Name n) { return v.name < n; });
            ranks[it - piece.vertices.begin()].push_back(static_cast<unsigned int>(rank));
          }
      return ranks;
    }

    /// By rank the cells of this one that it sees as ghosts: those at vertices where it has cells.
    std::map<unsigned int, std::vector<std::size_t>> cells_seen_elsewhere(const ForestPiece &piece,
                                                                          const MPI_Comm     communicator)
    {
      const auto                ranks = other_ranks(piece, communicator);
      ListsByRank<std::size_t>  result;
      std::vector<unsigned int> list;
      for (std::size_t c = 0; c < piece.cells.size(); ++c)
        {
          list.clear();
          for (const unsigned int v : piece.cells[c].tetrahedron.cell.vertices)
            list.insert(list.end(), ranks[v].begin(), ranks[v].end());
          make_unique(list);
          for (const unsigned int rank : list)
            result[rank].push_back(c);
        }
      return result;
    }

    ForestMesh unpack(const ForestPiece &piece)
    {
      ForestMesh mesh;
      mesh.cells.reserve(piece.cells.size());
      mesh.cell_numbers.reserve(piece.cells.size());
      for (const ForestPiece::Cell &cell : piece.cells)
        {
          mesh.cells.push_back(cell.tetrahedron.cell);
          mesh.cell_numbers.push_back(cell.place);
        }
      const std::size_t n = piece.vertices.size();
      mesh.vertices.reserve(n);
      mesh.points.reserve(n);
      mesh.carriers.reserve(n);
      mesh.is_marked.reserve(n);
      for (const ForestPiece::Vertex &v : piece.vertices)
        {
          mesh.vertices.push_back(v.name);
          mesh.points.emplace_back(v.position[0], v.position[1], v.position[2]);
          mesh.carriers.push_back(v.carrier);
          mesh.is_marked.push_back(v.is_marked != 0);
        }
      return mesh;
    }

    using Numbers = std::map<unsigned int, std::vector<std::array<std::uint64_t, 2>>>;

    /// Tells other ranks the numbers of vertices that they see.
    void send_numbers(ForestMesh &mesh, std::map<unsigned int, std::vector<unsigned int>> &&vertices,
                      const MPI_Comm communicator)
    {
      Numbers numbers;
      for (auto &[rank, list] : vertices)
        {
          make_unique(list);
          for (const unsigned int v : list)
            numbers[rank].push_back({{mesh.vertices[v], mesh.vertex_numbers[v]}});
        }
      for (const auto &entry : send_lists(numbers, communicator))
        for (const auto &[name, number] : entry.second)
          mesh.vertex_numbers[mesh.find(name)] = number;
    }

    /// Numbers of the vertices in the order of the cells, each on the first rank that has one of its cells.
    /// @param sent by rank the cells (counted among the own ones) that it sees as ghosts
    void number_vertices(ForestMesh &mesh, const std::map<unsigned int, std::vector<std::size_t>> &sent,
                         const MPI_Comm communicator)
    {
      const unsigned int        rank = Utilities::MPI::this_mpi_process(communicator);
      constexpr std::uint64_t   unknown(-1);
      std::vector<unsigned int> first_rank(mesh.vertices.size(), ForestMesh::none);
      mesh.vertex_numbers.assign(mesh.vertices.size(), unknown);
      std::uint64_t n = 0;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          const unsigned int owner = mesh.owner(c);
          for (const unsigned int v : mesh.cells[c].vertices)
            {
              if (first_rank[v] == ForestMesh::none)
                first_rank[v] = owner;
              if (owner == rank && first_rank[v] == rank && mesh.vertex_numbers[v] == unknown)
                mesh.vertex_numbers[v] = n++;
            }
        }
      mesh.first_vertex = partial_sums(n, communicator);
      for (std::uint64_t &number : mesh.vertex_numbers)
        if (number != unknown)
          number += mesh.first_vertex[rank];
      if (mesh.first_vertex.size() == 2)
        return;
      // The owner of a vertex knows all of its cells; then every rank knows the vertices of its own cells.
      ListsByRank<unsigned int> told;
      for (std::size_t c = mesh.first_owned + mesh.n_owned; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          if (first_rank[v] == rank)
            told[mesh.owner(c)].push_back(v);
      send_numbers(mesh, std::move(told), communicator);
      told.clear();
      for (const auto &[other, cells] : sent)
        for (const std::size_t c : cells)
          for (const unsigned int v : mesh.cells[mesh.first_owned + c].vertices)
            told[other].push_back(v);
      send_numbers(mesh, std::move(told), communicator);
    }
  } // namespace



  ForestMesh complete_mesh(ForestPiece &&owned, const MPI_Comm communicator)
  {
    const unsigned int rank       = Utilities::MPI::this_mpi_process(communicator);
    const auto         first_cell = partial_sums(owned.cells.size(), communicator);
    const std::size_t  n_owned    = owned.cells.size();
    for (std::size_t c = 0; c < n_owned; ++c)
      owned.cells[c].place = first_cell[rank] + c;
    ListsByRank<std::size_t> sent;
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        sent = cells_seen_elsewhere(owned, communicator);
        std::map<unsigned int, ForestPiece> parts;
        std::vector<unsigned int>           number(owned.vertices.size(), ForestMesh::none);
        for (const auto &[other, cells] : sent)
          parts[other] = extract_cells(owned, cells, number);
        std::vector<ForestPiece> all;
        all.push_back(std::move(owned));
        for (auto &[other, part] : exchange_pieces(std::move(parts), communicator))
          all.push_back(std::move(part));
        owned = merge_pieces(std::move(all));
      }
    ForestMesh mesh = unpack(owned);
    owned           = ForestPiece();
    mesh.first_cell = first_cell;
    mesh.n_owned    = n_owned;
    mesh.first_owned =
        std::lower_bound(mesh.cell_numbers.begin(), mesh.cell_numbers.end(), first_cell[rank]) -
        mesh.cell_numbers.begin();
    number_vertices(mesh, sent, communicator);
    return mesh;
  }
} // namespace Signorini
