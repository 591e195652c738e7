// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "motion_columns.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/loose_motions.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/discretization/rigid_support.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The half-spaces that a motion of at most some length along some directions may leave, as rows (normal
    /// parts of a step along each direction) and what is left to the bounds.
    struct Reach
    {
      std::vector<double> rows, bounds;
    };

    Reach half_spaces_in_reach(const HalfSpaces &spaces, const Vector &v,
                               const std::vector<Vector> &directions, const double length)
    {
      const auto      n = static_cast<Eigen::Index>(directions.size());
      Eigen::MatrixXd parts(n, spaces.size());
      double          largest = 0.;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        {
          double squares = 0.;
          for (Eigen::Index k = 0; k < n; ++k)
            {
              parts(k, p) = spaces.normal_part(p, directions[k]);
              squares += nodal_value(directions[k], spaces.nodes[p]).norm_square();
            }
          largest = std::max(largest, std::sqrt(squares));
        }
      largest = Utilities::MPI::max(largest, v.get_mpi_communicator());
      Reach result;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        {
          const double left  = std::max(0., spaces.bounds[p] - spaces.normal_part(p, v));
          const double slope = parts.col(p).norm();
          if (slope <= LooseMotionRule().rounding * largest || slope * length <= left)
            continue;
          result.rows.insert(result.rows.end(), parts.col(p).begin(), parts.col(p).end());
          result.bounds.push_back(left);
        }
      for (std::vector<double> *const list : {&result.rows, &result.bounds})
        *list = gather_lists(std::move(*list), v.get_mpi_communicator(), Receivers::all);
      return result;
    }

    /// Linear combinations of some vectors, one for each column.
    std::vector<Vector> combine(const std::vector<Vector> &vectors, const Eigen::MatrixXd &coefficients)
    {
      std::vector<Vector> result(coefficients.cols());
      for (Eigen::Index k = 0; k < coefficients.cols(); ++k)
        {
          result[k].reinit(vectors[0]);
          for (std::size_t i = 0; i < vectors.size(); ++i)
            result[k].add(coefficients(i, k), vectors[i]);
        }
      return result;
    }
  } // namespace



  void minimize_displacement(Vector &v, const Vector &u, const std::vector<std::vector<double>> &motions,
                             const std::vector<Vector> &fields, const std::vector<Vector> &displacements,
                             const HalfSpaces &spaces)
  {
    const auto                n            = static_cast<Eigen::Index>(motions.size());
    const Eigen::MatrixXd     coefficients = as_columns(motions);
    const std::vector<Vector> z            = combine(displacements, coefficients);
    // |u + Z x|^2 = |y + L^-1 Z^T u|^2 + const., where Z^T Z = L L^T, y = L^T x.
    Eigen::MatrixXd gram(n, n);
    Eigen::VectorXd target(n);
    for (Eigen::Index k = 0; k < n; ++k)
      {
        target[k] = -(z[k] * u);
        for (Eigen::Index l = 0; l <= k; ++l)
          gram(k, l) = gram(l, k) = z[k] * z[l];
      }
    const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
    cholesky.matrixL().solveInPlace(target);
    const Eigen::MatrixXd inverse = cholesky.matrixU().solve(Eigen::MatrixXd::Identity(n, n));
    const auto            steps   = combine(fields, coefficients * inverse);
    const Reach           reach   = half_spaces_in_reach(spaces, v, steps, target.norm());
    const auto            y =
        nearest_admissible(reach.rows, reach.bounds, std::vector<double>(target.begin(), target.end()));
    for (Eigen::Index k = 0; k < n; ++k)
      v.add(y[k], steps[k]);
  }
} // namespace Signorini
