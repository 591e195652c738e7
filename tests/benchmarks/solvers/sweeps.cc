// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The parts of a cycle on a cube of n^3 cells (n a power of two), in sweeps of its finest level:
//   bench_sweeps [n]

#include <signorini/algebra/galerkin_product.h>
#include <signorini/solvers/sweep_measurement.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdio>
#include <solvers/cube_problem.h>

using namespace Signorini;

namespace
{
  /// Median of some runs, in seconds.
  template <class Function>
  double median_time(const Function &function)
  {
    std::vector<double> times;
    for (unsigned int i = 0; i < 7; ++i)
      {
        const auto start = std::chrono::steady_clock::now();
        function();
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      }
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int                             n         = argc > 1 ? std::stoi(argv[1]) : 64;
  MultigridHierarchy                             hierarchy = CubeProblem::hierarchy(n);
  const NodeBlockMatrix                         &matrix    = hierarchy.finest().matrix;
  Smoother                                      &smoother  = *hierarchy.finest().smoother;
  const ProjectedGaussSeidel                     sweeps(matrix);
  ContactState                                   contact(matrix);
  Vector                                         v, rhs, residual;
  for (Vector *vector : {&v, &rhs, &residual})
    matrix.partition().reinit(*vector);
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
    rhs.local_element(i) = std::sin(i);

  const SweepMeasurement measured = measure_sweeps(hierarchy, rhs);
  const auto             print    = [&](const char *name, const double time) {
    std::printf("%-44s %8.2f ms %7.2f sweeps\n", name, 1e3 * time, time / measured.time);
  };
  std::printf("%u unknowns, sweep %.1f GB/s, read %.1f GB/s\n", 3 * matrix.n_rows(),
              1e-9 * measured.bytes_per_second, 1e-9 * measured.read_bytes_per_second);
  print("forward sweep", measured.time);
  print("backward sweep", median_time([&] { sweeps.sweep(v, rhs, contact, Direction::backward); }));
  print("product, half of the matrix", median_time([&] { matrix.subtract_product(residual, v); }));
  print("product", median_time([&] { matrix.vmult(residual, v); }));
  print("V(1,1) down: sweep from zero, residual", median_time([&] {
          smoother.smooth_from_zero(v, rhs, contact, {1, 1, 0}, residual);
        }));
  print("V(1,1) up: sweep, residual", median_time([&] {
          smoother.smooth_to_residual(v, rhs, contact, {1, 1, 0}, &residual);
        }));
  print("V(3,3) down", median_time([&] { smoother.smooth_from_zero(v, rhs, contact, {3, 3, 0}, residual); }));
  print("V(3,3) up", median_time([&] {
          smoother.smooth_to_residual(v, rhs, contact, {3, 3, 0}, &residual);
        }));
  print("vector: a += b", median_time([&] { v += rhs; }));
  MultigridLevel &coarse = hierarchy.level(hierarchy.n_levels() - 2);
  Vector          small;
  coarse.matrix.partition().reinit(small);
  print("restriction", median_time([&] { restrict_defect(coarse, small, residual); }));
  print("prolongation", median_time([&] { coarse.to_finer.prolongate(residual, small); }));
  print("Galerkin product", median_time([&] { compute_galerkin(coarse.matrix, matrix, coarse.to_finer); }));
  print("smoother: setup", median_time([&] { ProjectedGaussSeidel again(matrix); }));
}
