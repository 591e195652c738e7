// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_rounded_sweep_h
#define signorini_algebra_rounded_sweep_h

#include <signorini/algebra/node_block_matrix.h>

#include <array>
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
  /// 3x3 blocks, A = L + D + Lᵀ + G, where L couples a row to those that come before it in the order of the
  /// sweep, G to ghosts.
  ///
  /// A sweep reads L and D⁻¹ only, a quarter of the memory of A: from the matrix itself if it is split and
  /// the order is that of its numbers, else from a copy. Products with rows that come before are computed,
  /// those with the others are kept up to date, in `reduced` = rhs - Lᵀ v - G v, by passing the change of a
  /// row on to rows before it while it is at hand. Sweeps that go backward do the same. The numbers of v are
  /// kept in double precision as well, for rows that are not visited in this way: whoever changes v there
  /// tells by set() and pass_down(), and pass_from_ghost().
  ///
  /// Errors are those of single precision relative to v. The matrix must outlive the object, and stay
  /// split or whole.
  class RoundedSweep
  {
  public:
    /// Collective. To be completed by an update of all rows. The diagonal of the matrix, filled already,
    /// gives the units.
    /// @param order all owned rows in the order of a sweep forward; must outlive the object
    RoundedSweep(const NodeBlockMatrix &matrix, const std::vector<unsigned int> &order);

    /// Reads some owned rows of the matrix again, and all couplings to ghosts.
    /// @param inverse_diagonal the inverse diagonal blocks of all owned rows
    void update(const std::vector<unsigned int> &rows, const double *inverse_diagonal);

    /// Takes v and a right hand side. `reduced` is rhs: right if v is zero, or if the first sweep goes
    /// backward and passes all on, and ghosts follow with pass_from_ghost().
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

    /// Solves the rows at positions begin ... end - 1 of the order, from the last on if it goes backward.
    void relax(Vector &v, const std::size_t begin, const std::size_t end, const Options &options);

    /// For rows that are solved elsewhere, with a right hand side that must not be rounded. After start():
    /// the sweeps know nothing of the right hand side of a row.
    void leave_out_rhs(const unsigned int row)
    {
      set_reduced(row, {{0., 0., 0.}});
    }
    /// `reduced` of a row becomes three given numbers.
    void set_reduced(const unsigned int row, const std::array<double, 3> &numbers);
    /// s -= (A - D) v in such a row. Once leave_out_rhs() is called again, after the last visit of the row,
    /// the changes of nodes that are visited later are what get_residual() finds there.
    void subtract_product(double *s, const unsigned int row);

    /// Takes new values of a node, and passes a change (three numbers each) on to rows before it.
    void set(const unsigned int row, const double *v_row);
    void pass_down(const unsigned int row, const double *change);

    /// Passes a change of a ghost, counted from 0, on to all rows.
    void pass_from_ghost(const unsigned int ghost, const double *change);

    /// The residual after a sweep that has kept it.
    void get_residual(Vector &residual) const;

    /// What the kernels need.
    struct Arrays
    {
      /// Nine numbers a block, row by row of the block; eight more may be read.
      const float *blocks;
      /// The inverse diagonal blocks, column by column, by position in the order.
      const float *inverses;
      /// By position in the order: the first entry of a row in `columns`. In `blocks` those entries begin
      /// with zero.
      const std::size_t *lower_start;
      /// Positions.
      const unsigned int *columns;
      /// Of position 0.
      float *values, *reduced;
      double value_unit;
      /// The row of each position.
      const unsigned int *order;
    };

  private:
    Arrays arrays();
    void   order_columns();
    /// The blocks of row i whose columns come before it in the order; copies of those that are mirrored.
    void find_lower(std::vector<const double *> &lower, std::vector<double> &turned,
                    const unsigned int i) const;
    void update_ghost_couplings();
    void find_unit(const double largest_value);
    void fit_unit(const double largest_value);

    /// Whether the lower blocks are those of the matrix.
    bool shares_blocks() const
    {
      return positions.empty() && matrix.is_split();
    }

    /// Where a row is in the order.
    unsigned int position(const unsigned int row) const
    {
      return positions.empty() ? row : positions[row];
    }

    const NodeBlockMatrix           &matrix;
    const std::vector<unsigned int> &order;
    /// Empty if the order is that of the numbers; then the matrix' own arrays of lower parts are used.
    std::vector<unsigned int> positions, own_columns;
    std::vector<std::size_t>  own_lower_start;
    /// Of NodeBlockMatrix::ghost_column(), one column after the other; nine numbers, column by column.
    std::vector<float>        ghost_blocks;
    std::vector<unsigned int> ghost_positions;
    /// The lower blocks if they are not those of the matrix, and all inverse diagonal blocks: Arrays.
    std::unique_ptr<float[]> own_blocks, inverses;
    RoundedVector            values, reduced;
    /// Powers of two by which matrix, values and right hand side are divided: single precision has a small
    /// range.
    double matrix_unit = 1., value_unit = 1., rhs_unit = 1.;
    /// Whether there was anything on this rank that gives the unit of values.
    bool has_unit = false;
  };
} // namespace Signorini

#endif
