// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/sent_lists.h>
#include <signorini/discretization/interpolation_exchange.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Key  = ParentLookup::Key;
    using Cell = NodalSpace::Cell;

    Key name_of(const Cell &cell)
    {
      return {cell.coarse_cell, cell.path};
    }

    Key parent_of(const Key &key)
    {
      return {key.coarse_cell, key.path >> 3};
    }
  } // namespace



  ParentLookup::ParentLookup(const NodalSpace &fine, const NodalSpace &coarse)
  {
    collect_own_cells(coarse);
    if (Utilities::MPI::n_mpi_processes(fine.communicator()) > 1)
      fetch_remote_cells(fine);
  }



  void ParentLookup::collect_own_cells(const NodalSpace &coarse)
  {
    for (const Cell &cell : coarse.cells())
      if (cell.is_owned && cell.n_vertices == CellShape::hexahedron)
        {
          index[name_of(cell)] = static_cast<unsigned int>(cells.size());
          cells.emplace_back();
          CellInterpolation &data     = cells.back();
          const auto         vertices = coarse.nodes(cell);
          for (unsigned int v = 0; v < 8; ++v)
            {
              data.start[v] = static_cast<unsigned int>(data.nodes.size());
              if (const auto *parents = coarse.hanging_nodes().get_constraint_entries(vertices[v]))
                for (const auto &[node, weight] : *parents)
                  {
                    data.nodes.push_back(node);
                    data.weights.push_back(weight);
                  }
              else
                {
                  data.nodes.push_back(vertices[v]);
                  data.weights.push_back(1.);
                }
            }
          data.start[8] = static_cast<unsigned int>(data.nodes.size());
        }
  }



  std::map<unsigned int, std::vector<std::pair<ParentLookup::Key, unsigned int>>>
  ParentLookup::answer_for_owners(const NodalSpace &fine) const
  {
    const MPI_Comm     comm    = fine.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const auto home = [&](const Key &key) { return static_cast<unsigned int>(Hash()(key) % n_ranks); };

    // What every rank has, told to the directory.
    std::map<unsigned int, std::vector<Key>> owned, wanted;
    for (const auto &entry : index)
      owned[home(entry.first)].push_back(entry.first);
    std::unordered_map<Key, unsigned int, Hash> owner_of;
    for (const auto &[rank, keys] : send_lists(owned, comm))
      for (const Key &key : keys)
        owner_of[key] = rank;

    // What is missing here, asked of the directory; it answers with the owners.
    std::set<std::pair<std::uint64_t, std::uint64_t>> missing;
    for (const Cell &cell : fine.cells())
      if (cell.is_owned && cell.n_vertices == CellShape::hexahedron)
        {
          const Key key = name_of(cell), parent = parent_of(key);
          if (index.count(key) == 0 && index.count(parent) == 0)
            for (const Key &k : {key, parent})
              missing.insert({k.coarse_cell, k.path});
        }
    for (const auto &[coarse_cell, path] : missing)
      wanted[home({coarse_cell, path})].push_back({coarse_cell, path});
    std::map<unsigned int, std::vector<std::pair<Key, unsigned int>>> owners;
    for (const auto &[rank, keys] : send_lists(wanted, comm))
      for (const Key &key : keys)
        if (const auto it = owner_of.find(key); it != owner_of.end())
          owners[rank].emplace_back(key, it->second);
    return owners;
  }



  void ParentLookup::fetch_remote_cells(const NodalSpace &fine)
  {
    const MPI_Comm                           comm   = fine.communicator();
    const auto                               owners = answer_for_owners(fine);
    std::map<unsigned int, std::vector<Key>> requests;
    for (const auto &answer : send_values(owners, comm))
      for (const auto &[key, rank] : answer.second)
        requests[rank].push_back(key);
    std::map<unsigned int, std::vector<std::pair<Key, CellInterpolation>>> answers;
    for (const auto &[rank, keys] : send_lists(requests, comm))
      for (const Key &key : keys)
        answers[rank].emplace_back(key, cells[index.at(key)]);
    for (const auto &answer : send_values(answers, comm))
      for (const auto &[key, data] : answer.second)
        {
          index[key] = static_cast<unsigned int>(cells.size());
          cells.push_back(data);
        }
  }



  std::pair<const CellInterpolation *, int> ParentLookup::find(const Cell &cell) const
  {
    const Key key = name_of(cell);
    if (const auto it = index.find(key); it != index.end())
      return {&cells[it->second], -1};
    const auto it = index.find(parent_of(key));
    AssertThrow(it != index.end(), ExcMessage("The meshes of two consecutive levels are not nested."));
    return {&cells[it->second], static_cast<int>(key.path & 7u)};
  }
} // namespace Signorini
