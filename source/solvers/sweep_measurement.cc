// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/sweep_measurement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

namespace Signorini
{
  using namespace dealii;

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
    std::sort(times.begin(), times.end());
    result.time             = times[2];
    result.bytes_per_second = Utilities::MPI::sum(sweeps.sweep_bytes(), comm) / times[2];

    const double     *begin = matrix.block(0);
    const std::size_t n     = 9 * matrix.n_stored_blocks();
    times.clear();
    double sum = 0.;
    for (unsigned int i = 0; i < 5; ++i)
      {
        Timer  time;
        double s[8] = {};
        for (std::size_t k = 0; k + 8 <= n; k += 8)
          for (unsigned int j = 0; j < 8; ++j)
            s[j] += begin[k + j];
        sum += std::accumulate(s, s + 8, 0.);
        times.push_back(time.wall_time());
      }
    std::sort(times.begin(), times.end());
    volatile double keep = sum;
    (void)keep;
    result.read_bytes_per_second =
        Utilities::MPI::sum(static_cast<double>(n * sizeof(double)), comm) / times[2];
    return result;
  }
} // namespace Signorini
