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
    struct ActiveSetAmgRule
    {
      /// Bound for the cycles of one linear problem, that none should reach: 10 to 150 are usual, ν = 0.49
      /// (M1) takes up to 230, a stiffness ratio of 1e-6 840; stopped before, the active set is that of
      /// another problem.
      unsigned int most_cycles = 1000;
    };
  } // namespace



  void ActiveSetAmg::remove_normal_parts(Vector &x, const HalfSpaces &half_spaces) const
  {
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      if (is_active[p])
        half_spaces.add_normal(x, p, -half_spaces.normal_part(p, x));
  }



  struct ActiveSetAmg::LinearProblem
  {
    NodeBlockMatrix    matrix;
    AlgebraicMultigrid amg;
    /// Largest residual so far.
    double reference = 0.;
    Vector residual, correction;
  };



  unsigned int ActiveSetAmg::solve_linear(Vector &v, const ObstacleProblem &problem,
                                          LinearProblem &linear) const
  {
    const HalfSpaces &spaces = problem.half_spaces;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (is_active[p])
        spaces.add_normal(v, p, spaces.bounds[p] - spaces.normal_part(p, v));
    matrix().symmetric_residual(linear.residual, v, problem.rhs);
    remove_normal_parts(linear.residual, spaces);
    const double size     = linear.residual.l2_norm();
    linear.reference      = std::max(linear.reference, size);
    linear.correction     = 0.;
    unsigned int n_cycles = 0;
    if (size > parameters.tolerance * linear.reference)
      n_cycles = solve_cg(linear.matrix, linear.amg, linear.correction, linear.residual,
                          parameters.tolerance * linear.reference / size, ActiveSetAmgRule().most_cycles);
    v += linear.correction;
    return n_cycles;
  }



  bool ActiveSetAmg::update_active(const Vector &v, const Vector &residual, const HalfSpaces &half_spaces)
  {
    bool changed = false;
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      {
        const Vector3 &normal    = half_spaces.normals[p];
        const Block    block     = read_block(matrix().block(matrix().diagonal(half_spaces.nodes[p])));
        const double   stiffness = normal * (block * normal);
        const double   excess    = is_active[p] ? 0. : half_spaces.normal_part(p, v) - half_spaces.bounds[p];
        const double   force     = is_active[p] ? half_spaces.normal_part(p, residual) : 0.;
        const unsigned char now  = force + stiffness * excess > 0.;
        changed                  = changed || now != is_active[p];
        is_active[p]             = now;
      }
    return Utilities::MPI::max(static_cast<int>(changed), matrix().partition().communicator()) != 0;
  }



  ConvergenceReport ActiveSetAmg::solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor)
  {
    const HalfSpaces &spaces = problem.half_spaces;
    contact                  = ContactState(matrix(), spaces);
    contact.project(v);
    is_active = contact.active();

    ConvergenceReport report;
    LinearProblem     linear;
    Vector            step, product;
    for (Vector *vector : {&linear.residual, &linear.correction, &step, &product})
      vector->reinit(v);
    bool changed = true;
    while (goes_on(report))
      {
        if (changed)
          {
            linear.matrix                   = matrix_on_planes(matrix(), spaces, is_active);
            std::vector<Vector> near_kernel = problem.near_kernel;
            for (Vector &mode : near_kernel)
              remove_normal_parts(mode, spaces);
            linear.amg.initialize(linear.matrix, near_kernel);
            ++report.hierarchy_updates;
          }
        step = v;
        report.linear_cycles += solve_linear(v, problem, linear);
        step.sadd(-1., 1., v);

        matrix().vmult(product, v);
        const double square = v * product;
        product.sadd(-1., 1., problem.rhs);
        changed = update_active(v, product, spaces);
        matrix().vmult(product, step);
        book_iteration(report, std::sqrt(std::max(step * product, 0.)), std::sqrt(std::max(square, 0.)),
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
