// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/application/contact_problem.h>
#include <signorini/solvers/sweep_measurement.h>

#include <deal.II/base/utilities.h>

#include <iomanip>

namespace Signorini
{
  using namespace dealii;

  ContactProblem::ContactProblem(ProblemParameters &parameters, const MPI_Comm communicator,
                                 ConditionalOStream &out)
    : parameters(parameters)
    , comm(communicator)
    , out(out)
    , bodies(communicator, parameters.bodies, parameters.base_folder)
    , refinement(parameters.refinement)
    , progress(std::cout, Progress::wanted(out.is_active(), parameters.verbosity))
  {
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      loads.add(bodies, b, parameters.loads[b]);
    for (const std::string &text : bodies.notes())
      note(text);
    define_pairs();
    note_movement();
    for (unsigned int i = 0; i < parameters.refinement.initial_global; ++i)
      {
        const NodalSpace space(comm, bodies.mesh());
        bodies.refine(space, std::vector<bool>(space.cells().size(), true));
      }
  }



  void ContactProblem::note(const std::string &text)
  {
    if (std::find(results.notes.begin(), results.notes.end(), text) != results.notes.end())
      return;
    results.notes.push_back(text);
    print("note: " + text);
  }



  void ContactProblem::print(const std::string &line)
  {
    if (parameters.verbosity == 0)
      return;
    progress.clear();
    out << line << std::endl;
  }



  void ContactProblem::setup_space()
  {
    Discretization &d = discretization;
    d.space = std::make_shared<NodalSpace>(comm, bodies.mesh(), parameters.refinement.adaptive_cycles > 0);
    d.partition    = std::make_unique<NodePartition>(d.space->owned(), d.space->relevant(), comm);
    d.dirichlet    = evaluate_dirichlet(*d.space, loads, true);
    d.free_motions = free_motions(bodies, *d.space, d.dirichlet);
    hold_by_ties();
  }



  void ContactProblem::evaluate_contact(const Vector &v, const ObstacleProblem &problem,
                                        const NodeBlockMatrix &matrix, const std::vector<double> &bounds,
                                        const std::vector<unsigned char> &active)
  {
    Discretization &d = discretization;
    Vector          residual;
    residual.reinit(v);
    matrix.symmetric_residual(residual, v, problem.rhs);
    const auto forces = replicate_values(matrix.partition(), residual, d.coupling.rows);
    const auto values = replicate_values(matrix.partition(), v, d.coupling.rows);
    // The active set is what the projection of the solver wrote.
    Vector flags;
    flags.reinit(v);
    for (std::size_t p = 0; p < problem.half_spaces.size(); ++p)
      flags.local_element(dim * problem.half_spaces.nodes[p]) = active[p];
    const auto active_rows = replicate_values(matrix.partition(), flags, d.coupling.rows);
    d.traction.resize(d.coupling.n_rows());
    d.pressure.resize(d.coupling.n_rows());
    d.opening.resize(d.coupling.n_rows());
    d.active.resize(d.coupling.n_rows());
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      {
        const RowProjection &projection = d.projections[p];
        d.pressure[p] = (forces[p] * projection.direction()) / (d.coupling.weight[p] * projection.share());
        d.traction[p] = d.pressure[p] * projection.normal();
        d.opening[p]  = projection.share() * (bounds[p] - projection.direction() * values[p]);
        d.active[p]   = active_rows[p][0] != 0. && d.pressure[p] > 0.;
      }
  }



  HalfSpaces ContactProblem::make_half_spaces(const NodePartition       &partition,
                                              const std::vector<double> &bounds) const
  {
    HalfSpaces            result;
    const Discretization &d = discretization;
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (!d.tied[p] && partition.owns(d.coupling.rows[p]))
        {
          result.nodes.push_back(partition.to_local(d.coupling.rows[p]));
          result.normals.push_back(d.projections[p].direction());
          result.bounds.push_back(bounds[p]);
          result.shares.push_back(d.projections[p].share());
        }
    return result;
  }



  std::unique_ptr<MultigridHierarchy> ContactProblem::make_hierarchy(LinearSystem         &&system,
                                                                     const LevelSpaces     &levels,
                                                                     const ObstacleProblem &problem,
                                                                     const Vector *const    start) const
  {
    const SolverMethod method = parameters.solver.method;
    if (!needs_levels(method))
      return std::make_unique<MultigridHierarchy>(std::move(system.matrix), std::move(system.fixed));
    HierarchyOptions options{method == SolverMethod::monotone_multigrid,
                             parameters.solver.level_zero,
                             discretization.free_motions,
                             &bodies,
                             discretization.tied,
                             parameters.solver.level_zero_steps};
    for (const ContactPair &pair : discretization.pairs)
      options.has_stiff_nonmortar =
          options.has_stiff_nonmortar ||
          (pair.mortar_body != numbers::invalid_unsigned_int &&
           parameters.bodies[pair.nonmortar_body].young > parameters.bodies[pair.mortar_body].young);
    // Corrections of a slow interface, for a stiff nonmortar side, are linear ones on the coarser levels,
    // which are no obstacle problems then; and what is measured for them must not depend on the start. Free
    // bodies are not where the start is.
    if ((start != nullptr || method == SolverMethod::accelerated) && !options.has_stiff_nonmortar &&
        options.free_motions.empty())
      {
        options.problem = &problem;
        options.start   = start;
      }
    return std::make_unique<MultigridHierarchy>(build_hierarchy(
        std::move(system), levels, discretization.coupling, discretization.projections, options));
  }



  void ContactProblem::solve_cycle(CycleResult &cycle)
  {
    Discretization &d = discretization;
    Timer           time;
    progress.show("assembling");
    LinearSystem system =
        assemble_elasticity(bodies, *d.space, loads, d.dirichlet, d.coupling, d.projections);
    tie_unknowns(system);
    ObstacleProblem problem;
    problem.rhs = std::move(system.rhs);
    cycle.times["assembly"] += time.wall_time();

    time.restart();
    progress.show("building levels");
    auto levels =
        std::make_unique<const LevelSpaces>(*d.space, coarser_spaces.update(bodies, d.space), bodies, loads);
    cycle.levels = levels->n_levels();
    cycle.times["levels"] += time.wall_time();

    time.restart();
    const std::vector<double> bounds    = d.transformation->reduce_gaps(d.gaps);
    const NodePartition       partition = system.matrix.partition();
    problem.half_spaces                 = make_half_spaces(partition, bounds);
    Vector v, start;
    partition.reinit(v);
    const bool has_start       = d.displacement.size() == 3 * d.space->n_nodes();
    const bool compares_linear = parameters.compare_linear && !d.is_held_by_ties && !d.pairs.empty();
    if (has_start)
      d.transformation->from_displacement(v, d.displacement);
    if (compares_linear)
      start = has_start ? d.displacement : d.transformation->to_displacement(v, partition);
    auto hierarchy = make_hierarchy(std::move(system), *levels, problem, has_start ? &v : nullptr);
    if (!compares_linear)
      levels.reset();
    const NodeBlockMatrix &matrix = hierarchy->finest().matrix;
    cycle.times["hierarchy"] += time.wall_time();

    time.restart();
    if (parameters.solver.method == SolverMethod::active_set_amg)
      problem.near_kernel =
          rigid_motions(*d.space, matrix.partition(), hierarchy->finest().fixed, d.coupling, d.projections);
    const auto monitor = [&](const unsigned int iteration, const double correction,
                             const unsigned int active) {
      if (parameters.verbosity > 1)
        {
          std::ostringstream line;
          line << "    iteration " << std::setw(3) << iteration << "   correction " << std::scientific
               << std::setprecision(3) << correction << "   active " << active;
          print(line.str());
        }
      progress.show("solving",
                    correction > 0. ? std::log(correction) / std::log(parameters.solver.tolerance) : 1.);
    };
    if (!d.free_motions.empty())
      hold_free_bodies(v, problem, *hierarchy, !has_start);
    SolverParameters solver_parameters = parameters.solver;
    // What was slow on one mesh is slow on the next.
    solver_parameters.starts_with_interface_sweeps =
        cycle.cycle > 0 && results.cycles[cycle.cycle - 1].nonlinear.needed_interface_sweeps;
    const auto solver = make_solver(*hierarchy, solver_parameters);
    cycle.nonlinear   = solver->solve(v, problem, monitor);
    if (!d.free_motions.empty())
      remove_free_motions(v, problem, *hierarchy, solver->active());
    cycle.times["solve"] += time.wall_time();
    if (!cycle.nonlinear.converged)
      {
        results.converged = false;
        note("cycle " + std::to_string(cycle.cycle) + ": " + cycle.nonlinear.note + ".");
      }
    else if (cycle.nonlinear.stagnated)
      note("cycle " + std::to_string(cycle.cycle) + ": " + cycle.nonlinear.note + ".");

    evaluate_contact(v, problem, matrix, bounds, solver->active());
    cycle.contact_nodes = d.coupling.n_rows();
    cycle.active_nodes  = std::accumulate(d.active.begin(), d.active.end(), std::size_t(0));
    d.displacement      = d.transformation->to_displacement(v, matrix.partition());
    evaluate_ties();
    if (parameters.measure_sweeps && cycle.cycle == refinement.n_cycles())
      cycle.sweeps = measure_sweeps(*hierarchy, problem.rhs);
    if (parameters.compare_linear && d.is_held_by_ties)
      note("no comparison with the linear problem: a body is held by its ties alone.");
    if (compares_linear)
      {
        // The contact hierarchy is not needed any more: make room for the linear one.
        hierarchy.reset();
        progress.show("linear comparison");
        solve_linear(cycle, *levels, start);
      }
  }



  void ContactProblem::solve_linear(CycleResult &cycle, const LevelSpaces &levels, const Vector &start)
  {
    Discretization                  &d = discretization;
    Timer                            time;
    const InterfaceCoupling          none;
    const std::vector<RowProjection> no_rows;
    LinearSystem    system = assemble_elasticity(bodies, *d.space, loads, d.dirichlet, none, no_rows);
    ObstacleProblem problem;
    problem.rhs = std::move(system.rhs);
    // The contact stresses as loads: -D λ n on the nonmortar side, +Mᵀ λ n on the mortar side.
    const auto add = [&](const NodeIndex node, const Vector3 &force) {
      if (!d.partition->owns(node))
        return;
      const unsigned int i    = d.partition->to_local(node);
      const FixedMask    mask = d.dirichlet.mask[d.space->relevant().index_within_set(node)];
      const Vector3      free = project_free(mask, force);
      for (unsigned int c = 0; c < dim; ++c)
        problem.rhs.local_element(dim * i + c) += free[c];
    };
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      {
        const Vector3 force = d.coupling.weight[p] * d.traction[p];
        add(d.coupling.rows[p], -force);
        for (const auto *entry = d.coupling.begin(p); entry != d.coupling.end(p); ++entry)
          add(entry->node, entry->weight * force);
      }
    cycle.times["linear_assembly"] += time.wall_time();

    time.restart();
    MultigridHierarchy hierarchy = build_hierarchy(std::move(system), levels, none, no_rows,
                                                   {false,
                                                    parameters.solver.level_zero,
                                                    d.free_motions,
                                                    &bodies,
                                                    {},
                                                    parameters.solver.level_zero_steps});
    // Both linear solves need it.
    hierarchy.coarse_solver();
    cycle.times["linear_hierarchy"] += time.wall_time();

    const NodeBlockMatrix    &matrix = hierarchy.finest().matrix;
    const BasisTransformation plain(*d.space, *d.partition, d.dirichlet, none, no_rows);
    Vector                    v, solution, product;
    problem.semidefinite = !d.free_motions.empty();
    const auto solve     = [&](const SolverMethod method, const char *const name) {
      time.restart();
      matrix.partition().reinit(v);
      plain.from_displacement(v, start);
      SolverParameters linear_parameters = parameters.solver;
      linear_parameters.method           = method;
      const ConvergenceReport report     = make_solver(hierarchy, linear_parameters)->solve(v, problem);
      cycle.times[name] += time.wall_time();
      return report;
    };
    cycle.linear     = solve(SolverMethod::multigrid, "linear_solve");
    cycle.linear_cg  = solve(SolverMethod::multigrid_cg, "linear_cg_solve");
    cycle.has_linear = true;

    matrix.partition().reinit(solution);
    matrix.partition().reinit(product);
    plain.from_displacement(solution, d.displacement);
    matrix.vmult(product, solution);
    const double scale = product * solution;
    solution -= v;
    // Rigid motions of free bodies may differ by anything.
    if (!d.free_motions.empty())
      {
        std::vector<Vector> motions = motions_of_unknowns(matrix.partition(), plain);
        orthonormalize(motions);
        subtract_projection(solution, motions);
      }
    matrix.vmult(product, solution);
    cycle.difference = scale > 0. ? std::sqrt(std::max(0., product * solution) / scale) : 0.;
  }



  bool ContactProblem::refine(const std::vector<bool> &marked)
  {
    Discretization &d = discretization;
    if (!bodies.refine(*d.space, marked))
      return false;
    note_movement();
    const auto old_space     = std::move(d.space);
    const auto old_partition = std::move(d.partition);
    d.transformation.reset();
    setup_space();
    if (d.displacement.size() == 0)
      return true;
    const NodeRows rows = interpolation_rows(*d.space, *old_space, bodies.tetrahedra());
    d.displacement      = interpolate(d.displacement, rows, *old_space);
    for (Vector &displacement : earlier_displacements)
      displacement = interpolate(displacement, rows, *old_space);
    return true;
  }



  Vector ContactProblem::interpolate(const Vector &old, const NodeRows &rows,
                                     const NodalSpace &old_space) const
  {
    // The columns of the rows may belong to other ranks.
    const Discretization  &d = discretization;
    std::vector<NodeIndex> columns;
    for (const NodeIndex column : rows.columns)
      if (!old_space.owned().is_element(column))
        columns.push_back(column);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    IndexSet needed = old_space.owned();
    needed.add_indices(columns.begin(), columns.end());
    const NodePartition sources(old_space.owned(), needed, comm);
    Vector              values, result;
    sources.reinit(values);
    for (unsigned int i = 0; i < dim * sources.n_owned(); ++i)
      values.local_element(i) = old.local_element(i);
    values.update_ghost_values();
    d.partition->reinit(result);
    const auto add = [&](const NodeIndex to, const double weight, const Vector &from, const unsigned int i) {
      for (unsigned int c = 0; c < dim; ++c)
        result.local_element(dim * to + c) += weight * from.local_element(dim * i + c);
    };
    for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
      for (std::size_t k = rows.start[i]; k < rows.start[i + 1]; ++k)
        add(i, rows.weights[k], values, sources.to_local(rows.columns[k]));
    result.update_ghost_values();
    for (const auto &line : d.space->hanging_nodes().get_lines())
      if (d.partition->owns(line.index))
        for (const auto &[parent, weight] : line.entries)
          add(d.partition->to_local(line.index), weight, result, d.partition->to_local(parent));
    result.update_ghost_values();
    return result;
  }



  void ContactProblem::run()
  {
    std::vector<double> indicator;
    for (unsigned int cycle = 0; cycle <= refinement.n_cycles(); ++cycle)
      {
        results.cycles.emplace_back();
        CycleResult &result = results.cycles.back();
        result.cycle        = cycle;
        Timer time;
        if (cycle == 0)
          {
            setup_space();
            check_free_bodies();
          }
        else if (progress.show("refining"); !refine(mark(cycle, indicator)))
          {
            results.cycles.pop_back();
            continue;
          }
        result.movement = bodies.movement();
        result.cells    = discretization.space->n_global_cells();
        result.dofs     = dim * discretization.space->n_conforming_nodes();
        result.times["mesh"] += time.wall_time();
        print("cycle " + std::to_string(cycle) + ": " + std::to_string(result.cells) + " cells, " +
              std::to_string(result.dofs) + " dofs");
        progress.show("contact mapping and mortar integrals");
        setup_contact(result);
        solve_cycle(result);
        std::ostringstream line;
        line << "  " << result.nonlinear.iterations << " iterations";
        if (result.has_linear)
          line << " (linear multigrid " << result.linear.iterations << ", with conjugate gradients "
               << result.linear_cg.iterations << ", difference " << result.difference << ")";
        line << ", " << result.active_nodes << " of " << result.contact_nodes << " contact nodes active";
        compare_with_exact(result);
        if (parameters.refinement.adaptive_cycles > 0)
          {
            progress.show("estimating the error");
            time.restart();
            indicator               = estimate();
            result.potential_energy = potential_energy(
                bodies, *discretization.space, *discretization.partition, loads, discretization.displacement);
            double total = 0.;
            for (std::size_t c = 0; c < indicator.size(); ++c)
              if (discretization.space->cells()[c].is_owned)
                total += indicator[c];
            result.indicator = std::sqrt(Utilities::MPI::sum(total, comm));
            result.times["estimate"] += time.wall_time();
            line << ", error indicator " << result.indicator;
          }
        if (parameters.refinement.compare_cycles && cycle < refinement.n_cycles())
          earlier_displacements.push_back(discretization.displacement);
        print(line.str());
      }
    compare_cycles();
    progress.show("evaluating");
    finish();
    progress.clear();
    results.wall_time = total_time.wall_time();
  }



  void ContactProblem::build_meshes()
  {
    setup_space();
    CycleResult cycle;
    for (unsigned int c = 1; c <= refinement.n_cycles(); ++c)
      if (!refinement.is_adaptive(c))
        refine(refinement.mark(*discretization.space, c));
    if (parameters.refinement.adaptive_cycles > 0)
      note("the meshes are without the adaptive cycles, which need solutions.");
    setup_contact(cycle);
    discretization.partition->reinit(discretization.displacement);
    discretization.displacement.update_ghost_values();
    discretization.traction.assign(discretization.coupling.n_rows(), Vector3());
    discretization.pressure.assign(discretization.coupling.n_rows(), 0.);
    discretization.opening = discretization.gaps;
    discretization.active.assign(discretization.coupling.n_rows(), 0);
    collect_pairs();
  }
} // namespace Signorini
