// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/discretization/condition_frame.h>

#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Vector3 unit_vector(const unsigned int c)
    {
      Vector3 e;
      e[c] = 1.;
      return e;
    }

    /// A unit vector orthogonal to another one.
    Vector3 orthogonal_to(const Vector3 &n)
    {
      unsigned int smallest = 0;
      for (unsigned int c = 1; c < dim; ++c)
        if (std::abs(n[c]) < std::abs(n[smallest]))
          smallest = c;
      const Vector3 e = unit_vector(smallest), across = e - (e * n) * n;
      return across / across.norm();
    }

    Vector3 direction(const Vector3 &v)
    {
      const double length = v.norm();
      if (!(length > 0.) || !std::isfinite(length))
        throw InputError("the direction of a condition must not be zero.");
      return v / length;
    }
  } // namespace



  ConditionFrame ConditionFrame::rotated(const Vector3 &first, const Vector3 &second)
  {
    ConditionFrame result;
    result.kind           = Kind::rotated;
    result.first          = direction(first);
    const Vector3 across  = second - (second * result.first) * result.first;
    const bool    is_free = !(across.norm() > 1e-8 * second.norm());
    result.second         = is_free ? orthogonal_to(result.first) : across / across.norm();
    return result;
  }



  ConditionFrame ConditionFrame::normal()
  {
    ConditionFrame result;
    result.kind = Kind::normal;
    return result;
  }



  ConditionFrame ConditionFrame::cylindrical(const Point<3> &point, const Vector3 &axis)
  {
    ConditionFrame result;
    result.kind  = Kind::cylindrical;
    result.point = point;
    result.first = direction(axis);
    return result;
  }



  std::array<Vector3, 3> ConditionFrame::axes(const Point<3> &p, const Vector3 &normal) const
  {
    switch (kind)
      {
        case Kind::rotated:
          return {{first, second, cross_product_3d(first, second)}};
        case Kind::normal:
          {
            const Vector3 tangent = orthogonal_to(normal);
            return {{normal, tangent, cross_product_3d(normal, tangent)}};
          }
        case Kind::cylindrical:
          {
            const Vector3 from_point = p - point, from_axis = from_point - (from_point * first) * first;
            const bool    is_on_axis = !(from_axis.norm() > 1e-12 * from_point.norm());
            const Vector3 radial     = is_on_axis ? orthogonal_to(first) : from_axis / from_axis.norm();
            return {{radial, cross_product_3d(first, radial), first}};
          }
        default:
          return {{unit_vector(0), unit_vector(1), unit_vector(2)}};
      }
  }
} // namespace Signorini
