// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_convergence_report_h
#define signorini_solvers_convergence_report_h

#include <limits>
#include <string>
#include <vector>

namespace Signorini
{
  /// What caught an iteration that stayed slow (SafetyNet).
  struct SafetyNetReport
  {
    /// Iterations before; 0 if nothing was caught. What they left of the correction, each.
    unsigned int after = 0;
    double       rate  = std::numeric_limits<double>::quiet_NaN();
    /// Steps of the active set; how often they did not end, and the slow iteration had its turn again.
    unsigned int n_steps = 0, n_failed = 0;
    /// What solved their linear problems.
    std::string linear_solver;
  };

  /// What a solver returns. Numbers start as NaN, so that a forgotten one is loud.
  struct ConvergenceReport
  {
    /// Whether the stop rule was met.
    bool converged = false;
    /// Converged as far as rounding allows, short of the tolerance; see the note.
    bool stagnated = false;
    /// Applications of the V-cycle.
    unsigned int iterations = 0;
    /// The same on the coarser levels, coarsest first, where the start came from there.
    std::vector<unsigned int> start_iterations;
    /// Cycles of algebraic multigrid on the finest level, where that is the method.
    unsigned int linear_cycles = 0;
    /// Energy norm of the correction, one entry per iteration.
    std::vector<double> history;
    /// Energy norm of the iterate after the last iteration: the scale of the stop rule.
    double scale = std::numeric_limits<double>::quiet_NaN();
    /// Active contact nodes over all ranks, one entry per iteration.
    std::vector<unsigned int> active_nodes;
    /// ½ vᵀAv − bᵀv of the solution.
    double energy = std::numeric_limits<double>::quiet_NaN();
    /// Geometric mean of the last reductions of the correction.
    double rate = std::numeric_limits<double>::quiet_NaN();
    /// How often the truncated hierarchy was updated.
    unsigned int hierarchy_updates = 0;
    /// Minimizations in the contact subspace.
    unsigned int subspace_minimizations = 0;
    /// Whether an iteration at rest left so much of the correction that accelerated needs interface sweeps on
    /// the finest level.
    bool needed_interface_sweeps = false;
    /// Whether it was so slow that patches of nodes were smoothed at once; after how many iterations.
    bool         needed_patches = false;
    unsigned int before_patches = 0;
    /// What SolverParameters::check_monotonicity found: substeps, the largest rise of the energy (relative to
    /// the square of the energy norm) and the largest violation of a half-space (relative to the largest
    /// displacement of a contact node).
    unsigned int    checked_substeps    = 0;
    double          largest_energy_rise = 0., largest_violation = 0.;
    SafetyNetReport safety_net;
    /// Says why the solver stopped without having met the tolerance.
    std::string note;
  };

  /// Geometric mean of the last (at most 5) reductions above rounding level.
  double convergence_rate(const std::vector<double> &history);

  /// Whether corrections (energy norms, one entry per iteration) have become rounding of the iterate:
  /// doc/algorithm.md (61).
  /// @param iterate its energy norm
  bool is_at_rounding(const std::vector<double> &corrections, const double iterate);
} // namespace Signorini

#endif
