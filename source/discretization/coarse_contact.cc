// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

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



  std::vector<RowProjection> coarsen_projections(const std::vector<RowProjection> &projections,
                                                 const InterfaceCoupling          &fine,
                                                 const std::vector<NodeIndex>     &nodes,
                                                 const NodeRows &node_rows, const InterfaceCoupling &coarse,
                                                 const std::vector<FixedDirections> &coarse_masks)
  {
    std::vector<Vector3> sums(coarse.n_rows());
    for (std::size_t p = 0; p < fine.n_rows(); ++p)
      {
        const std::size_t row = index_of(fine.rows[p], nodes);
        for (std::size_t k = node_rows.start[row]; k < node_rows.start[row + 1]; ++k)
          sums[coarse.find(node_rows.columns[k])] +=
              (node_rows.weights[k] * fine.weight[p]) * projections[p].normal();
      }
    std::vector<RowProjection> result;
    for (std::size_t q = 0; q < sums.size(); ++q)
      {
        const double length = sums[q].norm();
        result.emplace_back(coarse_masks[q], length > 0. ? sums[q] / length : Vector3());
      }
    return result;
  }



  RowHalfSpaces replicate_half_spaces(const HalfSpaces &owned, const NodePartition &partition,
                                      const std::vector<NodeIndex> &rows)
  {
    Vector normals, bounds;
    partition.reinit(normals);
    partition.reinit(bounds);
    for (std::size_t p = 0; p < owned.size(); ++p)
      {
        bounds.local_element(dim * owned.nodes[p]) = owned.bounds[p];
        for (unsigned int c = 0; c < dim; ++c)
          normals.local_element(dim * owned.nodes[p] + c) = owned.normals[p][c];
      }
    RowHalfSpaces result;
    result.normals = replicate_values(partition, normals, rows);
    for (const Vector3 &value : replicate_values(partition, bounds, rows))
      result.bounds.push_back(value[0]);
    return result;
  }



  RowHalfSpaces inject_half_spaces(const RowHalfSpaces &half_spaces, const InterfaceCoupling &fine,
                                   const std::vector<NodeIndex> &nodes, const NodeRows &node_rows,
                                   const InterfaceCoupling          &coarse,
                                   const std::vector<RowProjection> &coarse_projections)
  {
    RowHalfSpaces result;
    result.normals.resize(coarse.n_rows());
    result.bounds.resize(coarse.n_rows());
    for (std::size_t p = 0; p < fine.n_rows(); ++p)
      {
        const std::size_t row = index_of(fine.rows[p], nodes);
        if (node_rows.start[row + 1] != node_rows.start[row] + 1)
          continue;
        const std::size_t q      = coarse.find(node_rows.columns[node_rows.start[row]]);
        const Vector3     free   = project_free(coarse_projections[q].fixed(), half_spaces.normals[p]);
        const double      length = free.norm();
        if (length > 1e-6)
          {
            result.normals[q] = free / length;
            result.bounds[q]  = half_spaces.bounds[p] / length;
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
