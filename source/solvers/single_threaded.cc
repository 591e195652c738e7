// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "single_threaded.h"

#include <dlfcn.h>

namespace Signorini
{
  namespace
  {
    // Looked up: nothing of this library is compiled with OpenMP, so it is not linked to it either.
    const auto get_levels = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
    const auto set_levels = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
  } // namespace



  SingleThreaded::SingleThreaded()
  {
    if (get_levels == nullptr || set_levels == nullptr)
      return;
    levels_before = get_levels();
    set_levels(0);
  }



  SingleThreaded::~SingleThreaded()
  {
    if (get_levels != nullptr && set_levels != nullptr)
      set_levels(levels_before);
  }
} // namespace Signorini
