// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_termination_h
#define signorini_output_termination_h

#include <memory>
#include <mutex>
#include <string>

namespace Signorini
{
  /// What a process leaves behind that is told to end by a signal (Ctrl-C, a batch system, a closed
  /// terminal): nothing. A thread of its own waits for the signals, so that folders can be removed there.
  class TerminationWatch
  {
  public:
    /// To be called first in main(), before MPI and other threads begin: blocks SIGINT, SIGTERM, SIGHUP and
    /// SIGXCPU in this thread and those that it makes, where they are not ignored. SIGPIPE and SIGXFSZ are
    /// ignored from here on: a run goes on when nobody reads its lines any more, and files that cannot grow
    /// are errors when they are written. Without it signals do what they always do.
    static void start();

    /// While one lives a signal waits, and the folders do not change.
    class Delay
    {
    public:
      Delay();

    private:
      std::unique_lock<std::mutex> lock;
    };

    /// Removes a folder if a signal comes, and says so on the standard error. Not for one who has a Delay.
    /// @param message none if empty
    static void guard(const std::string &folder, const std::string &message);

    /// The same for one who has a Delay.
    static void guard(const std::string &folder, const std::string &message, const Delay &delay);

    /// The folder stays from now on.
    static void release(const std::string &folder);

    /// The same for one who has a Delay.
    static void release(const std::string &folder, const Delay &delay);
  };
} // namespace Signorini

#endif
