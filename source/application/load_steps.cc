// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/journal.h>
#include <signorini/application/load_steps.h>
#include <signorini/application/pretension.h>
#include <signorini/mesh/expression.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_steps = 100000;
  }

  std::vector<double> parse_load_steps(const std::string &text, const std::string &where)
  {
    std::vector<double> times;
    if (Utilities::trim(text).empty())
      return times;
    for (const std::string &piece : split_list(text, ',', where))
      times.push_back(parse_number(piece, where));
    if (times.size() == 1 && times[0] != ScalarField::end)
      {
        const double n = times[0];
        if (!(n >= 1.) || n > most_steps || n != std::floor(n))
          throw InputError(where + ": \"" + text +
                           "\" should be a number of steps, or a list of ascending times like 0.2, 0.5, 1.");
        times.clear();
        for (unsigned int k = 1; k <= n; ++k)
          times.push_back(k / n);
      }
    for (std::size_t k = 0; k < times.size(); ++k)
      if (!(times[k] > (k == 0 ? 0. : times[k - 1])))
        throw InputError(where + ": the times in \"" + text + "\" should be positive and ascend.");
    return times;
  }



  namespace
  {
    StepResult step_result(const double time, const ContactModel &model, const Discretization &d,
                           const ContactSolution &solution, const std::vector<Probe> &probes)
    {
      StepResult              result;
      const ContactEvaluation evaluation = evaluate_contact(model, d, solution);
      result.time                        = time;
      result.report                      = solution.report;
      result.active_nodes                = solution.n_active;
      result.pairs                       = evaluation.pairs;
      result.boundaries                  = evaluation.equilibrium.reactions;
      result.probes                      = evaluate_probes(model, d, solution, probes);
      result.pretensions                 = solution.pretensions;
      return result;
    }

    /// What a step says on the terminal.
    std::string describe(const StepResult &step)
    {
      std::ostringstream line;
      line << "step t = " << step.time << ": " << step.report.iterations << " iterations, "
           << step.active_nodes << " contact nodes active";
      for (const PairResult &pair : step.pairs)
        line << ", force of " << pair.name << " " << pair.force.norm();
      return line.str();
    }

    /// The steps before the last on the mesh of that one.
    class LoadSteps
    {
    public:
      LoadSteps(ContactModel &model, const NestedParameters &parameters, const NestedSolution &last,
                Journal &journal)
        : model(model)
        , parameters(parameters)
        , last(last)
        , journal(journal)
        , previous(last.solution.displacement)
        , before(previous)
      {
        previous = 0.;
        before   = 0.;
      }

      /// Solves a step. The discretization is that of its conditions.
      ContactSolution solve(const double time)
      {
        model.set_time(time);
        const Discretization &full = *last.discretization;
        discretization             = std::make_unique<const Discretization>(
            full, std::make_shared<const ConstrainedSpace>(*full.constrained, model));
        foretell_pretension(model, *discretization);
        const Vector start = foretell(time);
        if (solver == nullptr)
          {
            SolveParameters how_to = parameters.solve;
            how_to.compare_linear  = false;
            const NestedStart from{start, last.solution.report.needed_interface_sweeps,
                                   last.solution.report.needed_patches};
            solver = std::make_unique<ContactSolver>(model, *discretization, coarser, &from, how_to, journal);
          }
        else
          solver->change_loads(*discretization, start);
        ContactSolution solution = solve_with_pretension(model, *solver, *discretization, journal);
        before.swap(previous);
        previous      = solution.displacement;
        time_before   = time_previous;
        time_previous = time;
        return solution;
      }

      const Discretization &present() const
      {
        return *discretization;
      }

    private:
      /// The line through the two steps before (the first is zero at t = 0).
      Vector foretell(const double time) const
      {
        Vector result = previous;
        if (time_previous > time_before)
          {
            const double share = (time - time_previous) / (time_previous - time_before);
            result.sadd(1. + share, -share, before);
          }
        result.update_ghost_values();
        return result;
      }

      ContactModel                         &model;
      const NestedParameters               &parameters;
      const NestedSolution                 &last;
      Journal                              &journal;
      CoarserSpaces                         coarser;
      Vector                                previous, before;
      double                                time_previous = 0., time_before = 0.;
      std::unique_ptr<const Discretization> discretization;
      std::unique_ptr<ContactSolver>        solver;
    };
  } // namespace



  NestedSolution run_load_steps(ContactModel &model, const NestedParameters &parameters,
                                const std::vector<double> &times, const StepObserver &observe,
                                Journal &journal)
  {
    if (!times.empty())
      model.set_time(times.back());
    NestedSolution last = run_nested_iteration(model, parameters, journal);
    if (times.empty() || !last.results.converged)
      return last;
    std::vector<StepResult>       steps;
    const std::vector<Pretension> tightened = model.pretensions();
    {
      LoadSteps series(model, parameters, last, journal);
      for (std::size_t k = 0; k + 1 < times.size() && last.results.converged; ++k)
        {
          const ContactSolution solution = series.solve(times[k]);
          steps.push_back(step_result(times[k], model, series.present(), solution, parameters.probes));
          journal.print(describe(steps.back()));
          last.results.converged = solution.report.converged;
          if (!solution.report.converged)
            journal.note("the step t = " + std::to_string(times[k]) + " was not solved: " +
                         solution.report.note + ". The steps after it are left out, but for the last.");
          observe(static_cast<unsigned int>(k), series.present(), solution);
        }
    }
    model.set_time(times.back());
    model.pretensions() = tightened;
    steps.push_back(step_result(times.back(), model, *last.discretization, last.solution, parameters.probes));
    journal.print(describe(steps.back()));
    observe(static_cast<unsigned int>(times.size() - 1), *last.discretization, last.solution);
    last.results.steps = std::move(steps);
    return last;
  }
} // namespace Signorini
