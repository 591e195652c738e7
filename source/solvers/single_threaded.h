// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_single_threaded_h
#define signorini_solvers_single_threaded_h

namespace Signorini
{
  /// While it exists, OpenMP regions have one thread. CHOLMOD asks for four, whatever OMP_NUM_THREADS says,
  /// and where there are not as many cores they wait for each other: a third of the time of small factors.
  /// Without OpenMP in the process it does nothing.
  class SingleThreaded
  {
  public:
    SingleThreaded();
    ~SingleThreaded();
    SingleThreaded(const SingleThreaded &)            = delete;
    SingleThreaded &operator=(const SingleThreaded &) = delete;

  private:
    int levels_before = 0;
  };
} // namespace Signorini

#endif
