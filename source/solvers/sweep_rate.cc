// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_rate.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Sweeps and energies of an error that is zero outside of some rows.
    struct ErrorSweeps
    {
      const NodeBlockMatrix           &matrix;
      const ProjectedGaussSeidel      &sweeps;
      const std::vector<unsigned int> &rows;
      Vector                          &error;

      void start() const
      {
        for (const unsigned int row : rows)
          for (unsigned int c = 0; c < dim; ++c)
            error.local_element(dim * row + c) =
                1. + .1 * std::sin(1. + 7. * (dim * matrix.partition().to_global(row) + c));
      }

      void relax(const unsigned int row) const
      {
        double product[dim];
        matrix.multiply_row(product, row, error);
        const double *const inverse = sweeps.inverse_diagonal() + 9 * static_cast<std::size_t>(row);
        const double        factor  = sweeps.damping()[row];
        for (unsigned int c = 0; c < dim; ++c)
          error.local_element(dim * row + c) -=
              factor * (inverse[dim * c] * product[0] + inverse[dim * c + 1] * product[1] +
                        inverse[dim * c + 2] * product[2]);
      }

      void relax(const std::size_t begin, const std::size_t end, const Direction direction) const
      {
        for (std::size_t k = begin; k < end; ++k)
          relax(rows[direction == Direction::forward ? k : begin + end - 1 - k]);
      }

      double energy() const
      {
        double sum = 0.;
        for (const unsigned int row : rows)
          {
            double product[dim];
            matrix.multiply_row(product, row, error);
            for (unsigned int c = 0; c < dim; ++c)
              sum += error.local_element(dim * row + c) * product[c];
          }
        return sum;
      }

      /// @param sweep goes over all rows in a direction
      /// @param sum over the ranks that take part
      template <typename Sweep, typename Sum>
      double rate(const SlowSweepsRule &rule, const Sweep &sweep, const Sum &sum) const
      {
        const auto forward_and_backward = [&] {
          sweep(Direction::forward);
          sweep(Direction::backward);
        };
        for (unsigned int i = 1; i < rule.measured_sweep; ++i)
          forward_and_backward();
        const double before = sum(energy());
        forward_and_backward();
        return before > 0. ? std::sqrt(std::max(0., sum(energy()) / before)) : 0.;
      }
    };
  } // namespace



  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const SweepSchedule &rows, const SlowSweepsRule &rule)
  {
    Vector error;
    matrix.partition().reinit(error);
    const ErrorSweeps errors{matrix, sweeps, rows.order(), error};
    errors.start();
    error.update_ghost_values();
    const auto sweep = [&](const Direction direction) {
      rows.visit_each(error, direction, [&](const unsigned int row) { errors.relax(row); });
    };
    return errors.rate(rule, sweep, [&](const double energy) {
      return Utilities::MPI::sum(energy, matrix.partition().communicator());
    });
  }



  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const std::vector<unsigned int> &rows, const SlowSweepsRule &rule, Vector &zero)
  {
    const ErrorSweeps errors{matrix, sweeps, rows, zero};
    errors.start();
    const double rate = errors.rate(
        rule, [&](const Direction direction) { errors.relax(0, rows.size(), direction); },
        [](const double energy) { return energy; });
    for (const unsigned int row : rows)
      for (unsigned int c = 0; c < dim; ++c)
        zero.local_element(dim * row + c) = 0.;
    return rate;
  }
} // namespace Signorini
