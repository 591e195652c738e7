// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/solvers/level_zero_solver.h>

namespace Signorini
{
  namespace
  {
    /// Ranges in which nothing changes: iterations on S1, a tetrahedral level 0 and ν = 0.49 (for algebraic
    /// multigrid), and on five problems of bodies that only contact holds.
    struct LevelZeroRule
    {
      /// From here on the fill of the factors costs more than the cycles: with 343, 729, 1331 and 2197 nodes
      /// (S1) 1.6, 2.5, 3.7 and 10 times as much.
      NodeIndex largest_for_cholesky = 500;
      /// 1e-2 to 1e-6 take as many iterations around (levels 0 that are the finest: 2 more), 0.1 up to 2
      /// more; 1e-6 takes 1.2 to 1.7 times as long as 1e-3.
      double amg_tolerance = 1e-3;
      /// From 20 on (ν = 0.49: 30) all solves around take as many iterations, with 5 twice as many.
      unsigned int amg_iterations = 100;
      /// A motion whose energy is below this part of the largest diagonal entry costs nothing. 1e-15 to 1e-5;
      /// from 1e-3 on the bending of a tall block counts as one.
      double costs_nothing = 1e-9;
      /// A motion is not loaded if the work is below this part of the largest load: 1e-8 to 1e-2; below that
      /// rounding counts as a load.
      double no_load = 1e-6;
      /// What is added to the diagonal, as a part of it. 1e-12 to 1e-6; 1e-5 takes up to two iterations more,
      /// from 1e-4 on tall bodies many.
      double regularization = 1e-9;
    };
    constexpr LevelZeroRule level_zero_rule;
  } // namespace



  bool LevelZero::uses_amg(const NodeIndex n_nodes) const
  {
    return method == LevelZeroMethod::amg || method == LevelZeroMethod::algebraic_shortened ||
           (method == LevelZeroMethod::automatic && n_nodes > level_zero_rule.largest_for_cholesky);
  }



  void LevelZeroSolver::setup(const NodeBlockMatrix &new_matrix)
  {
    matrix  = &new_matrix;
    n_steps = level_zero.method == LevelZeroMethod::algebraic_shortened ? level_zero.n_steps : 0;
    if (!level_zero.free_motions.empty())
      {
        find_kernel(new_matrix);
        make_definite(new_matrix);
        matrix = &definite;
      }
    if (!level_zero.uses_amg(matrix->partition().n_global()))
      {
        amg.reset();
        cholesky.factorize(*matrix, level_zero.is_nearly_singular);
        return;
      }
    amg = std::make_unique<AlgebraicMultigrid>();
    amg->initialize(*matrix, level_zero.near_kernel);
  }



  namespace
  {
    /// The products of some vectors with a matrix and with each other.
    Eigen::MatrixXd energies_of(const std::vector<Vector> &vectors, const NodeBlockMatrix &matrix)
    {
      const auto      n = static_cast<Eigen::Index>(vectors.size());
      Eigen::MatrixXd energies(n, n);
      Vector          vector, product;
      matrix.partition().reinit(vector);
      matrix.partition().reinit(product);
      for (Eigen::Index i = 0; i < n; ++i)
        {
          vector.copy_locally_owned_data_from(vectors[i]);
          matrix.vmult(product, vector);
          for (Eigen::Index j = 0; j < n; ++j)
            energies(i, j) = product * vectors[j];
        }
      return .5 * (energies + energies.transpose());
    }

    /// One combination for each column of coefficients.
    std::vector<Vector> combine(const std::vector<Vector> &vectors, const Eigen::MatrixXd &coefficients,
                                const NodePartition &partition)
    {
      std::vector<Vector> result(coefficients.cols());
      Vector              vector;
      partition.reinit(vector);
      for (Eigen::Index k = 0; k < coefficients.cols(); ++k)
        {
          partition.reinit(result[k]);
          for (Eigen::Index i = 0; i < coefficients.rows(); ++i)
            {
              vector.copy_locally_owned_data_from(vectors[i]);
              result[k].add(coefficients(i, k), vector);
            }
        }
      return result;
    }
  } // namespace



  void LevelZeroSolver::find_kernel(const NodeBlockMatrix &singular)
  {
    const std::vector<Vector> &motions  = level_zero.free_motions;
    const auto                 n        = static_cast<Eigen::Index>(motions.size());
    const double               scale    = diagonal_scale(singular);
    const SymmetricEigen       eigen    = symmetric_eigen(energies_of(motions, singular));
    Eigen::Index               n_kernel = 0;
    while (n_kernel < n && eigen.values[n_kernel] <= level_zero_rule.costs_nothing * scale)
      ++n_kernel;
    const Eigen::MatrixXd basis = eigen.vectors.leftCols(n_kernel);
    Eigen::MatrixXd       weights(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        weights(i, j) = motions[i] * level_zero.motion_weights[j];
    const Eigen::MatrixXd gram = basis.transpose() * weights * basis;
    kernel                     = combine(motions, basis, singular.partition());
    kernel_weights = combine(level_zero.motion_weights, basis * inverse(gram), singular.partition());
  }



  void LevelZeroSolver::make_definite(const NodeBlockMatrix &singular)
  {
    definite = singular;
    for (unsigned int i = 0; i < definite.n_rows(); ++i)
      for (unsigned int k = 0; k < 9; ++k)
        definite.block(definite.diagonal(i))[k] *= 1. + level_zero_rule.regularization;
  }



  void LevelZeroSolver::solve(Vector &solution, const Vector &rhs) const
  {
    if (kernel.empty())
      {
        solve_definite(solution, rhs);
        return;
      }
    largest_rhs                  = std::max(largest_rhs, rhs.l2_norm());
    Vector            consistent = rhs;
    std::vector<bool> is_loaded;
    for (std::size_t k = 0; k < kernel.size(); ++k)
      {
        const double work = kernel[k] * rhs;
        is_loaded.push_back(std::abs(work) > level_zero_rule.no_load * largest_rhs);
        if (!is_loaded.back())
          consistent.add(-work, kernel_weights[k]);
      }
    solve_definite(solution, consistent);
    for (std::size_t k = 0; k < kernel.size(); ++k)
      if (!is_loaded[k])
        solution.add(-(kernel_weights[k] * solution), kernel[k]);
  }



  void LevelZeroSolver::solve_definite(Vector &solution, const Vector &rhs) const
  {
    if (!amg)
      {
        cholesky.solve(solution, rhs);
        return;
      }
    solution = 0.;
    if (n_steps > 0)
      {
        Vector residual, step;
        residual.reinit(rhs);
        step.reinit(rhs);
        for (unsigned int i = 0; i < n_steps; ++i)
          {
            matrix->symmetric_residual(residual, solution, rhs);
            amg->vmult(step, residual);
            solution += step;
          }
        return;
      }
    solve_cg(*matrix, *amg, solution, rhs, level_zero_rule.amg_tolerance, level_zero_rule.amg_iterations);
  }
} // namespace Signorini
