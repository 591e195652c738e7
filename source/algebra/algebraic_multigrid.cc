// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/algebraic_multigrid.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace Signorini
{
  using namespace dealii;

  struct AlgebraicMultigrid::Implementation
  {
    std::unique_ptr<TrilinosWrappers::SparseMatrix> matrix;
    TrilinosWrappers::PreconditionAMG               preconditioner;
    std::vector<double>                             modes;
  };

  namespace
  {
    IndexSet owned_dofs(const NodePartition &partition)
    {
      IndexSet owned(dim * partition.n_global());
      owned.add_range(dim * partition.first_owned(), dim * (partition.first_owned() + partition.n_owned()));
      return owned;
    }

    std::unique_ptr<TrilinosWrappers::SparseMatrix> convert(const NodeBlockMatrix &matrix)
    {
      const NodePartition &partition = matrix.partition();
      const IndexSet       owned     = owned_dofs(partition);
      std::size_t          longest   = 0;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        longest = std::max(longest, matrix.row_length(i));
      auto result = std::make_unique<TrilinosWrappers::SparseMatrix>(
          owned, owned, partition.communicator(), static_cast<unsigned int>(dim * longest));
      std::vector<types::global_dof_index> columns;
      std::vector<double>                  values;
      for (unsigned int i = 0; i < matrix.n_rows(); ++i)
        {
          columns.clear();
          matrix.visit_row(i, [&](const RowEntry &entry) {
            for (unsigned int d = 0; d < dim; ++d)
              columns.push_back(dim * partition.to_global(entry.column) + d);
          });
          for (unsigned int c = 0; c < dim; ++c)
            {
              values.clear();
              matrix.visit_row(i, [&](const RowEntry &entry) {
                const Block block = entry.block();
                for (unsigned int d = 0; d < dim; ++d)
                  values.push_back(block[c][d]);
              });
              result->set(dim * partition.to_global(i) + c, columns.size(), columns.data(), values.data());
            }
        }
      result->compress(VectorOperation::insert);
      return result;
    }
  } // namespace



  AlgebraicMultigrid::AlgebraicMultigrid()
    : implementation(std::make_unique<Implementation>())
  {
  }



  AlgebraicMultigrid::~AlgebraicMultigrid() = default;



  void AlgebraicMultigrid::initialize(const NodeBlockMatrix &matrix, const std::vector<Vector> &near_kernel)
  {
    // Afresh: the preconditioner must not outlive its matrix.
    implementation         = std::make_unique<Implementation>();
    implementation->matrix = convert(matrix);
    Teuchos::ParameterList parameters;
    ML_Epetra::SetDefaults("SA", parameters);
    parameters.set("ML output", 0);
    parameters.set("PDE equations", static_cast<int>(dim));
    parameters.set("aggregation: threshold", .01);
    parameters.set("smoother: type", "Chebyshev");
    parameters.set("smoother: sweeps", 2);
    parameters.set("coarse: max size", 500);
    if (!near_kernel.empty())
      {
        const std::size_t n = dim * static_cast<std::size_t>(matrix.n_rows());
        for (const Vector &mode : near_kernel)
          implementation->modes.insert(implementation->modes.end(), mode.begin(), mode.begin() + n);
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", static_cast<int>(near_kernel.size()));
        parameters.set("null space: vectors", implementation->modes.data());
      }
    implementation->preconditioner.initialize(*implementation->matrix, parameters);
  }



  void AlgebraicMultigrid::vmult(Vector &dst, const Vector &src) const
  {
    implementation->preconditioner.vmult(dst, src);
  }



  unsigned int solve_cg(const NodeBlockMatrix &matrix, const AlgebraicMultigrid &preconditioner, Vector &x,
                        const Vector &b, const double tolerance, const unsigned int max_iterations)
  {
    const double size = b.l2_norm();
    if (!(size > 0.))
      {
        x = 0.;
        return 0;
      }
    // The control counts what it checks: the last state tells, no exception.
    IterationNumberControl control(max_iterations, tolerance * size, false, false);
    SolverCG<Vector>       solver(control);
    solver.solve(matrix, x, b, preconditioner);
    return control.last_step();
  }
} // namespace Signorini
