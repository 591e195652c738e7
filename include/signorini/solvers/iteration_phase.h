// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_iteration_phase_h
#define signorini_solvers_iteration_phase_h

namespace Signorini
{
  /// Where a truncated Newton iteration is.
  enum class IterationPhase
  {
    /// The active set may change: coarse corrections are searched.
    searching,
    /// The last step was shortened: active nodes have left their planes behind and are on the way to them.
    /// The way there is no linear function of the residual, as conjugate gradients need it; the next step
    /// with a search is not shortened and arrives.
    on_the_way,
    /// The active set rests and the iteration is linear: steps are those of conjugate gradients.
    resting
  };

  /// What an iteration did, as far as the next one depends on it.
  struct StepTaken
  {
    /// A step of conjugate gradients.
    bool is_conjugate = false;
    /// Less than the whole correction.
    bool is_shortened = false;
    /// The correction of a semidefinite problem grew: rounding along motions that cost nothing feeds on
    /// itself through old directions.
    bool grows_freely = false;
  };

  /// The phase after an iteration.
  inline IterationPhase next_phase(const StepTaken &step)
  {
    if (step.is_shortened)
      return IterationPhase::on_the_way;
    return step.is_conjugate && !step.grows_freely ? IterationPhase::resting : IterationPhase::searching;
  }
} // namespace Signorini

#endif
