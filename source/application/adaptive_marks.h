// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_adaptive_marks_h
#define signorini_application_adaptive_marks_h

#include <signorini/application/journal.h>
#include <signorini/mesh/refinement.h>
#include <signorini/output/results.h>

#include <vector>

namespace Signorini
{
  /// Collective. What the adaptive cycle after the cycle `last` refines; nothing where that makes no sense,
  /// with a note.
  /// @param indicator squared, by cell (estimate_error())
  std::vector<bool> mark_adaptively(const NodalSpace &space, const std::vector<double> &indicator,
                                    const CycleResult &last, const RefinementParameters &p, Journal &journal);

  /// Notes where stresses have not become as good as wanted.
  void compare_with_wanted(const CycleResult &last, const RefinementParameters &p, Journal &journal);
} // namespace Signorini

#endif
