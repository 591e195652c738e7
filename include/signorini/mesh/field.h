// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_field_h
#define signorini_mesh_field_h

#include <signorini/algebra/types.h>

#include <deal.II/base/point.h>

#include <functional>
#include <type_traits>
#include <utility>

namespace Signorini
{
  /// A function of the place and of the pseudo-time t of load steps (a pure number), as conditions, loads and
  /// gaps are given. What an empty one means is said where it is used.
  template <typename T>
  class Field
  {
  public:
    /// The time at which everything is applied that does not say otherwise.
    static constexpr double end = 1.;

    /// An empty one.
    Field() = default;

    /// From a function of a point, or of a point and a time.
    template <typename F, typename = std::enable_if_t<!std::is_same<std::decay_t<F>, Field>::value>>
    Field(F f) // NOLINT: functions are fields
    {
      if constexpr (std::is_invocable<const F &, const dealii::Point<3> &, const double>::value)
        function = std::move(f);
      else
        function = [g = std::move(f)](const dealii::Point<3> &p, const double) { return T(g(p)); };
    }

    /// Whether it is not empty.
    explicit operator bool() const
    {
      return static_cast<bool>(function);
    }

    /// The value at a point and a time.
    T operator()(const dealii::Point<3> &p, const double time = end) const
    {
      return function(p, time);
    }

  private:
    std::function<T(const dealii::Point<3> &, const double)> function;
  };

  using ScalarField = Field<double>;
  using VectorField = Field<Vector3>;
  /// Strains: symmetric, the diagonal is that of elongations, the rest half of the engineering shear.
  using StrainField = Field<Block>;
} // namespace Signorini

#endif
