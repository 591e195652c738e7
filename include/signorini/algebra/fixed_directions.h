// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_fixed_directions_h
#define signorini_algebra_fixed_directions_h

#include <signorini/algebra/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace Signorini
{
  /// Bit c is set if component c of the displacement of a node is prescribed.
  using FixedMask = std::uint8_t;

  constexpr FixedMask all_fixed = 7;

  /// The directions in which the displacement of a node is prescribed: a subspace of dimension 0 to 3, and
  /// the projector E_p of doc/algorithm.md, chapter 4, onto what is free. Most are spanned by axes of
  /// coordinates, and these stay exact. Trivially copyable.
  class FixedDirections
  {
  public:
    /// What is left of a unit vector where it counts as dependent on others: the sine of an angle of 1.1
    /// degrees. Normals of one plane, computed twice, must not hold two directions.
    static constexpr double independence = .02;

    /// None.
    FixedDirections() = default;

    /// Axes of coordinates.
    FixedDirections(const FixedMask components) // NOLINT: every mask is such a subspace
      : mask(components)
    {
    }

    /// The same again from its numbers.
    FixedDirections(const FixedMask components, const unsigned int n_oblique_directions,
                    const Vector3 &oblique_axis)
      : axis{{oblique_axis[0], oblique_axis[1], oblique_axis[2]}}
      , mask(components)
      , n_oblique(static_cast<FixedMask>(n_oblique_directions))
    {
    }

    /// What unit vectors span; those that depend on the ones before do not count.
    static FixedDirections span(const std::vector<Vector3> &directions);

    /// Whether there are any.
    bool any() const
    {
      return mask != 0 || n_oblique != 0;
    }

    /// Whether nothing is free.
    bool all() const
    {
      return mask == all_fixed;
    }

    /// Whether axes of coordinates span them, or nothing does.
    bool is_along_axes() const
    {
      return n_oblique == 0;
    }

    /// The components that are fixed; meaningful if is_along_axes().
    FixedMask components() const
    {
      return mask;
    }

    /// 1 or 2 of them if axes of coordinates do not span them, else 0.
    unsigned int n_oblique_directions() const
    {
      return n_oblique;
    }

    /// A unit vector: the fixed direction where there is one, the free one where there are two; zero if axes
    /// of coordinates span them.
    Vector3 oblique_axis() const
    {
      Vector3 a;
      for (unsigned int c = 0; c < dim; ++c)
        a[c] = axis[c];
      return a;
    }

    /// E_p v.
    Vector3 project_free(const Vector3 &v) const
    {
      Vector3 w = v;
      if (n_oblique == 0)
        {
          for (unsigned int c = 0; c < dim; ++c)
            if (mask & (1u << c))
              w[c] = 0.;
          return w;
        }
      const Vector3 a     = oblique_axis();
      const Vector3 along = (a * v) * a;
      return n_oblique == 1 ? v - along : along;
    }

    /// E_p.
    Block free_block() const
    {
      Block block;
      for (unsigned int c = 0; c < dim; ++c)
        {
          Vector3 unit;
          unit[c]              = 1.;
          const Vector3 column = project_free(unit);
          for (unsigned int d = 0; d < dim; ++d)
            block[d][c] = column[d];
        }
      return block;
    }

    /// Whether a direction (a unit vector) is fixed.
    bool contains(const Vector3 &direction) const
    {
      return project_free(direction).norm() < independence;
    }

    /// An orthonormal basis of what is fixed; axes of coordinates where these span it.
    std::vector<Vector3> basis() const;

    /// What is fixed in both: exact for axes of coordinates, else the line or plane of one of the two that
    /// lies in the other.
    FixedDirections common(const FixedDirections &other) const;

    /// Whether the same is fixed, to the last bit.
    bool operator==(const FixedDirections &other) const
    {
      return mask == other.mask && n_oblique == other.n_oblique && axis == other.axis;
    }

    /// Whether something else is fixed.
    bool operator!=(const FixedDirections &other) const
    {
      return !(*this == other);
    }

  private:
    /// As oblique_axis().
    std::array<double, 3> axis = {{0., 0., 0.}};
    FixedMask             mask = 0, n_oblique = 0;
  };

  /// E_p v of a local node of a field, in place.
  inline void project_free(const FixedDirections &fixed, Vector &v, const unsigned int node)
  {
    Vector3 value;
    for (unsigned int c = 0; c < dim; ++c)
      value[c] = v.local_element(dim * node + c);
    value = fixed.project_free(value);
    for (unsigned int c = 0; c < dim; ++c)
      v.local_element(dim * node + c) = value[c];
  }

  /// E_p v.
  inline Vector3 project_free(const FixedDirections &fixed, const Vector3 &v)
  {
    return fixed.project_free(v);
  }
} // namespace Signorini

#endif
