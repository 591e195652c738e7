// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/application/contact_solve.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/loose_motions.h>
#include <signorini/application/pretension.h>
#include <signorini/application/ties.h>
#include <signorini/discretization/motion_description.h>

#include <iomanip>
#include <numeric>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  ContactStress no_stress(const Discretization &d)
  {
    const std::size_t n = d.coupling.n_rows();
    return {std::vector<Vector3>(n), std::vector<double>(n, 0.), d.gaps, std::vector<unsigned char>(n, 0)};
  }



  namespace
  {
    /// Of the contact nodes that a rank owns.
    /// @param bounds of BasisTransformation::reduce_gaps()
    HalfSpaces make_half_spaces(const Discretization &d, const NodePartition &unknowns,
                                const std::vector<double> &bounds)
    {
      HalfSpaces result;
      for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
        if (!d.tied[p] && d.owns_row(p))
          {
            result.nodes.push_back(unknowns.to_local(d.coupling.rows[p]));
            result.normals.push_back(d.projections[p].direction());
            result.bounds.push_back(bounds[p]);
            result.shares.push_back(d.projections[p].share());
          }
      return result;
    }

    bool has_stiff_nonmortar(const Discretization &d)
    {
      return std::any_of(d.pairs.begin(), d.pairs.end(), [](const ContactPair &pair) {
        return !pair.obstacle && pair.nonmortar.material.young > pair.mortar.material.young;
      });
    }

    /// @param start null, or what the active set is guessed from
    std::unique_ptr<MultigridHierarchy> make_hierarchy(LinearSystem &&system, const LevelSpaces &levels,
                                                       const Discretization   &d,
                                                       const SolverParameters &parameters,
                                                       HierarchyOptions        options)
    {
      if (!needs_levels(parameters.method))
        return std::make_unique<MultigridHierarchy>(std::move(system.matrix), std::move(system.fixed));
      options.coarse_obstacles    = parameters.method == SolverMethod::monotone_multigrid;
      options.level_zero          = parameters.level_zero;
      options.level_zero_steps    = parameters.level_zero_steps;
      options.free_motions        = d.free_motions();
      options.tied                = d.tied;
      options.has_stiff_nonmortar = has_stiff_nonmortar(d);
      // Corrections of a slow interface, for a stiff nonmortar side, are linear ones on the coarser levels,
      // which are no obstacle problems then; and what is measured for them must not depend on the start. Free
      // bodies are not where the start is.
      if ((options.start == nullptr && parameters.method != SolverMethod::accelerated) ||
          options.has_stiff_nonmortar || !options.free_motions.empty())
        {
          options.problem = nullptr;
          options.start   = nullptr;
        }
      return std::make_unique<MultigridHierarchy>(
          build_hierarchy(std::move(system), levels, d.coupling, d.projections, options));
    }

    ObstacleSolver::Monitor make_monitor(const double tolerance, Journal &journal)
    {
      return [tolerance, &journal](const unsigned int iteration, const double correction,
                                   const unsigned int active) {
        if (journal.wants_iterations())
          {
            std::ostringstream line;
            line << "    iteration " << std::setw(3) << iteration << "   correction " << std::scientific
                 << std::setprecision(3) << correction << "   active " << active;
            journal.print(line.str());
          }
        journal.show("solving", correction > 0. ? std::log(correction) / std::log(tolerance) : 1.);
      };
    }

    /// @param v and residual = rhs - A v
    ContactStress evaluate_stress(const Discretization &d, const NodePartition &partition, const Vector &v,
                                  const Vector &residual, const HalfSpaces &half_spaces,
                                  const std::vector<unsigned char> &active)
    {
      const auto                forces = import_values(partition, residual, d.coupling.rows);
      const auto                values = import_values(partition, v, d.coupling.rows);
      const std::vector<double> bounds = d.transformation->reduce_gaps(d.gaps);
      // The active set is what the projection of the solver wrote.
      Vector flags;
      flags.reinit(v);
      for (std::size_t p = 0; p < half_spaces.size(); ++p)
        flags.local_element(dim * half_spaces.nodes[p]) = active[p];
      const auto    active_rows = import_values(partition, flags, d.coupling.rows);
      ContactStress stress      = no_stress(d);
      for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
        {
          const RowProjection &projection = d.projections[p];
          stress.pressure[p] =
              (forces[p] * projection.direction()) / (d.coupling.weight[p] * projection.share());
          stress.traction[p] = stress.pressure[p] * projection.normal();
          stress.opening[p]  = projection.share() * (bounds[p] - projection.direction() * values[p]);
          stress.active[p]   = active_rows[p][0] != 0. && stress.pressure[p] > 0.;
        }
      return stress;
    }
  } // namespace



  struct AlgebraicProblem
  {
    ObstacleProblem                     problem;
    std::shared_ptr<const LevelSpaces>  levels;
    std::unique_ptr<MultigridHierarchy> hierarchy;
    Vector                              v;
    /// rhs - A v, after the solution.
    Vector residual;
  };



  namespace
  {
    /// Solves for what is left when the rigid motions of a start are taken out of it: these can be longer
    /// than the deformation by many orders of magnitude, and products of A with them are rounding.
    class DeformationOnly
    {
    public:
      explicit DeformationOnly(AlgebraicProblem &algebraic)
        : algebraic(algebraic)
        , bounds(algebraic.problem.half_spaces.bounds)
      {
        HalfSpaces   &spaces      = algebraic.problem.half_spaces;
        const Vector &start       = algebraic.v;
        Vector        deformation = start;
        subtract_projection(deformation, algebraic.problem.free_motions);
        rigid = start;
        rigid -= deformation;
        for (std::size_t p = 0; p < spaces.size(); ++p)
          spaces.bounds[p] -= spaces.normal_part(p, rigid);
        algebraic.v = deformation;
      }

      /// Puts them back.
      void restore()
      {
        algebraic.v += rigid;
        algebraic.problem.half_spaces.bounds = bounds;
      }

    private:
      AlgebraicProblem         &algebraic;
      const std::vector<double> bounds;
      Vector                    rigid;
    };

    AlgebraicProblem build_problem(const ContactModel &model, const Discretization &d, CoarserSpaces &coarser,
                                   const NestedStart *const start, const SolveParameters &parameters,
                                   Journal &journal)
    {
      AlgebraicProblem  result;
      ObstacleProblem  &problem  = result.problem;
      PhaseTimes::Scope assembly = journal.measure(Phase::assembly);
      journal.show("assembling");
      LinearSystem system = assemble_elasticity(model.bodies(), d.nodal(), model.loads(), d.dirichlet(),
                                                d.expansion(), d.projections);
      fix_tied_unknowns(system, d);
      problem.rhs = std::move(system.rhs);
      assembly.stop();

      PhaseTimes::Scope building_levels = journal.measure(Phase::levels);
      journal.show("building levels");
      result.levels = std::make_shared<const LevelSpaces>(
          d.nodal(), coarser.update(model.bodies(), d.constrained->space), model.bodies(), model.loads(),
          parameters.coarse_levels_of_method());
      building_levels.stop();

      const auto          time      = journal.measure(Phase::hierarchy);
      const NodePartition partition = system.matrix.partition();
      problem.half_spaces           = make_half_spaces(d, partition, d.transformation->reduce_gaps(d.gaps));
      problem.semidefinite          = !d.free_motions().empty();
      if (problem.semidefinite)
        {
          problem.free_motions = motions_of_unknowns(model, d, partition);
          orthonormalize(problem.free_motions);
        }
      partition.reinit(result.v);
      if (start != nullptr)
        {
          d.transformation->from_displacement(result.v, start->displacement);
          clear_tied_unknowns(result.v, partition, d);
        }
      HierarchyOptions options;
      options.problem  = &problem;
      options.start    = start != nullptr ? &result.v : nullptr;
      result.hierarchy = make_hierarchy(std::move(system), *result.levels, d, parameters.solver, options);
      if (d.has_ties())
        refuse_opposed_motions(result.hierarchy->finest().matrix, problem.free_motions, model, d);
      return result;
    }

    void note_undetermined(const LooseMotions &loose, const ContactModel &model, const Discretization &d,
                           Journal &journal)
    {
      for (const std::string &motion : describe_motions(d.free_motions(), loose.undetermined, model.bodies()))
        journal.note("nothing determines " + motion +
                     ": frictionless contact does not hold it. Of all solutions that with the smallest "
                     "displacement is taken.");
    }

    /// The width of the faces of the contact surfaces, in the mean.
    double mean_width(const Discretization &d)
    {
      double area = 0.;
      for (std::size_t p = 0; p < d.coupling.n_rows(); ++p)
        if (d.owns_row(p))
          area += d.coupling.weight[p];
      area = Utilities::MPI::sum(area, d.nodal().communicator());
      return std::sqrt(area / std::max<double>(1., d.n_contact_nodes));
    }

    /// What is around the half-spaces of a problem.
    FacesAtContact faces_at_contact(const Discretization &d)
    {
      std::vector<std::vector<Vector3>> turns(d.coupling.n_rows());
      for (const NodalSpace::BoundaryFace &face : d.nodal().boundary_faces())
        {
          const NodalSpace::Cell &cell    = d.nodal().cells()[face.cell];
          const auto              corners = CellShape::face(cell.n_vertices, face.face);
          for (const unsigned int one : corners)
            for (const unsigned int other : corners)
              if (const std::ptrdiff_t a = d.coupling.find(d.nodal().nodes(cell)[one]),
                  b                      = d.coupling.find(d.nodal().nodes(cell)[other]);
                  a >= 0 && b >= 0)
                if (const Vector3 turn = d.projections[b].direction() - d.projections[a].direction();
                    a != b && turn.norm() < LooseMotionRule().sharp)
                  turns[a].push_back(turn);
        }
      FacesAtContact result{mean_width(d), {}};
      for (std::size_t row = 0; row < turns.size(); ++row)
        if (!d.tied[row] && d.owns_row(row))
          result.turns.push_back(turns[row]);
      return result;
    }

    /// Collective. By how much normals change within a face where bodies touch, at most (1).
    double largest_turn(const FacesAtContact &faces, const std::vector<unsigned char> &active,
                        const Discretization &d)
    {
      double result = 0.;
      for (std::size_t p = 0; p < active.size(); ++p)
        if (active[p])
          result = std::max(result, faces.turn(p));
      return Utilities::MPI::max(result, d.nodal().communicator());
    }

    /// What contact leaves loose: notes it, and takes out of a solution what nothing determines. Returns the
    /// motions along which it drifts.
    Drift settle_loose_motions(AlgebraicProblem &algebraic, const std::vector<unsigned char> &active,
                               const ContactModel &model, const Discretization &d, Journal &journal)
    {
      const HalfSpaces    &spaces   = algebraic.problem.half_spaces;
      const NodePartition &unknowns = algebraic.hierarchy->finest().matrix.partition();
      const auto           fields   = motions_of_unknowns(model, d, unknowns);
      const LooseMotions   loose    = find_loose_motions(d.free_motions(), fields, spaces, active);
      const double         width    = mean_width(d);
      Drift                drift{HoldReason::drifting,
                  find_drift(d.free_motions(), fields, spaces, loose, algebraic.v, width), 0.};
      if (!drift.motions.empty())
        return drift;
      const FreeSolution   solution{d.free_motions(), fields, spaces, active, algebraic.v};
      const FacesAtContact faces = faces_at_contact(d);
      if (auto sliding = find_sliding(solution, normals_of_partners(d), width); !sliding.empty())
        {
          const auto undetermined = of_same_parts(d.free_motions(), loose.undetermined, sliding);
          sliding.insert(sliding.end(), undetermined.begin(), undetermined.end());
          return {HoldReason::sliding, sliding, largest_turn(faces, active, d)};
        }
      note_undetermined(loose, model, d, journal);
      warn_of_facets(model, d.free_motions(),
                     !loose.hardly_held.empty() ? loose.slides_on_facets
                                                : find_motions_of_the_mesh(solution, faces),
                     journal);
      if (!loose.undetermined.empty())
        minimize_displacement(
            algebraic.v, d.transformation->to_displacement(algebraic.v, unknowns), loose.undetermined, fields,
            motion_fields(d.free_motions(), model.bodies(), d.nodal(), d.partition()), spaces);
      return {};
    }

    void refuse_what_obstacles_cannot_hold(const AlgebraicProblem &algebraic, const ContactModel &model,
                                           const Discretization &d)
    {
      const auto fields = motions_of_unknowns(model, d, algebraic.hierarchy->finest().matrix.partition());
      const std::vector<unsigned char> none(algebraic.problem.half_spaces.size(), 0);
      refuse_loads_along_obstacles(
          {d.free_motions(), fields, algebraic.problem.half_spaces, none, algebraic.v},
          normals_of_partners(d), algebraic.problem.rhs, model);
    }

    /// Solves; returns the active half-spaces.
    std::vector<unsigned char> solve(ContactSolution &result, AlgebraicProblem &algebraic,
                                     const ContactModel &model, const Discretization &d,
                                     const SolverParameters &parameters, Journal &journal)
    {
      ObstacleProblem     &problem   = algebraic.problem;
      MultigridHierarchy  &hierarchy = *algebraic.hierarchy;
      const NodePartition &partition = hierarchy.finest().matrix.partition();
      if (parameters.method == SolverMethod::active_set_amg)
        problem.near_kernel = rigid_motions(node_places(model.bodies(), d.nodal()).positions, partition,
                                            hierarchy.finest().fixed, d.coupling, d.projections);
      const auto      solver = make_solver(hierarchy, parameters);
      DeformationOnly deformation(algebraic);
      result.report = solver->solve(algebraic.v, problem, make_monitor(parameters.tolerance, journal));
      partition.reinit(algebraic.residual);
      hierarchy.finest().matrix.symmetric_residual(algebraic.residual, algebraic.v, problem.rhs);
      deformation.restore();
      if (!d.free_motions().empty())
        result.drift = settle_loose_motions(algebraic, solver->active(), model, d, journal);
      return solver->active();
    }

  } // namespace



  void check_method(const PairDefinition &pair, const SolverMethod method)
  {
    if (pair.contact != ContactKind::tied && is_linear(method))
      throw InputError("Pair " + pair.name +
                       "/Contact: the solvers multigrid and multigrid cg (Solver/Method) are for linear "
                       "problems. Choose accelerated, or tie the pair.");
  }



  ContactSolver::ContactSolver(const ContactModel &model, const Discretization &d, CoarserSpaces &coarser,
                               const NestedStart *const start, const SolveParameters &how_to,
                               Journal &journal)
    : model(model)
    , journal(journal)
    , parameters(how_to.solver)
    , algebraic(std::make_unique<AlgebraicProblem>(build_problem(model, d, coarser, start, how_to, journal)))
  {
    n_levels = algebraic->levels->n_levels();
    if (!how_to.compare_linear)
      algebraic->levels.reset();
    // What was slow on one mesh is slow on the next.
    parameters.starts_with_interface_sweeps = start != nullptr && start->needed_interface_sweeps;
    parameters.starts_with_patches          = start != nullptr && start->needed_patches;
  }



  ContactSolver::~ContactSolver() = default;



  ContactSolution ContactSolver::solve(const Discretization &d)
  {
    ContactSolution        result;
    const NodeBlockMatrix &matrix  = algebraic->hierarchy->finest().matrix;
    PhaseTimes::Scope      solving = journal.measure(Phase::solve);
    if (!d.free_motions().empty())
      if (const auto turning =
              settle_free_parts(algebraic->v, model, d, matrix.partition(), algebraic->problem);
          !turning.empty())
        {
          result.drift = {HoldReason::drifting, {turning}, 0.};
          return result;
        }
    if (!d.free_motions().empty())
      refuse_what_obstacles_cannot_hold(*algebraic, model, d);
    const auto active = Signorini::solve(result, *algebraic, model, d, parameters, journal);
    solving.stop();

    result.n_levels      = n_levels;
    result.stress        = evaluate_stress(d, matrix.partition(), algebraic->v, algebraic->residual,
                                           algebraic->problem.half_spaces, active);
    std::size_t n_active = 0;
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      n_active += d.owns_row(row) && result.stress.active[row];
    result.n_active     = Utilities::MPI::sum(n_active, model.communicator());
    result.displacement = d.transformation->to_displacement(algebraic->v, matrix.partition());
    set_tie_stress(result.stress, model, d, result.displacement);
    return result;
  }



  void ContactSolver::change_loads(const Discretization &d, const Vector &displacement)
  {
    const auto            time     = journal.measure(Phase::assembly);
    const MultigridLevel &finest   = algebraic->hierarchy->finest();
    const NodePartition  &unknowns = finest.matrix.partition();
    Vector                forces =
        physical_residual(model.bodies(), d.nodal(), d.partition(), model.loads(), d.transformation->lift());
    forces *= -1.;
    ObstacleProblem &problem = algebraic->problem;
    problem.rhs              = d.transformation->restrict_forces(forces, unknowns);
    add_rigid_forces(problem.rhs, unknowns, d.dirichlet());
    for (unsigned int i = 0; i < unknowns.n_owned(); ++i)
      project_free(finest.fixed[i], problem.rhs, i);
    problem.half_spaces = make_half_spaces(d, unknowns, d.transformation->reduce_gaps(d.gaps));
    d.transformation->from_displacement(algebraic->v, displacement);
    clear_tied_unknowns(algebraic->v, unknowns, d);
  }



  SweepMeasurement ContactSolver::measure() const
  {
    return measure_sweeps(*algebraic->hierarchy, algebraic->problem.rhs);
  }



  std::shared_ptr<const LevelSpaces> ContactSolver::release()
  {
    algebraic->hierarchy.reset();
    return std::move(algebraic->levels);
  }



  std::vector<std::vector<double>> find_unopposed_motions(const ContactModel &model, const Discretization &d)
  {
    if (d.free_motions().empty())
      return {};
    const HalfSpaces   spaces = make_half_spaces(d, d.partition(), d.gaps);
    const auto         fields = motions_of_unknowns(model, d, d.partition());
    const LooseMotions loose =
        find_loose_motions(d.free_motions(), fields, spaces, std::vector<unsigned char>(spaces.size(), 1));
    if (loose.next_to_undetermined.empty())
      return {};
    return of_same_parts(d.free_motions(), loose.undetermined, loose.next_to_undetermined);
  }



  ContactSolution solve_contact(ContactModel &model, const Discretization &d, CoarserSpaces &coarser,
                                const NestedStart *const start, const SolveParameters &parameters,
                                Journal &journal)
  {
    for (const PairModel &pair : model.pairs())
      check_method(pair.definition, parameters.solver.method);
    check_free_parts(model, d.constrained->free_parts, parameters.solver.method, journal);
    const bool      has_tied_part = d.constrained->free_parts.has_tied_part;
    SolveParameters how_to        = parameters;
    how_to.compare_linear         = parameters.compare_linear && !has_tied_part && !d.pairs.empty();
    foretell_pretension(model, d);
    ContactSolver   solver(model, d, coarser, start, how_to, journal);
    ContactSolution result = solve_with_locked_pretension(
        model, solver, d, start != nullptr ? &start->displacement : nullptr, journal);
    if (result.displacement.size() == 0)
      return result;
    if (parameters.measure_sweeps)
      result.sweeps = solver.measure();
    if (parameters.compare_linear && has_tied_part)
      journal.note("no comparison with the linear problem: a body is held by its ties alone.");
    if (how_to.compare_linear)
      {
        // Make room for the linear hierarchy.
        const auto levels = solver.release();
        journal.show("linear comparison");
        result.linear = compare_linear(
            model, d,
            {*levels, result.displacement, result.stress, start != nullptr ? &start->displacement : nullptr},
            parameters.solver, journal);
      }
    return result;
  }
} // namespace Signorini
