// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "cycle_words.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/journal.h>
#include <signorini/application/load_steps.h>
#include <signorini/application/parting_bodies.h>
#include <signorini/application/point_holds.h>
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
      result.boundaries                  = evaluation.equilibrium.told_reactions();
      result.probes                      = evaluate_probes(model, d, solution, probes);
      result.pretensions                 = solution.pretensions;
      return result;
    }

    /// What a step says on the terminal.
    std::string describe(const StepResult &step)
    {
      std::ostringstream line;
      line << "step t = " << step.time << ": " << count_iterations(step.report.iterations) << ", "
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
                const std::vector<double> &times, Journal &journal)
        : model(model)
        , parameters(parameters)
        , last(last)
        , times(times)
        , journal(journal)
        , tightened(model.pretensions())
        , full_holds(model.point_holds())
        , previous(last.solution.displacement)
        , before(previous)
      {
        previous = 0.;
        before   = 0.;
      }

      /// Solves all steps but the last, from where a saved state ends.
      void run(const StepObserver &observe, Checkpoints *const checkpoints)
      {
        if (checkpoints != nullptr && checkpoints->state().series)
          restore(*checkpoints->state().series);
        for (std::size_t k = steps.size(); k + 1 < times.size() && converged; ++k)
          {
            const ContactSolution solution = solve(times[k]);
            if (steps.empty())
              note_if_constant(solution);
            steps.push_back(step_result(times[k], model, *discretization, solution, parameters.probes));
            journal.print(describe(steps.back()));
            converged = solution.report.converged;
            if (!converged)
              journal.note("the step t = " + Patterns::Tools::to_string(times[k]) + " was not solved: " +
                           solution.report.note + ". The steps after it are left out, but for the last.");
            for (const PartedPairs &parted : find_parted_bodies(*discretization, solution))
              journal.note("warning: load step t = " + Patterns::Tools::to_string(times[k]) + ": " +
                           describe_parted(parted, *discretization) +
                           " then, though it does in the end: the nodes between them are held at the mean. "
                           "Compute that step alone.");
            observe(static_cast<unsigned int>(k), *discretization, solution);
            if (checkpoints != nullptr && checkpoints->are_wanted())
              save(*checkpoints);
          }
        hold_at(full_holds);
        model.set_time(times.back());
        model.pretensions() = tightened;
      }

      /// Relative difference of solutions that are the same to the tolerance of the solver.
      static constexpr double same = 1e-7;

      /// Those that were solved.
      std::vector<StepResult> steps;
      bool                    converged = true;

    private:
      /// Whoever wants steps wants them to differ.
      void note_if_constant(const ContactSolution &first) const
      {
        Vector difference = first.displacement;
        difference -= last.solution.displacement;
        if (difference.l2_norm() <= same * last.solution.displacement.l2_norm())
          journal.note("the first load step has the solution of the last: no condition and no load depends "
                       "on t, it seems. Write for example (0, 0, -1000*t) for what grows from step to step.");
      }

      /// The discretization is that of the conditions of the step.
      ContactSolution solve(const double time)
      {
        if (solver == nullptr)
          set_up(time);
        // From the same values at all steps: they must not depend on where a saved state ends.
        hold_at(full_holds);
        if (time != times.front() || !full_holds.empty())
          {
            set_time(time);
            solver->change_loads(*discretization, foretell(time));
          }
        ContactSolution solution = solve_with_pretension(model, *solver, *discretization, journal);
        leave_drift(model, *discretization, solution, journal);
        settle_holds(solution, time);
        needed_patches = needed_patches || solution.report.needed_patches;
        before.swap(previous);
        previous      = solution.displacement;
        time_before   = time_previous;
        time_previous = time;
        return solution;
      }

      /// What the steps to come depend on.
      void save(Checkpoints &checkpoints) const
      {
        const CurveOrder     order(last.discretization->nodal());
        const NodePartition &partition = last.discretization->partition();
        SeriesState         &state     = checkpoints.state().series.emplace();
        state                          = {steps,
                                          time_previous,
                                          time_before,
                                          save_field(previous, partition, order),
                                          save_field(before, partition, order),
                                          save_bolts(model.loads().pretensions),
                                          converged,
                                          needed_patches};
        // They have been compared, and the last cycle has got its potential energy.
        checkpoints.state().nested.cycles  = last.results.cycles;
        checkpoints.state().nested.earlier = {};
        std::ostringstream stage;
        stage << "step t = " << time_previous;
        checkpoints.end_of_stage(stage.str(), converged && steps.size() + 1 < times.size() ? 1. : 0.,
                                 journal);
      }

      void restore(const SeriesState &state)
      {
        steps     = state.steps;
        converged = state.converged;
        const CurveOrder order(last.discretization->nodal());
        restore_field(previous, state.previous, last.discretization->partition(), order);
        restore_field(before, state.before, last.discretization->partition(), order);
        time_previous  = state.time_previous;
        time_before    = state.time_before;
        needed_patches = state.needed_patches;
        restore_bolts(model.pretensions(), state.bolts);
      }

      void hold_at(const std::vector<PointHold> &holds)
      {
        for (std::size_t i = 0; i < holds.size(); ++i)
          model.set_hold_value(i, holds[i].value);
      }

      /// As in the nested iteration.
      void settle_holds(ContactSolution &solution, const double time)
      {
        const auto at_rest = settle_point_holds(model, *discretization, solution.displacement);
        if (!at_rest)
          return;
        const double strain = strain_of_point_holds(model, *discretization, solution);
        set_time(time);
        solver->change_loads(*discretization, *at_rest);
        ContactSolution settled = solve_with_pretension(model, *solver, *discretization, journal);
        if (strain_of_point_holds(model, *discretization, settled) <= std::max(strain, small_strain))
          std::swap(settled, solution);
        else
          {
            hold_at(full_holds);
            set_time(time);
            solver->change_loads(*discretization, solution.displacement);
          }
      }

      /// Conditions and strains of bolts of a step.
      void set_time(const double time)
      {
        model.set_time(time);
        for (std::size_t i = 0; i < tightened.size(); ++i)
          if (tightened[i].is_locked(time))
            model.pretensions()[i].strain = tightened[i].strain;
        const Discretization &full = *last.discretization;
        discretization             = std::make_unique<const Discretization>(
            full, std::make_shared<const ConstrainedSpace>(*full.constrained, model));
        foretell_pretension(model, *discretization);
      }

      /// The solver of all steps, which is that of the first, also where a saved series goes on.
      /// @param time of the step that is to be solved
      void set_up(const double time)
      {
        const std::vector<Pretension> present = model.pretensions();
        model.pretensions()                   = tightened;
        set_time(times.front());
        Vector start = previous;
        start        = 0.;
        start.update_ghost_values();
        SolveParameters how_to = parameters.solve;
        how_to.compare_linear  = false;
        const NestedStart from{start, last.solution.report.needed_interface_sweeps,
                               last.solution.report.needed_patches || needed_patches};
        solver = std::make_unique<ContactSolver>(model, *discretization, coarser, &from, how_to, journal);
        if (time != times.front())
          model.pretensions() = present;
      }

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
      const std::vector<double>            &times;
      Journal                              &journal;
      const std::vector<Pretension>         tightened;
      const std::vector<PointHold>          full_holds;
      CoarserSpaces                         coarser;
      Vector                                previous, before;
      double                                time_previous = 0., time_before = 0.;
      bool                                  needed_patches = false;
      std::unique_ptr<const Discretization> discretization;
      std::unique_ptr<ContactSolver>        solver;
    };
  } // namespace



  NestedSolution run_load_steps(ContactModel &model, const NestedParameters &parameters,
                                const std::vector<double> &times, const StepObserver &observe,
                                Journal &journal, Checkpoints *const checkpoints)
  {
    if (!times.empty())
      model.set_time(times.back());
    if (checkpoints != nullptr)
      checkpoints->announce_steps(times.size() > 1);
    NestedSolution last = run_nested_iteration(model, parameters, journal, checkpoints);
    if (times.empty() || !last.results.converged)
      return last;
    std::vector<StepResult> steps;
    {
      LoadSteps series(model, parameters, last, times, journal);
      series.run(observe, checkpoints);
      steps                  = std::move(series.steps);
      last.results.converged = series.converged;
    }
    steps.push_back(step_result(times.back(), model, *last.discretization, last.solution, parameters.probes));
    journal.print(describe(steps.back()));
    observe(static_cast<unsigned int>(times.size() - 1), *last.discretization, last.solution);
    last.results.steps = std::move(steps);
    return last;
  }
} // namespace Signorini
