// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/motion_functions.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  MotionFunctions::MotionFunctions(const std::vector<Vector> &motions, std::vector<unsigned int> rows)
    : motions(motions)
    , rows(std::move(rows))
  {
  }



  MotionFunctions::Couplings MotionFunctions::couple(const NodeBlockMatrix           &matrix,
                                                     const std::vector<unsigned int> &numbers,
                                                     const double                     scale) const
  {
    AssertDimension(numbers.size(), rows.size());
    const unsigned int  n = n_nodes();
    std::vector<Vector> missing(motions.size()), products(motions.size());
    for (std::size_t m = 0; m < motions.size(); ++m)
      {
        matrix.partition().reinit(missing[m]);
        matrix.partition().reinit(products[m]);
        for (std::size_t k = 0; k < rows.size(); ++k)
          for (unsigned int c = 0; c < dim; ++c)
            missing[m].local_element(dim * numbers[k] + c) = motions[m].local_element(dim * rows[k] + c);
        matrix.vmult(products[m], missing[m]);
      }
    Couplings result;
    result.with_nodes.resize(matrix.n_rows() * n);
    result.own.resize(n * n);
    for (std::size_t m = 0; m < motions.size(); ++m)
      {
        for (unsigned int row = 0; row < matrix.n_rows(); ++row)
          for (unsigned int c = 0; c < dim; ++c)
            result.with_nodes[row * n + m / dim][c][m % dim] = -products[m].local_element(dim * row + c);
        for (std::size_t k = 0; k < motions.size(); ++k)
          result.own[m / dim * n + k / dim][m % dim][k % dim] = missing[m] * products[k];
      }
    for (unsigned int m = 0; m < dim * n; ++m)
      {
        double &energy = result.own[m / dim * (n + 1)][m % dim][m % dim];
        energy         = energy > 0. ? (1. + Rule().stiffer) * energy : scale;
      }
    return result;
  }



  std::vector<Vector3> MotionFunctions::work(const Vector &residual) const
  {
    std::vector<double> sums(dim * n_nodes(), 0.);
    for (std::size_t m = 0; m < motions.size(); ++m)
      {
        for (unsigned int i = 0; i < residual.locally_owned_size(); ++i)
          sums[m] += motions[m].local_element(i) * residual.local_element(i);
        for (const unsigned int row : rows)
          for (unsigned int i = dim * row; i < dim * (row + 1); ++i)
            sums[m] -= motions[m].local_element(i) * residual.local_element(i);
      }
    Utilities::MPI::sum(sums, residual.get_mpi_communicator(), sums);
    std::vector<Vector3> result;
    for (std::size_t m = 0; m < sums.size(); m += dim)
      result.push_back(Vector3({sums[m], sums[m + 1], sums[m + 2]}));
    return result;
  }



  void MotionFunctions::add(Vector &v, const std::vector<Vector3> &coefficients) const
  {
    std::vector<double> kept;
    for (const unsigned int row : rows)
      for (unsigned int c = 0; c < dim; ++c)
        kept.push_back(v.local_element(dim * row + c));
    for (std::size_t m = 0; m < motions.size(); ++m)
      v.add(coefficients[m / dim][m % dim], motions[m]);
    for (std::size_t k = 0; k < rows.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        v.local_element(dim * rows[k] + c) = kept[dim * k + c];
  }
} // namespace Signorini
