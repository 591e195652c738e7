// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_sweep_rate_h
#define signorini_solvers_sweep_rate_h

#include <signorini/solvers/projected_gauss_seidel.h>

namespace Signorini
{
  /// When sweeps by node over some rows are called slow.
  struct SlowSweepsRule
  {
    /// The sweep, forward and backward, that is measured.
    unsigned int measured_sweep;
    /// What it must leave of the energy norm of an error to be slow.
    double slow;
  };

  /// Over lines and planes of stretched cells (StrongBlocks): where sweeps by node leave less, a block is not
  /// worth its factors.
  constexpr SlowSweepsRule slow_in_blocks = {4, .75};

  /// Over the contact nodes of both sides (InterfaceCorrection): 0.8 to 0.93 where the nonmortar side is as
  /// stiff as the mortar side or softer, 0.96 where it is ten times as stiff. Soft motions that the first
  /// sweeps leave behind show only when the stiff ones are gone: a stiffness ratio of 1e6 takes 15.
  constexpr SlowSweepsRule slow_at_interface = {20, .95};

  /// Collective. What the measured sweep (forward and backward) over some rows leaves of the energy norm of
  /// an error there, everything else at rest. The error begins almost constant, as slow motions are.
  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const SweepSchedule &rows, const SlowSweepsRule &rule);

  /// The same while the rows of other ranks are at rest; not collective.
  /// @param zero a vector of zeros in the layout of the matrix, which is left as it was
  double sweep_rate(const NodeBlockMatrix &matrix, const ProjectedGaussSeidel &sweeps,
                    const std::vector<unsigned int> &rows, const SlowSweepsRule &rule, Vector &zero);
} // namespace Signorini

#endif
