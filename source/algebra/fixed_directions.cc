// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/fixed_directions.h>

#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// What is left of a unit vector along an axis when it is meant to be one: rounding of a rotation.
    constexpr double rounding = 1e-14;

    /// Of the axes of coordinates, what is left in a subspace that the ones before have spanned.
    constexpr double largest_share_left = 1e-6;

    /// The axis of coordinates that a unit vector is, or -1.
    int axis_of(const Vector3 &v)
    {
      for (unsigned int c = 0; c < dim; ++c)
        if (std::abs(v[(c + 1) % dim]) <= rounding && std::abs(v[(c + 2) % dim]) <= rounding)
          return static_cast<int>(c);
      return -1;
    }
  } // namespace



  FixedDirections FixedDirections::span(const std::vector<Vector3> &directions)
  {
    std::vector<Vector3> basis;
    for (const Vector3 &d : directions)
      {
        Vector3 rest = d;
        for (unsigned int turn = 0; turn < 2; ++turn)
          for (const Vector3 &b : basis)
            rest -= (b * rest) * b;
        if (const double length = rest.norm(); length >= independence)
          basis.push_back(rest / length);
      }
    if (basis.size() >= dim)
      return all_fixed;
    FixedDirections result;
    if (basis.empty())
      return result;
    const Vector3 axis = basis.size() == 1 ? basis[0] : cross_product_3d(basis[0], basis[1]);
    if (const int c = axis_of(axis); c >= 0)
      return static_cast<FixedMask>(basis.size() == 1 ? 1u << c : all_fixed & ~(1u << c));
    result.n_oblique = static_cast<FixedMask>(basis.size());
    for (unsigned int c = 0; c < dim; ++c)
      result.axis[c] = axis[c];
    return result;
  }



  std::vector<Vector3> FixedDirections::basis() const
  {
    std::vector<Vector3> result;
    for (unsigned int c = 0; c < dim; ++c)
      {
        Vector3 unit;
        unit[c]      = 1.;
        Vector3 rest = unit - project_free(unit);
        for (const Vector3 &b : result)
          rest -= (b * rest) * b;
        if (const double length = rest.norm(); length > largest_share_left)
          result.push_back(rest / length);
      }
    return result;
  }



  FixedDirections FixedDirections::common(const FixedDirections &other) const
  {
    if (n_oblique == 0 && other.n_oblique == 0)
      return static_cast<FixedMask>(mask & other.mask);
    if (all() || *this == other)
      return other;
    if (other.all())
      return *this;
    if (!any() || !other.any())
      return {};
    // Each is a line or a plane: they have a line in common if it lies in the other one.
    const auto is_line_in = [](const FixedDirections &line, const FixedDirections &plane) {
      const std::vector<Vector3> spanned = line.basis();
      return spanned.size() == 1 && plane.contains(spanned[0]);
    };
    return is_line_in(*this, other) ? *this : is_line_in(other, *this) ? other : FixedDirections();
  }
} // namespace Signorini
