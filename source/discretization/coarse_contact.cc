// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/interface_rows.h>
#include <signorini/discretization/coarse_contact.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::size_t index_of(const NodeIndex node, const std::vector<NodeIndex> &sorted)
    {
      return std::lower_bound(sorted.begin(), sorted.end(), node) - sorted.begin();
    }
  } // namespace



  namespace
  {
    using Entry = InterfaceCoupling::Entry;

    /// What a fine row adds to a coarse one, on its way to the rank that owns that; its entries follow those
    /// of the one before.
    struct RowPart
    {
      NodeIndex    row, fine_row;
      double       weight;
      Vector3      normal;
      unsigned int n_entries;
      /// First entry, set on arrival.
      std::size_t begin;

      /// As if the fine rows were visited one after the other, whoever owns them.
      bool operator<(const RowPart &other) const
      {
        return std::tie(row, fine_row) < std::tie(other.row, other.fine_row);
      }
    };

    struct RowParts
    {
      std::vector<RowPart> parts;
      std::vector<Entry>   entries;
    };

    /// Collective. The parts of all rows that this rank owns.
    RowParts exchange_parts(const ListsByRank<RowPart> &parts, const ListsByRank<Entry> &entries,
                            const MPI_Comm communicator)
    {
      ListsByRank<char> sent;
      for (const auto &[rank, list] : parts)
        {
          Parcel parcel;
          parcel.write(list);
          parcel.write(entries.at(rank));
          sent[rank] = parcel.bytes();
        }
      RowParts result;
      for (const auto &[rank, bytes] : send_lists(sent, communicator))
        {
          Parcel      parcel(bytes);
          std::size_t begin = result.entries.size();
          for (RowPart part : parcel.read<RowPart>())
            {
              part.begin = begin;
              begin += part.n_entries;
              result.parts.push_back(part);
            }
          const std::vector<Entry> list = parcel.read<Entry>();
          result.entries.insert(result.entries.end(), list.begin(), list.end());
        }
      std::stable_sort(result.parts.begin(), result.parts.end());
      return result;
    }

    /// Columns that are rows themselves are left out, so that S² = 0: only a choice of the basis.
    void drop_rows_from_columns(InterfaceCoupling &coupling, const NodePartition &partition)
    {
      std::vector<NodeIndex> columns;
      for (const Entry &entry : coupling.entries)
        columns.push_back(entry.node);
      const NodeRequest                request(partition, sorted_nodes(std::move(columns)));
      const std::vector<unsigned char> is_row = request.fetch([&](const unsigned int local) {
        return static_cast<unsigned char>(coupling.find(partition.to_global(local)) >= 0);
      });
      std::vector<Entry>               kept;
      std::vector<std::size_t>         row_start = {0};
      for (std::size_t row = 0; row < coupling.n_rows(); ++row)
        {
          for (const Entry *entry = coupling.begin(row); entry != coupling.end(row); ++entry)
            if (!is_row[index_of(entry->node, request.nodes())])
              kept.push_back(*entry);
          row_start.push_back(kept.size());
        }
      coupling.entries   = std::move(kept);
      coupling.row_start = std::move(row_start);
    }
  } // namespace



  CoarseCoupling coarsen_coupling(const InterfaceCoupling          &fine,
                                  const std::vector<RowProjection> &projections,
                                  const std::vector<NodeIndex> &nodes, const NodeRows &rows,
                                  const NodePartition &partition)
  {
    ListsByRank<RowPart> parts;
    ListsByRank<Entry>   entries;
    for (std::size_t p = 0; p < fine.n_rows(); ++p)
      {
        std::map<NodeIndex, double> mapped;
        for (const Entry *entry = fine.begin(p); entry != fine.end(p); ++entry)
          {
            const std::size_t q = index_of(entry->node, nodes);
            for (std::size_t k = rows.start[q]; k < rows.start[q + 1]; ++k)
              mapped[rows.columns[k]] += entry->weight * rows.weights[k];
          }
        const std::size_t i = index_of(fine.rows[p], nodes);
        for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
          {
            const double       w    = rows.weights[k] * fine.weight[p];
            const unsigned int rank = partition.owner(rows.columns[k]);
            parts[rank].push_back({rows.columns[k], fine.rows[p], w, w * projections[p].normal(),
                                   static_cast<unsigned int>(mapped.size()), 0});
            std::vector<Entry> &list = entries[rank];
            for (const auto &[column, value] : mapped)
              list.push_back({column, w * value});
          }
      }
    const RowParts all = exchange_parts(parts, entries, partition.communicator());
    CoarseCoupling coarse;
    for (auto first = all.parts.begin(), last = first; first != all.parts.end(); first = last)
      {
        std::map<NodeIndex, double> sums;
        double                      weight = 0.;
        Vector3                     normal;
        for (; last != all.parts.end() && last->row == first->row; ++last)
          {
            weight += last->weight;
            normal += last->normal;
            for (std::size_t k = last->begin; k < last->begin + last->n_entries; ++k)
              sums[all.entries[k].node] += all.entries[k].weight;
          }
        coarse.coupling.rows.push_back(first->row);
        coarse.coupling.weight.push_back(weight);
        coarse.normals.push_back(normal);
        for (const auto &[column, value] : sums)
          coarse.coupling.entries.push_back({column, value / weight});
        coarse.coupling.row_start.push_back(coarse.coupling.entries.size());
      }
    drop_rows_from_columns(coarse.coupling, partition);
    return coarse;
  }



  std::vector<RowProjection> coarse_projections(const CoarseCoupling               &coarse,
                                                const std::vector<FixedDirections> &fixed,
                                                const NodePartition                &partition)
  {
    std::vector<RowProjection> result;
    for (std::size_t q = 0; q < coarse.normals.size(); ++q)
      {
        const double length = coarse.normals[q].norm();
        result.emplace_back(fixed[partition.to_local(coarse.coupling.rows[q])],
                            length > 0. ? coarse.normals[q] / length : Vector3());
      }
    return result;
  }



  RowHalfSpaces half_spaces_of_rows(const HalfSpaces &owned, const NodePartition &partition,
                                    const std::vector<NodeIndex> &rows)
  {
    RowHalfSpaces result;
    result.normals.resize(rows.size());
    result.bounds.resize(rows.size(), 0.);
    for (std::size_t p = 0; p < owned.size(); ++p)
      {
        const std::size_t row = index_of(partition.to_global(owned.nodes[p]), rows);
        result.normals[row]   = owned.normals[p];
        result.bounds[row]    = owned.bounds[p];
      }
    return result;
  }



  RowHalfSpaces inject_half_spaces(const RowHalfSpaces &half_spaces, const InterfaceCoupling &fine,
                                   const std::vector<NodeIndex> &nodes, const NodeRows &node_rows,
                                   const CoarseRows &coarse, const NodePartition &partition)
  {
    struct Injected
    {
      NodeIndex coarse_row;
      Vector3   normal;
      double    bound;
    };
    ListsByRank<Injected> injected;
    for (std::size_t p = 0; p < fine.n_rows(); ++p)
      {
        const std::size_t row = index_of(fine.rows[p], nodes);
        if (node_rows.start[row + 1] != node_rows.start[row] + 1)
          continue;
        const NodeIndex coarse_row = node_rows.columns[node_rows.start[row]];
        injected[partition.owner(coarse_row)].push_back(
            {coarse_row, half_spaces.normals[p], half_spaces.bounds[p]});
      }
    RowHalfSpaces result;
    result.normals.resize(coarse.coupling.n_rows());
    result.bounds.resize(coarse.coupling.n_rows());
    for (const auto &[rank, list] : send_lists(injected, partition.communicator()))
      for (const Injected &one : list)
        {
          const std::size_t q      = coarse.coupling.find(one.coarse_row);
          const Vector3     free   = project_free(coarse.projections[q].fixed(), one.normal);
          const double      length = free.norm();
          if (length > 1e-6)
            {
              result.normals[q] = free / length;
              result.bounds[q]  = one.bound / length;
            }
        }
    return result;
  }



  HalfSpaces own_half_spaces(const RowHalfSpaces &half_spaces, const std::vector<NodeIndex> &rows,
                             const NodePartition &partition)
  {
    HalfSpaces result;
    for (std::size_t q = 0; q < rows.size(); ++q)
      if (partition.owns(rows[q]) && half_spaces.normals[q].norm_square() > 0.)
        {
          result.nodes.push_back(partition.to_local(rows[q]));
          result.normals.push_back(half_spaces.normals[q]);
          result.bounds.push_back(half_spaces.bounds[q]);
        }
    return result;
  }
} // namespace Signorini
