// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "cycle_words.h"

#include <signorini/output/final_words.h>

#include <iomanip>
#include <sstream>

namespace Signorini
{
  std::string count_iterations(const unsigned int n)
  {
    return std::to_string(n) + (n == 1 ? " iteration" : " iterations");
  }



  std::string describe(const CycleResult &result, const bool has_estimate)
  {
    std::ostringstream line;
    line << "cycle " << result.cycle << ": " << result.cells << " cells, " << result.dofs << " unknowns, "
         << count_iterations(result.nonlinear.iterations);
    if (result.has_linear)
      line << " (linear multigrid " << result.linear.iterations << ", with conjugate gradients "
           << result.linear_cg.iterations << ", difference " << result.difference << ")";
    line << ", " << result.active_nodes << " of " << result.contact_nodes << " contact nodes active";
    if (has_estimate)
      line << ", estimated error of stresses " << percent_text(result.stress_error);
    return line.str();
  }



  std::string what_may_help(const SolverParameters &solver)
  {
    std::string text = " What may help:";
    if (solver.method != SolverMethod::accelerated)
      text += " Solver/Method = accelerated;";
    else if (!solver.safety_net)
      text += " Solver/Safety net = true;";
    if (solver.max_iterations < 100)
      text += " more Maximal iterations;";
    return text + " the softer body as Pair/Nonmortar; cells that are less stretched "
                  "(contrib/plots/render.py shows "
                  "them); a condition that stops bodies from sliding where only contact holds them.";
  }



  std::string describe(const SafetyNetReport &net)
  {
    std::ostringstream text;
    text << "the iteration was slow, after " << net.after << " of them each left " << std::setprecision(2)
         << net.rate << " of the correction: went on with " << net.n_steps << " active-set steps, by "
         << net.linear_solver << ".";
    if (net.n_failed > 0)
      text << " They did not end " << net.n_failed << " times, and the iteration had its turn again.";
    return text.str();
  }
} // namespace Signorini
