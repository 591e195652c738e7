// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_monotone_multigrid_h
#define signorini_solvers_monotone_multigrid_h

#include <signorini/solvers/obstacle_solver.h>

namespace Signorini
{
  /// Monotone multigrid (Kornhuber & Krause 2001, Wohlmuth & Krause 2003): projected sweeps on all levels. On
  /// the coarse ones the correction has obstacles of its own: at a coarse contact node the least room
  /// g - n.v among the fine nodes it moves that are not active (Mandel). Coarse spaces are truncated at
  /// active nodes. Every correction keeps the iterate admissible and lowers the energy; nothing is damped or
  /// projected back. The sum of the coarse corrections may be made longer, or shorter, where that lowers the
  /// energy further and is admissible: it brings the iterations down to those of the linear multigrid (19
  /// to 14).
  ///
  /// The transfer must take normal parts (times HalfSpaces::share()) to normal parts with weights that add up
  /// to at most 1: rows at contact nodes are multiples of rotations of the coarse normal into the fine one,
  /// with the projection of the fine node (build_hierarchy() with coarse obstacles).
  class MonotoneMultigrid : public ObstacleSolver
  {
  public:
    /// The hierarchy must outlive the object; its truncation is changed.
    MonotoneMultigrid(MultigridHierarchy &hierarchy, const SolverParameters &parameters);

    /// The one without a monitor.
    using ObstacleSolver::solve;

    ConvergenceReport solve(Vector &v, const ObstacleProblem &problem, const Monitor &monitor) override;

  private:
    /// The correction of a coarse level and its surroundings.
    struct Work
    {
      Vector correction, rhs, residual, finer;
      /// Bounds of relative displacements along full normals at nodes, in the first component; the largest
      /// number where none is.
      Vector room;
      /// The half-spaces that this room leaves.
      ContactState contact;
    };

    /// Room left at contact nodes of a level by a correction, restricted to the next coarser level.
    void restrict_room(const unsigned int to_level, const HalfSpaces &half_spaces, const Vector &values,
                       const std::vector<unsigned char> *const active);
    /// Collective. The correction of the coarser levels, as far as it lowers the energy.
    /// @param residual of v; its normal parts at active nodes are lost
    void add_coarse_correction(Vector &v, Vector &residual, const ObstacleProblem &problem);
    /// The correction of a level for its right hand side and its room, from zero.
    void correct_level(const unsigned int level);
    void solve_level_zero();
    /// Half-spaces of a coarse level from its room.
    HalfSpaces half_spaces_of(const unsigned int level) const;

    std::vector<Work> work;
  };
} // namespace Signorini

#endif
