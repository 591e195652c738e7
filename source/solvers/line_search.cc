// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/line_search.h>

namespace Signorini
{
  LineSearch search_along(const NodeBlockMatrix &matrix, const Vector &c, const Vector &residual,
                          const double longest_admissible, const bool semidefinite)
  {
    Vector product;
    product.reinit(residual);
    matrix.vmult(product, c);
    const double slope = residual * c, curvature = product * c;
    double       longest = std::max(1., longest_admissible);
    // Where c is close to a motion that costs nothing, its curvature is rounding.
    if (semidefinite)
      longest = std::min(longest, 2.);
    LineSearch result;
    if (curvature > 0. && slope > 0.)
      result.length = std::min(slope / curvature, longest);
    else if (semidefinite && slope > 0.)
      result.length = 1.;
    result.decrease = result.length * (slope - .5 * result.length * curvature);
    return result;
  }
} // namespace Signorini
