// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_interface_sweep_policy_h
#define signorini_solvers_interface_sweep_policy_h

#include <signorini/solvers/iteration_phase.h>
#include <signorini/solvers/smoother.h>

namespace Signorini
{
  /// Whether iterations take interface sweeps on the finest level. From a good start most problems do without
  /// them once the active set rests, but not all: the first iteration at rest that leaves too much of the
  /// correction (doc/algorithm.md, (55)) brings them back for good.
  class InterfaceSweepPolicy
  {
  public:
    /// What an iteration at rest may leave of the correction: .25 for V(3,3), and more where fewer sweeps
    /// leave more in any case (doc/measurements.md).
    struct Rule
    {
      /// Divided by the number of sweeps of a cycle, at least two.
      double slow = 1.5;
    };

    /// @param may_spare whether there is a good start and nothing else against it
    /// @param is_slow whether they are known to be needed
    InterfaceSweepPolicy(const SmoothingParameters &smoothing, const bool may_spare, const bool is_slow)
      : smoothing(smoothing)
      , may_spare(may_spare)
      , is_slow(is_slow)
    {
    }

    /// How the next iteration smooths.
    SmoothingParameters choose(const IterationPhase phase) const
    {
      SmoothingParameters result = smoothing;
      if (may_spare && phase == IterationPhase::resting && !is_slow)
        result.n_interface_sweeps = 0;
      return result;
    }

    /// After an iteration, with the norm of its correction and those before: one that was linear counts as at
    /// rest.
    void observe(const bool was_linear, const double norm, const std::vector<double> &history)
    {
      const double slow_rate = Rule().slow / std::max(2u, smoothing.n_pre + smoothing.n_post);
      is_slow = is_slow || (was_linear && !history.empty() && norm > slow_rate * history.back());
    }

    /// Whether they were, or would have been, needed at rest.
    bool needs_sweeps() const
    {
      return is_slow;
    }

  private:
    const SmoothingParameters smoothing;
    const bool                may_spare;
    bool                      is_slow;
  };
} // namespace Signorini

#endif
