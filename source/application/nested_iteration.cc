// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "adaptive_marks.h"
#include "cycle_words.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/certificate.h>
#include <signorini/application/error_estimate.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/nested_iteration.h>
#include <signorini/application/pair_fields.h>
#include <signorini/application/parting_bodies.h>
#include <signorini/application/point_holds.h>
#include <signorini/application/turning_faces.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/exact_error.h>
#include <signorini/discretization/level_hierarchy.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    void compare_with_exact(CycleResult &result, const ContactModel &model, const Discretization &d,
                            const Vector &displacement, const std::vector<VectorField> &exact)
    {
      AssertThrow(exact.size() <= model.bodies().n_bodies(), ExcMessage("There is no such body."));
      for (unsigned int b = 0; b < exact.size(); ++b)
        if (exact[b])
          result.exact_errors[model.bodies().body_name(b)] = compute_exact_error(
              model.bodies(), model.loads(), d.nodal(), d.partition(), displacement, {b, exact[b]});
    }

    void store(CycleResult &result, const Discretization &d, const ContactSolution &solution)
    {
      result.levels        = solution.n_levels;
      result.nonlinear     = solution.report;
      result.contact_nodes = d.n_contact_nodes;
      result.active_nodes  = solution.n_active;
      result.sweeps        = solution.sweeps;
      result.has_linear    = solution.linear.has_value();
      if (!solution.linear)
        return;
      result.linear     = solution.linear->multigrid;
      result.linear_cg  = solution.linear->multigrid_cg;
      result.difference = solution.linear->difference;
    }

    /// The state of the nested iteration between two meshes.
    class NestedIteration
    {
    public:
      NestedIteration(ContactModel &model, const NestedParameters &parameters, Journal &journal,
                      Checkpoints *const checkpoints)
        : model(model)
        , parameters(parameters)
        , journal(journal)
        , checkpoints(checkpoints)
        , refinement(parameters.refinement)
        , is_adaptive(parameters.refinement.adaptive_cycles > 0)
      {
      }

      NestedSolution run()
      {
        const bool resumes = checkpoints != nullptr && checkpoints->reader() != nullptr;
        for (unsigned int cycle = resumes ? restore() + 1 : 0;
             cycle <= refinement.n_cycles() && goes_on(cycle); ++cycle)
          if (next_mesh(cycle))
            {
              solve_mesh(cycle);
              save(cycle);
            }
        if (!last.discretization)
          restore_solution();
        compare_cycles();
        compare_with_wanted(last.results.cycles.back(), parameters.refinement, journal);
        journal.show("evaluating");
        evaluate();
        last.indicator = std::move(indicator);
        journal.clear();
        return std::move(last);
      }

    private:
      /// Finer meshes are no use where a coarser one could not be solved, and an indicator means nothing
      /// there.
      bool goes_on(const unsigned int cycle)
      {
        if (cycle == 0 || last.results.converged)
          return true;
        journal.note("cycle " + std::to_string(last.results.cycles.back().cycle) +
                     " was not solved: no further refinement.");
        return false;
      }

      bool next_mesh(const unsigned int cycle)
      {
        const auto time = journal.measure(Phase::mesh);
        if (cycle == 0)
          {
            space = std::make_shared<const ConstrainedSpace>(model, is_adaptive);
            check_free_parts(model, space->free_parts, parameters.solve.solver.method, journal);
            note_turning_faces(model, *space, journal);
            check_probes(model, space->nodal(), parameters.probes);
            return true;
          }
        journal.show("refining");
        const NodalSpace       &old = space->nodal();
        const std::vector<bool> marked =
            refinement.is_adaptive(cycle)
                ? mark_adaptively(old, indicator, last.results.cycles.back(), parameters.refinement, journal)
                : refinement.mark(model.bodies(), old, cycle);
        if (!model.refine(old, marked))
          return false;
        if (keeps_state())
          note_marks(marked, CurveOrder(old));
        model.note_movement(journal);
        carry_over(std::make_shared<const ConstrainedSpace>(model, is_adaptive));
        return true;
      }

      /// Solutions of the old mesh become those of the new one.
      void carry_over(std::shared_ptr<const ConstrainedSpace> next)
      {
        const NodeRows rows = interpolation_rows(next->nodal(), space->nodal(), model.bodies().tetrahedra());
        start               = {next->interpolate(last.solution.displacement, *space, rows),
                               last.solution.report.needed_interface_sweeps, last.solution.report.needed_patches};
        for (Vector &displacement : earlier_displacements)
          displacement = next->interpolate(displacement, *space, rows);
        last.discretization.reset();
        space = std::move(next);
      }

      void solve_mesh(const unsigned int cycle)
      {
        CycleResult result;
        result.cycle    = cycle;
        result.movement = model.bodies().movement();
        result.cells    = space->nodal().n_global_cells();
        result.dofs     = dim * space->nodal().n_conforming_nodes();
        expect(result);
        if (journal.wants_iterations())
          journal.print("cycle " + std::to_string(cycle) + ": " + std::to_string(result.cells) + " cells, " +
                        std::to_string(result.dofs) + " unknowns");
        couple(cycle);
        solve_coupled(cycle, cycle > 0 ? &start : nullptr);
        while (part_bodies(choices, *last.discretization, last.solution, journal))
          {
            start = {last.solution.displacement, last.solution.report.needed_interface_sweeps,
                     last.solution.report.needed_patches};
            couple(cycle);
            solve_coupled(cycle, &start);
          }
        const Discretization    &d      = *last.discretization;
        const ConvergenceReport &report = last.solution.report;
        last.results.converged          = last.results.converged && report.converged;
        if (!report.converged || report.stagnated)
          journal.note("cycle " + std::to_string(cycle) + ": " + report.note + "." +
                       (report.converged ? "" : what_may_help(parameters.solve.solver)));
        if (report.safety_net.after > 0)
          journal.note("cycle " + std::to_string(cycle) + ": " + describe(report.safety_net));
        if (report.needed_patches && report.before_patches > 0)
          journal.note("cycle " + std::to_string(cycle) + ": the iteration was slow, and after " +
                       std::to_string(report.before_patches) +
                       " of them went on to smooth patches of nodes; so do the next meshes.");
        store(result, d, last.solution);
        compare_with_exact(result, model, d, last.solution.displacement, parameters.exact_displacements);
        if (is_adaptive)
          estimate(result);
        if (parameters.refinement.compare_cycles && cycle < refinement.n_cycles())
          earlier_displacements.push_back(last.solution.displacement);
        result.times = journal.take_times();
        journal.print(describe(result, is_adaptive));
        last.results.cycles.push_back(result);
      }

      /// The contact problem on the present mesh.
      void couple(const unsigned int cycle)
      {
        journal.show("contact mapping and mortar integrals");
        last.discretization.reset();
        last.discretization = discretize(model, space, choices, cycle, journal);
        choices             = last.discretization->choices;
      }

      /// Holds points where contact leaves motions open.
      /// @param from null without a start
      void solve_coupled(const unsigned int cycle, const NestedStart *const from)
      {
        // Without points for that the solution shows whether it drifts.
        const auto      unopposed = find_unopposed_motions(model, *last.discretization);
        const bool      holds_now = !unopposed.empty() && hold_points({HoldReason::unopposed, unopposed, 0.});
        SolveParameters how_to    = parameters.solve;
        how_to.measure_sweeps     = how_to.measure_sweeps && cycle == refinement.n_cycles();
        last.solution =
            solve_contact(model, *last.discretization, coarser, holds_now ? nullptr : from, how_to, journal);
        unsigned int before_holds = 0;
        while (!last.solution.drift.motions.empty())
          {
            if (!hold_points(last.solution.drift))
              {
                leave_drift(model, *last.discretization, last.solution, journal);
                break;
              }
            before_holds += last.solution.report.iterations;
            last.solution = solve_contact(model, *last.discretization, coarser, nullptr, how_to, journal);
          }
        before_holds += settle_holds(how_to);
        if (before_holds > 0)
          journal.note("cycle " + std::to_string(cycle) + ": " + std::to_string(before_holds) +
                       " iterations more, before points were held.");
        check_point_holds(model, *last.discretization, last.solution);
      }

      /// False if there is no point for that.
      bool hold_points(const Drift &drift)
      {
        const std::vector<PointHold> holds = choose_point_holds(model, *last.discretization, drift);
        if (holds.empty())
          return false;
        for (const PointHold &hold : holds)
          model.hold(hold);
        renew_conditions();
        return true;
      }

      /// Solves once more with held points where they should be, unless they carry more there; from zero, for
      /// motions that hardly anything opposes are the last to converge. Returns the number of iterations
      /// more.
      unsigned int settle_holds(const SolveParameters &how_to)
      {
        const std::vector<PointHold> holds = model.point_holds();
        const auto at_rest = settle_point_holds(model, *last.discretization, last.solution.displacement);
        if (!at_rest)
          return 0;
        const double strain = strain_of_point_holds(model, *last.discretization, last.solution);
        renew_conditions();
        ContactSolution solution =
            solve_contact(model, *last.discretization, coarser, nullptr, how_to, journal);
        const unsigned int n_settled = solution.report.iterations;
        if (strain_of_point_holds(model, *last.discretization, solution) <= std::max(strain, small_strain))
          {
            std::swap(solution, last.solution);
            return solution.report.iterations;
          }
        for (std::size_t i = 0; i < holds.size(); ++i)
          model.set_hold_value(i, holds[i].value);
        renew_conditions();
        return n_settled;
      }

      /// On the same mesh.
      void renew_conditions()
      {
        space               = ConstrainedSpace::with_more_conditions(*space, model);
        last.discretization = std::make_unique<const Discretization>(*last.discretization, space);
      }

      bool keeps_state() const
      {
        return checkpoints != nullptr && checkpoints->are_wanted();
      }

      void note_marks(const std::vector<bool> &marked, const CurveOrder &order)
      {
        auto &all = checkpoints->state().nested.marked;
        all.emplace_back();
        for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
          for (const unsigned int cell : order.cells(kind))
            all.back()[kind].push_back(marked[cell]);
      }

      /// The state after a cycle, from which its file is written.
      void save(const unsigned int cycle)
      {
        if (!keeps_state())
          return;
        const CurveOrder     order(space->nodal());
        const NodePartition &partition = space->partition;
        NestedState         &state     = checkpoints->state().nested;
        state.cycle                    = cycle;
        state.trace                    = order.trace();
        state.choices                  = choices;
        state.bolts                    = save_bolts(model.loads().pretensions);
        state.holds                    = model.point_holds();
        state.cycles                   = last.results.cycles;
        state.converged                = last.results.converged;
        state.solution.report          = last.solution.report;
        state.solution.pretensions     = last.solution.pretensions;
        state.solution.n_active        = last.solution.n_active;
        state.solution.n_levels        = last.solution.n_levels;
        state.displacement             = save_field(last.solution.displacement, partition, order);
        state.earlier.clear();
        for (const Vector &displacement : earlier_displacements)
          state.earlier.push_back(save_field(displacement, partition, order));
        state.contact       = save_stress(last.solution.stress, *last.discretization, order);
        state.has_indicator = is_adaptive;
        for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
          {
            state.indicator[kind].clear();
            for (const unsigned int cell : order.cells(kind))
              if (is_adaptive)
                state.indicator[kind].push_back(indicator[cell]);
          }
        checkpoints->end_of_stage("cycle " + std::to_string(cycle), growth_of_work(cycle), journal);
      }

      /// How many times as long the next cycle will take; 0 after the last.
      double growth_of_work(const unsigned int cycle) const
      {
        const std::vector<CycleResult> &cycles = last.results.cycles;
        if (cycle >= refinement.n_cycles() || !last.results.converged)
          return 0.;
        if (refinement.is_global(cycle + 1))
          return 8.;
        return cycles.size() < 2 ? 2.
                                 : static_cast<double>(cycles.back().dofs) /
                                       static_cast<double>(cycles[cycles.size() - 2].dofs);
      }

      /// Meshes and fields of a saved state; returns its cycle.
      unsigned int restore()
      {
        journal.show("rebuilding the meshes");
        RunState               &saved  = checkpoints->state();
        NestedState            &state  = saved.nested;
        const CheckpointReader &reader = *checkpoints->reader();
        try
          {
            for (unsigned int k = 0; k < state.marked.size(); ++k)
              {
                const NodalSpace old(model.communicator(), model.bodies().mesh());
                const CurveOrder order(old);
                read_marks(state, reader, k, order);
                std::vector<bool> marked(old.cells().size(), false);
                for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
                  for (std::size_t i = 0; i < order.cells(kind).size(); ++i)
                    marked[order.cells(kind)[i]] = state.marked[k][kind][i] != 0;
                model.refine(old, marked);
              }
            for (const PointHold &hold : state.holds)
              model.hold(hold);
            space = std::make_shared<const ConstrainedSpace>(model, is_adaptive);
            read_fields(saved, reader, CurveOrder(space->nodal()));
          }
        catch (const InputError &e)
          {
            checkpoints->refuse(e.what());
          }
        checkpoints->end_of_reading();
        take_over(saved);
        return state.cycle;
      }

      /// What a state has of this object.
      void take_over(const RunState &saved)
      {
        const NestedState &state = saved.nested;
        const CurveOrder   order(space->nodal());
        for (const std::string &note : saved.notes)
          journal.note(note);
        choices                = state.choices;
        last.results.cycles    = state.cycles;
        last.results.converged = state.converged;
        last.solution          = state.solution;
        restore_field(last.solution.displacement, state.displacement, space->partition, order);
        for (const SavedField &displacement : state.earlier)
          restore_field(earlier_displacements.emplace_back(), displacement, space->partition, order);
        restore_bolts(model.pretensions(), state.bolts);
        indicator.assign(is_adaptive ? space->nodal().cells().size() : 0, 0.);
        for (unsigned int kind = 0; kind < CurveOrder::n_kinds; ++kind)
          for (std::size_t i = 0; i < state.indicator[kind].size(); ++i)
            indicator[order.cells(kind)[i]] = state.indicator[kind][i];
        journal.print("goes on after cycle " + std::to_string(state.cycle) +
                      (saved.series ? " and step " + std::to_string(saved.series->steps.size()) : "") +
                      " of an interrupted run");
        check_free_parts(model, space->free_parts, parameters.solve.solver.method, journal);
      }

      /// The last mesh was that of the state: what is evaluated on it.
      void restore_solution()
      {
        const NestedState &state = checkpoints->state().nested;
        last.discretization      = discretize(model, space, choices, state.cycle, journal);
        last.solution.stress =
            restore_stress(state.contact, *last.discretization, CurveOrder(space->nodal()));
        journal.take_times();
      }

      /// Work is in proportion to the unknowns; those of the meshes to come are guessed.
      void expect(const CycleResult &present)
      {
        double before = 0., next = static_cast<double>(present.dofs), growth = 2.;
        for (const CycleResult &cycle : last.results.cycles)
          before += static_cast<double>(cycle.dofs);
        if (!last.results.cycles.empty())
          growth = next / static_cast<double>(last.results.cycles.back().dofs);
        double all = before + next;
        for (unsigned int cycle = present.cycle + 1; cycle <= refinement.n_cycles(); ++cycle)
          {
            next *= refinement.is_global(cycle) ? 8. : growth;
            all += next;
          }
        journal.expect(before, static_cast<double>(present.dofs), all);
      }

      void estimate(CycleResult &result)
      {
        const auto time = journal.measure(Phase::estimate);
        journal.show("estimating the error");
        indicator               = estimate_error(model, *last.discretization, last.solution);
        result.indicator        = total_indicator(space->nodal(), indicator);
        result.stress_error     = estimate_stress_error(model, *last.discretization, last.solution);
        result.potential_energy = potential_energy(model.bodies(), space->nodal(), space->partition,
                                                   model.loads(), last.solution.displacement);
      }

      /// How far the solutions of all cycles are from the last.
      void compare_cycles()
      {
        std::vector<CycleResult> &cycles = last.results.cycles;
        for (std::size_t k = 0; k < earlier_displacements.size() && k + 1 < cycles.size(); ++k)
          {
            Vector &difference = earlier_displacements[k];
            difference -= last.solution.displacement;
            difference.update_ghost_values();
            cycles[k].error_to_last =
                std::sqrt(2. * std::max(0., strain_energy(model.bodies(), space->nodal(), space->partition,
                                                          difference)));
          }
        earlier_displacements.clear();
      }

      void evaluate()
      {
        const Discretization &d          = *last.discretization;
        Results              &results    = last.results;
        ContactEvaluation     evaluation = evaluate_contact(model, d, last.solution);
        const auto            unseen     = find_unseen_penetrations(model, d, last.solution.displacement);
        results.probes                   = evaluate_probes(model, d, last.solution, parameters.probes);
        results.certificate              = certify(model, d, last.solution, evaluation, unseen,
                                                   {parameters.solve.solver.tolerance, results.converged});
        results.cycles.back().potential_energy = results.certificate.potential_energy;
        for (unsigned int p = 0; p < d.pairs.size(); ++p)
          {
            const PairResult &pair = evaluation.pairs[p];
            if (!(pair.contact_area > 0.) && pair.missed_penetration == 0.)
              journal.note("pair " + d.pairs[p].name +
                           ": the surfaces are separated, there is no contact force.");
          }
        for (const UnseenPenetration &one : unseen)
          if (!one.has_pair)
            journal.note(describe_unseen(model, one));
        for (const std::string &remark : check_point_holds(model, d, last.solution))
          journal.note(remark);
        results.boundaries          = evaluation.equilibrium.told_reactions();
        results.largest_nodal_force = evaluation.equilibrium.largest_nodal_force;
        results.pairs               = std::move(evaluation.pairs);
        results.pretensions         = last.solution.pretensions;
        results.pressure            = std::move(evaluation.pressure);
        results.mortar_pressure     = std::move(evaluation.mortar_pressure);
      }

      ContactModel                           &model;
      const NestedParameters                 &parameters;
      Journal                                &journal;
      Checkpoints *const                      checkpoints;
      const Refinement                        refinement;
      const bool                              is_adaptive;
      std::shared_ptr<const ConstrainedSpace> space;
      CoarserSpaces                           coarser;
      NestedStart                             start;
      std::vector<PairChoice>                 choices;
      std::vector<double>                     indicator;
      /// Those of the cycles before, on the current mesh, if they are to be compared.
      std::vector<Vector> earlier_displacements;
      NestedSolution      last;
    };
  } // namespace



  NestedSolution run_nested_iteration(ContactModel &model, const NestedParameters &parameters,
                                      Journal &journal, Checkpoints *const checkpoints)
  {
    return NestedIteration(model, parameters, journal, checkpoints).run();
  }
} // namespace Signorini
