// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/line_search.h>
#include <signorini/solvers/monotone_multigrid.h>
#include <signorini/solvers/substep_check.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr double no_bound = std::numeric_limits<double>::max();

    struct MonotoneRule
    {
      /// Newton steps, each as far as it is admissible, with sweeps in between. Without half-spaces in the
      /// way the first one is the solution.
      unsigned int n_steps_on_level_zero = 3;
    };
  } // namespace



  MonotoneMultigrid::MonotoneMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters)
    : ObstacleSolver(hierarchy, parameters, hierarchy.n_levels() - 1)
    , work(hierarchy.n_levels() - 1)
  {
    for (unsigned int l = 0; l + 1 < hierarchy.n_levels(); ++l)
      {
        for (Vector *vector : {&work[l].correction, &work[l].rhs, &work[l].residual, &work[l].room})
          hierarchy.level(l).matrix.partition().reinit(*vector);
        hierarchy.level(l + 1).matrix.partition().reinit(work[l].finer);
      }
  }



  HalfSpaces MonotoneMultigrid::half_spaces_of(const unsigned int level) const
  {
    const HalfSpaces &all = hierarchy.level(level).contact;
    HalfSpaces        result;
    for (std::size_t q = 0; q < all.size(); ++q)
      if (const double bound = work[level].room.local_element(dim * all.nodes[q]); bound < no_bound)
        {
          result.nodes.push_back(all.nodes[q]);
          result.normals.push_back(all.normals[q]);
          result.bounds.push_back(bound / all.share(q));
          result.shares.push_back(all.share(q));
        }
    return result;
  }



  void MonotoneMultigrid::restrict_room(const unsigned int to_level, const HalfSpaces &half_spaces,
                                        const Vector &values, const std::vector<unsigned char> *const active)
  {
    const NodalTransfer &transfer = hierarchy.level(to_level).to_finer;
    const NodePartition &coarse   = hierarchy.level(to_level).matrix.partition();
    Vector              &room     = work[to_level].room;
    for (unsigned int i = 0; i < dim * coarse.n_local(); ++i)
      room.local_element(i) = no_bound;
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      {
        if (active != nullptr && (*active)[p])
          continue;
        const double left =
            half_spaces.share(p) * std::max(0., half_spaces.bounds[p] - half_spaces.normal_part(p, values));
        const unsigned int row    = half_spaces.nodes[p];
        const Block *const blocks = transfer.row_blocks(row);
        for (std::size_t k = transfer.row_begin(row); k < transfer.row_end(row); ++k)
          if (blocks != nullptr ? blocks[k - transfer.row_begin(row)].norm_square() > 0.
                                : transfer.weight(k) != 0.)
            {
              double &bound = *(room.begin() + dim * transfer.column(k));
              bound         = std::min(bound, left);
            }
      }
    room.compress(VectorOperation::min);
  }



  void MonotoneMultigrid::solve_level_zero()
  {
    MultigridLevel &coarsest = hierarchy.level(0);
    Work           &w        = work[0];
    w.contact                = ContactState(coarsest.matrix, half_spaces_of(0));
    w.correction             = 0.;
    Vector step;
    step.reinit(w.correction);
    for (unsigned int i = 0; i < MonotoneRule().n_steps_on_level_zero; ++i)
      {
        coarsest.matrix.symmetric_residual(w.residual, w.correction, w.rhs);
        hierarchy.coarse_solver().solve(step, w.residual);
        const HalfSpaces &spaces = w.contact.half_spaces();
        const double      length = std::min(1., Utilities::MPI::min(spaces.longest_step(w.correction, step),
                                                                    coarsest.matrix.partition().communicator()));
        w.correction.add(length, step);
        if (length == 1.)
          break;
        for (const auto direction : {Direction::forward, Direction::backward})
          coarsest.smoother->smooth(w.correction, w.rhs, w.contact, parameters.smoothing, direction);
      }
  }



  void MonotoneMultigrid::correct_level(const unsigned int level)
  {
    if (level == 0)
      {
        solve_level_zero();
        return;
      }
    MultigridLevel &here  = hierarchy.level(level);
    Work           &w     = work[level];
    Work           &below = work[level - 1];
    w.contact             = ContactState(here.matrix, half_spaces_of(level));
    here.smoother->smooth_from_zero(w.correction, w.rhs, w.contact, parameters.smoothing, w.residual);
    below.rhs = 0.;
    restrict_defect(hierarchy.level(level - 1), below.rhs, w.residual);
    restrict_room(level - 1, w.contact.half_spaces(), w.correction, nullptr);
    correct_level(level - 1);
    hierarchy.level(level - 1).to_finer.prolongate(below.finer, below.correction);
    w.correction.zero_out_ghost_values();
    w.correction += below.finer;

    here.smoother->smooth_to_residual(w.correction, w.rhs, w.contact, parameters.smoothing, nullptr);
  }



  void MonotoneMultigrid::add_coarse_correction(Vector &v, Vector &residual, const ObstacleProblem &problem)
  {
    const unsigned int coarse = level - 1;
    work[coarse].rhs          = 0.;
    restrict_defect(hierarchy.level(coarse), work[coarse].rhs, residual);
    restrict_room(coarse, problem.half_spaces, v, &contact.active());
    correct_level(coarse);
    hierarchy.level(coarse).to_finer.prolongate(work[coarse].finer, work[coarse].correction);
    v.zero_out_ghost_values();
    const Vector &step = work[coarse].finer;
    contact.restrict_to_tangents(residual);
    v.add(search_along(matrix(), step, residual, contact.longest_step(v, step), problem.semidefinite).length,
          step);
  }



  ConvergenceReport MonotoneMultigrid::solve(Vector &v, const ObstacleProblem &problem,
                                             const Monitor &monitor)
  {
    Smoother &smoother = *hierarchy.level(level).smoother;
    contact            = ContactState(matrix(), problem.half_spaces);
    contact.project(v);

    ConvergenceReport report;
    SubstepCheck      check(matrix(), problem, report, parameters.check_monotonicity);
    Vector            start, residual, product;
    for (Vector *vector : {&start, &residual, &product})
      vector->reinit(v);
    unsigned int n_updates = 0;
    while (goes_on(report))
      {
        start.copy_locally_owned_data_from(v);
        smoother.smooth(v, problem.rhs, contact, parameters.smoothing, Direction::forward);
        check(v);

        if (hierarchy.truncate(level, problem.half_spaces, contact.active()))
          ++n_updates;
        matrix().symmetric_residual(residual, v, problem.rhs);
        const double square = v * problem.rhs - v * residual;
        add_coarse_correction(v, residual, problem);
        check(v);

        smoother.smooth(v, problem.rhs, contact, parameters.smoothing, Direction::backward);
        check(v);
        start.sadd(-1., 1., v);
        matrix().vmult(product, start);
        book_iteration(report, std::sqrt(std::max(start * product, 0.)), std::sqrt(std::max(square, 0.)),
                       monitor);
      }
    close(report, v, problem);
    report.hierarchy_updates = n_updates;
    return report;
  }
} // namespace Signorini
