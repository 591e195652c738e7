// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/solvers/invariant_products.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The energy of a vector if no two nodes moved together.
    double diagonal_energy(const NodeBlockMatrix &matrix, const Vector &v)
    {
      double sum = 0.;
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        {
          const double *const block = matrix.block(matrix.diagonal(row));
          for (unsigned int c = 0; c < dim; ++c)
            sum += block[(dim + 1) * c] * Utilities::fixed_power<2>(v.local_element(dim * row + c));
        }
      return Utilities::MPI::sum(sum, matrix.partition().communicator());
    }
  } // namespace



  InvariantProducts::InvariantProducts(const NodeBlockMatrix &matrix, const std::vector<Vector> &motions)
  {
    const auto          n = static_cast<Eigen::Index>(motions.size());
    std::vector<Vector> products(motions.size());
    Eigen::MatrixXd     energies(n, n);
    double              largest = 0.;
    for (Eigen::Index i = 0; i < n; ++i)
      {
        products[i].reinit(motions[i]);
        matrix.vmult(products[i], motions[i]);
        largest = std::max(largest, diagonal_energy(matrix, motions[i]));
        for (Eigen::Index j = 0; j <= i; ++j)
          energies(i, j) = energies(j, i) = motions[j] * products[i];
      }
    const SymmetricEigen eigen = symmetric_eigen(energies);
    for (Eigen::Index k = 0; k < n; ++k)
      if (eigen.values[k] > Rule().opposed * largest)
        {
          Vector motion, force;
          matrix.partition().reinit(motion);
          matrix.partition().reinit(force);
          for (Eigen::Index i = 0; i < n; ++i)
            {
              motion.add(eigen.vectors(i, k), motions[i]);
              force.add(eigen.vectors(i, k) / eigen.values[k], products[i]);
            }
          opposed.push_back(std::move(motion));
          forces.push_back(std::move(force));
        }
  }



  void InvariantProducts::correct_product(Vector &product) const
  {
    if (opposed.empty())
      return;
    product.zero_out_ghost_values();
    for (std::size_t k = 0; k < opposed.size(); ++k)
      product.add(-(opposed[k] * product), forces[k]);
  }



  void InvariantProducts::correct_residual(Vector &residual, const Vector &rhs) const
  {
    if (opposed.empty())
      return;
    residual.zero_out_ghost_values();
    for (std::size_t k = 0; k < opposed.size(); ++k)
      residual.add(opposed[k] * rhs - opposed[k] * residual, forces[k]);
  }



  std::vector<double> InvariantProducts::coefficients(const Vector &v) const
  {
    std::vector<double> result;
    for (const Vector &force : forces)
      result.push_back(force * v);
    return result;
  }
} // namespace Signorini
