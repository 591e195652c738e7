// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_truncated_cycle_h
#define signorini_solvers_truncated_cycle_h

#include <signorini/solvers/contact_subspace.h>
#include <signorini/solvers/free_motion_correction.h>
#include <signorini/solvers/iteration_phase.h>
#include <signorini/solvers/line_search.h>
#include <signorini/solvers/substep_check.h>
#include <signorini/solvers/v_cycle.h>

namespace Signorini
{
  /// One correction z of an iterate v: projected smoothing on a level, one linear V-cycle on the spaces below
  /// truncated at active nodes, the better of this correction projected and shortened with exact line search,
  /// smoothing. Where nodes in the way leave little of the correction, the minimizer in the contact subspace
  /// follows, and a second correction. It hands out A z, which costs no product, but where there was a
  /// minimizer.
  class TruncatedCycle
  {
  public:
    /// All must outlive the object; the truncation of the hierarchy is changed.
    /// @param level the finest one of the problem
    /// @param knows_contact whether the start carries loads, as that of another mesh or load does
    TruncatedCycle(MultigridHierarchy &hierarchy, const unsigned int level,
                   const SmoothingParameters &coarse_smoothing, const ObstacleProblem &problem,
                   ContactState &contact, const bool knows_contact);

    /// How a run goes about it.
    struct Plan
    {
      /// On the finest level.
      SmoothingParameters smoothing;
      IterationPhase      phase;
      /// Whether a set that the first half keeps is mostly the last one: then no search, which costs a
      /// product. From a good start it is.
      bool trusts_kept_set;
    };

    /// Collective. The correction of v, with residual = b - A v, of which rounding along free motions is
    /// taken out (FreeMotionCorrection::restore_work()).
    void run(const Vector &v, Vector &residual, const Plan &plan, SubstepCheck &check);

    /// Collective. The energy norm of the correction, before anything was cut off.
    double norm() const;

    /// Whether the correction is a linear function of the residual.
    bool is_linear(const IterationPhase phase) const
    {
      return keeps_active && is_on_planes && phase != IterationPhase::on_the_way && cut_off == 0.;
    }

    /// Collective. Shortens the correction, where that is due because it was not searched, so that it lowers
    /// the energy, and updates the residual of v by it; whether it was shortened.
    bool shorten(Vector &residual);

    /// Collective. Takes a step of conjugate gradients for the correction, and updates the residual of v by
    /// it.
    void replace(const double length, const Vector &direction, const Vector &direction_product,
                 Vector &residual);

    /// Whether the next runs can begin in the contact subspace, and do not yet.
    bool may_begin_in_subspace() const
    {
      return has_subspace && !stays_blocked;
    }

    /// Has them begin there, until the active set rests or a minimizer has cleared the way.
    void begin_in_subspace()
    {
      stays_blocked = true;
    }

    /// z, and A z.
    Vector correction, product;

    /// How often the hierarchy was truncated anew; how many minimizers in the contact subspace there were.
    unsigned int n_updates = 0, n_minimizations = 0;

  private:
    bool all_ranks(const bool condition) const;

    /// Collective. step = the coarse correction on the finest level, tangential at active nodes, with the
    /// free motions before and after it.
    void find_step();

    /// Adds the truncated V-cycle of the residual to the correction: by add_better() if `searched` is set or
    /// something is not admissible, and then it is set. Motions of semidefinite problems that cost nothing
    /// come out very long: what is not admissible is shortened as a whole there, so that they stay motions,
    /// with a search or without. Returns what add_better() does, or zero.
    double correct();

    /// Adds the coarse correction in `step`, of which `length` is admissible, with exact line search. What is
    /// not admissible is cut off node by node or the whole is shortened, whichever lowers the energy more.
    /// Returns the energy norm of what was cut off or shortened, before that; zero where nothing was, and for
    /// semidefinite problems.
    double add_better(const double length);

    /// Collective. Contact nodes for the subspace: those with half-spaces. The others move as coarse
    /// functions do.
    std::vector<NodeIndex> nodes_of_subspace() const;

    /// Collective. Adds the minimizer in the contact subspace to the correction, and updates new_residual.
    void minimize_in_subspace();

    MultigridHierarchy    &hierarchy;
    const unsigned int     level;
    const ObstacleProblem &problem;
    ContactState          &contact;
    VCycle                 cycle;
    /// Made when it is needed first.
    const bool                     has_subspace;
    std::optional<ContactSubspace> subspace;
    FreeMotionCorrection           motions;
    Vector                         coarse_defect, coarse_correction;
    /// b - A (v + z); a coarse correction on the finest level.
    Vector new_residual, step, tangential;
    /// Whether the coarse correction was searched; whether the active set is that from before the run.
    bool searched = false, keeps_active = false;
    /// Whether the correction moves along the planes of active nodes, not also onto them.
    bool is_on_planes = false;
    /// Whether nodes in the way left little of the last coarse correction, or nothing holds the bodies.
    bool is_blocked = false;
    /// Whether that was so after the last minimizer, too, nothing is known yet, or the active set is lost:
    /// the next iterations begin with one.
    bool stays_blocked;
    /// Energy norm of a coarse correction of which something was cut off or shortened; else zero.
    double cut_off = 0.;
  };
} // namespace Signorini

#endif
