// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "forest_closure.h"

#include <signorini/algebra/collectives.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr ForestMesh::Name handle_bit = ForestMesh::Name(1) << 63;

    std::uint64_t edge_key(const unsigned int a, const unsigned int b)
    {
      return static_cast<std::uint64_t>(std::max(a, b)) << 32 | std::min(a, b);
    }

    ForestMesh::Carrier joined(const ForestMesh::Carrier &a, const ForestMesh::Carrier &b)
    {
      // At most four corners: an edge lies in one cell of the start mesh.
      std::array<unsigned int, 8> all;
      const auto                  end   = std::set_union(a.begin(), a.end(), b.begin(), b.end(), all.begin());
      const auto                  valid = std::lower_bound(all.begin(), end, ForestMesh::none);
      Assert(valid - all.begin() <= 4, ExcInternalError());
      ForestMesh::Carrier result;
      result.fill(ForestMesh::none);
      std::copy(all.begin(), valid, result.begin());
      return result;
    }
  } // namespace



  ForestClosure::ForestClosure(const ForestMesh &mesh, const MPI_Comm communicator)
    : comm(communicator)
    , rank(Utilities::MPI::this_mpi_process(communicator))
    , n_old(static_cast<unsigned int>(mesh.vertices.size()))
    , at_split_edge(mesh.vertices.size(), false)
  {
    vertices.reserve(n_old);
    for (unsigned int v = 0; v < n_old; ++v)
      vertices.push_back({mesh.vertices[v],
                          {{mesh.points[v][0], mesh.points[v][1], mesh.points[v][2]}},
                          mesh.carriers[v],
                          mesh.is_marked[v] ? 1u : 0u});
    std::vector<bool> is_own(n_old, false);
    for (std::size_t c = mesh.first_owned; c < mesh.first_owned + mesh.n_owned; ++c)
      for (const unsigned int v : mesh.cells[c].vertices)
        is_own[v] = true;
    // Cells come in the order of their owners.
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      if (!mesh.is_owned(c))
        for (const unsigned int v : mesh.cells[c].vertices)
          if (is_own[v])
            {
              Ranks &ranks = others[v];
              if (ranks.empty() || ranks.back() != mesh.owner(c))
                ranks.push_back(mesh.owner(c));
              known[vertices[v].name] = v;
            }
  }



  ForestClosure::Ranks ForestClosure::common_ranks(const unsigned int a, const unsigned int b) const
  {
    Ranks      result;
    const auto of_a = others.find(a), of_b = others.find(b);
    if (of_a != others.end() && of_b != others.end())
      std::set_intersection(of_a->second.begin(), of_a->second.end(), of_b->second.begin(),
                            of_b->second.end(), std::back_inserter(result));
    return result;
  }



  unsigned int ForestClosure::add_middle(const unsigned int a, const unsigned int b, const Name handle)
  {
    const unsigned int  middle = static_cast<unsigned int>(vertices.size());
    ForestPiece::Vertex vertex{handle, {}, joined(vertices[a].carrier, vertices[b].carrier), 0u};
    // The same bits whichever end comes first.
    for (unsigned int d = 0; d < 3; ++d)
      vertex.position[d] = .5 * (vertices[a].position[d] + vertices[b].position[d]);
    middles[edge_key(a, b)] = middle;
    vertices.push_back(vertex);
    ends.push_back({{a, b}});
    at_split_edge.push_back(false);
    at_split_edge[a] = at_split_edge[b] = true;
    if (Ranks ranks = common_ranks(a, b); !ranks.empty())
      {
        known[handle]  = middle;
        others[middle] = std::move(ranks);
      }
    return middle;
  }



  unsigned int ForestClosure::middle_of(const unsigned int a, const unsigned int b)
  {
    if (const auto it = middles.find(edge_key(a, b)); it != middles.end())
      return it->second;
    const Name         handle = handle_bit | static_cast<Name>(rank) << 40 | vertices.size();
    const unsigned int middle = add_middle(a, b, handle);
    if (const auto it = others.find(middle); it != others.end())
      for (const unsigned int other : it->second)
        news[other].push_back({handle, {vertices[a].name, vertices[b].name}});
    return middle;
  }



  bool ForestClosure::has_split_edge(const Tetrahedron &cell) const
  {
    for (unsigned int i = 1; i < 4; ++i)
      if (at_split_edge[cell.vertices[i]])
        for (unsigned int j = 0; j < i; ++j)
          if (at_split_edge[cell.vertices[j]] &&
              middles.count(edge_key(cell.vertices[i], cell.vertices[j])) > 0)
            return true;
    return false;
  }



  void ForestClosure::close(std::vector<Item> &cells)
  {
    std::vector<Item> next;
    for (bool changed = true; changed;)
      {
        changed = false;
        next.clear();
        next.reserve(cells.size() + cells.size() / 8);
        for (const Item &item : cells)
          if (item.bisections > 0 || has_split_edge(item.tetrahedron.cell))
            {
              const auto        &corners = item.tetrahedron.cell.vertices;
              const auto        &edge    = item.tetrahedron.marking.refinement_edge;
              const unsigned int left    = item.bisections > 0 ? item.bisections - 1 : 0;
              for (const MarkedTetrahedron &child :
                   bisect(item.tetrahedron, middle_of(corners[edge[0]], corners[edge[1]])))
                next.push_back({child, left});
              changed = true;
            }
          else
            next.push_back(item);
        cells.swap(next);
      }
  }



  bool ForestClosure::exchange()
  {
    bool       is_new   = false;
    const auto received = send_lists(news, comm);
    news.clear();
    // Of each rank in the order in which it made them: the ends of an edge come before its middle.
    for (const auto &message : received)
      for (const SplitEdge &edge : message.second)
        {
          const unsigned int a = known.at(edge.ends[0]), b = known.at(edge.ends[1]);
          const auto         it = middles.find(edge_key(a, b));
          if (it != middles.end())
            known[edge.middle] = it->second;
          else
            add_middle(a, b, edge.middle);
          is_new = is_new || it == middles.end();
        }
    return is_new;
  }



  void ForestClosure::run(std::vector<Item> &cells)
  {
    bool goes_on = true;
    while (true)
      {
        if (goes_on)
          close(cells);
        if (Utilities::MPI::max(news.empty() ? 0 : 1, comm) == 0)
          return;
        goes_on = exchange();
      }
  }



  std::vector<bool> ForestClosure::used_vertices(const std::vector<Item> &cells) const
  {
    std::vector<bool> is_used(vertices.size(), false);
    for (const Item &item : cells)
      for (const unsigned int v : item.tetrahedron.cell.vertices)
        is_used[v] = true;
    return is_used;
  }



  std::unordered_map<unsigned int, ForestClosure::Ranks>
  ForestClosure::holders(const std::vector<bool> &is_used) const
  {
    std::unordered_map<unsigned int, Ranks> result;
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return result;
    ListsByRank<Name> told;
    for (unsigned int v = n_old; v < vertices.size(); ++v)
      if (is_used[v])
        if (const auto it = others.find(v); it != others.end())
          for (const unsigned int other : it->second)
            told[other].push_back(vertices[v].name);
    for (const auto &[other, names] : send_lists(told, comm))
      for (const Name name : names)
        result[known.at(name)].push_back(other);
    return result;
  }



  std::vector<unsigned int>
  ForestClosure::vertices_to_name(const std::vector<Item>                       &cells,
                                  const std::unordered_map<unsigned int, Ranks> &holders) const
  {
    std::vector<unsigned int> result;
    std::vector<bool>         is_done(vertices.size(), false);
    for (const Item &item : cells)
      for (const unsigned int v : item.tetrahedron.cell.vertices)
        if (v >= n_old && !is_done[v])
          {
            is_done[v]    = true;
            const auto it = holders.find(v);
            if (it == holders.end() || rank < it->second.front())
              result.push_back(v);
          }
    return result;
  }



  std::vector<ForestMesh::Name> ForestClosure::name_vertices(const std::vector<Item> &cells,
                                                             const Name               first_free)
  {
    const auto        at     = holders(used_vertices(cells));
    const auto        mine   = vertices_to_name(cells, at);
    std::vector<Name> result = {first_free};
    for (const std::uint64_t n : gather_values(static_cast<std::uint64_t>(mine.size()), comm))
      result.push_back(result.back() + n);

    ListsByRank<std::array<Name, 2>> told;
    for (std::size_t i = 0; i < mine.size(); ++i)
      {
        const Name name = result[rank] + i;
        if (const auto it = at.find(mine[i]); it != at.end())
          for (const unsigned int other : it->second)
            told[other].push_back({{vertices[mine[i]].name, name}});
        vertices[mine[i]].name = name;
      }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      for (const auto &message : send_lists(told, comm))
        for (const auto &[handle, name] : message.second)
          vertices[known.at(handle)].name = name;
    parents.clear();
    parents.reserve(mine.size());
    for (const unsigned int v : mine)
      {
        const auto [a, b] = ends[v - n_old];
        parents.push_back(
            {{std::min(vertices[a].name, vertices[b].name), std::max(vertices[a].name, vertices[b].name)}});
      }
    return result;
  }
} // namespace Signorini
