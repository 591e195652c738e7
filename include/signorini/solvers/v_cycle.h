// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_v_cycle_h
#define signorini_solvers_v_cycle_h

#include <signorini/solvers/multigrid_hierarchy.h>

namespace Signorini
{
  /// The linear V-cycle on the levels of a hierarchy below a given one. Not dealii::Multigrid: that computes
  /// residuals by products of their own, which the smoother hands out without one.
  class VCycle
  {
  public:
    /// The hierarchy must outlive the object. max_level is the finest level the cycle acts on.
    VCycle(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing, const unsigned int max_level);

    /// Collective. correction = (approximate inverse) * defect, on max_level.
    void apply(Vector &correction, const Vector &defect);

    /// The same, and residual = defect - A correction.
    void apply(Vector &correction, const Vector &defect, Vector &residual);

  private:
    struct Work
    {
      /// Empty on max_level.
      Vector solution, rhs;
      /// After pre-smoothing, then the coarse correction.
      Vector residual;
      /// Of levels with several cycles or an exact step: what the first cycle left of the right hand side,
      /// what the second left, and its correction.
      Vector left, left_after, second;
      /// Corrections are free.
      ContactState free;
    };

    /// The correction of a level as it asks for it (LevelCorrection).
    /// @param new_residual null, or where to leave rhs - A solution
    void correct(const unsigned int level, Vector &solution, const Vector &rhs, Vector *const new_residual);

    /// One cycle.
    void run(const unsigned int level, Vector &solution, const Vector &rhs, Vector *const new_residual);

    MultigridHierarchy       &hierarchy;
    const SmoothingParameters smoothing;
    std::vector<Work>         work;
  };
} // namespace Signorini

#endif
