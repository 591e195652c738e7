// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_truncated_newton_multigrid_h
#define signorini_solvers_truncated_newton_multigrid_h

#include <signorini/solvers/conjugate_gradients.h>
#include <signorini/solvers/obstacle_solver.h>
#include <signorini/solvers/truncated_cycle.h>

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
  /// (HierarchyParts::start, or from below) the interface sweeps of the finest level are
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
    /// @param level the finest one of the problem
    TruncatedNewtonMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters,
                             const unsigned int level);

    /// The one without a monitor.
    using ObstacleSolver::solve;

    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

  private:
    /// Collective. Projects v, after a nested start where there can be one; whether that is a good start.
    bool start(Vector &v, const ObstacleProblem &problem, ConvergenceReport &report);

    /// Collective. Whether the levels below are obstacle problems that can give a start.
    bool has_nested_start(const Vector &v, const ObstacleProblem &problem) const;

    /// Collective. v = an approximate solution on the next coarser level (doc/algorithm.md, (57)). Returns
    /// the iterations on the coarser levels.
    std::vector<unsigned int> nested_start(Vector &v, const ObstacleProblem &problem);

    /// Collective. A step of conjugate gradients for the correction of a cycle, if it is admissible from v;
    /// whether it was taken. Updates the residual of v by it.
    bool accelerate(const Vector &v, Vector &residual, TruncatedCycle &cycle, const ObstacleProblem &problem);

    /// Collective. The iteration begins, or begins anew, at v: residual = rhs - A v, no old directions.
    IterationPhase begin_from(const Vector &v, Vector &residual, const ObstacleProblem &problem);

    ConjugateGradients conjugate;
  };
} // namespace Signorini

#endif
