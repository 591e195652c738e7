// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/solvers/truncated_cycle.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct PlaneRule
    {
      /// Of the energy of a correction, that of bringing active nodes back to their planes. The way there is
      /// as long as it is: times the length of a step of conjugate gradients it ends beyond them, and where
      /// that length is above 2 again and again the distance grows (a light shaft in a V-block: from rounding
      /// to a hundred times the deformation, 65 iterations instead of 5).
      double largest_share = 1e-3;
    };
  } // namespace



  TruncatedCycle::TruncatedCycle(MultigridHierarchy &hierarchy, const unsigned int level,
                                 const SmoothingParameters &coarse_smoothing, const ObstacleProblem &problem,
                                 ContactState &contact, const bool knows_contact)
    : hierarchy(hierarchy)
    , level(level)
    , problem(problem)
    , contact(contact)
    , cycle(hierarchy, coarse_smoothing, level - 1)
    , has_subspace(ContactSubspace::exists(hierarchy, level, problem))
    , motions(hierarchy.level(level).matrix, problem.free_motions, problem.rhs)
    , stays_blocked(!knows_contact)
  {
    for (Vector *vector : {&coarse_defect, &coarse_correction})
      hierarchy.level(level - 1).matrix.partition().reinit(*vector);
    for (Vector *vector : {&correction, &product, &new_residual, &step, &tangential})
      hierarchy.level(level).matrix.partition().reinit(*vector);
  }



  bool TruncatedCycle::all_ranks(const bool condition) const
  {
    return Utilities::MPI::min(static_cast<int>(condition),
                               hierarchy.level(level).matrix.partition().communicator()) != 0;
  }



  void TruncatedCycle::run(const Vector &v, Vector &residual, const Plan &plan, SubstepCheck &check)
  {
    Smoother                        &smoother = *hierarchy.level(level).smoother;
    const std::vector<unsigned char> active   = contact.active();
    contact.set_bounds_from(problem.half_spaces, v);
    check.begin_iteration();
    motions.restore_work(residual);
    smoother.smooth_from_zero(correction, residual, contact, plan.smoothing, new_residual);
    motions.restore_work(new_residual);
    check(v, correction);
    const bool may_minimize = has_subspace && plan.phase != IterationPhase::resting;
    if (may_minimize && stays_blocked)
      {
        minimize_in_subspace();
        check(v, correction);
      }

    keeps_active = contact.active() == active;
    searched     = plan.trusts_kept_set ? plan.phase == IterationPhase::on_the_way || !all_ranks(keeps_active)
                                        : plan.phase != IterationPhase::resting;
    cut_off      = correct();
    if (may_minimize && is_blocked)
      {
        check(v, correction);
        hierarchy.level(level).matrix.vmult(product, correction);
        new_residual = residual;
        new_residual -= product;
        minimize_in_subspace();
        check(v, correction);
        keeps_active = contact.active() == active;
        cut_off      = correct();
        // A body that is still on its way to contacts is not in the way of itself.
        stays_blocked = is_blocked && !motions.is_driven();
      }
    if (searched)
      check(v, correction);
    else
      // Without a search the iteration as a whole lowers the energy, not each step after the first.
      check.return_to_start();

    smoother.smooth_to_residual(correction, residual, contact, plan.smoothing, &new_residual);
    motions.restore_work(new_residual);
    keeps_active  = all_ranks(keeps_active && contact.active() == active);
    stays_blocked = stays_blocked && (is_blocked || !keeps_active);
    product       = residual;
    product -= new_residual;
    is_on_planes = contact.normal_energy(hierarchy.level(level).matrix, correction) <=
                   PlaneRule().largest_share * std::abs(correction * product);
  }



  std::vector<NodeIndex> TruncatedCycle::nodes_of_subspace() const
  {
    const NodePartition   &partition = hierarchy.level(level).matrix.partition();
    std::vector<NodeIndex> own;
    for (const NodeIndex node : hierarchy.level(level).contact_nodes)
      if (partition.owns(node) && contact.at(partition.to_local(node)) >= 0)
        own.push_back(node);
    return gather_lists(std::move(own), partition.communicator(), Receivers::all);
  }



  void TruncatedCycle::minimize_in_subspace()
  {
    ++n_minimizations;
    if (!subspace)
      subspace.emplace(hierarchy, level, nodes_of_subspace(), problem.free_motions);
    subspace->run(correction, new_residual, contact, motions);
  }



  void TruncatedCycle::find_step()
  {
    tangential = new_residual;
    contact.restrict_to_tangents(tangential);
    motions.update(contact);
    const std::vector<double> moved = motions.minimize(tangential);
    coarse_defect                   = 0.;
    restrict_defect(hierarchy.level(level - 1), coarse_defect, tangential);
    cycle.apply(coarse_correction, coarse_defect);
    hierarchy.level(level - 1).to_finer.prolongate(step, coarse_correction);
    contact.restrict_to_tangents(step);
    correction.zero_out_ghost_values();
    motions.complete(step, moved, tangential, correction, contact);
  }



  double TruncatedCycle::correct()
  {
    if (hierarchy.truncate(level, contact.half_spaces(), contact.active()))
      ++n_updates;
    find_step();
    // Such a motion has no energy, but what it wins has not come to an end.
    const double driven = motions.is_driven() ? std::sqrt(std::max(tangential * step, 0.)) : 0.;
    const double length = std::min(1., contact.longest_step(correction, step));
    searched            = searched || length < 1.;
    is_blocked          = motions.is_driven();
    double won          = 0.;
    if (searched)
      {
        contact.restrict_to_tangents(new_residual);
        won = add_better(length);
      }
    else
      correction.add(length, step);
    // Where the step did not run into anything.
    if (length == 1.)
      won = std::max(won, std::sqrt(motions.drive(correction, contact)));
    return std::max(driven, won);
  }



  double TruncatedCycle::add_better(const double length)
  {
    const NodeBlockMatrix &matrix = hierarchy.level(level).matrix;
    const auto             search = [&] {
      return search_along(matrix, step, new_residual, contact.longest_step(correction, step),
                                      problem.semidefinite);
    };
    if (length == 1.)
      {
        correction.add(search().length, step);
        return 0.;
      }
    // A V-cycle is at most the inverse of A: the slope is at least the curvature.
    const double square   = std::max(new_residual * step, 0.);
    const double decrease = (length - .5 * length * length) * square;
    const Vector whole    = step;
    contact.project_correction(step, correction);
    LineSearch best = search();
    if (best.decrease < decrease)
      {
        step = whole;
        step *= length;
        best = search();
      }
    correction.add(best.length, step);
    is_blocked = is_blocked || best.decrease < ContactSubspace::Rule().least_decrease * .5 * square;
    return std::sqrt(square);
  }



  double TruncatedCycle::norm() const
  {
    return std::max(std::sqrt(std::max(correction * product, 0.)), cut_off);
  }



  bool TruncatedCycle::shorten(Vector &residual)
  {
    double length = 1.;
    if (!searched)
      {
        double slope = residual * correction;
        if (keeps_active)
          slope -= contact.normal_product(residual, correction);
        const double curvature = correction * product;
        length                 = slope <= 0. ? 0. : curvature > slope ? slope / curvature : 1.;
      }
    if (length == 1.)
      {
        residual.swap(new_residual);
        return false;
      }
    correction *= length;
    residual.add(-length, product);
    return true;
  }



  void TruncatedCycle::replace(const double length, const Vector &direction, const Vector &direction_product,
                               Vector &residual)
  {
    correction.equ(length, direction);
    product.equ(length, direction_product);
    residual -= product;
  }
} // namespace Signorini
