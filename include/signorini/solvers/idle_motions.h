// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_idle_motions_h
#define signorini_solvers_idle_motions_h

#include <signorini/solvers/contact_state.h>

namespace Signorini
{
  /// The rigid motions that neither conditions nor active half-spaces oppose. They cost nothing, loads do no
  /// work on them, and what a correction has of them is rounding over rounding: it can be many times longer
  /// than the deformation, and then its own rounding hides that.
  class IdleMotions
  {
  public:
    /// When a motion is idle.
    struct Rule
    {
      /// The mean square of its normal parts at active nodes, relative to that of the motion that is opposed
      /// most: rounding.
      double opposed = 1e-10;
    };

    /// @param free_motions orthonormal; they must outlive the object
    explicit IdleMotions(const std::vector<Vector> &free_motions)
      : motions(free_motions)
    {
    }

    /// Collective. Finds those of the active half-spaces.
    void find(const ContactState &contact);

    /// Collective. Removes them from a correction c of z, unless that runs into a half-space that is not
    /// active.
    /// @param contact half-spaces of z
    void remove(Vector &c, const Vector &z, const ContactState &contact) const;

  private:
    const std::vector<Vector> &motions;
    /// Projector onto the coefficients of idle motions, row by row; empty if there are none.
    std::vector<double> projector;
  };
} // namespace Signorini

#endif
