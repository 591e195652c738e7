// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_condition_frame_h
#define signorini_discretization_condition_frame_h

#include <signorini/algebra/types.h>

#include <deal.II/base/point.h>

#include <array>

namespace Signorini
{
  /// The directions that the three components of a prescribed displacement are meant in.
  class ConditionFrame
  {
  public:
    /// x, y, z.
    ConditionFrame() = default;

    /// Two directions and their cross product. The second one is made orthogonal to the first; it may be
    /// zero: any orthogonal one will do. Errors: InputError for a first one that is zero.
    static ConditionFrame rotated(const Vector3 &first, const Vector3 &second = Vector3());

    /// The outward normal of the boundary, and two tangents without further meaning.
    static ConditionFrame normal();

    /// Radial, tangential (counterclockwise about the axis) and axial. Errors: InputError for an axis that is
    /// zero.
    static ConditionFrame cylindrical(const dealii::Point<3> &point, const Vector3 &axis);

    /// Whether it is x, y, z.
    bool is_cartesian() const
    {
      return kind == Kind::cartesian;
    }

    /// Whether it asks for the normal of the boundary.
    bool needs_normal() const
    {
      return kind == Kind::normal;
    }

    /// The three directions (unit vectors) at a point of a boundary with the given outward unit normal. On
    /// the axis of a cylindrical frame the radial direction is any orthogonal one.
    std::array<Vector3, 3> axes(const dealii::Point<3> &p, const Vector3 &normal) const;

  private:
    enum class Kind
    {
      cartesian,
      rotated,
      normal,
      cylindrical
    };

    Kind             kind = Kind::cartesian;
    dealii::Point<3> point;
    /// The directions of a rotated frame; the axis is the first.
    Vector3 first, second;
  };
} // namespace Signorini

#endif
