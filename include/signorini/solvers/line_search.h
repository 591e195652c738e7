// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_line_search_h
#define signorini_solvers_line_search_h

#include <signorini/solvers/contact_state.h>

namespace Signorini
{
  /// A step along a correction c (doc/algorithm.md, (50)).
  struct LineSearch
  {
    /// In units of c.
    double length = 0.;
    /// By which the energy falls.
    double decrease = 0.;
  };

  /// Collective. The t that minimizes the energy of v + t c, as far as it is admissible. c is admissible
  /// for v; c and residual = b - A v are tangential at active nodes: the slope must not see the contact
  /// forces, which are larger than the residual by orders of magnitude.
  /// @param longest ContactState::longest_step() from v
  LineSearch search_along(const NodeBlockMatrix &matrix, const Vector &c, const Vector &residual,
                          const double longest, const bool semidefinite);
} // namespace Signorini

#endif
