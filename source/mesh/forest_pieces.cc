// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "forest_pieces.h"

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int bits_per_direction = 20;

    /// The names of the vertices of a cell, in its order.
    std::array<ForestMesh::Name, 4> names_of(const ForestPiece &piece, const ForestPiece::Cell &cell)
    {
      std::array<ForestMesh::Name, 4> names;
      for (unsigned int i = 0; i < 4; ++i)
        names[i] = piece.vertices[cell.tetrahedron.cell.vertices[i]].name;
      return names;
    }

    void sort_cells(ForestPiece &piece)
    {
      std::vector<unsigned int> order(piece.cells.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        const ForestPiece::Cell &x = piece.cells[a], &y = piece.cells[b];
        return x.place != y.place ? x.place < y.place : names_of(piece, x) < names_of(piece, y);
      });
      std::vector<ForestPiece::Cell> sorted;
      sorted.reserve(order.size());
      for (const unsigned int i : order)
        sorted.push_back(piece.cells[i]);
      piece.cells.swap(sorted);
    }

    /// The mean of the corners.
    Point<3> centre(const ForestPiece &piece, const ForestPiece::Cell &cell)
    {
      Point<3> mean;
      for (const unsigned int v : cell.tetrahedron.cell.vertices)
        for (unsigned int d = 0; d < 3; ++d)
          mean[d] += piece.vertices[v].position[d];
      mean *= .25;
      return mean;
    }
  } // namespace



  void place_on_curve(ForestPiece &piece, const MPI_Comm communicator)
  {
    std::vector<Point<3>> centres;
    centres.reserve(piece.cells.size() + 2);
    for (const ForestPiece::Cell &cell : piece.cells)
      centres.push_back(centre(piece, cell));
    // Lower corner of the box, and the upper one negative: one reduction.
    std::vector<double> box(6, std::numeric_limits<double>::max());
    for (const Point<3> &c : centres)
      for (unsigned int d = 0; d < 3; ++d)
        {
          box[d]     = std::min(box[d], c[d]);
          box[3 + d] = std::min(box[3 + d], -c[d]);
        }
    Utilities::MPI::min(box, communicator, box);
    // The curve runs through the box of the points that are given. It is made a cube: in a long body pieces
    // of a curve that is stretched with it would be long, too, with many ghosts.
    const double width = -std::min({box[0] + box[3], box[1] + box[4], box[2] + box[5]});
    centres.emplace_back(box[0], box[1], box[2]);
    // Not less than the largest coordinate by rounding: all ranks need the same box.
    centres.emplace_back(std::max(box[0] + width, -box[3]), std::max(box[1] + width, -box[4]),
                         std::max(box[2] + width, -box[5]));
    const auto keys = Utilities::inverse_Hilbert_space_filling_curve(centres, bits_per_direction);
    for (std::size_t c = 0; c < piece.cells.size(); ++c)
      piece.cells[c].place = Utilities::pack_integers<3>(keys[c], bits_per_direction);
    sort_cells(piece);
  }



  ForestPiece merge_pieces(std::vector<ForestPiece> &&pieces)
  {
    ForestPiece               all;
    std::vector<unsigned int> order;
    for (ForestPiece &piece : pieces)
      {
        const unsigned int shift = static_cast<unsigned int>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), piece.vertices.begin(), piece.vertices.end());
        for (ForestPiece::Cell &cell : piece.cells)
          for (unsigned int &v : cell.tetrahedron.cell.vertices)
            v += shift;
        all.cells.insert(all.cells.end(), piece.cells.begin(), piece.cells.end());
        piece = ForestPiece();
      }
    order.resize(all.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return all.vertices[a].name < all.vertices[b].name;
    });
    std::vector<unsigned int>        number(order.size());
    std::vector<ForestPiece::Vertex> vertices;
    for (const unsigned int v : order)
      {
        if (vertices.empty() || vertices.back().name != all.vertices[v].name)
          vertices.push_back(all.vertices[v]);
        number[v] = static_cast<unsigned int>(vertices.size() - 1);
      }
    vertices.shrink_to_fit();
    all.vertices.swap(vertices);
    for (ForestPiece::Cell &cell : all.cells)
      for (unsigned int &v : cell.tetrahedron.cell.vertices)
        v = number[v];
    sort_cells(all);
    return all;
  }



  std::map<unsigned int, ForestPiece> exchange_pieces(std::map<unsigned int, ForestPiece> &&pieces,
                                                      const MPI_Comm                        communicator)
  {
    ListsByRank<ForestPiece::Cell>   cells;
    ListsByRank<ForestPiece::Vertex> vertices;
    for (auto &[rank, piece] : pieces)
      {
        cells[rank]    = std::move(piece.cells);
        vertices[rank] = std::move(piece.vertices);
      }
    pieces.clear();
    std::map<unsigned int, ForestPiece> result;
    for (auto &[rank, list] : send_lists(cells, communicator))
      result[rank].cells = list;
    for (auto &[rank, list] : send_lists(vertices, communicator))
      result[rank].vertices = list;
    return result;
  }



  namespace
  {
    /// Where the curve is cut: rank r gets the places from cut r to cut r + 1. Before cut r lies the r-th
    /// part of the weight, or a little more. By bisection of the range of the places, all cuts at once.
    std::vector<std::uint64_t> find_cuts(const std::vector<ForestPiece::Cell> &cells,
                                         const std::vector<std::uint64_t>     &weight_before,
                                         const MPI_Comm                        communicator)
    {
      const unsigned int         n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      const std::uint64_t        last    = std::uint64_t(1) << (3 * bits_per_direction);
      const std::uint64_t        total   = Utilities::MPI::sum(weight_before.back(), communicator);
      std::vector<std::uint64_t> low(n_ranks + 1, 0), high(n_ranks + 1, last), before(n_ranks + 1);
      for (unsigned int bit = 0; bit <= 3 * bits_per_direction; ++bit)
        {
          for (unsigned int r = 0; r <= n_ranks; ++r)
            {
              const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
              const auto          it =
                  std::lower_bound(cells.begin(), cells.end(), middle,
                                   [](const auto &cell, const std::uint64_t p) { return cell.place < p; });
              before[r] = weight_before[it - cells.begin()];
            }
          Utilities::MPI::sum(before, communicator, before);
          for (unsigned int r = 0; r <= n_ranks; ++r)
            if (low[r] < high[r])
              {
                const std::uint64_t middle = low[r] + (high[r] - low[r]) / 2;
                if (before[r] >= total * r / n_ranks)
                  high[r] = middle;
                else
                  low[r] = middle + 1;
              }
        }
      low[n_ranks] = last;
      return low;
    }
  } // namespace



  ForestPiece repartition(ForestPiece &&piece, const CellWeight &weight, const MPI_Comm communicator)
  {
    const unsigned int       n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    std::vector<ForestPiece> mine;
    if (n_ranks == 1)
      mine.push_back(std::move(piece));
    else
      {
        std::vector<std::uint64_t> before = {0};
        before.reserve(piece.cells.size() + 1);
        for (const ForestPiece::Cell &cell : piece.cells)
          before.push_back(before.back() + (weight ? weight(cell.tetrahedron.cell) : 1u));
        const auto                          cuts = find_cuts(piece.cells, before, communicator);
        std::map<unsigned int, ForestPiece> parts;
        std::vector<unsigned int>           number(piece.vertices.size(), ForestMesh::none);
        std::vector<std::size_t>            list;
        for (std::size_t c = 0; c < piece.cells.size();)
          {
            const unsigned int rank = static_cast<unsigned int>(
                std::upper_bound(cuts.begin(), cuts.end(), piece.cells[c].place) - cuts.begin() - 1);
            list.clear();
            for (; c < piece.cells.size() && piece.cells[c].place < cuts[rank + 1]; ++c)
              list.push_back(c);
            parts[rank] = extract_cells(piece, list, number);
          }
        piece = ForestPiece();
        for (auto &[rank, part] : exchange_pieces(std::move(parts), communicator))
          mine.push_back(std::move(part));
      }
    return merge_pieces(std::move(mine));
  }
} // namespace Signorini
