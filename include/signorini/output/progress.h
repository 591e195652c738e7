// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_progress_h
#define signorini_output_progress_h

#include <chrono>
#include <ostream>
#include <string>

namespace Signorini
{
  /// One line at the bottom of a terminal that says what is going on, rewritten in place. Prints nothing if
  /// it is off: into files and pipes go only the plain lines of the program.
  class Progress
  {
  public:
    /// @param enabled on the rank that writes
    Progress(std::ostream &out, const bool enabled);

    /// Clears the line.
    ~Progress();

    /// On if the standard output is a terminal, this is the root rank, and the verbosity is at least 1.
    static bool wanted(const bool is_root, const unsigned int verbosity);

    /// Shows a phase.
    void show(const std::string &phase);

    /// Shows a phase with a bar; fraction between 0 and 1.
    void show(const std::string &phase, const double fraction);

    /// How much work there is, for the time that is left: what was done before the present part, the part (of
    /// which show() tells how much is done), and all, in any unit. Without it no time is shown.
    void expect(const double before, const double present, const double all);

    /// Takes the line away; to be called before anything else is printed.
    void clear();

  private:
    void write(const std::string &text);
    /// Time that is left and memory of this rank, in words.
    std::string outlook(const double fraction) const;

    std::ostream                               &out;
    const bool                                  enabled;
    std::size_t                                 width  = 0;
    double                                      before = 0., present = 0., all = 0.;
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };
} // namespace Signorini

#endif
