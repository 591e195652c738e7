// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_projected_gauss_seidel_h
#define signorini_solvers_projected_gauss_seidel_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/algebra/rounded_sweep.h>
#include <signorini/solvers/interface_correction.h>
#include <signorini/solvers/obstacle_problem.h>
#include <signorini/solvers/strong_blocks.h>
#include <signorini/solvers/sweep_schedule.h>

#include <vector>

namespace Signorini
{
  /// Smoothing of all levels.
  struct SmoothingParameters
  {
    unsigned int n_pre              = 3;
    unsigned int n_post             = 3;
    unsigned int n_interface_sweeps = 2;
  };

  /// Block Gauss-Seidel by node (3x3 blocks), with or without half-spaces.
  ///
  /// At a contact node the 3x3 problem with one half-space has a closed solution: solve without
  /// constraint; if it is violated, move along A_pp^-1 n_p onto the plane (method.md, section 4).
  /// The matrix must outlive the object.
  class ProjectedGaussSeidel
  {
  public:
    enum Direction
    {
      forward,
      backward
    };

    explicit ProjectedGaussSeidel(const NodeBlockMatrix &matrix);

    /// Reads some rows of the matrix again.
    void update(const std::vector<unsigned int> &rows);

    /// Sets the half-spaces; without a call there are none. Collective in nothing.
    void set_half_spaces(const HalfSpaces &half_spaces);

    /// Replaces the bounds by what v leaves of those of `half_spaces`, which are otherwise the ones that were
    /// set: the half-spaces of corrections of v.
    void set_bounds_from(const HalfSpaces &half_spaces, const Vector &v);

    /// What was set last.
    const HalfSpaces &half_spaces() const
    {
      return constraints;
    }

    /// Chooses the rows of interface_sweep().
    void set_interface(const std::vector<unsigned int> &rows);

    /// Collective. Measures how fast sweeps over the contact nodes of both sides are (global numbers, sorted,
    /// the same on all ranks), and adds an InterfaceCorrection to the interface sweeps if they are slow;
    /// whether they are.
    bool correct_slow_interface(const std::vector<NodeIndex> &contact_nodes);

    /// One sweep over all rows: v <- minimizer row by row. Energy never rises.
    void sweep(Vector &v, const Vector &rhs, const Direction direction);

    /// One sweep over the interface rows only.
    void interface_sweep(Vector &v, const Vector &rhs, const Direction direction);

    /// Collective. Projects v and sweeps once over the interface rows: shows the active set of a good start.
    void find_active(Vector &v, const Vector &rhs);

    /// The sweeps before (forward) or after (backward) a coarse correction, interface sweeps nearest to it.
    /// Where cells are stretched each sweep goes over lines and planes of nodes (StrongBlocks) as well. One
    /// is the adjoint of the other, so that a cycle is symmetric.
    void smooth(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                const Direction direction);

    /// smooth() forward from v = 0, and residual = rhs - A v, in single precision (see RoundedSweep): for
    /// corrections, and right hand sides that go to zero with them. The right hand side of rows with a
    /// half-space, which at an active node is the contact force, is not rounded. Interface sweeps are in
    /// double precision, from the residual that the others leave.
    void smooth_from_zero(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                          Vector &residual);

    /// smooth() backward in the same way, and residual = rhs - A v in double precision unless it is null.
    void smooth_to_residual(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                            Vector *const residual);

    /// For each half-space whether the last visit projected onto its plane.
    const std::vector<unsigned char> &active() const
    {
      return is_active;
    }

    /// Moves v onto the planes of violated half-spaces (along A_pp^-1 n_p) and marks what it moved.
    void project(Vector &v);

    /// Removes the normal parts at active nodes. A line search along corrections that are tangential there
    /// must not see the contact forces: their product with the rounding errors of the correction drowns the
    /// slope.
    void restrict_to_tangents(Vector &residual) const;

    /// Collective. Sum of (n·a)(n·b) over the active nodes: the part of a·b that restrict_to_tangents() would
    /// remove.
    double normal_product(const Vector &a, const Vector &b) const;

    /// Makes c tangential at active nodes; elsewhere shortens it so that v + c keeps the half-spaces.
    void project_correction(Vector &c, const Vector &v) const;

    /// Bytes that a sweep reads and writes at least.
    double sweep_bytes() const;

  private:
    /// v_row <- its minimizer, A_row,row v_row = s without the half-space.
    void minimize_row(double *v_row, const double *s, const unsigned int row);

    /// minimize_row() from a whole row.
    template <Direction direction>
    void relax(double *v, const double *rhs, const unsigned int row);

    /// RoundedSweep::start() without the right hand sides of relax_half_space().
    void start_rounded(const Vector &v, const Vector &rhs);

    /// minimize_row() of a row with a half-space, of which only products with other rows are rounded. Keeps
    /// its residual if wanted.
    void relax_half_space(double *y, const double *rhs, const unsigned int row, const bool keeps_residual);

    /// The residual after a sweep that has kept it.
    void get_residual(Vector &residual) const;

    /// A sweep in single precision but for rows that are not ordered or have a half-space.
    void run_rounded(Vector &v, const Vector &rhs, const RoundedSweep::Options &options);

    /// The same in double precision from a residual that is valid where rows are ordered, and stays so.
    void relax_with_residual(Vector &v, const Vector &rhs, const unsigned int row, Vector &residual);

    /// residual -= A change of a row.
    void pass_on(double *residual, const unsigned int row, const double *change) const;

    /// Collective. Runs an action that changes v at given rows, then pass_on_change(row, change) for each.
    template <typename Action, typename PassOn>
    void follow_changes(const std::vector<unsigned int> &rows, const Vector &v, const Action &action,
                        const PassOn &pass_on_change) const;

    void project_row(double *v_row, const int half_space);

    /// Collective. Calls visit_row(row) in the order of a schedule.
    template <typename Visit>
    void visit(Vector &v, const SweepSchedule &schedule, const Direction direction, const Visit &visit_row);

    void run(Vector &v, const Vector &rhs, const SweepSchedule &schedule, const Direction direction);

    void find_ordered_rows();

    /// Interface sweeps, each with the interface correction after it (before it, backward).
    void smooth_interface(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                          const Direction direction);

    void correct_interface(Vector &v, const Vector &rhs);

    void sweep_blocks(Vector &v, const Vector &rhs, const Direction direction);

    /// sweep_blocks() between sweeps in single precision.
    void sweep_blocks_rounded(Vector &v, const Vector &rhs, const Direction direction,
                              const bool passes_down);

    /// The residual at rows that are not ordered.
    void complete_residual(Vector &residual, const Vector &v, const Vector &rhs);

    /// Collective. By how much a forward and a backward sweep over some rows reduce the energy norm of an
    /// error there, everything else at rest, after some sweeps.
    double sweep_rate(const SweepSchedule &schedule);

    const NodeBlockMatrix &matrix;
    SweepSchedule          all_rows;
    StrongBlocks           blocks;
    /// Rows in blocks.
    std::vector<unsigned int> block_rows;
    SweepSchedule             interface_rows;
    /// Null where sweeps by node are fast enough.
    std::unique_ptr<InterfaceCorrection> interface_correction;
    /// Rows of which a forward sweep visits the lower part before and the upper part after them, seen by no
    /// other rank. Sweeps in single precision read the others as a whole, in double precision.
    std::vector<bool>    is_ordered;
    RoundedSweep         rounded;
    std::vector<double>  inverse_diagonal;
    HalfSpaces           constraints;
    std::vector<int>     half_space_of_row;
    std::vector<Vector3> projection_direction;
    /// Of relax_half_space().
    std::vector<Vector3>       contact_residual;
    std::vector<unsigned char> is_active;
  };



  inline void ProjectedGaussSeidel::project_row(double *const v, const int p)
  {
    const Vector3 &n      = constraints.normals[p];
    const double   excess = n[0] * v[0] + n[1] * v[1] + n[2] * v[2] - constraints.bounds[p];
    is_active[p]          = excess >= 0.;
    if (excess > 0.)
      for (unsigned int c = 0; c < dim; ++c)
        v[c] -= excess * projection_direction[p][c];
  }



  inline void ProjectedGaussSeidel::minimize_row(double *const y, const double *const s,
                                                 const unsigned int row)
  {
    const double *const d = inverse_diagonal.data() + 9 * static_cast<std::size_t>(row);
    y[0]                  = d[0] * s[0] + d[1] * s[1] + d[2] * s[2];
    y[1]                  = d[3] * s[0] + d[4] * s[1] + d[5] * s[2];
    y[2]                  = d[6] * s[0] + d[7] * s[1] + d[8] * s[2];
    if (half_space_of_row[row] >= 0)
      project_row(y, half_space_of_row[row]);
  }



  template <ProjectedGaussSeidel::Direction direction>
  inline void ProjectedGaussSeidel::relax(double *const v, const double *const rhs, const unsigned int row)
  {
    const BlockRange here[2] = {matrix.lower(row), matrix.upper(row)};
    double           sums[6];
    // Memory is read in one direction throughout, also within a row.
    (direction == forward ? multiply_block_ranges : multiply_block_ranges_backward)(
        sums, matrix.block_data(), matrix.column_data(), here, 2, v);
    const double s[3] = {rhs[dim * row] - sums[0] - sums[3], rhs[dim * row + 1] - sums[1] - sums[4],
                         rhs[dim * row + 2] - sums[2] - sums[5]};
    minimize_row(v + dim * static_cast<std::size_t>(row), s, row);
  }



  template <typename Visit>
  void ProjectedGaussSeidel::visit(Vector &v, const SweepSchedule &schedule, const Direction direction,
                                   const Visit &visit_row)
  {
    const std::size_t n_phases = schedule.phases().size();
    for (std::size_t i = 0; i < n_phases; ++i)
      {
        v.update_ghost_values();
        const auto       &rows = schedule.phases()[direction == forward ? i : n_phases - 1 - i];
        const std::size_t n    = rows.size();
        if (direction == forward)
          for (std::size_t k = 0; k < n; ++k)
            visit_row(rows[k]);
        else
          for (std::size_t k = n; k-- > 0;)
            visit_row(rows[k]);
      }
  }
} // namespace Signorini

#endif
