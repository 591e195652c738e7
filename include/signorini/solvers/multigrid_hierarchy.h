// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_multigrid_hierarchy_h
#define signorini_solvers_multigrid_hierarchy_h

#include <signorini/algebra/nodal_transfer.h>
#include <signorini/solvers/empty_directions.h>
#include <signorini/solvers/level_zero_solver.h>
#include <signorini/solvers/staged_smoother.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace Signorini
{
  /// How the correction of a level is found (doc/algorithm.md, (46a)).
  struct LevelCorrection
  {
    /// V-cycles, one after the other: two on all levels make a W-cycle. Level 0 has one.
    unsigned int n_cycles = 1;
    /// Whether it gets the length that minimizes the energy of the level, which costs no product. Functions
    /// that are coarser than the body is thick, and those of no mesh, return too short a correction. The
    /// cycle is not a linear function of the residual then.
    bool exact_step = false;
  };

  /// One level: its matrix, its smoother, and the prolongation from it to the next finer level.
  struct MultigridLevel
  {
    /// A of the level, fixed components eliminated.
    NodeBlockMatrix matrix;
    /// Fixed components of the local nodes.
    std::vector<FixedDirections> fixed;
    /// What the matrix has that no energy gave it.
    EmptyDirections           empty;
    std::unique_ptr<Smoother> smoother;
    /// Contact nodes of both sides: global numbers, sorted, the same on all ranks.
    std::vector<NodeIndex> contact_nodes;
    /// Contact nodes of a coarse level with their normals, for coarse obstacles (no bounds); may be empty.
    HalfSpaces contact;
    /// Half-spaces at the contact nodes that a coarse level shares with the finest one, those of the problem
    /// that the hierarchy is built for: the level as an obstacle problem of its own, for a start. May be
    /// empty.
    HalfSpaces half_spaces;
    /// From this level to the finer one; unused on the finest level.
    NodalTransfer   to_finer;
    LevelCorrection correction;
    /// The largest diagonal entry when the level was built.
    double scale = 0.;
    /// One per half-space: where the prolongation to this level is truncated.
    std::vector<unsigned char> truncated;
  };

  /// The owned rows of a matrix.
  std::vector<unsigned int> all_rows(const NodeBlockMatrix &matrix);

  /// Collective. coarse_defect += P^T residual, zero in fixed components; level is the coarse one.
  void restrict_defect(const MultigridLevel &level, Vector &coarse_defect, const Vector &residual);

  /// Zeroes rows and columns of fixed components; the diagonal entry stays, or where it is zero becomes the
  /// mean of the others of its block, `scale` where these are zero, too. `rows` are owned rows.
  void eliminate_fixed_components(NodeBlockMatrix &matrix, const std::vector<FixedDirections> &fixed,
                                  const std::vector<unsigned int> &rows, const double scale);

  /// A level below another one, as it is described to the hierarchy.
  struct CoarserLevel
  {
    /// Rows of the local nodes of the finer level.
    NodalTransfer transfer;
    /// Owned nodes, and their fixed masks.
    dealii::IndexSet             owned;
    std::vector<FixedDirections> fixed;
    /// Contact nodes of both sides.
    LevelInterface interface;
    /// See MultigridLevel.
    HalfSpaces      contact, half_spaces;
    LevelCorrection correction;
  };



  /// Describes the levels of a hierarchy below its finest one, one after the other: which ghosts a level has
  /// follows from the level above.
  class LevelSource
  {
  public:
    virtual ~LevelSource() = default;

    /// Collective. The next coarser level; nothing below level 0.
    virtual std::optional<CoarserLevel> next(const NodePartition &finer) = 0;

    /// Collective. What the solver of level 0 needs.
    virtual LevelZero level_zero(const NodePartition &coarsest) = 0;
  };



  /// What a hierarchy is built from.
  struct HierarchyParts
  {
    /// The finest matrix, whose fixed components are eliminated by the hierarchy, and the fixed masks of its
    /// owned nodes (what follows is not looked at).
    NodeBlockMatrix              matrix;
    std::vector<FixedDirections> fixed;
    LevelInterface               interface;
    /// Null for a hierarchy of the finest level alone, which only methods without levels can use.
    LevelSource *levels = nullptr;
    /// Null, or a problem and a good start: the coarser levels are built truncated at the active set that
    /// these let expect.
    const ObstacleProblem *problem = nullptr;
    const Vector          *start   = nullptr;
    /// Another smoother for all levels, another solver of level 0; empty for those of this program.
    std::function<std::unique_ptr<Smoother>(const NodeBlockMatrix &, const LevelInterface &)> make_smoother;
    std::unique_ptr<CoarseSolver>                                                             coarse_solver;
  };



  /// Matrices and transfers of all levels, Galerkin products from fine to coarse, and their truncation:
  /// on the finest level the normal part of the prolongation is removed at active nodes, and what
  /// depends on it on coarser levels is recomputed (doc/algorithm.md, chapter 7, (35)).
  class MultigridHierarchy
  {
  public:
    /// Collective. A hierarchy of a single level gets an algebraic copy of it as level 0, so that the
    /// truncated problem has an exact coarse solver.
    explicit MultigridHierarchy(HierarchyParts &&parts);

    /// Collective. The finest level alone, for methods without levels.
    MultigridHierarchy(NodeBlockMatrix &&matrix, std::vector<FixedDirections> fixed);

    /// Whether it was built for a good start (HierarchyParts::start).
    bool expects_active_set() const
    {
      return was_expected;
    }

    /// Whether interface sweeps alone would be slow on some level.
    bool has_slow_interface() const
    {
      return slow_interface;
    }

    /// Collective. Truncates the prolongation to a level at the active ones of its half-spaces and
    /// recomputes, on the levels below, only what changed since the last call. Returns whether anything
    /// changed on any rank.
    bool truncate(const unsigned int level, const HalfSpaces &half_spaces,
                  const std::vector<unsigned char> &active);

    /// Collective. Smoother::strengthen() on all levels that are smoothed, once.
    void strengthen_smoothers();

    /// Whether that was done.
    bool has_strong_smoothers() const
    {
      return strong_smoothers;
    }

    /// Level 0 is the coarsest.
    unsigned int n_levels() const
    {
      return static_cast<unsigned int>(levels.size());
    }

    /// A level; level 0 is the coarsest.
    MultigridLevel &level(const unsigned int l)
    {
      return *levels[levels.size() - 1 - l];
    }

    /// The same.
    const MultigridLevel &level(const unsigned int l) const
    {
      return *levels[levels.size() - 1 - l];
    }

    /// The level of the problem.
    MultigridLevel &finest()
    {
      return *levels.front();
    }

    /// Collective. Set up anew if level 0 has changed.
    const CoarseSolver &coarse_solver();

  private:
    void add_finest(HierarchyParts &parts);
    void add_coarser(CoarserLevel &&description, const HierarchyParts &parts);
    void make_smoother(MultigridLevel &level, const LevelInterface &interface, const HierarchyParts &parts);
    /// An algebraic copy of the only level.
    CoarserLevel copy_of_finest(const HalfSpaces &contact) const;
    /// LevelZero::motion_weights of a motion on level 0.
    Vector weights_of_motion(const Vector &motion) const;
    /// Truncates the first prolongation at the active set that problem and start let expect.
    void truncate_expected(const HierarchyParts &parts, NodalTransfer &transfer);

    /// Collective. Makes `active` the truncated nodes of a level; whether anything changes. Unit normals at
    /// them and a flag where something changes, zero elsewhere, both with ghosts: ghosts of active nodes must
    /// be truncated as well.
    bool set_truncated(MultigridLevel &fine, const HalfSpaces &half_spaces,
                       const std::vector<unsigned char> &active, Vector &planes, Vector &changed);

    /// Finest first.
    std::vector<std::unique_ptr<MultigridLevel>> levels;
    std::unique_ptr<CoarseSolver>                level_zero_solver;
    bool                                         level_zero_changed = false;
    bool was_expected = false, slow_interface = false, strong_smoothers = false;
  };

  /// Collective. Marks the active nodes of a good start (left as it is): projects it and sweeps once over the
  /// interface.
  ContactState find_active(MultigridLevel &level, const HalfSpaces &half_spaces, const Vector &rhs,
                           Vector &v);
} // namespace Signorini

#endif
