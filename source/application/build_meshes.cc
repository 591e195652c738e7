// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/contact_evaluation.h>
#include <signorini/application/journal.h>
#include <signorini/application/nested_iteration.h>

namespace Signorini
{
  NestedSolution build_meshes(ContactModel &model, const NestedParameters &parameters, Journal &journal)
  {
    const Refinement refinement(parameters.refinement);
    auto             space = std::make_shared<const ConstrainedSpace>(model);
    for (unsigned int c = 1; c <= refinement.n_cycles(); ++c)
      if (!refinement.is_adaptive(c) &&
          model.refine(space->nodal(), refinement.mark(model.bodies(), space->nodal(), c)))
        {
          model.note_movement(journal);
          space = std::make_shared<const ConstrainedSpace>(model);
        }
    if (parameters.refinement.adaptive_cycles > 0)
      journal.note("the meshes are without the adaptive cycles, which need solutions.");
    NestedSolution result;
    result.discretization   = discretize(model, space, {}, 0, journal);
    const Discretization &d = *result.discretization;
    d.partition().reinit(result.solution.displacement);
    result.solution.displacement.update_ghost_values();
    result.solution.stress = no_stress(d);
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        result.results.pairs.push_back(evaluate_pair(d, result.solution, p));
        const auto rows = pressure_rows(model.bodies(), d, result.solution.stress, p);
        result.results.pressure.insert(result.results.pressure.end(), rows.begin(), rows.end());
      }
    return result;
  }
} // namespace Signorini
