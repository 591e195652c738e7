// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_multigrid_hierarchy_h
#define signorini_solvers_multigrid_hierarchy_h

#include <signorini/algebra/nodal_transfer.h>
#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/level_zero_solver.h>
#include <signorini/solvers/obstacle_problem.h>
#include <signorini/solvers/projected_gauss_seidel.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// One level: its matrix, its smoother, and the prolongation from it to the next finer level.
  struct MultigridLevel
  {
    NodeBlockMatrix matrix;
    /// Fixed components of the local nodes.
    std::vector<FixedMask>                fixed;
    std::unique_ptr<ProjectedGaussSeidel> smoother;
    /// Contact nodes of a coarse level with their normals, for coarse obstacles (no bounds); may be empty.
    HalfSpaces contact;
    /// Half-spaces at the contact nodes that a coarse level shares with the finest one, those of the problem
    /// that the hierarchy is built for: the level as an obstacle problem of its own, for a start. May be
    /// empty.
    HalfSpaces half_spaces;
    /// From this level to the finer one; unused on the finest level.
    NodalTransfer to_finer;
    /// The largest diagonal entry when the level was built.
    double scale = 0.;
    /// One per half-space: where the prolongation to this level is truncated.
    std::vector<unsigned char> truncated;
  };

  /// Collective. coarse_defect += P^T residual, zero in fixed components; level is the coarse one.
  void restrict_defect(const MultigridLevel &level, Vector &coarse_defect, const Vector &residual);

  /// Zeroes rows and columns of fixed components (the diagonal entry stays, or becomes `scale` where it
  /// is zero) and gives directions without any stiffness, which truncation can leave behind, a diagonal
  /// entry, so that blocks can be inverted. `rows` are owned rows.
  void eliminate_fixed_components(NodeBlockMatrix &matrix, const std::vector<FixedMask> &fixed,
                                  const std::vector<unsigned int> &rows, const double scale);

  /// Matrices and transfers of all levels, Galerkin products from fine to coarse, and their truncation:
  /// on the finest level the normal part of the prolongation is removed at active nodes, and what
  /// depends on it on coarser levels is recomputed (method.md, section 5).
  class MultigridHierarchy
  {
  public:
    /// The finest matrix, whose fixed components are eliminated here, and its fixed masks (local nodes).
    MultigridHierarchy(NodeBlockMatrix &&matrix, std::vector<FixedMask> fixed);

    /// Collective. Adds the next coarser level: transfer rows as in NodalTransfer, owned coarse nodes,
    /// fixed masks of the owned coarse nodes.
    void add_coarser_level(NodalTransfer &&transfer, const dealii::IndexSet &owned_coarse,
                           const std::vector<FixedMask> &fixed);

    /// Collective. Chooses the interface rows of the level added last: contact nodes (global numbers, the
    /// same on all ranks, sorted) and one layer of neighbours. Where sweeps may be slow, because of a stiff
    /// nonmortar side, that is measured (ProjectedGaussSeidel::correct_slow_interface).
    void set_interface(const std::vector<NodeIndex> &contact_nodes, const bool may_be_slow = false);

    /// Collective. Before the first coarser level is added: guesses the active set by a sweep over the
    /// contact nodes from a start (left as it is), so that the coarser levels are built truncated there.
    void expect_active_set(const ObstacleProblem &problem, const Vector &start);

    /// Whether expect_active_set() was called: there is a good start.
    bool expects_active_set() const
    {
      return was_expected;
    }

    /// Whether interface sweeps alone would be slow on some level (see set_interface()).
    bool has_slow_interface() const
    {
      return slow_interface;
    }

    /// Collective. After the last level: what the solver of level 0 needs. A hierarchy of a single level gets
    /// an algebraic copy of it as level 0, so that the truncated problem has an exact coarse solver.
    void finish(LevelZero level_zero = {});

    /// Collective. Truncates at the active ones of the half-spaces of the finest level; recomputes only
    /// what changed since the last call. Returns whether anything changed on any rank.
    bool truncate(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active);

    /// As long as an object of this class lives its hierarchy lacks the finest level: the levels below are a
    /// hierarchy themselves. What they were truncated at must be undone before the object goes.
    class WithoutFinest
    {
    public:
      explicit WithoutFinest(MultigridHierarchy &hierarchy);
      ~WithoutFinest();
      WithoutFinest(const WithoutFinest &) = delete;

    private:
      MultigridHierarchy             &hierarchy;
      std::unique_ptr<MultigridLevel> finest;
    };

    /// Level 0 is the coarsest.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(levels.size());
    }

    MultigridLevel &level(const unsigned int l)
    {
      return *levels[levels.size() - 1 - l];
    }

    const MultigridLevel &level(const unsigned int l) const
    {
      return *levels[levels.size() - 1 - l];
    }

    MultigridLevel &finest()
    {
      return *levels.front();
    }

    /// The level added last.
    MultigridLevel &coarsest()
    {
      return *levels.back();
    }

    /// Collective. Set up anew if level 0 has changed.
    const LevelZeroSolver &coarse_solver();

  private:
    /// Collective. Makes `active` the truncated nodes; whether anything changes. Unit normals at them and a
    /// flag where something changes, zero elsewhere, both with ghosts: ghosts of active nodes must be
    /// truncated as well.
    bool set_truncated(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active,
                       Vector &planes, Vector &changed);

    /// Removes the planes' normals from the changed block rows of the finest transfer.
    void truncate_transfer(const Vector &planes, const Vector &changed);

    /// Finest first.
    std::vector<std::unique_ptr<MultigridLevel>> levels;
    LevelZero                                    level_zero;
    LevelZeroSolver                              level_zero_solver;
    bool                                         level_zero_changed = false;
    /// What expect_active_set() found, until the next level is added (see set_truncated()).
    Vector expected_planes, expected_nodes;
    bool   was_expected = false, slow_interface = false;
  };
} // namespace Signorini

#endif
