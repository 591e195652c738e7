// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_algebra_vector_span_h
#define signorini_algebra_vector_span_h

#include <signorini/algebra/types.h>

#include <vector>

namespace Signorini
{
  /// Collective. Gives some linearly independent vectors an orthonormal basis of their span (Gram-Schmidt,
  /// twice).
  void orthonormalize(std::vector<Vector> &vectors);

  /// Collective. Makes x orthogonal to some orthonormal vectors.
  void subtract_projection(Vector &x, const std::vector<Vector> &basis);
} // namespace Signorini

#endif
