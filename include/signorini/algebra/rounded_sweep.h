// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_rounded_sweep_h
#define signorini_algebra_rounded_sweep_h

#include <signorini/algebra/node_block_matrix.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// Three numbers per node in single precision, at a distance of four: a node fills a register.
  class RoundedVector
  {
  public:
    /// Zero at n_nodes local nodes.
    explicit RoundedVector(const unsigned int n_nodes)
      : values(4 * (static_cast<std::size_t>(n_nodes) + 2))
    {
    }

    /// The numbers of a node. Those of the nodes beside it may be read with them, also of the first and the
    /// last node; the fourth number may be written.
    float *node(const unsigned int i)
    {
      return values.data() + 4 * (static_cast<std::size_t>(i) + 1);
    }

    /// The three numbers of local node i.
    const float *node(const unsigned int i) const
    {
      return values.data() + 4 * (static_cast<std::size_t>(i) + 1);
    }

  private:
    std::vector<float> values;
  };



  /// Gauss-Seidel sweeps over owned rows of A v = rhs in single precision, for corrections: A symmetric with
  /// 3x3 blocks, A = L + D + Lᵀ.
  ///
  /// A sweep reads L and D⁻¹ only, a quarter of the memory of A: products with nodes of smaller number are
  /// computed, those with the others are kept up to date, in `reduced` = rhs - Lᵀ v, by passing the change of
  /// a node on to nodes of smaller number while its row is at hand. Sweeps that go backward do the same. The
  /// numbers of v are kept in double precision as well, for rows that are not visited in this way: whoever
  /// changes v there tells by set() and pass_down().
  ///
  /// Errors are those of single precision relative to v. The matrix must outlive the object.
  class RoundedSweep
  {
  public:
    /// Collective. To be completed by an update of all rows. The diagonal of the matrix, filled already,
    /// gives the units.
    explicit RoundedSweep(const NodeBlockMatrix &matrix);

    /// Reads some owned rows of the matrix again.
    /// @param inverse_diagonal the inverse diagonal blocks of all owned rows
    void update(const std::vector<unsigned int> &rows, const double *inverse_diagonal);

    /// Takes v and a right hand side. `reduced` is rhs: right if v is zero, or if the first sweep goes
    /// backward and passes all on.
    void start(const Vector &v, const Vector &rhs);

    /// What a sweep does.
    struct Options
    {
      /// From the last node to the first.
      bool backward = false;
      /// Whether all of the new values is passed on, not their change: in the first sweep if v was not zero.
      bool passes_all = false;
      /// Whether `reduced` becomes the residual in the rows that are visited: in the last sweep.
      bool keeps_residual = false;
    };

    /// Solves n rows, rows[0] first, or rows[n - 1] if it goes backward.
    void relax(Vector &v, const unsigned int *rows, const std::size_t n, const Options &options);

    /// For rows that are solved elsewhere, with a right hand side that must not be rounded. After start():
    /// the sweeps know nothing of the right hand side of a row.
    void leave_out_rhs(const unsigned int row);
    /// s -= (A - D) v in such a row. Once leave_out_rhs() is called again, after the last visit of the row,
    /// the changes of nodes that are visited later are what get_residual() finds there.
    void subtract_product(double *s, const unsigned int row);

    /// Takes new values of a node, and passes a change (three numbers each) on to nodes of smaller number.
    void set(const unsigned int row, const double *v_row);
    void pass_down(const unsigned int row, const double *change);

    /// The residual after a sweep that has kept it.
    void get_residual(Vector &residual) const;

    /// What the kernels need.
    struct Arrays
    {
      /// Nine numbers a block, see RoundedSweep::blocks.
      const float *blocks;
      /// Position of the first lower block of a row in the matrix. Here those positions begin with zero, and
      /// with an inverse behind each row.
      const std::size_t  *lower_start;
      const unsigned int *columns;
      /// Of node 0.
      float *values, *reduced;
      double value_unit;
    };

  private:
    Arrays arrays();

    const NodeBlockMatrix &matrix;
    /// A row: its lower blocks two by two, side by side (three rows of six numbers), the last one alone, as
    /// well as the one before if it is left over; then the inverse diagonal block, column by column.
    std::unique_ptr<float[]> blocks;
    RoundedVector            values, reduced;
    /// Powers of two by which matrix, values and right hand side are divided: single precision has a small
    /// range.
    double matrix_unit = 1., value_unit = 1., rhs_unit = 1.;
  };
} // namespace Signorini

#endif
