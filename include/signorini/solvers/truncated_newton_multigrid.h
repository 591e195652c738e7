// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_truncated_newton_multigrid_h
#define signorini_solvers_truncated_newton_multigrid_h

#include <signorini/solvers/conjugate_direction.h>
#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  /// Truncated nonsmooth Newton multigrid (Gräser, Sack & Sander 2009): projected smoothing on the finest
  /// level, one linear V-cycle on the coarse spaces truncated at active nodes, projection, exact line
  /// search, post-smoothing. (Linear problems: LinearMultigrid.) Instead of being projected node by node the
  /// coarse correction is shortened as a whole where that lowers the energy more: projected bending of a
  /// slender body leaves kinks that cost more than it wins.
  ///
  /// Accelerated: as long as the active set rests, the same iteration is a linear symmetric
  /// preconditioner z = M(v) - v of the residual on the free components, and the step goes along the
  /// A-conjugate direction p = z - (z·Ap_old / p_old·Ap_old) p_old with the exact step length. This
  /// minimizes the energy over v + span(z, p_old), so it never ends above M(v). Where the active set moves,
  /// something was cut off or p leaves the admissible set, M(v) is taken, shortened if it was not searched
  /// and its energy is not lower. After that the active nodes are on the way to their planes, and M is no
  /// linear map: the first M(v) that need not be shortened is taken before conjugate gradients go on. None of
  /// this needs a product with A more than the plain iteration. From a good start
  /// (MultigridHierarchy::expect_active_set(), or from below) the interface sweeps of the finest level are
  /// left out while the active set rests and iterations are fast.
  ///
  /// Accelerated without a start gets one from the levels below, each an obstacle problem of its own with the
  /// half-spaces of the nodes it shares with the finest (nested iteration without coarser meshes).
  ///
  /// One iteration is one application of the V-cycle.
  class TruncatedNewtonMultigrid : public ObstacleSolver
  {
  public:
    /// The hierarchy must outlive the object; its truncation is changed.
    TruncatedNewtonMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters);

    using ObstacleSolver::solve;

    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

  private:
    /// Collective. Whether the levels below are obstacle problems that can give a start.
    bool has_nested_start(const Vector &v, const ObstacleProblem &problem) const;

    /// Collective. v = an approximate solution on the next coarser level. Returns the iterations on the
    /// coarser levels.
    std::vector<unsigned int> start_below(Vector &v, const ObstacleProblem &problem);

    /// Collective. The coarse correction on the finest level, tangential at active nodes, in `scratch`.
    Vector &prolongate_correction();

    /// Collective. Adds the truncated V-cycle of the residual, which may be changed, to the correction z: by
    /// add_better() if `searches` or something is not admissible, and then `searches` is set. Motions of
    /// semidefinite problems that cost nothing come out very long: what is not admissible is shortened as a
    /// whole there, so that they stay motions, with a search or without. Returns what add_better() does, or
    /// zero.
    double correct(Vector &z, Vector &residual, const bool semidefinite, bool &searches);

    /// Collective. Adds the coarse correction in `scratch`, of which `length` is admissible, with exact line
    /// search. What is not admissible is cut off node by node or the whole is shortened, whichever lowers the
    /// energy more. Returns the energy norm of what was cut off or shortened, before that; zero where nothing
    /// was, and for semidefinite problems.
    double add_better(Vector &z, const Vector &residual, const double length, const bool semidefinite);

    /// One accelerated step from v with the correction z, az = A z; false, and nothing changed but the
    /// direction, if it is not to be taken. On success z and az are the correction made and its product with
    /// A.
    bool accelerate(const Vector &v, const Vector &residual, Vector &z, Vector &az,
                    const ObstacleProblem &problem);

    /// Length of z (at most 1) that lowers the energy, for an admissible v + z that was not searched because
    /// the active set seemed to rest. az = A z.
    double safe_length(const Vector &z, const Vector &az, const Vector &residual,
                       const bool keeps_active) const;

    bool all_ranks(const bool condition) const;

    VCycle cycle;
    Vector coarse_defect, coarse_correction;
    /// On the finest level: a coarse correction there, then the product of a whole one.
    Vector             scratch;
    unsigned int       n_updates = 0;
    ConjugateDirection conjugate;
  };
} // namespace Signorini

#endif
