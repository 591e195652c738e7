// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_phase_times_h
#define signorini_output_phase_times_h

#include <deal.II/base/timer.h>

#include <array>
#include <numeric>

namespace Signorini
{
  /// What the time of a cycle goes into.
  enum class Phase
  {
    mesh,
    mapping,
    mortar,
    assembly,
    levels,
    hierarchy,
    solve,
    linear_assembly,
    linear_hierarchy,
    linear_solve,
    linear_cg_solve,
    estimate,
    output
  };

  /// Wall times of the phases (seconds).
  class PhaseTimes
  {
  public:
    /// Number of phases.
    static constexpr std::size_t n_phases = static_cast<std::size_t>(Phase::output) + 1;

    /// Names in the order of the phases, as summary.json has them.
    static constexpr std::array<const char *, n_phases> names = {
        {"mesh", "mapping", "mortar", "assembly", "levels", "hierarchy", "solve", "linear_assembly",
         "linear_hierarchy", "linear_solve", "linear_cg_solve", "estimate", "output"}};

    /// Books the time between its construction and its end, or stop().
    class Scope
    {
    public:
      /// Adds to `target`, which must outlive the object.
      explicit Scope(double &target)
        : target(&target)
      {
      }

      ~Scope()
      {
        stop();
      }

      Scope(const Scope &) = delete;

      /// Seconds so far.
      double stop()
      {
        if (target != nullptr)
          *target += seconds = timer.wall_time();
        target = nullptr;
        return seconds;
      }

    private:
      dealii::Timer timer;
      double       *target;
      double        seconds = 0.;
    };

    /// Books time for a phase from now on.
    Scope measure(const Phase phase)
    {
      return Scope(seconds[static_cast<std::size_t>(phase)]);
    }

    /// Books time that was measured elsewhere.
    void add(const Phase phase, const double time)
    {
      seconds[static_cast<std::size_t>(phase)] += time;
    }

    /// The time of one phase so far.
    double operator[](const Phase phase) const
    {
      return seconds[static_cast<std::size_t>(phase)];
    }

    /// Of all phases.
    double total() const
    {
      return std::accumulate(seconds.begin(), seconds.end(), 0.);
    }

  private:
    std::array<double, n_phases> seconds = {};
  };
} // namespace Signorini

#endif
