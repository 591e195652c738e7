// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_output_process_memory_h
#define signorini_output_process_memory_h

namespace Signorini
{
  /// Memory of this process (bytes); zero where the system does not tell.
  struct ProcessMemory
  {
    /// Now; the most so far.
    double resident = 0., peak = 0.;
  };

  /// From /proc. Where that is not mounted (a bare chroot) deal.II's get_memory_stats() reads without end.
  ProcessMemory process_memory();
} // namespace Signorini

#endif
