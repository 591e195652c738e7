// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_sweep_measurement_h
#define signorini_solvers_sweep_measurement_h

#include <signorini/solvers/multigrid_hierarchy.h>

namespace Signorini
{
  /// The unit of cost (doc/algorithm.md, (70)): median of five Gauss-Seidel sweeps on the finest level, and
  /// how close they come to the bandwidth of memory. Rates are sums over the ranks.
  struct SweepMeasurement
  {
    /// Seconds; 0 if not measured.
    double time = 0.;
    /// Bytes per second, of the sweep and of a plain read of the same matrix.
    double bytes_per_second = 0., read_bytes_per_second = 0.;
  };

  /// Collective.
  SweepMeasurement measure_sweeps(MultigridHierarchy &hierarchy, const Vector &rhs);
} // namespace Signorini

#endif
