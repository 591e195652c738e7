// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_rotation_h
#define signorini_algebra_rotation_h

#include <signorini/algebra/types.h>

namespace Signorini
{
  /// The rotation that takes one unit vector to another in their common plane. Opposite vectors have none:
  /// then it is the half turn about no axis in particular, minus the identity.
  inline Block rotation(const Vector3 &from, const Vector3 &to)
  {
    const Vector3 axis   = cross_product_3d(from, to);
    const double  cosine = from * to;
    Block         result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c][c] = cosine;
    result[0][1] -= axis[2];
    result[0][2] += axis[1];
    result[1][0] += axis[2];
    result[1][2] -= axis[0];
    result[2][0] -= axis[1];
    result[2][1] += axis[0];
    if (1. + cosine > 1e-12)
      result += outer_product(axis, axis) / (1. + cosine);
    return result;
  }
} // namespace Signorini

#endif
