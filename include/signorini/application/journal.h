// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_journal_h
#define signorini_application_journal_h

#include <signorini/output/phase_times.h>
#include <signorini/output/progress.h>

#include <functional>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace Signorini
{
  /// A remark as a line for people: warnings say themselves what they are.
  std::string note_line(const std::string &remark);

  /// What a run tells: lines and progress on the terminal, notes that are kept for the results, and times.
  class Journal
  {
  public:
    /// Says nothing, but keeps notes and times.
    Journal()
      : Journal(false, 0)
    {
    }

    /// @param is_root whether this rank may print
    /// @param verbosity 0: nothing, 1: a line per cycle, 2: also one per iteration
    Journal(const bool is_root, const unsigned int verbosity)
      : prints(is_root && verbosity > 0)
      , prints_iterations(verbosity > 1)
      , progress(std::cout, Progress::wanted(is_root, verbosity))
    {
    }

    /// What is called whenever show() is, in each iteration at least; what it throws ends the run.
    void interrupt_by(std::function<void()> check)
    {
      interruption = std::move(check);
    }

    /// A remark for the results; the same one is kept once.
    void note(const std::string &text);

    /// All remarks so far, in order.
    const std::vector<std::string> &notes() const
    {
      return remarks;
    }

    /// A line on the terminal, if this rank may print.
    void print(const std::string &line)
    {
      if (!prints)
        return;
      progress.clear();
      std::cout << line << std::endl;
    }

    /// Whether a line for each iteration is wanted.
    bool wants_iterations() const
    {
      return prints_iterations;
    }

    /// What is going on, on the terminal.
    void show(const std::string &phase)
    {
      if (interruption)
        interruption();
      progress.show(phase);
    }

    /// The same with the share of it that is done, in [0,1].
    void show(const std::string &phase, const double fraction)
    {
      if (interruption)
        interruption();
      progress.show(phase, fraction);
    }

    /// For the time that is left: Progress::expect().
    void expect(const double before, const double present, const double all)
    {
      progress.expect(before, present, all);
    }

    /// Removes what show() has left on the terminal.
    void clear()
    {
      progress.clear();
    }

    /// Books the time until the end of the scope.
    PhaseTimes::Scope measure(const Phase phase)
    {
      return times.measure(phase);
    }

    /// The times since the last call.
    PhaseTimes take_times()
    {
      return std::exchange(times, PhaseTimes());
    }

  private:
    const bool               prints, prints_iterations;
    Progress                 progress;
    std::function<void()>    interruption;
    std::vector<std::string> remarks;
    PhaseTimes               times;
  };
} // namespace Signorini

#endif
