// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_forest_pieces_h
#define signorini_mesh_forest_pieces_h

#include <signorini/algebra/sent_lists.h>
#include <signorini/mesh/forest_mesh.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <vector>

namespace Signorini
{
  /// Cells with their vertices as they travel from rank to rank.
  struct ForestPiece
  {
    /// The vertices of the cell count in the list of the piece.
    struct Cell
    {
      /// Place on the curve (key of 60 bits), or number of the cell.
      std::uint64_t     place;
      MarkedTetrahedron tetrahedron;
    };

    struct Vertex
    {
      ForestMesh::Name      name;
      std::array<double, 3> position;
      ForestMesh::Carrier   carrier;
      unsigned int          is_marked;
    };

    std::vector<Cell>   cells;
    std::vector<Vertex> vertices;

    /// Number of bytes.
    std::size_t memory_consumption() const
    {
      return cells.capacity() * sizeof(Cell) + vertices.capacity() * sizeof(Vertex);
    }
  };

  /// Sets the places of all cells on the space-filling curve (Hilbert's, through the box of the centres of
  /// all ranks) and sorts them. Collective.
  void place_on_curve(ForestPiece &piece, const MPI_Comm communicator);

  /// Gives each rank a contiguous part of the curve of equal weight. The order of the cells of all ranks does
  /// not depend on the number of ranks. Collective.
  /// @param piece cells in the order of the curve, any of them
  ForestPiece repartition(ForestPiece &&piece, const CellWeight &weight, const MPI_Comm communicator);

  /// Adds the ghost cells to the cells of this rank and numbers the vertices. Collective.
  ForestMesh complete_mesh(ForestPiece &&owned, const MPI_Comm communicator);

  /// Cells and vertices of all pieces, cells in the order of their places, vertices in that of their names.
  ForestPiece merge_pieces(std::vector<ForestPiece> &&pieces);

  /// Some cells of a piece and their vertices. `number` has an entry for each vertex of the piece, all `none`
  /// before and after.
  template <typename Cells>
  ForestPiece extract_cells(const ForestPiece &piece, const Cells &cells, std::vector<unsigned int> &number)
  {
    ForestPiece part;
    part.cells.reserve(cells.size());
    std::vector<unsigned int> seen;
    for (const std::size_t c : cells)
      {
        part.cells.push_back(piece.cells[c]);
        for (unsigned int &v : part.cells.back().tetrahedron.cell.vertices)
          {
            if (number[v] == ForestMesh::none)
              {
                number[v] = static_cast<unsigned int>(part.vertices.size());
                part.vertices.push_back(piece.vertices[v]);
                seen.push_back(v);
              }
            v = number[v];
          }
      }
    for (const unsigned int v : seen)
      number[v] = ForestMesh::none;
    return part;
  }

  /// Sends pieces to ranks; what arrives, in the order of the ranks. Collective.
  std::map<unsigned int, ForestPiece> exchange_pieces(std::map<unsigned int, ForestPiece> &&pieces,
                                                      const MPI_Comm                        communicator);
} // namespace Signorini

#endif
