// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/active_set_solver.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct ActiveSetRule
    {
      /// Active sets before another method has its turn: where it ends it takes 2 to 7 of them.
      unsigned int n_sets = 15;
      /// Part of the first correction on a set that is left when an inexact solver may see another set.
      double inexact = 1e-3;
      /// Forces and penetrations below this part of the node's stiffness times the largest displacement are
      /// rounding: a node with neither stays what it is.
      double rounding = 1e-13;
    };
    constexpr ActiveSetRule active_set_rule;
  } // namespace



  ActiveSetSolver::ActiveSetSolver(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                                   const unsigned int level, PlaneSolver &planes)
    : ObstacleSolver(hierarchy, parameters, level)
    , planes(planes)
  {
    for (Vector *vector : {&residual, &tangential, &correction, &product, &best})
      matrix().partition().reinit(*vector);
  }



  ConvergenceReport ActiveSetSolver::solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor)
  {
    ConvergenceReport report;
    contact = ContactState(matrix(), problem.half_spaces);
    contact.project(v);
    const std::vector<unsigned char> active = contact.active();
    go_on(v, active, problem, report, monitor);
    close(report, v, problem);
    return report;
  }



  bool ActiveSetSolver::go_on(Vector &v, const std::vector<unsigned char> &active,
                              const ObstacleProblem &problem, ConvergenceReport &report,
                              const Monitor &monitor)
  {
    contact = ContactState(matrix(), problem.half_spaces);
    for (std::size_t p = 0; p < active.size(); ++p)
      contact.set_active(p, active[p]);
    FreeMotionCorrection motions(matrix(), problem.free_motions, problem.rhs);
    best = v;
    matrix().symmetric_residual(residual, v, problem.rhs);
    least_energy = -.5 * (problem.rhs * v + residual * v);
    for (unsigned int k = 0; k < active_set_rule.n_sets; ++k)
      {
        const Outcome outcome = solve_on_planes(v, problem, motions, report, monitor);
        if (outcome == Outcome::converged)
          {
            const std::vector<unsigned char> flags = contact.active();
            contact.project(v);
            for (std::size_t p = 0; p < flags.size(); ++p)
              contact.set_active(p, flags[p]);
            return true;
          }
        offer(v, problem);
        if (outcome == Outcome::stopped)
          break;
      }
    v = best;
    contact.project(v);
    return false;
  }



  double ActiveSetSolver::move_to_planes(Vector &v)
  {
    const HalfSpaces &spaces = contact.half_spaces();
    correction               = 0.;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (contact.active()[p])
        spaces.add_normal(correction, p, spaces.bounds[p] - spaces.normal_part(p, v));
    matrix().vmult(product, correction);
    correction.zero_out_ghost_values();
    v.zero_out_ghost_values();
    v += correction;
    return std::sqrt(std::max(correction * product, 0.));
  }



  void ActiveSetSolver::find_correction(const Vector &v, const FreeMotionCorrection &motions)
  {
    tangential = residual;
    contact.restrict_to_tangents(tangential);
    const std::vector<double> moved = motions.minimize(tangential);
    planes.correct(correction, tangential);
    // Smoothing in single precision leaves a little along normals that are no axes.
    contact.restrict_to_tangents(correction);
    motions.complete(correction, moved, tangential, v, contact);
    correction.update_ghost_values();
  }



  ActiveSetSolver::Outcome ActiveSetSolver::solve_on_planes(Vector &v, const ObstacleProblem &problem,
                                                            FreeMotionCorrection &motions,
                                                            ConvergenceReport &report, const Monitor &monitor)
  {
    motions.update(contact);
    if (motions.is_driven())
      return Outcome::stopped;
    ++n_sets;
    planes.setup(contact.half_spaces(), contact.active());
    double moved = move_to_planes(v), first = 0.;
    matrix().symmetric_residual(residual, v, problem.rhs);
    conjugate.restart();
    bool is_seen = false;
    while (goes_on(report))
      {
        find_correction(v, motions);
        matrix().vmult(product, correction);
        correction.zero_out_ghost_values();
        const double length = conjugate.find_step(correction, product, residual, contact);
        v.zero_out_ghost_values();
        v.add(length, conjugate.direction());
        residual.add(-length, conjugate.product());
        const double norm =
            moved + length * std::sqrt(std::max(conjugate.direction() * conjugate.product(), 0.));
        first               = std::max(first, norm);
        const double square = v * problem.rhs - v * residual;
        book_iteration(report, norm, std::sqrt(std::max(square, 0.)), monitor);
        moved = 0.;
        // A length of zero is rounding: this is as far as it goes.
        if (!(planes.is_exact() || report.converged || length == 0. ||
              (!is_seen && norm <= active_set_rule.inexact * first)))
          continue;
        is_seen = true;
        if (update_set(v))
          {
            report.converged = report.stagnated = false;
            report.note.clear();
            return Outcome::set_changed;
          }
        if (report.converged || length == 0.)
          {
            report.converged = true;
            return Outcome::converged;
          }
      }
    return Outcome::stopped;
  }



  bool ActiveSetSolver::update_set(const Vector &v)
  {
    const HalfSpaces &spaces   = contact.half_spaces();
    const double      rounding = active_set_rule.rounding * v.linfty_norm();
    bool              changes  = false;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      {
        const Block  block     = read_block(matrix().block(matrix().diagonal(spaces.nodes[p])));
        const double stiffness = spaces.normals[p] * (block * spaces.normals[p]);
        const bool   now = contact.active()[p] ? spaces.normal_part(p, residual) >= -rounding * stiffness
                                               : spaces.normal_part(p, v) - spaces.bounds[p] > rounding;
        changes          = changes || now != static_cast<bool>(contact.active()[p]);
        contact.set_active(p, now);
      }
    return Utilities::MPI::max(static_cast<int>(changes), matrix().partition().communicator()) != 0;
  }



  void ActiveSetSolver::offer(const Vector &v, const ObstacleProblem &problem)
  {
    const std::vector<unsigned char> flags = contact.active();
    correction                             = v;
    contact.project(correction);
    for (std::size_t p = 0; p < flags.size(); ++p)
      contact.set_active(p, flags[p]);
    matrix().symmetric_residual(tangential, correction, problem.rhs);
    const double energy = -.5 * (problem.rhs * correction + tangential * correction);
    if (energy < least_energy)
      {
        least_energy = energy;
        best         = correction;
      }
  }
} // namespace Signorini
