// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "nodal_contact_forces.h"

#include <signorini/algebra/vector_span.h>
#include <signorini/application/contact_solve.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/linear_comparison.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The contact stresses as loads: -D λ n on the nonmortar side, +Mᵀ λ n on the mortar side.
    void add_contact_forces(Vector &rhs, const Discretization &d, const ContactStress &stress)
    {
      for_contact_forces(d, stress, [&](const unsigned int i, const Vector3 &force) {
        const NodeIndex node = d.partition().to_global(i);
        const Vector3   free =
            project_free(d.dirichlet().fixed[d.nodal().relevant().index_within_set(node)], force);
        for (unsigned int c = 0; c < dim; ++c)
          rhs.local_element(dim * i + c) += free[c];
      });
    }

    /// |solution - v| / |solution| in the energy norm, motions of free bodies aside.
    double energy_difference(const NodeBlockMatrix &matrix, Vector &solution, const Vector &v,
                             std::vector<Vector> motions)
    {
      Vector product;
      matrix.partition().reinit(product);
      matrix.vmult(product, solution);
      const double scale = product * solution;
      solution -= v;
      if (!motions.empty())
        {
          orthonormalize(motions);
          subtract_projection(solution, motions);
        }
      matrix.vmult(product, solution);
      return scale > 0. ? std::sqrt(std::max(0., product * solution) / scale) : 0.;
    }
  } // namespace



  LinearComparison compare_linear(const ContactModel &model, const Discretization &d, const LinearTask &task,
                                  const SolverParameters &parameters, Journal &journal)
  {
    const InterfaceCoupling          none;
    const std::vector<RowProjection> no_rows;
    PhaseTimes::Scope                assembly = journal.measure(Phase::linear_assembly);
    LinearSystem                     system =
        assemble_elasticity(model.bodies(), d.nodal(), model.loads(), d.dirichlet(), none, no_rows);
    ObstacleProblem problem;
    problem.rhs          = std::move(system.rhs);
    problem.semidefinite = !d.free_motions().empty();
    add_contact_forces(problem.rhs, d, task.stress);
    assembly.stop();

    PhaseTimes::Scope building = journal.measure(Phase::linear_hierarchy);
    HierarchyOptions  options;
    options.level_zero           = parameters.level_zero;
    options.level_zero_steps     = parameters.level_zero_steps;
    options.free_motions         = d.free_motions();
    MultigridHierarchy hierarchy = build_hierarchy(std::move(system), task.levels, none, no_rows, options);
    // Both linear solves need it.
    hierarchy.coarse_solver();
    building.stop();

    const NodeBlockMatrix    &matrix = hierarchy.finest().matrix;
    const BasisTransformation plain(d.nodal(), d.partition(), d.dirichlet(), none, none, no_rows);
    Vector                    v, solution;
    const auto                solve = [&](const SolverMethod method, const Phase phase) {
      const auto time = journal.measure(phase);
      matrix.partition().reinit(v);
      if (task.start != nullptr)
        plain.from_displacement(v, *task.start);
      SolverParameters linear_parameters = parameters;
      linear_parameters.method           = method;
      return make_solver(hierarchy, linear_parameters)->solve(v, problem);
    };
    LinearComparison result;
    result.multigrid    = solve(SolverMethod::multigrid, Phase::linear_solve);
    result.multigrid_cg = solve(SolverMethod::multigrid_cg, Phase::linear_cg_solve);
    matrix.partition().reinit(solution);
    plain.from_displacement(solution, task.displacement);
    // Rigid motions of free bodies may differ by anything.
    std::vector<Vector> motions;
    if (!d.free_motions().empty())
      motions = motions_of_unknowns(model, *d.constrained, matrix.partition(), plain);
    result.difference = energy_difference(matrix, solution, v, std::move(motions));
    return result;
  }
} // namespace Signorini
