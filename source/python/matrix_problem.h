// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_python_matrix_problem_h
#define signorini_python_matrix_problem_h

#include <signorini/solvers/obstacle_solver.h>

#include <cstdint>
#include <string>
#include <vector>

namespace Signorini
{
  /// A sparse matrix row by row, as scipy has it, with deal.II's iterators (read_matrix()).
  struct CompressedRows
  {
    /// As in csr_matrix: the entries of row i are those from start[i] on, before start[i + 1].
    std::size_t               n_columns = 0;
    std::vector<std::int64_t> start, columns;
    std::vector<double>       values;

    /// An entry, and the way to the next.
    class Entry
    {
    public:
      /// @param at number of the entry in all rows; the matrix must outlive the object
      Entry(const CompressedRows &matrix, const std::int64_t at)
        : matrix(matrix)
        , at(at)
      {
      }

      /// Where and what it is.
      std::size_t column() const
      {
        return static_cast<std::size_t>(matrix.columns[at]);
      }

      double value() const
      {
        return matrix.values[at];
      }

      /// As an iterator.
      const Entry *operator->() const
      {
        return this;
      }

      /// To the next entry.
      void operator++()
      {
        ++at;
      }

      /// Whether the end is not reached.
      bool operator!=(const Entry &other) const
      {
        return at != other.at;
      }

    private:
      const CompressedRows &matrix;
      std::int64_t          at;
    };

    /// Number of rows.
    std::size_t n_rows() const
    {
      return start.size() - 1;
    }

    /// The entries of a row.
    Entry begin(const std::size_t row) const
    {
      return {*this, start[row]};
    }

    /// Behind them.
    Entry end(const std::size_t row) const
    {
      return {*this, start[row + 1]};
    }
  };

  /// An obstacle problem in matrices: ½uᵀAu - fᵀu = min, n_p . u_p <= g_p.
  struct MatrixProblem
  {
    /// Of a node; dof = n_components * node + component.
    unsigned int        n_components = 1;
    CompressedRows      matrix;
    std::vector<double> rhs, start;
    /// 1 for dofs that are zero, else 0.
    std::vector<unsigned char> fixed;
    /// By node, finest first: from the level below.
    std::vector<CompressedRows> prolongations;
    /// Nodes with a half-space, ascending; three components a normal, which need no length of one.
    std::vector<std::int64_t> nodes;
    std::vector<double>       normals, bounds;
    /// Lines of the section Solver of a parameter file.
    std::string solver;
  };

  /// What solve() finds.
  struct MatrixSolution
  {
    /// By dof; of the solver.
    std::vector<double> displacement;
    ConvergenceReport   report;
    /// The nodes whose half-spaces are active.
    std::vector<std::int64_t> active;
  };

  /// Solves on this rank alone. Errors: InputError, and what `interrupt` throws, which is called in each
  /// iteration.
  MatrixSolution solve(const MatrixProblem &problem, const std::function<void()> &interrupt);
} // namespace Signorini

#endif
