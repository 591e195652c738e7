// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_contact_state_h
#define signorini_solvers_contact_state_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/obstacle_problem.h>

#include <vector>

namespace Signorini
{
  /// The half-spaces of a solve and which of them are active: owned by the solver, lent to whatever changes
  /// the iterate. A half-space is active if the last visit of its node ended on its plane.
  class ContactState
  {
  public:
    ContactState() = default;

    /// Half-spaces at owned nodes of a matrix, none of them active; without any: every node is free.
    explicit ContactState(const NodeBlockMatrix &matrix, const HalfSpaces &half_spaces = HalfSpaces());

    /// The half-spaces, with bounds as set_bounds_from() left them.
    const HalfSpaces &half_spaces() const
    {
      return spaces;
    }

    /// Number of half-spaces of this rank.
    std::size_t size() const
    {
      return spaces.size();
    }

    /// Index of the half-space at an owned row, or -1.
    int at(const unsigned int row) const
    {
      return half_space_of_row[row];
    }

    /// For each half-space whether it is active.
    const std::vector<unsigned char> &active() const
    {
      return is_active;
    }

    /// Says whether a half-space is active, for those who solve for several nodes at once.
    void set_active(const std::size_t p, const bool value)
    {
      is_active[p] = value;
    }

    /// Unit normal of the plane on which an owned row has to stay; zero if it is free or not active.
    Vector3 plane(const unsigned int row) const
    {
      const int p = half_space_of_row[row];
      return p >= 0 && is_active[p] ? spaces.normals[p] : Vector3();
    }

    /// Replaces the bounds by what v leaves of those of `all`, which are otherwise the half-spaces of this
    /// object: the half-spaces of corrections of v.
    void set_bounds_from(const HalfSpaces &all, const Vector &v);

    /// Moves the three numbers of a node with half-space p onto the plane if they violate it, along
    /// A_pp⁻¹ n_p (the minimizer of the 3×3 problem, if they are that without the half-space), and says
    /// whether it is active.
    void project_node(double *v_row, const int p);

    /// project_node() at all nodes.
    void project(Vector &v);

    /// Removes the normal parts at active nodes. A line search along corrections that are tangential there
    /// must not see the contact forces: their product with the rounding errors of the correction drowns the
    /// slope.
    void restrict_to_tangents(Vector &residual) const;

    /// Collective. Sum of (n·a)(n·b) over the active nodes: the part of a·b that restrict_to_tangents() would
    /// remove.
    double normal_product(const Vector &a, const Vector &b) const;

    /// Collective. The energy of the normal parts of c at active nodes, each as if it moved alone.
    double normal_energy(const NodeBlockMatrix &matrix, const Vector &c) const;

    /// Makes c tangential at active nodes; elsewhere shortens it, node by node, so that v + c is admissible.
    void project_correction(Vector &c, const Vector &v) const;

    /// Collective. Largest step along c from v that keeps the half-spaces that are not active.
    double longest_step(const Vector &v, const Vector &c) const
    {
      return longest_step(v, c, spaces);
    }

    /// The same for other bounds.
    double longest_step(const Vector &v, const Vector &c, const HalfSpaces &all) const;

    /// Collective. Active ones of all ranks.
    unsigned int n_active() const;

  private:
    HalfSpaces           spaces;
    std::vector<int>     half_space_of_row;
    std::vector<Vector3> projection_direction;
    // One byte each: ranks and sweeps write them one by one.
    std::vector<unsigned char> is_active;
    MPI_Comm                   communicator = MPI_COMM_SELF;
  };



  inline void ContactState::project_node(double *const v, const int p)
  {
    const Vector3 &n      = spaces.normals[p];
    const double   excess = n[0] * v[0] + n[1] * v[1] + n[2] * v[2] - spaces.bounds[p];
    is_active[p]          = excess >= 0.;
    if (excess > 0.)
      for (unsigned int c = 0; c < dim; ++c)
        v[c] -= excess * projection_direction[p][c];
  }
} // namespace Signorini

#endif
