// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "late_vertices.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/sent_lists.h>
#include <signorini/mesh/forest_vertices.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  ForestVertices::ForestVertices(const ForestMesh &mesh, const MPI_Comm communicator)
    : mesh(mesh)
    , comm(communicator)
    , rank(Utilities::MPI::this_mpi_process(communicator))
  {
    ListsByRank<Name> asked;
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      if (!owns(v))
        {
          const auto &first = mesh.first_vertex;
          const auto  owner = static_cast<unsigned int>(
              std::upper_bound(first.begin(), first.end(), mesh.vertex_numbers[v]) - first.begin() - 1);
          asked[owner].push_back(mesh.vertices[v]);
          received[owner].push_back(v);
        }
    for (const auto &[other, names] : send_lists(asked, comm))
      for (const Name name : names)
        sent[other].push_back(mesh.find(name));
  }



  void ForestVertices::update(std::vector<double> &values) const
  {
    if (mesh.vertices.empty() || (sent.empty() && received.empty()))
      return;
    constexpr int                               tag = 3107;
    const std::size_t                           n   = values.size() / mesh.vertices.size();
    std::map<unsigned int, std::vector<double>> out, in;
    std::vector<MPI_Request>                    requests;
    const auto start = [&](const auto &send, const unsigned int other, std::vector<double> &buffer) {
      requests.emplace_back();
      send(buffer.data(), static_cast<int>(buffer.size()), MPI_DOUBLE, static_cast<int>(other), tag, comm,
           &requests.back());
    };
    for (const auto &[other, list] : received)
      {
        in[other].resize(n * list.size());
        start(MPI_Irecv, other, in[other]);
      }
    for (const auto &[other, list] : sent)
      {
        for (const unsigned int v : list)
          out[other].insert(out[other].end(), values.begin() + n * v, values.begin() + n * (v + 1));
        start(MPI_Isend, other, out[other]);
      }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (const auto &[other, list] : received)
      for (std::size_t i = 0; i < list.size(); ++i)
        std::copy_n(in[other].begin() + n * i, n, values.begin() + n * list[i]);
  }



  double ForestVertices::minimum(const double value) const
  {
    return Utilities::MPI::min(value, comm);
  }



  double ForestVertices::sum(const double value) const
  {
    return Utilities::MPI::sum(value, comm);
  }



  std::vector<ForestMesh::Name> ForestVertices::chosen_vertices(const std::vector<unsigned int> &late) const
  {
    const std::size_t most = MovementRule().n_attempts;
    std::vector<Name> mine;
    for (std::size_t i = 0; i < std::min(late.size(), most); ++i)
      mine.push_back(mesh.vertices[late[i]]);
    std::vector<Name> all = gather_lists(mine, comm, Receivers::rank_zero);
    if (rank != 0)
      all.clear();
    std::sort(all.begin(), all.end());
    all.resize(std::min(all.size(), most));
    return broadcast_value(all, comm);
  }



  std::vector<bool> ForestVertices::near(const std::vector<Name> &chosen) const
  {
    // The free vertices in two layers around a vertex move, and the cells of these change.
    constexpr unsigned int n_layers = 3;
    std::vector<double>    flags(mesh.vertices.size(), 0.);
    for (const Name name : chosen)
      if (const unsigned int v = mesh.find(name); v != ForestMesh::none)
        flags[v] = 1.;
    std::vector<bool> is_near(mesh.cells.size(), false);
    for (unsigned int layer = 0; layer < n_layers; ++layer)
      {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          for (const unsigned int v : mesh.cells[c].vertices)
            is_near[c] = is_near[c] || flags[v] > 0.;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          if (is_near[c])
            for (const unsigned int v : mesh.cells[c].vertices)
              flags[v] = 1.;
        update(flags);
      }
    return is_near;
  }



  namespace
  {
    using Name = ForestMesh::Name;

    struct PackedPoint
    {
      Name                  name;
      std::array<double, 3> position;
    };

    struct PackedCell
    {
      std::uint64_t                        number;
      std::array<Name, 4>                  names;
      std::array<std::array<double, 3>, 4> positions;
      std::array<bool, 4>                  is_free;
      double                               reference;
    };

    Point<3> unpack(const std::array<double, 3> &x)
    {
      return Point<3>(x[0], x[1], x[2]);
    }

    PackedPoint pack(const Name name, const Point<3> &x)
    {
      return {name, {{x[0], x[1], x[2]}}};
    }

    /// A small mesh that is whole on one rank: cells in their order, vertices in that of their names.
    struct GatheredCells
    {
      explicit GatheredCells(std::vector<PackedCell> &&all)
      {
        std::sort(all.begin(), all.end(),
                  [](const PackedCell &a, const PackedCell &b) { return a.number < b.number; });
        for (const PackedCell &cell : all)
          names.insert(names.end(), cell.names.begin(), cell.names.end());
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        positions.resize(names.size());
        is_free.resize(names.size());
        vertices.reserve(all.size());
        for (const PackedCell &cell : all)
          {
            vertices.emplace_back();
            for (unsigned int i = 0; i < 4; ++i)
              {
                const unsigned int v = find(cell.names[i]);
                vertices.back()[i]   = v;
                positions[v]         = unpack(cell.positions[i]);
                is_free[v]           = cell.is_free[i];
              }
            cells.emplace_back(vertices.back().data(), 4);
            reference.push_back(cell.reference);
          }
      }

      unsigned int find(const Name name) const
      {
        return static_cast<unsigned int>(std::lower_bound(names.begin(), names.end(), name) - names.begin());
      }

      std::vector<Name>                          names;
      std::vector<Point<3>>                      positions;
      std::vector<bool>                          is_free;
      std::vector<std::array<unsigned int, 4>>   vertices;
      std::vector<ArrayView<const unsigned int>> cells;
      std::vector<double>                        reference;
    };
  } // namespace



  void ForestVertices::try_again(std::vector<unsigned int> &late, const std::vector<Point<3>> &targets,
                                 std::vector<Point<3>> &positions,
                                 const std::vector<ArrayView<const unsigned int>> &,
                                 const std::vector<bool> &is_free, std::vector<double> &reference) const
  {
    const std::vector<Name> chosen = chosen_vertices(late);
    if (chosen.empty())
      return;
    std::vector<PackedPoint> wanted;
    for (std::size_t i = 0; i < late.size(); ++i)
      if (mesh.vertices[late[i]] <= chosen.back())
        wanted.push_back(pack(mesh.vertices[late[i]], targets[i]));
    std::vector<PackedCell> mine;
    const auto              is_near = near(chosen);
    for (std::size_t c = mesh.first_owned; c < mesh.first_owned + mesh.n_owned; ++c)
      if (is_near[c])
        {
          PackedCell cell{mesh.cell_numbers[c], {}, {}, {}, reference[c]};
          for (unsigned int i = 0; i < 4; ++i)
            {
              const unsigned int v = mesh.cells[c].vertices[i];
              cell.names[i]        = mesh.vertices[v];
              cell.positions[i]    = pack(0, positions[v]).position;
              cell.is_free[i]      = is_free[v];
            }
          mine.push_back(cell);
        }
    wanted = gather_lists(std::move(wanted), comm, Receivers::rank_zero);
    mine   = gather_lists(std::move(mine), comm, Receivers::rank_zero);

    std::vector<PackedPoint> moved;
    std::vector<Name>        still;
    if (rank == 0)
      {
        std::sort(wanted.begin(), wanted.end(),
                  [](const PackedPoint &a, const PackedPoint &b) { return a.name < b.name; });
        GatheredCells             region(std::move(mine));
        std::vector<unsigned int> list;
        std::vector<Point<3>>     goals;
        for (const PackedPoint &entry : wanted)
          {
            list.push_back(region.find(entry.name));
            goals.push_back(unpack(entry.position));
          }
        Signorini::try_again(list, goals, region.positions, region.cells, region.is_free, region.reference);
        for (std::size_t v = 0; v < region.names.size(); ++v)
          moved.push_back(pack(region.names[v], region.positions[v]));
        for (const unsigned int v : list)
          still.push_back(region.names[v]);
      }
    // Few: there is a bound for the attempts.
    if (rank != 0)
      moved.clear();
    moved = gather_lists(std::move(moved), comm, Receivers::all);
    still = gather_lists(std::move(still), comm, Receivers::all);
    for (const PackedPoint &entry : moved)
      if (const unsigned int v = mesh.find(entry.name); v != ForestMesh::none)
        positions[v] = unpack(entry.position);
    std::vector<unsigned int> left;
    for (const unsigned int v : late)
      if (mesh.vertices[v] > chosen.back() ||
          std::find(still.begin(), still.end(), mesh.vertices[v]) != still.end())
        left.push_back(v);
    late = std::move(left);
  }
} // namespace Signorini
