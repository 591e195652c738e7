// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_row_projection_h
#define signorini_algebra_row_projection_h

#include <signorini/algebra/fixed_directions.h>

namespace Signorini
{
  /// A_p of doc/algorithm.md, (23): how a node of the nonmortar side follows a displacement s of the other
  /// side where directions of its own are prescribed. With its unit normal n, m = E_p n and n_F = n - m,
  ///   A_p = E_p + m n_Fᵀ / |m|² ,
  /// the projection onto the free directions that keeps normal parts, n·A_p s = n·s. So u_p = v_p + A_p s
  /// gives n·(u_p - s) = m·v_p: what the fixed components cannot do is left to the free ones. It is the
  /// identity where nothing is fixed, and E_p where no part of the normal is.
  class RowProjection
  {
  public:
    /// Below this |m| a node cannot carry a multiplier, and A_p is E_p: a displacement of the other side by d
    /// would move the node by d/|m| along the surface. (Nodes that may go without one do so much earlier,
    /// DroppingRule::smallest_free_normal.)
    static constexpr double smallest_share = .01;

    /// The identity, at a node without a normal.
    RowProjection() = default;

    /// @param normal outward unit normal, or zero for E_p
    RowProjection(const FixedDirections &fixed, const Vector3 &normal)
      : fixed_directions(fixed)
      , full_normal(normal)
      , free_direction(normal)
    {
      const Vector3 fixed_part = normal - project_free(fixed, normal);
      if (fixed_part.norm_square() == 0.)
        return;
      const Vector3 free_part = normal - fixed_part;
      free_share              = free_part.norm();
      free_direction          = free_share > rounding ? free_part / free_share : Vector3();
      if (free_share >= smallest_share)
        lever = fixed_part / free_share;
    }

    /// E_p at a node that is tied in all of its free components, with the normal in these.
    static RowProjection tied(const FixedDirections &fixed, const Vector3 &normal)
    {
      const RowProjection contact(fixed, normal);
      return RowProjection(fixed, contact.direction());
    }

    /// A_p s.
    Vector3 apply(const Vector3 &s) const
    {
      return project_free(fixed_directions, s) + (lever * s) * free_direction;
    }

    /// A_p.
    Block block() const
    {
      return fixed_directions.free_block() + outer_product(free_direction, lever);
    }

    /// Whether no component is prescribed: the projection is the identity then.
    bool is_identity() const
    {
      return !fixed_directions.any();
    }

    /// The prescribed directions.
    const FixedDirections &fixed() const
    {
      return fixed_directions;
    }

    /// n.
    const Vector3 &normal() const
    {
      return full_normal;
    }

    /// m/|m|, the normal of the half-space of v_p; zero if nothing of n is free.
    const Vector3 &direction() const
    {
      return free_direction;
    }

    /// |m|: lengths along n over those along direction().
    double share() const
    {
      return free_share;
    }

  private:
    /// What is left of a component of a unit normal where it is zero.
    static constexpr double rounding = 1e-6;

    FixedDirections fixed_directions;
    Vector3         full_normal, free_direction;
    /// n_F/|m|.
    Vector3 lever;
    double  free_share = 1.;
  };
} // namespace Signorini

#endif
