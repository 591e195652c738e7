// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_level_zero_solver_h
#define signorini_solvers_level_zero_solver_h

#include <signorini/algebra/algebraic_multigrid.h>
#include <signorini/solvers/coarse_cholesky.h>
#include <signorini/solvers/obstacle_problem.h>

namespace Signorini
{
  enum class LevelZeroMethod
  {
    /// Cholesky as long as the level is small.
    automatic,
    cholesky,
    amg,
    /// V-cycles of algebraic multigrid on the truncated matrix, without conjugate gradients. With coarse
    /// obstacles the step is shortened as a whole to what they admit, with projected sweeps behind it: the
    /// aggregates themselves have no obstacles.
    algebraic_shortened
  };

  /// What level 0 of a hierarchy needs besides its matrix.
  struct LevelZero
  {
    /// How the level is solved.
    LevelZeroMethod method = LevelZeroMethod::automatic;
    /// Number of V-cycles of algebraic_shortened.
    unsigned int n_steps = 1;
    /// Whether its functions may depend on each other, as those of background levels do.
    bool is_nearly_singular = false;
    /// Vectors of little energy on level 0 (rigid motions), for amg; may be empty.
    std::vector<Vector> near_kernel;
    /// Contact nodes, for a hierarchy that has to add a copy of its only level.
    HalfSpaces contact;
    /// Orthonormal rigid motions of bodies that only contact holds: on those that no active node opposes the
    /// matrix is singular. Empty if all bodies are held.
    std::vector<Vector> free_motions;
    /// Of each, made by the hierarchy: P^T P m, P all transfers together, whose product with a correction is
    /// what this has of the motion m on the finest level. Functions of background levels that vanish at all
    /// nodes of the mesh have nothing of it, whatever their product with m is.
    std::vector<Vector> motion_weights;

    /// Whether a level of so many nodes is left to amg.
    bool uses_amg(const NodeIndex n_nodes) const;
  };

  /// What multigrid asks of the solver of level 0. Whoever implements this hands it to the hierarchy
  /// (HierarchyParts::coarse_solver).
  class CoarseSolver
  {
  public:
    virtual ~CoarseSolver() = default;

    /// Collective. The matrix, which outlives the object, is new or has changed.
    virtual void setup(const NodeBlockMatrix &matrix) = 0;

    /// Collective. solution = (approximate, symmetric) inverse times rhs.
    virtual void solve(Vector &solution, const Vector &rhs) const = 0;
  };



  /// Solver of level 0: sparse Cholesky, or conjugate gradients with algebraic multigrid to three digits,
  /// which the iteration around it does not notice, or a number of its cycles alone.
  class LevelZeroSolver : public CoarseSolver
  {
  public:
    /// To be followed by setup().
    explicit LevelZeroSolver(LevelZero level_zero)
      : level_zero(std::move(level_zero))
    {
    }

    void setup(const NodeBlockMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) const override;

  private:
    /// Of the free motions those that cost nothing, orthonormal.
    void find_kernel(const NodeBlockMatrix &singular);
    void make_definite(const NodeBlockMatrix &singular);
    void solve_definite(Vector &solution, const Vector &rhs) const;

    const LevelZero level_zero;
    /// V-cycles without conjugate gradients; 0 for those.
    unsigned int n_steps = 0;

    CoarseCholesky                      cholesky;
    std::unique_ptr<AlgebraicMultigrid> amg;
    const NodeBlockMatrix              *matrix = nullptr;
    NodeBlockMatrix                     definite;
    /// Orthonormal motions that cost nothing, what measures them (biorthogonal), and the largest right hand
    /// side so far.
    std::vector<Vector> kernel, kernel_weights;
    mutable double      largest_rhs = 0.;
  };
} // namespace Signorini

#endif
