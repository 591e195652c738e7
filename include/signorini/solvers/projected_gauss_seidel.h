// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_projected_gauss_seidel_h
#define signorini_solvers_projected_gauss_seidel_h

#include <signorini/algebra/node_block_matrix.h>
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

    /// Recomputes the inverse diagonal blocks of all rows, or of the given ones.
    void update_diagonal();
    void update_diagonal(const std::vector<unsigned int> &rows);

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
    /// the same on all ranks), and adds an InterfaceCorrection to the interface sweeps if they are slow.
    void correct_slow_interface(const std::vector<NodeIndex> &contact_nodes);

    /// One sweep over all rows: v <- minimizer row by row. Energy never rises.
    void sweep(Vector &v, const Vector &rhs, const Direction direction);

    /// One sweep over the interface rows only.
    void interface_sweep(Vector &v, const Vector &rhs, const Direction direction);

    /// The sweeps before (forward) or after (backward) a coarse correction, interface sweeps nearest to it.
    /// Where cells are stretched each sweep goes over lines and planes of nodes (StrongBlocks) as well. One
    /// is the adjoint of the other, so that a cycle is symmetric.
    void smooth(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                const Direction direction);

    /// smooth() forward from v = 0, and residual = rhs - A v. The first sweep reads only the blocks of nodes
    /// visited before; the last one passes the changes of a node on to the residuals of those visited before
    /// while it has the row at hand (the matrix is symmetric). The residual costs no further pass over it.
    void smooth_from_zero(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                          Vector &residual);

    /// smooth() backward, and residual = rhs - A v, in the same way.
    void smooth_to_residual(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                            Vector &residual);

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
    /// What a sweep may leave out and has to leave behind.
    struct SweepOptions
    {
      /// v is zero at nodes that were not visited.
      bool from_zero = false;
      /// Where to collect rhs - A v at nodes that no other rank sees, up to projections; may be null.
      double *residual = nullptr;
    };

    template <Direction direction>
    void relax(double *v, const double *rhs, const unsigned int row, const unsigned int later_row,
               const SweepOptions &options);

    void project_row(double *v_row, const int half_space);

    void run(Vector &v, const Vector &rhs, const SweepSchedule &schedule, const Direction direction,
             const SweepOptions &options);

    /// Splits the rows at the diagonal.
    void split_rows();

    /// The blocks of a row that a sweep multiplies, from and to.
    std::pair<std::size_t, std::size_t> range(const unsigned int row, const SweepOptions &options) const;

    /// Interface sweeps, each with the interface correction after it (before it, backward).
    void smooth_interface(Vector &v, const Vector &rhs, const SmoothingParameters &parameters,
                          const Direction direction);

    /// A sweep over all rows and one over the blocks, nearer to the coarse correction.
    void sweep_with_blocks(Vector &v, const Vector &rhs, const Direction direction,
                           const SweepOptions &options);

    /// Residuals that the last sweep cannot collect: at nodes that other ranks see, at contact nodes (where
    /// it may project), and at the given nodes (may be null), where something else has changed v since.
    void complete_residual(Vector &residual, const Vector &v, const Vector &rhs,
                           const std::vector<bool> *const changed,
                           const std::vector<bool> *const also_changed);

    /// Collective. By how much a forward and a backward sweep over some rows reduce the energy norm of an
    /// error there, everything else at rest, after some sweeps.
    double sweep_rate(const SweepSchedule &schedule);

    /// The rows that see one of the given ones (themselves included).
    std::vector<bool> rows_that_see(const std::vector<unsigned int> &rows) const;

    const NodeBlockMatrix &matrix;
    SweepSchedule          all_rows;
    StrongBlocks           blocks;
    SweepSchedule          interface_rows;
    /// Null where sweeps by node are fast enough.
    std::unique_ptr<InterfaceCorrection> interface_correction;
    /// Position of the first block above the diagonal.
    std::vector<std::size_t> first_above;
    /// Rows of nodes that no other rank sees; those whose columns after first_above are visited after them.
    std::vector<bool> is_inner, is_ordered;
    /// Rows that see rows of interface sweeps, of blocks.
    std::vector<bool>          sees_interface, sees_blocks;
    std::vector<double>        inverse_diagonal;
    HalfSpaces                 constraints;
    std::vector<int>           half_space_of_row;
    std::vector<Vector3>       projection_direction;
    std::vector<unsigned char> is_active;
  };
} // namespace Signorini

#endif
