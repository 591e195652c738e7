// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// Multigrid for an obstacle problem of someone else: the membrane of deal.II's step-41, in deal.II's own
// matrices and prolongations. See README.md.

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/multigrid/mg_constrained_dofs.h>
#include <deal.II/multigrid/mg_tools.h>

#include <signorini/solvers/foreign_levels.h>
#include <signorini/solvers/obstacle_solver.h>

#include <cstdio>
#include <fstream>

using namespace dealii;

// The membrane hangs in a square, pulled down by f = -10, over stairs.
double
stairs(const Point<2> &p)
{
  return p[0] < -.5 ? -.2 : p[0] < 0. ? -.4 : p[0] < .5 ? -.6 : -.8;
}

// What a deal.II program has before it knows anything of Signorini: a matrix, a right hand side, and
// prolongations between the levels of its mesh (in level numbering).
struct Membrane
{
  explicit Membrane(const unsigned int n_refinements);

  Triangulation<2>                  mesh;
  FE_Q<2>                           element;
  DoFHandler<2>                     dofs;
  unsigned int                      finest;
  SparsityPattern                   pattern;
  SparseMatrix<double>              matrix;
  dealii::Vector<double>            rhs, obstacle, mass;
  std::vector<Point<2>>             positions;
  std::vector<IndexSet>             boundary;
  std::vector<SparsityPattern>      prolongation_patterns;
  std::vector<SparseMatrix<double>> prolongations;

  void assemble();
  void make_prolongation(const unsigned int level);
};

Membrane::Membrane(const unsigned int n_refinements)
  : mesh(Triangulation<2>::limit_level_difference_at_vertices)
  , element(1)
  , dofs(mesh)
  , finest(n_refinements)
  , prolongation_patterns(n_refinements)
  , prolongations(n_refinements)
{
  GridGenerator::hyper_cube(mesh, -1., 1.);
  mesh.refine_global(n_refinements);
  dofs.distribute_dofs(element);
  dofs.distribute_mg_dofs();
  MGConstrainedDoFs constrained;
  constrained.initialize(dofs);
  constrained.make_zero_boundary_constraints(dofs, {0});
  for (unsigned int level = 0; level <= finest; ++level)
    boundary.push_back(constrained.get_boundary_indices(level));
  assemble();
  for (unsigned int level = 1; level < finest; ++level)
    make_prolongation(level);
}

void
Membrane::assemble()
{
  const unsigned int     n = dofs.n_dofs(finest);
  DynamicSparsityPattern dynamic(n);
  MGTools::make_sparsity_pattern(dofs, dynamic, finest);
  pattern.copy_from(dynamic);
  matrix.reinit(pattern);
  for (auto *vector : {&rhs, &obstacle, &mass})
    vector->reinit(n);
  positions.resize(n);
  const QGauss<2> quadrature(2);
  FEValues<2>     values(element, quadrature, update_values | update_gradients | update_JxW_values);
  std::vector<types::global_dof_index> indices(4);
  for (const auto &cell : dofs.mg_cell_iterators_on_level(finest))
    {
      values.reinit(cell);
      cell->get_mg_dof_indices(indices);
      for (unsigned int i = 0; i < 4; ++i)
        {
          positions[indices[i]] = cell->vertex(i);
          obstacle(indices[i])  = stairs(cell->vertex(i));
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              rhs(indices[i]) -= 10. * values.shape_value(i, q) * values.JxW(q);
              mass(indices[i]) += values.shape_value(i, q) * values.JxW(q);
              for (unsigned int j = 0; j < 4; ++j)
                matrix.add(indices[i], indices[j],
                           values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q));
            }
        }
    }
  // u = 0 on the boundary.
  for (unsigned int row = 0; row < n; ++row)
    for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
      if (entry->column() != row &&
          (boundary[finest].is_element(row) || boundary[finest].is_element(entry->column())))
        entry->value() = 0.;
  for (const auto i : boundary[finest])
    rhs(i) = 0.;
}

// From the dofs of a level to those of the next finer one, by the element's own prolongations to its
// children.
void
Membrane::make_prolongation(const unsigned int level)
{
  DynamicSparsityPattern               dynamic(dofs.n_dofs(level + 1), dofs.n_dofs(level));
  std::vector<types::global_dof_index> coarse(4), fine(4);
  const auto                           for_each = [&](const auto &action) {
    for (const auto &cell : dofs.mg_cell_iterators_on_level(level))
      {
        cell->get_mg_dof_indices(coarse);
        for (unsigned int child = 0; child < 4; ++child)
          {
            cell->child(child)->get_mg_dof_indices(fine);
            const FullMatrix<double> &weights = element.get_prolongation_matrix(child);
            for (unsigned int i = 0; i < 4; ++i)
              for (unsigned int j = 0; j < 4; ++j)
                if (weights(i, j) != 0.)
                  action(fine[i], coarse[j], weights(i, j));
          }
      }
  };
  for_each([&](const unsigned int i, const unsigned int j, const double) { dynamic.add(i, j); });
  prolongation_patterns[level].copy_from(dynamic);
  prolongations[level].reinit(prolongation_patterns[level]);
  for_each(
      [&](const unsigned int i, const unsigned int j, const double w) { prolongations[level].set(i, j, w); });
}

// The same for Signorini: a copy of the matrix, the prolongations, and masks of what is prescribed.
Signorini::MultigridHierarchy
build_hierarchy(const Membrane &membrane, const Signorini::HalfSpaces &half_spaces)
{
  const Signorini::ForeignNumbering            scalar;
  std::vector<Signorini::ForeignLevels::Level> levels;
  for (unsigned int level = membrane.finest - 1; level >= 1; --level)
    {
      const IndexSet fine   = complete_index_set(membrane.dofs.n_dofs(level + 1));
      const IndexSet coarse = complete_index_set(membrane.dofs.n_dofs(level));
      levels.push_back({Signorini::read_prolongation(membrane.prolongations[level], scalar, fine),
                        scalar.nodes(coarse), scalar.fixed(coarse, membrane.boundary[level])});
    }
  Signorini::ForeignLevels  source(std::move(levels), half_spaces);
  const IndexSet            all = complete_index_set(membrane.rhs.size());
  Signorini::HierarchyParts parts;
  parts.matrix = Signorini::read_matrix(membrane.matrix, scalar, all, MPI_COMM_SELF);
  parts.fixed  = scalar.fixed(all, membrane.boundary[membrane.finest]);
  parts.levels = &source;
  return Signorini::MultigridHierarchy(std::move(parts));
}

// u >= g: -u <= -g in the first component.
Signorini::ObstacleProblem
make_problem(const Membrane &membrane, const bool with_obstacle)
{
  Signorini::ObstacleProblem problem;
  problem.rhs.reinit(3 * membrane.rhs.size());
  Signorini::Vector3 down;
  down[0] = -1.;
  for (unsigned int i = 0; i < membrane.rhs.size(); ++i)
    {
      problem.rhs.local_element(3 * i) = membrane.rhs(i);
      if (with_obstacle && !membrane.boundary[membrane.finest].is_element(i))
        {
          problem.half_spaces.nodes.push_back(i);
          problem.half_spaces.normals.push_back(down);
          problem.half_spaces.bounds.push_back(-membrane.obstacle(i));
        }
    }
  return problem;
}

// step-41's own way: guess the set in contact, solve the linear problem, guess again.
unsigned int
primal_dual_active_set(const Membrane &membrane, dealii::Vector<double> &u)
{
  std::vector<bool>      active(membrane.rhs.size(), false);
  dealii::Vector<double> force(membrane.rhs.size());
  for (unsigned int iteration = 1;; ++iteration)
    {
      SparseMatrix<double> matrix(membrane.pattern);
      matrix.copy_from(membrane.matrix);
      u = membrane.rhs;
      for (unsigned int i = 0; i < active.size(); ++i)
        if (active[i])
          {
            for (auto entry = matrix.begin(i); entry != matrix.end(i); ++entry)
              entry->value() = entry->column() == i ? 1. : 0.;
            u(i) = membrane.obstacle(i);
          }
      SparseDirectUMFPACK direct;
      direct.solve(matrix, u);
      membrane.matrix.vmult(force, u);
      force -= membrane.rhs;
      bool changed = false;
      for (unsigned int i = 0; i < active.size(); ++i)
        if (!membrane.boundary[membrane.finest].is_element(i))
          {
            const bool now = force(i) + 100. * membrane.mass(i) * (membrane.obstacle(i) - u(i)) > 0.;
            changed        = changed || now != active[i];
            active[i]      = now;
          }
      if (!changed)
        return iteration;
    }
}

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  bool                                   is_right = true;
  std::printf("%9s %8s %10s %8s %10s %10s %12s\n", "unknowns", "contact", "multigrid", "linear", "linear cg",
              "step-41", "difference");
  for (unsigned int n_refinements = 5; n_refinements <= 8; ++n_refinements)
    {
      const Membrane              membrane(n_refinements);
      Signorini::SolverParameters parameters;
      parameters.tolerance = 1e-10;
      Signorini::Vector v(3 * membrane.rhs.size());

      // Nothing in the way: the linear multigrid, and conjugate gradients of deal.II with the V-cycle.
      const auto problem            = make_problem(membrane, true);
      auto       hierarchy          = build_hierarchy(membrane, problem.half_spaces);
      parameters.method             = Signorini::SolverMethod::multigrid;
      const auto             free   = make_problem(membrane, false);
      const auto             linear = Signorini::make_solver(hierarchy, parameters)->solve(v, free);
      dealii::Vector<double> u(membrane.rhs.size());
      SolverControl          control(100, 1e-10 * membrane.rhs.l2_norm());
      SolverCG<>(control).solve(membrane.matrix, u, membrane.rhs,
                                Signorini::VCyclePreconditioner(hierarchy, {}));
      double difference = 0.;
      for (unsigned int i = 0; i < u.size(); ++i)
        difference = std::max(difference, std::abs(u(i) - v.local_element(3 * i)));

      v                  = 0.;
      parameters.method  = Signorini::SolverMethod::accelerated;
      const auto contact = Signorini::make_solver(hierarchy, parameters)->solve(v, problem);
      const auto step_41 = primal_dual_active_set(membrane, u);
      for (unsigned int i = 0; i < u.size(); ++i)
        difference = std::max(difference, std::abs(u(i) - v.local_element(3 * i)));
      std::printf("%9u %8u %10u %8u %10u %10u %12.1e\n", u.size(), contact.active_nodes.back(),
                  contact.iterations, linear.iterations, control.last_step(), step_41, difference);
      is_right =
          is_right && contact.converged && difference < 1e-8 && contact.iterations <= linear.iterations + 2;
      if (n_refinements == 6)
        {
          std::ofstream file("membrane.csv");
          file << "x,y,u,obstacle\n";
          for (unsigned int i = 0; i < u.size(); ++i)
            file << membrane.positions[i][0] << ',' << membrane.positions[i][1] << ','
                 << v.local_element(3 * i) << ',' << membrane.obstacle(i) << '\n';
        }
    }
  return is_right ? 0 : 1;
}
