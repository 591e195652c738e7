// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_conjugate_gradients_h
#define signorini_solvers_conjugate_gradients_h

#include <signorini/solvers/contact_state.h>

namespace Signorini
{
  /// The step of conjugate gradients, along p = z - (z·Ap_old / p_old·Ap_old) p_old, from one preconditioned
  /// residual z after the other (doc/algorithm.md, (48)). Only the last direction is kept, and its product
  /// with A.
  class ConjugateGradients
  {
  public:
    /// Forgets the last direction.
    void restart()
    {
      is_set = false;
    }

    /// Collective. The new direction from z and az = A z; returns the length along it that minimizes the
    /// energy, or 0 if there is none. The slope is taken without the normal parts at active nodes: it must
    /// not see the contact forces.
    double find_step(const Vector &z, const Vector &az, const Vector &residual, const ContactState &contact)
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
      is_set                 = true;
      const double curvature = p * ap;
      const double slope     = residual * p - contact.normal_product(residual, p);
      return curvature > 0. && slope > 0. ? slope / curvature : 0.;
    }

    /// The direction p.
    const Vector &direction() const
    {
      return p;
    }

    /// A p.
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
