// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "adaptive_marks.h"

#include <signorini/application/error_estimate.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/output/final_words.h>

namespace Signorini
{
  std::vector<bool> mark_adaptively(const NodalSpace &space, const std::vector<double> &indicator,
                                    const CycleResult &last, const RefinementParameters &p, Journal &journal)
  {
    const std::vector<bool> none(space.cells().size(), false);
    // The indicator of an exact solution is rounding: 1e-8 of what a difference of squares consists of.
    if (last.indicator * last.indicator <= 1e-14 * std::abs(last.nonlinear.energy))
      {
        journal.note("cycle " + std::to_string(last.cycle) +
                     ": the error indicator is at the level of rounding, there is nothing to refine.");
        return none;
      }
    if (p.wanted_stress_error > 0. && last.stress_error <= p.wanted_stress_error)
      {
        journal.note("cycle " + std::to_string(last.cycle) + ": the estimated error of stresses is " +
                     percent_text(last.stress_error) +
                     ", not above \"Wanted stress error\": no further adaptive refinement.");
        return none;
      }
    const std::vector<bool> marked = p.marking == RefinementParameters::Marking::cells
                                         ? mark_share_of_cells(space, indicator, p.marking_fraction)
                                         : mark_share_of_error(space, indicator, p.marking_fraction);
    if (p.max_dofs > 0.)
      if (const double expected = expected_dofs(space, marked); expected > p.max_dofs)
        {
          journal.note("cycle " + std::to_string(last.cycle + 1) + " would have about " +
                       std::to_string(static_cast<std::size_t>(expected)) +
                       " dofs, more than \"Max dofs\": no further adaptive refinement.");
          return none;
        }
    return marked;
  }



  void compare_with_wanted(const CycleResult &last, const RefinementParameters &p, Journal &journal)
  {
    if (p.wanted_stress_error > 0. && !(last.stress_error <= p.wanted_stress_error))
      journal.note("the estimated error of stresses is " + percent_text(last.stress_error) +
                   " at the end, not " + percent_text(p.wanted_stress_error) +
                   " as wanted: more \"Adaptive cycles\" or \"Max dofs\" are needed.");
  }
} // namespace Signorini
