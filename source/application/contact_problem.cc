// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_problem.h>
#include <signorini/mesh/surface_extraction.h>

#include <deal.II/base/utilities.h>
#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/fe/fe_q.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// "body: boundary".
    std::pair<std::string, std::string> split_side(const std::string &text, const std::string &where)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
        throw InputError(where + ": \"" + text + "\" should read \"body: boundary\".");
      return {Utilities::trim(text.substr(0, colon)), Utilities::trim(text.substr(colon + 1))};
    }

    double average_face_area(const ContactSurface &surface)
    {
      double area = 0.;
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        area += triangle_area(surface.mesh, t);
      return surface.faces.empty() ? 0. : area / static_cast<double>(surface.faces.size());
    }
  } // namespace



  ContactProblem::ContactProblem(ProblemParameters &parameters, const MPI_Comm communicator,
                                 ConditionalOStream &out)
    : parameters(parameters)
    , comm(communicator)
    , out(out)
    , bodies(communicator, parameters.bodies, parameters.base_folder)
    , refinement(parameters.refinement)
  {
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      loads.add(bodies, b, parameters.loads[b]);
    for (const std::string &text : bodies.notes())
      note(text);
    define_pairs();
    if (parameters.refinement.initial_global > 0)
      bodies.triangulation().refine_global(parameters.refinement.initial_global);
  }



  void ContactProblem::note(const std::string &text)
  {
    if (std::find(results.notes.begin(), results.notes.end(), text) != results.notes.end())
      return;
    results.notes.push_back(text);
    if (parameters.verbosity > 0)
      out << "note: " << text << std::endl;
  }



  void ContactProblem::define_pairs()
  {
    for (const PairParameters &p : parameters.pairs)
      {
        PairDefinition    definition;
        const std::string section     = "Pair " + p.name + "/";
        definition.parameters         = p;
        const std::string *sides[2]   = {&p.first, &p.second};
        const std::string *regions[2] = {&p.first_region, &p.second_region};
        const char        *names[2]   = {"First", "Second"};
        for (unsigned int i = 0; i < 2; ++i)
          {
            const std::string where     = section + names[i];
            const auto [body, boundary] = split_side(*sides[i], where);
            definition.body[i]          = bodies.body_index(body, where);
            definition.boundary[i]      = boundary;
            try
              {
                bodies.boundary_ids(definition.body[i], boundary);
              }
            catch (const InputError &e)
              {
                throw InputError(where + ": " + e.what());
              }
            definition.has_region[i] = !Utilities::trim(*regions[i]).empty();
            if (definition.has_region[i])
              definition.region[i] = Expression(*regions[i], where + " region");
          }
        definition.has_gap = Utilities::trim(p.initial_gap) != "geometry";
        if (definition.has_gap)
          definition.gap = Expression(p.initial_gap, section + "Initial gap");
        if (p.penetration != "resolve" && p.penetration != "refuse")
          throw InputError(section + "Initial penetration: use resolve or refuse.");
        pair_definitions.push_back(definition);
      }
  }



  void ContactProblem::setup_space()
  {
    Discretization &d = discretization;
    d.space           = std::make_unique<NodalSpace>(bodies.triangulation());
    d.partition       = std::make_unique<NodePartition>(d.space->owned(), d.space->relevant(), comm);
    d.dirichlet       = evaluate_dirichlet(*d.space, loads, true);
  }



  unsigned int ContactProblem::choose_nonmortar(const PairDefinition &definition,
                                                const ContactSurface (&surfaces)[2])
  {
    const double young[2] = {parameters.bodies[definition.body[0]].young,
                             parameters.bodies[definition.body[1]].young};
    unsigned int softer   = 0;
    if (std::abs(young[0] - young[1]) > 1e-6 * std::max(young[0], young[1]))
      softer = young[0] < young[1] ? 0 : 1;
    else
      softer = average_face_area(surfaces[0]) <= average_face_area(surfaces[1]) * (1. + 1e-9) ? 0 : 1;
    if (definition.parameters.nonmortar == "auto")
      {
        note("pair " + definition.parameters.name + ": \"" + bodies.body_name(definition.body[softer]) +
             "\" is the nonmortar side (the softer body, then the finer mesh).");
        return softer;
      }
    const unsigned int chosen = definition.parameters.nonmortar == "first" ? 0 : 1;
    if (young[chosen] > 10. * young[1 - chosen])
      note("warning: pair " + definition.parameters.name +
           ": the nonmortar side is the stiffer body; the solver needs many more iterations this way.");
    return chosen;
  }



  ContactPair ContactProblem::make_pair(const PairDefinition &definition, CycleResult &cycle)
  {
    Discretization &d = discretization;
    Timer           time;
    ContactSurface  surfaces[2];
    for (unsigned int i = 0; i < 2; ++i)
      surfaces[i] = extract_contact_surface(
          *d.space, bodies.boundary_ids(definition.body[i], definition.boundary[i]),
          [&](const NodeIndex node) { return d.dirichlet.mask[d.space->relevant().index_within_set(node)]; },
          definition.has_region[i] ? [&](const Point<3> &p) { return definition.region[i](p) > 0.; }
                                   : std::function<bool(const Point<3> &)>());
    for (unsigned int i = 0; i < 2; ++i)
      if (surfaces[i].faces.empty())
        throw InputError("Pair " + definition.parameters.name + ": the boundary \"" + definition.boundary[i] +
                         "\" of body \"" + bodies.body_name(definition.body[i]) +
                         "\" has no faces in its region.");

    const unsigned int non = choose_nonmortar(definition, surfaces);
    ContactPair        pair;
    pair.name           = definition.parameters.name;
    pair.nonmortar_body = definition.body[non];
    pair.mortar_body    = definition.body[1 - non];
    pair.nonmortar_name = bodies.body_name(pair.nonmortar_body) + ": " + definition.boundary[non];
    pair.mortar_name    = bodies.body_name(pair.mortar_body) + ": " + definition.boundary[1 - non];
    pair.nonmortar      = std::move(surfaces[non]);
    pair.mortar         = std::move(surfaces[1 - non]);
    if (definition.has_gap)
      pair.prescribed_gap = [gap = definition.gap](const Point<3> &p) { return gap(p); };
    cycle.times["mesh"] += time.wall_time();

    time.restart();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    pair.mapping =
        std::make_unique<ContactMapping>(pair.nonmortar.mesh, pair.mortar.mesh, [&](const unsigned int t) {
          return pair.nonmortar.faces[pair.nonmortar.triangle_face[t]].owner == rank;
        });
    if (Utilities::MPI::sum(pair.mapping->report().n_cells, comm) == 0)
      throw InputError("Pair " + pair.name + ": the surfaces \"" + pair.nonmortar_name + "\" and \"" +
                       pair.mortar_name +
                       "\" do not face each other anywhere: there is not a single overlay cell.");
    cycle.times["mapping"] += time.wall_time();

    time.restart();
    pair.moments =
        compute_face_moments(pair.nonmortar, pair.mortar, pair.mapping->overlay(), pair.prescribed_gap, comm);
    cycle.times["mortar"] += time.wall_time();
    return pair;
  }



  void ContactProblem::setup_contact(CycleResult &cycle)
  {
    Discretization &d = discretization;
    d.pairs.clear();
    for (const PairDefinition &definition : pair_definitions)
      d.pairs.push_back(make_pair(definition, cycle));

    Timer                            time;
    std::vector<std::set<NodeIndex>> nonmortar_nodes, mortar_nodes;
    for (const ContactPair &pair : d.pairs)
      {
        nonmortar_nodes.push_back(touched_nonmortar_nodes(pair.nonmortar, pair.moments));
        mortar_nodes.push_back(touched_mortar_nodes(pair.mortar, pair.moments));
      }
    d.couplings.clear();
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        std::set<NodeIndex> excluded;
        for (unsigned int q = 0; q < d.pairs.size(); ++q)
          {
            if (q < p)
              excluded.insert(nonmortar_nodes[q].begin(), nonmortar_nodes[q].end());
            if (q != p)
              excluded.insert(mortar_nodes[q].begin(), mortar_nodes[q].end());
          }
        const ContactPair &pair = d.pairs[p];
        d.couplings.push_back(couple(pair.nonmortar, pair.mortar, pair.moments, excluded,
                                     static_cast<bool>(pair.prescribed_gap)));
        const PairCoupling                 &c = d.couplings.back();
        std::map<std::string, unsigned int> reasons;
        for (const DroppedNode &node : c.dropped)
          ++reasons[to_string(node.reason)];
        for (const auto &[reason, n] : reasons)
          note("pair " + pair.name + ", cycle " + std::to_string(cycle.cycle) + ": " + std::to_string(n) +
               " nonmortar nodes without multiplier (" + reason + ").");
        if (c.lost_area > 1e-12 * c.area)
          note("pair " + pair.name + ": an area of " + std::to_string(c.lost_area) +
               " is covered but carries no multiplier.");
        const double smallest = c.gaps.empty() ? 0. : *std::min_element(c.gaps.begin(), c.gaps.end());
        double       size     = 0.;
        for (const Point<3> &x : c.positions)
          size = std::max(size, x.distance(c.positions[0]));
        // Faceted curved surfaces overlap by rounding and by their sagitta; report what exceeds rounding.
        if (smallest < -1e-12 * size && cycle.cycle == 0)
          {
            std::ostringstream text;
            text << "pair " << pair.name << ": initial penetration of " << -smallest << " (weighted gap)";
            if (pair_definitions[p].parameters.penetration == "refuse")
              throw InputError(text.str() + "; \"Initial penetration = refuse\" does not allow it.");
            note(text.str() + ", resolved as an interference fit.");
          }
      }
    d.origin = join_couplings(d.coupling, d.couplings);
    d.row_masks.clear();
    d.normals.clear();
    d.gaps.clear();
    for (const auto &[p, row] : d.origin)
      {
        d.row_masks.push_back(d.couplings[p].fixed[row]);
        d.normals.push_back(d.couplings[p].normals[row]);
        d.gaps.push_back(d.couplings[p].gaps[row]);
      }
    d.transformation =
        std::make_unique<BasisTransformation>(*d.space, *d.partition, d.dirichlet, d.coupling, d.row_masks);
    cycle.times["mortar"] += time.wall_time();
  }



  void ContactProblem::evaluate_contact(const Vector &v, const ObstacleProblem &problem,
                                        const NodeBlockMatrix &matrix, const std::vector<double> &gaps)
  {
    Discretization &d = discretization;
    Vector          residual;
    residual.reinit(v);
    matrix.vmult(residual, v);
    residual.sadd(-1., 1., problem.rhs);
    const auto forces = replicate_values(matrix.partition(), residual, d.coupling.rows);
    const auto values = replicate_values(matrix.partition(), v, d.coupling.rows);
    d.pressure.resize(d.coupling.n_rows());
    d.opening.resize(d.coupling.n_rows());
    d.active.resize(d.coupling.n_rows());
    double scale = 0.;
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      {
        d.pressure[p] = (forces[p] * d.normals[p]) / d.coupling.weight[p];
        d.opening[p]  = gaps[p] - d.normals[p] * values[p];
        scale         = std::max(scale, values[p].norm());
      }
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      d.active[p] = d.opening[p] <= 1e-14 * std::max(scale, std::abs(gaps[p])) && d.pressure[p] > 0.;
  }



  void ContactProblem::solve_cycle(CycleResult &cycle)
  {
    Discretization &d = discretization;
    Timer           time;
    LinearSystem system = assemble_elasticity(bodies, *d.space, loads, d.dirichlet, d.coupling, d.row_masks);
    ObstacleProblem problem;
    problem.rhs = std::move(system.rhs);
    cycle.times["assembly"] += time.wall_time();

    time.restart();
    const LevelSpaces levels(*d.space, loads);
    auto              hierarchy =
        std::make_unique<MultigridHierarchy>(build_hierarchy(std::move(system), levels, d.coupling));
    cycle.levels = levels.n_levels();
    cycle.times["hierarchy"] += time.wall_time();

    time.restart();
    const NodeBlockMatrix    &matrix = hierarchy->finest().matrix;
    const std::vector<double> gaps   = d.transformation->reduce_gaps(d.gaps, d.normals);
    for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
      if (matrix.partition().owns(d.coupling.rows[p]))
        {
          problem.half_spaces.nodes.push_back(matrix.partition().to_local(d.coupling.rows[p]));
          problem.half_spaces.normals.push_back(d.normals[p]);
          problem.half_spaces.bounds.push_back(gaps[p]);
        }
    Vector v;
    matrix.partition().reinit(v);
    const bool has_start = d.displacement.size() == 3 * d.space->n_nodes();
    Vector     start;
    if (has_start)
      {
        d.transformation->from_displacement(v, d.displacement);
        start = d.displacement;
      }
    else
      {
        d.partition->reinit(start);
        start = d.transformation->to_displacement(v, matrix.partition());
      }
    const auto monitor = [&](const unsigned int iteration, const double correction,
                             const unsigned int active) {
      if (parameters.verbosity > 1)
        out << "    iteration " << std::setw(3) << iteration << "   correction " << std::scientific
            << std::setprecision(3) << correction << std::defaultfloat << "   active " << active << std::endl;
    };
    TruncatedNewtonMultigrid solver(*hierarchy, parameters.solver);
    cycle.nonlinear = solver.solve(v, problem, monitor);
    cycle.times["solve"] += time.wall_time();
    if (!cycle.nonlinear.converged)
      {
        results.converged = false;
        note("cycle " + std::to_string(cycle.cycle) + ": " + cycle.nonlinear.note + ".");
      }

    evaluate_contact(v, problem, matrix, gaps);
    cycle.contact_nodes = d.coupling.n_rows();
    cycle.active_nodes  = std::accumulate(d.active.begin(), d.active.end(), std::size_t(0));
    d.displacement      = d.transformation->to_displacement(v, matrix.partition());
    if (parameters.measure_sweeps && cycle.cycle == refinement.n_cycles())
      measure_sweeps(cycle, *hierarchy, problem.rhs);
    if (parameters.compare_linear && !d.pairs.empty())
      {
        // The contact hierarchy is not needed any more: make room for the linear one.
        hierarchy.reset();
        solve_linear(cycle, levels, start);
      }
  }



  void ContactProblem::solve_linear(CycleResult &cycle, const LevelSpaces &levels, const Vector &start)
  {
    Discretization              &d = discretization;
    Timer                        time;
    const InterfaceCoupling      none;
    const std::vector<FixedMask> no_masks;
    LinearSystem    system = assemble_elasticity(bodies, *d.space, loads, d.dirichlet, none, no_masks);
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
        const Vector3 force = (d.coupling.weight[p] * d.pressure[p]) * d.normals[p];
        add(d.coupling.rows[p], -force);
        for (const auto *entry = d.coupling.begin(p); entry != d.coupling.end(p); ++entry)
          add(entry->node, entry->weight * project_free(d.row_masks[p], force));
      }
    MultigridHierarchy        hierarchy = build_hierarchy(std::move(system), levels, none);
    const NodeBlockMatrix    &matrix    = hierarchy.finest().matrix;
    const BasisTransformation plain(*d.space, *d.partition, d.dirichlet, none, no_masks);
    Vector                    v, solution, product;
    matrix.partition().reinit(v);
    plain.from_displacement(v, start);
    TruncatedNewtonMultigrid solver(hierarchy, parameters.solver);
    cycle.linear     = solver.solve(v, problem);
    cycle.has_linear = true;

    matrix.partition().reinit(solution);
    matrix.partition().reinit(product);
    plain.from_displacement(solution, d.displacement);
    matrix.vmult(product, solution);
    const double scale = product * solution;
    solution -= v;
    matrix.vmult(product, solution);
    cycle.difference = scale > 0. ? std::sqrt(std::max(0., product * solution) / scale) : 0.;
    cycle.times["linear_solve"] += time.wall_time();
  }



  void ContactProblem::measure_sweeps(CycleResult &cycle, MultigridHierarchy &hierarchy, const Vector &rhs)
  {
    ProjectedGaussSeidel &smoother = *hierarchy.finest().smoother;
    Vector                v;
    v.reinit(rhs);
    std::vector<double> times;
    for (unsigned int i = 0; i < 5; ++i)
      {
        Timer time;
        smoother.sweep(v, rhs, ProjectedGaussSeidel::forward);
        times.push_back(time.wall_time());
      }
    std::sort(times.begin(), times.end());
    cycle.sweep_time             = times[2];
    cycle.sweep_bytes_per_second = Utilities::MPI::sum(smoother.sweep_bytes(), comm) / times[2];

    const NodeBlockMatrix &matrix = hierarchy.finest().matrix;
    const double          *begin  = matrix.block(0);
    const std::size_t      n      = 9 * matrix.row_end(matrix.n_rows() - 1);
    times.clear();
    double sum = 0.;
    for (unsigned int i = 0; i < 5; ++i)
      {
        Timer  time;
        double s[8] = {};
        for (std::size_t k = 0; k + 8 <= n; k += 8)
          for (unsigned int j = 0; j < 8; ++j)
            s[j] += begin[k + j];
        sum += std::accumulate(s, s + 8, 0.);
        times.push_back(time.wall_time());
      }
    std::sort(times.begin(), times.end());
    volatile double keep = sum;
    (void)keep;
    cycle.read_bytes_per_second =
        Utilities::MPI::sum(static_cast<double>(n * sizeof(double)), comm) / times[2];
  }



  void ContactProblem::refine()
  {
    Discretization &d = discretization;
    // The numbering of the nodes follows from the triangulation alone, so a second handler of dofs, which
    // lives through the refinement, numbers like the NodalSpace before and after it.
    const FE_Q<3> fe(1);
    DoFHandler<3> dofs(bodies.triangulation());
    dofs.distribute_dofs(fe);
    const bool                                         transfers = d.displacement.size() > 0;
    std::array<Vector, 3>                              components;
    std::vector<const Vector *>                        old;
    parallel::distributed::SolutionTransfer<3, Vector> transfer(dofs);
    bodies.triangulation().prepare_coarsening_and_refinement();
    if (transfers)
      {
        for (unsigned int c = 0; c < dim; ++c)
          {
            components[c].reinit(d.space->owned(), d.space->relevant(), comm);
            for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
              components[c].local_element(i) = d.displacement.local_element(dim * i + c);
            components[c].update_ghost_values();
            old.push_back(&components[c]);
          }
        transfer.prepare_for_coarsening_and_refinement(old);
      }
    bodies.triangulation().execute_coarsening_and_refinement();
    d.transformation.reset();
    d.space.reset();
    setup_space();
    if (!transfers)
      return;
    dofs.distribute_dofs(fe);
    std::array<Vector, 3> interpolated;
    std::vector<Vector *> targets;
    for (Vector &component : interpolated)
      {
        component.reinit(d.space->owned(), d.space->relevant(), comm);
        targets.push_back(&component);
      }
    transfer.interpolate(targets);
    d.partition->reinit(d.displacement);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
        d.displacement.local_element(dim * i + c) = interpolated[c].local_element(i);
    d.displacement.update_ghost_values();
  }



  void ContactProblem::run()
  {
    for (unsigned int cycle = 0; cycle <= refinement.n_cycles(); ++cycle)
      {
        results.cycles.emplace_back();
        CycleResult &result = results.cycles.back();
        result.cycle        = cycle;
        Timer time;
        if (cycle == 0)
          {
            setup_space();
            check_rigid_motions(bodies, *discretization.space, discretization.dirichlet);
          }
        else if (refinement.mark(bodies.triangulation(), cycle))
          refine();
        else
          {
            results.cycles.pop_back();
            continue;
          }
        result.cells = bodies.triangulation().n_global_active_cells();
        result.dofs  = dim * discretization.space->n_conforming_nodes();
        result.times["mesh"] += time.wall_time();
        if (parameters.verbosity > 0)
          out << "cycle " << cycle << ": " << result.cells << " cells, " << result.dofs << " dofs"
              << std::endl;
        setup_contact(result);
        solve_cycle(result);
        if (parameters.verbosity > 0)
          {
            out << "  " << result.nonlinear.iterations << " iterations";
            if (result.has_linear)
              out << " (linear multigrid " << result.linear.iterations << ", difference " << result.difference
                  << ")";
            out << ", " << result.active_nodes << " of " << result.contact_nodes << " contact nodes active"
                << std::endl;
          }
      }
    finish();
    results.wall_time = total_time.wall_time();
  }



  void ContactProblem::build_meshes()
  {
    setup_space();
    CycleResult cycle;
    for (unsigned int c = 1; c <= refinement.n_cycles(); ++c)
      if (refinement.mark(bodies.triangulation(), c))
        refine();
    setup_contact(cycle);
    discretization.partition->reinit(discretization.displacement);
    discretization.displacement.update_ghost_values();
    discretization.pressure.assign(discretization.coupling.n_rows(), 0.);
    discretization.opening = discretization.gaps;
    discretization.active.assign(discretization.coupling.n_rows(), 0);
    collect_pairs();
  }
} // namespace Signorini
