// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/empty_directions.h>

#include <Eigen/Dense>

namespace Signorini
{
  namespace
  {
    /// When a direction of a diagonal block counts as one without stiffness.
    struct EmptyDirectionRule
    {
      /// Of the stiffest direction of the block. Truncation at normals that are nearly the same leaves very
      /// little to a coarse function along their mean, and sweeps in single precision (6e-8) then return
      /// rounding, and more of it in each cycle. A lug that is pulled against its pin, 275,859 unknowns: 15
      /// iterations from 1e-9 to 1e-3, 30 at 1e-11.
      double of_block = 1e-6;
      /// Of the largest entry of the level: rounding. Blocks with less get that entry, others in their empty
      /// directions their own stiffest one: functions of background levels that hardly reach a node have
      /// next to nothing beside it, and the inverse of a block of both is rounding in single precision. A
      /// lug with a rigid face, 74,901 unknowns: 13 iterations, no end where blocks up to 1e-10 are filled
      /// with the entry of the level.
      double of_level = 1e-14;
    };

    /// Whether there was one.
    bool fill_empty_directions(double *const block, const double scale)
    {
      constexpr EmptyDirectionRule rule;
      Eigen::Matrix3d              s;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          s(c, d) = .5 * (block[dim * c + d] + block[dim * d + c]);
      const double mean = s.trace() / dim;
      // Well away from singular, the common case: the determinant is at most 3.4 times the smallest
      // eigenvalue, if that is small, times the square of the mean.
      if (mean > rule.of_level * scale && s.determinant() > 10. * rule.of_block * mean * mean * mean)
        return false;
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(s);
      const Eigen::Vector3d                               &values    = eigen.eigenvalues();
      const double                                         reference = std::max(values.maxCoeff(), 0.);
      const double filling   = reference > rule.of_level * scale ? reference : scale;
      bool         has_empty = false;
      for (unsigned int k = 0; k < dim; ++k)
        if (values[k] <= std::max(rule.of_block * reference, rule.of_level * scale))
          {
            has_empty                       = true;
            const Eigen::Vector3d direction = eigen.eigenvectors().col(k);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                block[dim * c + d] += filling * direction[c] * direction[d];
          }
      return has_empty;
    }
  } // namespace



  void EmptyDirections::fill(NodeBlockMatrix &matrix, const std::vector<unsigned int> &rows,
                             const double scale)
  {
    for (const unsigned int row : rows)
      {
        double *const block    = matrix.block(matrix.diagonal(row));
        const Block   original = read_block(block);
        if (fill_empty_directions(block, scale))
          originals.emplace(row, original);
      }
  }



  std::vector<unsigned int> EmptyDirections::restore(NodeBlockMatrix &matrix)
  {
    std::vector<unsigned int> rows;
    for (const auto &[row, block] : originals)
      {
        write_block(matrix.block(matrix.diagonal(row)), block);
        rows.push_back(row);
      }
    originals.clear();
    return rows;
  }



  void EmptyDirections::leave_out(Vector &residual, const NodeBlockMatrix &matrix, const Vector &v) const
  {
    for (const auto &[row, original] : originals)
      {
        const Block   filling = read_block(matrix.block(matrix.diagonal(row))) - original;
        const Vector3 load    = filling * Vector3({v.local_element(dim * row), v.local_element(dim * row + 1),
                                                   v.local_element(dim * row + 2)});
        for (unsigned int c = 0; c < dim; ++c)
          residual.local_element(dim * row + c) += load[c];
      }
  }
} // namespace Signorini
