// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_rate.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    using Phases = std::vector<std::vector<unsigned int>>;

    /// Sweeps and energies of an error that is zero outside of some rows.
    struct ErrorSweeps
    {
      const NodeBlockMatrix      &matrix;
      const ProjectedGaussSeidel &sweeps;
      const Phases               &phases;
      Vector                     &error;
      bool                        has_ghosts;

      void start() const
      {
        for (const auto &rows : phases)
          for (const unsigned int row : rows)
            for (unsigned int c = 0; c < dim; ++c)
              error.local_element(dim * row + c) =
                  1. + .1 * std::sin(1. + 7. * (dim * matrix.partition().to_global(row) + c));
      }

      void exchange() const
      {
        if (has_ghosts)
          error.update_ghost_values();
      }

      void relax(const unsigned int row) const
      {
        double product[dim];
        matrix.multiply_row(product, row, error);
        const double *const inverse = sweeps.inverse_diagonal() + 9 * static_cast<std::size_t>(row);
        for (unsigned int c = 0; c < dim; ++c)
          error.local_element(dim * row + c) -= inverse[dim * c] * product[0] +
                                                inverse[dim * c + 1] * product[1] +
                                                inverse[dim * c + 2] * product[2];
      }

      void forward_and_backward() const
      {
        for (const auto &rows : phases)
          {
            exchange();
            for (const unsigned int row : rows)
              relax(row);
          }
        for (std::size_t i = phases.size(); i-- > 0;)
          {
            exchange();
            for (std::size_t k = phases[i].size(); k-- > 0;)
              relax(phases[i][k]);
          }
      }

      double energy() const
      {
        exchange();
        double sum = 0.;
        for (const auto &rows : phases)
          for (const unsigned int row : rows)
            {
              double product[dim];
              matrix.multiply_row(product, row, error);
              for (unsigned int c = 0; c < dim; ++c)
                sum += error.local_element(dim * row + c) * product[c];
            }
        return has_ghosts ? Utilities::MPI::sum(sum, matrix.partition().communicator()) : sum;
      }

      double rate(const SlowSweepsRule &rule) const
      {
        start();
        for (unsigned int sweep = 1; sweep < rule.measured_sweep; ++sweep)
          forward_and_backward();
        const double before = energy();
        forward_and_backward();
        return before > 0. ? std::sqrt(std::max(0., energy() / before)) : 0.;
      }
    };
  } // namespace



  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const SweepSchedule &rows, const SlowSweepsRule &rule)
  {
    Vector error;
    matrix.partition().reinit(error);
    return ErrorSweeps{matrix, sweeps, rows.phases(), error, true}.rate(rule);
  }



  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const std::vector<unsigned int> &rows, const SlowSweepsRule &rule, Vector &zero)
  {
    const Phases phases = {rows};
    const double rate   = ErrorSweeps{matrix, sweeps, phases, zero, false}.rate(rule);
    for (const unsigned int row : rows)
      for (unsigned int c = 0; c < dim; ++c)
        zero.local_element(dim * row + c) = 0.;
    return rate;
  }
} // namespace Signorini
