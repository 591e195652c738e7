// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_field_h
#define signorini_mesh_field_h

#include <signorini/algebra/types.h>

#include <deal.II/base/point.h>

#include <functional>

namespace Signorini
{
  /// A function of the place, as conditions, loads and gaps are given. What an empty one means is said where
  /// it is used.
  using ScalarField = std::function<double(const dealii::Point<3> &)>;
  using VectorField = std::function<Vector3(const dealii::Point<3> &)>;
} // namespace Signorini

#endif
