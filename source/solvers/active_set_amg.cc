// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/active_set_amg.h>
#include <signorini/solvers/plane_solver.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_cycles = 1000;

  } // namespace



  void ActiveSetAmg::remove_normal_parts(Vector &x, const HalfSpaces &half_spaces) const
  {
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      if (is_active[p])
        half_spaces.add_normal(x, p, -half_spaces.normal_part(p, x));
  }



  ConvergenceReport ActiveSetAmg::solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor)
  {
    const NodeBlockMatrix &matrix = this->matrix();
    const HalfSpaces      &spaces = problem.half_spaces;
    const MPI_Comm         comm   = matrix.partition().communicator();
    contact                       = ContactState(matrix, spaces);
    contact.project(v);
    is_active = contact.active();

    ConvergenceReport  report;
    AlgebraicMultigrid amg;
    NodeBlockMatrix    reduced;
    Vector             residual, correction, product;
    for (Vector *vector : {&residual, &correction, &product})
      vector->reinit(v);
    double reference = 0.;
    bool   changed   = true;
    while (goes_on(report))
      {
        if (changed)
          {
            reduced                         = matrix_on_planes(matrix, spaces, is_active);
            std::vector<Vector> near_kernel = problem.near_kernel;
            for (Vector &mode : near_kernel)
              remove_normal_parts(mode, spaces);
            amg.initialize(reduced, near_kernel);
            ++report.hierarchy_updates;
          }
        const Vector start = v;
        for (std::size_t p = 0; p < spaces.size(); ++p)
          if (is_active[p])
            spaces.add_normal(v, p, spaces.bounds[p] - spaces.normal_part(p, v));
        matrix.symmetric_residual(residual, v, problem.rhs);
        remove_normal_parts(residual, spaces);
        const double size = residual.l2_norm();
        reference         = std::max(reference, size);
        correction        = 0.;
        if (size > parameters.tolerance * reference)
          report.linear_cycles += solve_cg(reduced, amg, correction, residual,
                                           parameters.tolerance * reference / size, most_cycles);
        v += correction;

        // Contact pressure where it pushes, or penetration, in the measure of the node's own stiffness.
        matrix.vmult(residual, v);
        const double square = v * residual;
        residual.sadd(-1., 1., problem.rhs);
        changed = false;
        for (std::size_t p = 0; p < spaces.size(); ++p)
          {
            const Block         block     = read_block(matrix.block(matrix.diagonal(spaces.nodes[p])));
            const double        stiffness = spaces.normals[p] * (block * spaces.normals[p]);
            const double        excess    = is_active[p] ? 0. : spaces.normal_part(p, v) - spaces.bounds[p];
            const double        force     = is_active[p] ? spaces.normal_part(p, residual) : 0.;
            const unsigned char now       = force + stiffness * excess > 0.;
            changed                       = changed || now != is_active[p];
            is_active[p]                  = now;
          }
        changed    = Utilities::MPI::max(static_cast<int>(changed), comm) != 0;
        correction = v;
        correction -= start;
        matrix.vmult(product, correction);
        book_iteration(report, std::sqrt(std::max(correction * product, 0.)), std::sqrt(std::max(square, 0.)),
                       monitor);
        // The active set decides; the linear problems have been solved to the tolerance.
        report.converged = !changed;
        report.stagnated = false;
        report.note.clear();
      }
    close(report, v, problem);
    return report;
  }
} // namespace Signorini
