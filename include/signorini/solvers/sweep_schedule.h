// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_sweep_schedule_h
#define signorini_solvers_sweep_schedule_h

#include <signorini/algebra/node_partition.h>

#include <vector>

namespace Signorini
{
  /// In which direction a sweep goes over its rows.
  enum class Direction
  {
    forward,
    backward
  };

  /// The order of a Gauss-Seidel sweep under MPI that keeps it a true (multiplicative) sweep: the
  /// energy falls in every step on any number of ranks, which is what the convergence theory of
  /// monotone multigrid needs and what a block-Jacobi variant loses.
  ///
  /// Ranks are coloured such that neighbours differ. In phase c the ranks of colour c sweep over
  /// their nodes that other ranks see; the last phase is for the inner nodes of all ranks. Ghost
  /// values are exchanged before each phase.
  class SweepSchedule
  {
  public:
    SweepSchedule() = default;

    /// Collective. A sweep over all owned nodes.
    explicit SweepSchedule(const NodePartition &partition);

    /// The same order, for some of the owned nodes only.
    SweepSchedule subset(const std::vector<unsigned int> &nodes) const;

    /// Owned nodes, phase by phase; the same number of phases on all ranks.
    const std::vector<std::vector<unsigned int>> &phases() const
    {
      return rows;
    }

  private:
    std::vector<std::vector<unsigned int>> rows;
  };
} // namespace Signorini

#endif
