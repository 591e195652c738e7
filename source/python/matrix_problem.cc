// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "matrix_problem.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/parameters.h>
#include <signorini/solvers/foreign_levels.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The section Solver, by the reader of parameter files.
    SolverParameters solver_parameters(const MatrixProblem &problem)
    {
      ParameterText lines;
      lines.text = "set Bodies = matrix\nsubsection Solver\n" + problem.solver + "end\n";
      lines.name = "solver";
      const ParameterFile    file(lines, {});
      const SolverParameters parameters = file.nested().solve.solver;
      if (parameters.method == SolverMethod::monotone_multigrid)
        throw InputError(
            "Method = monotone multigrid needs normals on all levels, which prolongations do not "
            "have; take accelerated or truncated newton multigrid.");
      if (is_linear(parameters.method) && !problem.nodes.empty())
        throw InputError("Method = multigrid and multigrid cg are for problems without obstacles; take "
                         "accelerated.");
      return parameters;
    }

    /// By level, finest first: which components of nodes are zero. What interpolates to a prescribed
    /// component is prescribed.
    std::vector<std::vector<FixedMask>> fixed_components(const MatrixProblem &problem)
    {
      const unsigned int                  n = problem.n_components;
      const ForeignNumbering              numbering{n};
      std::vector<std::vector<FixedMask>> levels(1);
      for (std::size_t dof = 0; dof < problem.fixed.size(); dof += n)
        {
          FixedMask mask = numbering.missing();
          for (unsigned int c = 0; c < n; ++c)
            if (problem.fixed[dof + c] != 0)
              mask = static_cast<FixedMask>(mask | (1u << c));
          levels.back().push_back(mask);
        }
      for (const CompressedRows &prolongation : problem.prolongations)
        {
          std::vector<FixedMask> coarse(prolongation.n_columns, numbering.missing());
          for (std::size_t row = 0; row < prolongation.n_rows(); ++row)
            for (auto entry = prolongation.begin(row); entry != prolongation.end(row); ++entry)
              if (entry->value() != 0.)
                coarse[entry->column()] =
                    static_cast<FixedMask>(coarse[entry->column()] | levels.back()[row]);
          levels.push_back(std::move(coarse));
        }
      return levels;
    }

    std::vector<FixedDirections> directions(const std::vector<FixedMask> &masks)
    {
      return std::vector<FixedDirections>(masks.begin(), masks.end());
    }

    HalfSpaces half_spaces(const MatrixProblem &problem, const std::vector<FixedMask> &fixed)
    {
      HalfSpaces result;
      for (std::size_t p = 0; p < problem.nodes.size(); ++p)
        {
          const auto   node = static_cast<unsigned int>(problem.nodes[p]);
          Vector3      normal(ArrayView<const double>(problem.normals.data() + 3 * p, 3));
          const double whole = normal.norm();
          normal             = project_free(FixedDirections(fixed[node]), normal);
          const double free  = normal.norm();
          if (free > RowProjection::smallest_share * whole)
            {
              result.nodes.push_back(node);
              result.normals.push_back(normal / free);
              result.bounds.push_back(problem.bounds[p] / free);
            }
          else if (problem.bounds[p] < 0.)
            throw InputError("Node " + std::to_string(node) +
                             " is prescribed where its obstacle does not let it be.");
        }
      return result;
    }

    MultigridHierarchy build_hierarchy(const MatrixProblem &problem, const HalfSpaces &half_spaces,
                                       const std::vector<std::vector<FixedMask>> &fixed)
    {
      // Prolongations have one row a node.
      const ForeignNumbering            by_node;
      std::vector<ForeignLevels::Level> levels;
      for (std::size_t l = 0; l < problem.prolongations.size(); ++l)
        {
          const CompressedRows &prolongation = problem.prolongations[l];
          levels.push_back(
              {read_prolongation(prolongation, by_node, complete_index_set(prolongation.n_rows())),
               complete_index_set(prolongation.n_columns), directions(fixed[l + 1])});
        }
      ForeignLevels  source(std::move(levels), half_spaces);
      HierarchyParts parts;
      parts.matrix = read_matrix(problem.matrix, {problem.n_components},
                                 complete_index_set(problem.rhs.size()), MPI_COMM_SELF);
      parts.fixed  = directions(fixed[0]);
      parts.levels = &source;
      return MultigridHierarchy(std::move(parts));
    }

    /// Three numbers a node from n_components, zero where a component is fixed.
    void scatter(Vector &v, const std::vector<double> &values, const MatrixProblem &problem)
    {
      v = 0.;
      for (std::size_t dof = 0; dof < values.size(); ++dof)
        if (problem.fixed[dof] == 0)
          v.local_element(dim * (dof / problem.n_components) + dof % problem.n_components) = values[dof];
    }
  } // namespace



  MatrixSolution solve(const MatrixProblem &problem, const std::function<void()> &interrupt)
  {
    const SolverParameters parameters = solver_parameters(problem);
    const auto             fixed      = fixed_components(problem);
    ObstacleProblem        obstacle;
    obstacle.half_spaces         = half_spaces(problem, fixed[0]);
    MultigridHierarchy hierarchy = build_hierarchy(problem, obstacle.half_spaces, fixed);
    Vector             v;
    for (Vector *vector : {&v, &obstacle.rhs})
      hierarchy.finest().matrix.partition().reinit(*vector);
    scatter(v, problem.start, problem);
    scatter(obstacle.rhs, problem.rhs, problem);

    MatrixSolution result;
    const auto     solver = make_solver(hierarchy, parameters);
    result.report         = solver->solve(v, obstacle,
                                          [&](const unsigned int, const double, const unsigned int) { interrupt(); });
    for (std::size_t dof = 0; dof < problem.rhs.size(); ++dof)
      result.displacement.push_back(
          v.local_element(dim * (dof / problem.n_components) + dof % problem.n_components));
    for (std::size_t p = 0; p < obstacle.half_spaces.size(); ++p)
      if (solver->active()[p] != 0)
        result.active.push_back(obstacle.half_spaces.nodes[p]);
    return result;
  }
} // namespace Signorini
