// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_obstacle_problem_h
#define signorini_solvers_obstacle_problem_h

#include <signorini/algebra/types.h>

#include <vector>

namespace Signorini
{
  /// The half-spaces n_p . v_p <= g_p of the owned contact nodes of a rank.
  struct HalfSpaces
  {
    /// Owned local nodes, sorted.
    std::vector<unsigned int> nodes;
    /// Unit normals, in the free directions of the node.
    std::vector<Vector3> normals;
    /// Bounds (length).
    std::vector<double> bounds;
    /// |m| of doc/algorithm.md, (24): relative displacements along the full normal over those along
    /// `normals`. Empty: one everywhere.
    std::vector<double> shares;

    /// |m| of a node.
    double share(const std::size_t p) const
    {
      return shares.empty() ? 1. : shares[p];
    }

    /// Number of half-spaces of this rank.
    std::size_t size() const
    {
      return nodes.size();
    }

    /// n_p . v_p
    double normal_part(const std::size_t p, const Vector &v) const;

    /// v_p += length n_p
    void add_normal(Vector &v, const std::size_t p, const double length) const;

    /// Largest step along c from v that keeps the half-spaces of this rank, those that `ignored` marks left
    /// out; the largest number if nothing is in the way.
    double longest_step(const Vector &v, const Vector &c,
                        const std::vector<unsigned char> *const ignored = nullptr) const;
  };

  /// A block of a matrix that acts in the planes with given normals only (zero for no plane). A diagonal
  /// block keeps its stiffness along the normal, so that it can be inverted.
  Block restrict_to_planes(const Block &block, const Vector3 &row_normal, const Vector3 &column_normal,
                           const bool is_diagonal);

  /// The narrow waist between discretization and solvers: find v with
  ///   ½ vᵀ A v − bᵀ v = min,   n_p . v_p <= g_p at the contact nodes,   v = 0 in fixed components,
  /// where A (finest matrix of the hierarchy given to the solver) has unit-like rows and columns in
  /// fixed components and b is zero there.
  struct ObstacleProblem
  {
    /// b, in the layout of A, and the half-spaces of this rank.
    Vector     rhs;
    HalfSpaces half_spaces;
    /// Vectors of little energy (rigid motions), for algebraic multigrid; may be empty.
    std::vector<Vector> near_kernel;
    /// Whether A has a kernel: bodies that only the half-spaces hold.
    bool semidefinite = false;
    /// Rigid motions of such bodies, orthonormal; may be left out.
    std::vector<Vector> free_motions;
  };
} // namespace Signorini

#endif
