// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_conjugate_direction_h
#define signorini_solvers_conjugate_direction_h

#include <signorini/algebra/types.h>

namespace Signorini
{
  /// The direction of conjugate gradients, p = z - (z·Ap_old / p_old·Ap_old) p_old, from one preconditioned
  /// residual z after the other. Only the last direction is kept, and its product with A.
  class ConjugateDirection
  {
  public:
    /// Forgets the last direction.
    void restart()
    {
      is_set = false;
    }

    /// Collective. az = A z.
    void update(const Vector &z, const Vector &az)
    {
      if (is_set)
        {
          const double beta = -(z * ap) / (p * ap);
          p.sadd(beta, 1., z);
          ap.sadd(beta, 1., az);
        }
      else
        {
          p  = z;
          ap = az;
        }
      is_set = true;
    }

    const Vector &direction() const
    {
      return p;
    }

    /// A direction().
    const Vector &product() const
    {
      return ap;
    }

  private:
    Vector p, ap;
    bool   is_set = false;
  };
} // namespace Signorini

#endif
