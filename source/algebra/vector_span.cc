// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/vector_span.h>

namespace Signorini
{
  void orthonormalize(std::vector<Vector> &vectors)
  {
    for (std::size_t i = 0; i < vectors.size(); ++i)
      {
        for (unsigned int twice = 0; twice < 2; ++twice)
          for (std::size_t j = 0; j < i; ++j)
            vectors[i].add(-(vectors[j] * vectors[i]), vectors[j]);
        vectors[i] /= vectors[i].l2_norm();
      }
  }



  void subtract_projection(Vector &x, const std::vector<Vector> &basis)
  {
    for (const Vector &direction : basis)
      x.add(-(direction * x), direction);
  }
} // namespace Signorini
