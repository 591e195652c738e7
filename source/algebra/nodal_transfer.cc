// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/nodal_transfer.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    bool is_multiple_of_identity(const Block &block)
    {
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          if (block[c][d] != (c == d ? block[0][0] : 0.))
            return false;
      return true;
    }
  } // namespace



  void NodalTransfer::append(const BlockRow &row)
  {
    global_columns.insert(global_columns.end(), row.columns.begin(), row.columns.end());
    if (!row.weights.empty())
      weights.insert(weights.end(), row.weights.begin(), row.weights.end());
    else if (std::all_of(row.blocks.begin(), row.blocks.end(), is_multiple_of_identity))
      for (const Block &block : row.blocks)
        weights.push_back(block[0][0]);
    else
      {
        block_start[row.row] = static_cast<unsigned int>(blocks.size());
        blocks.insert(blocks.end(), row.blocks.begin(), row.blocks.end());
        weights.resize(global_columns.size(), 0.);
      }
  }



  void NodalTransfer::reinit(NodeRows rows, const std::vector<BlockRow> &block_rows,
                             const unsigned int n_owned_fine)
  {
    n_owned = n_owned_fine;
    block_start.assign(rows.n_rows(), no_blocks);
    blocks.clear();
    columns.clear();
    plane_of_row.clear();
    planes.clear();
    coarse.reset();
    if (block_rows.empty())
      {
        row_start      = std::move(rows.start);
        global_columns = std::move(rows.columns);
        weights        = std::move(rows.weights);
        return;
      }
    row_start.assign(1, 0);
    row_start.reserve(rows.start.size());
    global_columns.clear();
    weights.clear();
    std::size_t n_entries = rows.columns.size();
    for (const BlockRow &row : block_rows)
      n_entries += row.columns.size();
    global_columns.reserve(n_entries);
    weights.reserve(n_entries);
    auto next = block_rows.begin();
    for (unsigned int i = 0; i < rows.n_rows(); ++i)
      {
        if (next != block_rows.end() && next->row == i)
          append(*next++);
        else
          {
            global_columns.insert(global_columns.end(), rows.columns.begin() + rows.start[i],
                                  rows.columns.begin() + rows.start[i + 1]);
            weights.insert(weights.end(), rows.weights.begin() + rows.start[i],
                           rows.weights.begin() + rows.start[i + 1]);
          }
        row_start.push_back(global_columns.size());
      }
    Assert(next == block_rows.end(), ExcInternalError());
  }



  void NodalTransfer::set_plane(const unsigned int row, const Vector3 &normal)
  {
    if (plane_of_row.empty())
      plane_of_row.assign(n_rows(), -1);
    int &place = plane_of_row[row];
    if (place < 0)
      {
        place = static_cast<int>(planes.size());
        planes.emplace_back();
      }
    planes[place] = normal;
  }



  IndexSet NodalTransfer::foreign_coarse_nodes(const IndexSet &owned) const
  {
    const NodeIndex        begin = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    const NodeIndex        end   = begin + owned.n_elements();
    std::vector<NodeIndex> nodes;
    for (const NodeIndex column : global_columns)
      if (column < begin || column >= end)
        nodes.push_back(column);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    IndexSet set(owned.size());
    set.add_indices(nodes.begin(), nodes.end());
    set.compress();
    return set;
  }



  void NodalTransfer::localize(std::shared_ptr<const NodePartition> new_coarse)
  {
    if (global_columns.empty())
      for (unsigned int &column : columns)
        column = new_coarse->to_local(coarse->to_global(column));
    else
      {
        columns.resize(global_columns.size());
        for (std::size_t k = 0; k < columns.size(); ++k)
          columns[k] = new_coarse->to_local(global_columns[k]);
        global_columns.clear();
        global_columns.shrink_to_fit();
      }
    coarse = std::move(new_coarse);
  }



  void NodalTransfer::prolongate(Vector &fine, const Vector &coarse_vector) const
  {
    coarse_vector.update_ghost_values();
    const double *const x = coarse_vector.begin();
    double *const       y = fine.begin();
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        double s[3] = {0., 0., 0.};
        if (const Block *b = row_blocks(i))
          {
            for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k, ++b)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  s[c] += (*b)[c][d] * x[dim * static_cast<std::size_t>(columns[k]) + d];
          }
        else
          for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
            for (unsigned int c = 0; c < dim; ++c)
              s[c] += weights[k] * x[dim * static_cast<std::size_t>(columns[k]) + c];
        if (const Vector3 *const n = plane(i))
          project_to_plane(*n, s);
        for (unsigned int c = 0; c < dim; ++c)
          y[dim * i + c] = s[c];
      }
  }



  void NodalTransfer::restrict_and_add(Vector &coarse_vector, const Vector &fine) const
  {
    coarse_vector.zero_out_ghost_values();
    const double *const x = fine.begin();
    double *const       y = coarse_vector.begin();
    for (unsigned int i = 0; i < n_owned; ++i)
      {
        double v[3];
        std::copy_n(x + dim * static_cast<std::size_t>(i), dim, v);
        if (const Vector3 *const n = plane(i))
          project_to_plane(*n, v);
        if (const Block *b = row_blocks(i))
          {
            for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k, ++b)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  y[dim * static_cast<std::size_t>(columns[k]) + d] += (*b)[c][d] * v[c];
          }
        else
          for (std::size_t k = row_start[i]; k < row_start[i + 1]; ++k)
            for (unsigned int c = 0; c < dim; ++c)
              y[dim * static_cast<std::size_t>(columns[k]) + c] += weights[k] * v[c];
      }
    coarse_vector.compress(VectorOperation::add);
  }
} // namespace Signorini
