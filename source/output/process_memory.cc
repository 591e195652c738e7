// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/output/process_memory.h>

#include <deal.II/base/utilities.h>

#include <fstream>

namespace Signorini
{
  ProcessMemory process_memory()
  {
    if (!std::ifstream("/proc/self/status"))
      return {};
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    constexpr double kilobyte = 1024.;
    return {kilobyte * static_cast<double>(stats.VmRSS), kilobyte * static_cast<double>(stats.VmHWM)};
  }
} // namespace Signorini
