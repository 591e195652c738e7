// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_measurement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    double median(std::vector<double> times)
    {
      std::sort(times.begin(), times.end());
      return times[times.size() / 2];
    }

    /// Collective. Bytes a second in which all ranks read n numbers each.
    template <typename Number>
    double reading_rate(const Number *const begin, const std::size_t n, const MPI_Comm comm)
    {
      std::vector<double> times;
      Number              sum = 0;
      for (unsigned int i = 0; i < 5; ++i)
        {
          Timer  time;
          Number s[8] = {};
          for (std::size_t k = 0; k + 8 <= n; k += 8)
            for (unsigned int j = 0; j < 8; ++j)
              s[j] += begin[k + j];
          sum += std::accumulate(s, s + 8, Number(0));
          times.push_back(time.wall_time());
        }
      volatile Number keep = sum;
      (void)keep;
      return Utilities::MPI::sum(static_cast<double>(n * sizeof(Number)), comm) / median(times);
    }
  } // namespace



  SweepMeasurement measure_sweeps(MultigridHierarchy &hierarchy, const Vector &rhs)
  {
    SweepMeasurement           result;
    const NodeBlockMatrix     &matrix = hierarchy.finest().matrix;
    const MPI_Comm             comm   = matrix.partition().communicator();
    const ProjectedGaussSeidel sweeps(matrix);
    ContactState               free(matrix);
    Vector                     v;
    v.reinit(rhs);
    std::vector<double> times;
    for (unsigned int i = 0; i < 5; ++i)
      {
        Timer time;
        sweeps.sweep(v, rhs, free, Direction::forward);
        times.push_back(time.wall_time());
      }
    result.time             = median(times);
    result.bytes_per_second = Utilities::MPI::sum(sweeps.sweep_bytes(), comm) / result.time;

    const BlockNumbers numbers = matrix.block_data();
    result.read_bytes_per_second =
        numbers.rounded != nullptr
            ? reading_rate(numbers.rounded, 9 * (matrix.n_stored_blocks() - matrix.n_rows()), comm)
            : reading_rate(numbers.exact, 9 * matrix.n_stored_blocks(), comm);
    return result;
  }
} // namespace Signorini
