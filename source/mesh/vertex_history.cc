// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/sent_lists.h>
#include <signorini/mesh/vertex_history.h>

#include <algorithm>
#include <unordered_set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Short cuts: there every vertex is at home, in the place that its name says.
    bool is_on_one_rank(const std::vector<std::vector<ForestMesh::Name>> &first_names)
    {
      return first_names[0].size() == 2;
    }
  } // namespace



  VertexHistory::VertexHistory(const Name n_vertices, const MPI_Comm communicator)
    : comm(communicator)
    , rank(Utilities::MPI::this_mpi_process(communicator))
    , first_names(1)
    , first_slot(1, 0)
    , latest_parent(1, 0)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    for (unsigned int r = 0; r <= n_ranks; ++r)
      first_names[0].push_back(n_vertices * r / n_ranks);
    for (Name v = first_names[0][rank]; v < first_names[0][rank + 1]; ++v)
      parent_names.push_back({{v, v}});
  }



  unsigned int VertexHistory::level_of(const Name vertex) const
  {
    unsigned int level = static_cast<unsigned int>(first_names.size() - 1);
    while (level > 0 && vertex < first_names[level].front())
      --level;
    return level;
  }



  unsigned int VertexHistory::home(const Name vertex) const
  {
    if (is_on_one_rank(first_names))
      return 0;
    const auto &first = first_names[level_of(vertex)];
    return static_cast<unsigned int>(std::upper_bound(first.begin(), first.end(), vertex) - first.begin() -
                                     1);
  }



  std::size_t VertexHistory::slot(const Name vertex) const
  {
    if (is_on_one_rank(first_names))
      return vertex;
    const unsigned int level = level_of(vertex);
    return first_slot[level] + (vertex - first_names[level][rank]);
  }



  void VertexHistory::add_level(const std::vector<Name> &first_name, const std::vector<Parents> &parents)
  {
    unsigned int latest = 0;
    for (const auto &ends : parents)
      latest = std::max(latest, ends[1] >= first_name.front() ? static_cast<unsigned int>(first_names.size())
                                                              : level_of(ends[1]));
    first_names.push_back(first_name);
    first_slot.push_back(parent_names.size());
    parent_names.insert(parent_names.end(), parents.begin(), parents.end());
    latest_parent.push_back(Utilities::MPI::max(latest, comm));
  }



  bool VertexHistory::halves_twice(const unsigned int coarse, const unsigned int fine) const
  {
    return std::any_of(latest_parent.begin() + coarse + 1, latest_parent.begin() + fine + 1,
                       [&](const unsigned int level) { return level > coarse; });
  }



  std::vector<NodeIndex> VertexHistory::look_up(const std::vector<Name>      &names,
                                                const std::vector<NodeIndex> &values,
                                                const std::vector<Name>      &wanted) const
  {
    using Entry = std::array<std::uint64_t, 2>;
    std::vector<NodeIndex> at_home(parent_names.size(), invalid_node);
    ListsByRank<Entry>     told;
    ListsByRank<Name>      asked;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (const unsigned int other = home(names[i]); other == rank)
        at_home[slot(names[i])] = values[i];
      else
        told[other].push_back({{names[i], values[i]}});
    std::unordered_map<Name, NodeIndex> fetched;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        for (const auto &message : send_lists(told, comm))
          for (const auto &[name, value] : message.second)
            at_home[slot(name)] = static_cast<NodeIndex>(value);
        for (const Name name : wanted)
          if (const unsigned int other = home(name); other != rank && fetched.insert({name, 0}).second)
            asked[other].push_back(name);
        ListsByRank<Entry> answers;
        for (const auto &[other, list] : send_lists(asked, comm))
          for (const Name name : list)
            answers[other].push_back({{name, at_home[slot(name)]}});
        for (const auto &message : send_lists(answers, comm))
          for (const auto &[name, value] : message.second)
            fetched[name] = static_cast<NodeIndex>(value);
      }
    std::vector<NodeIndex> result;
    result.reserve(wanted.size());
    for (const Name name : wanted)
      result.push_back(home(name) == rank ? at_home[slot(name)] : fetched.at(name));
    return result;
  }



  std::unordered_map<VertexHistory::Name, VertexHistory::Parents>
  VertexHistory::fetch(const std::vector<Name> &vertices) const
  {
    ListsByRank<Name> asked;
    for (const Name name : vertices)
      asked[home(name)].push_back(name);
    ListsByRank<std::array<Name, 3>> answers;
    for (const auto &[other, list] : send_lists(asked, comm))
      for (const Name name : list)
        {
          const Parents &ends = parent_names[slot(name)];
          answers[other].push_back({{name, ends[0], ends[1]}});
        }
    std::unordered_map<Name, Parents> result;
    for (const auto &message : send_lists(answers, comm))
      for (const auto &[name, a, b] : message.second)
        result[name] = {{a, b}};
    return result;
  }



  std::unordered_map<VertexHistory::Name, VertexHistory::Parents>
  VertexHistory::fetch_ancestors(const std::vector<Name> &vertices, const Name n_coarse) const
  {
    std::unordered_map<Name, Parents> result;
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return result;
    std::unordered_set<Name> seen;
    std::vector<Name>        open = vertices, missing;
    while (true)
      {
        missing.clear();
        while (!open.empty())
          {
            const Name v = open.back();
            open.pop_back();
            if (v < n_coarse)
              continue;
            const bool is_here = home(v) == rank;
            const auto it      = result.find(v);
            if (!is_here && it == result.end())
              missing.push_back(v);
            else if (seen.insert(v).second)
              for (const Name parent : is_here ? parent_names[slot(v)] : it->second)
                open.push_back(parent);
          }
        std::sort(missing.begin(), missing.end());
        missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
        if (Utilities::MPI::max(missing.empty() ? 0 : 1, comm) == 0)
          return result;
        const auto fetched = fetch(missing);
        result.insert(fetched.begin(), fetched.end());
        open = missing;
      }
  }



  VertexHistory::Rows VertexHistory::rows(const std::vector<Name> &vertices, const unsigned int coarse) const
  {
    const Name                           n_coarse = n_vertices(coarse);
    const auto                           fetched  = fetch_ancestors(vertices, n_coarse);
    Rows                                 result;
    std::vector<std::pair<Name, double>> open;
    for (const Name vertex : vertices)
      {
        open = {{vertex, 1.}};
        while (!open.empty())
          {
            const auto [v, weight] = open.back();
            open.pop_back();
            const auto begin = result.names.begin() + result.start.back();
            if (v >= n_coarse)
              for (const Name parent : home(v) == rank ? parent_names[slot(v)] : fetched.at(v))
                open.emplace_back(parent, .5 * weight);
            else if (const auto it = std::find(begin, result.names.end(), v); it != result.names.end())
              result.weights[it - result.names.begin()] += weight;
            else
              {
                result.names.push_back(v);
                result.weights.push_back(weight);
              }
          }
        result.start.push_back(result.names.size());
      }
    return result;
  }



  std::size_t VertexHistory::memory_consumption() const
  {
    std::size_t bytes = parent_names.capacity() * sizeof(Parents);
    for (const auto &first : first_names)
      bytes += first.capacity() * sizeof(Name);
    return bytes;
  }
} // namespace Signorini
