// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_pretension_h
#define signorini_application_pretension_h

#include <signorini/application/contact_solve.h>

namespace Signorini
{
  /// When bolts carry what they should, and how their strains are found.
  struct PretensionRule
  {
    /// Of the section force, relative. Where contact does not change from one solution to the next the secant
    /// is exact, and leaves what the solver does.
    double tolerance = 1e-8;
    /// Solutions for one load.
    unsigned int solutions = 40;
    /// The section force grows at least by this part of what it does in a shank between rigid plates.
    double smallest_slope = 1e-4;
  };

  /// Collective. Strains of the bolts of a model for the loads of the present time, as far as what is known
  /// of earlier solutions tells; at first, as if the plates were rigid. Errors: InputError where there is no
  /// cell in a shank, and for negative forces.
  void foretell_pretension(ContactModel &model, const Discretization &discretization);

  /// Collective. Solves, and changes the strains of the bolts of the model until their sections carry their
  /// forces, by Broyden's method (with one bolt that of the secant). Without bolts: ContactSolver::solve().
  /// @param solver of the model, set up or changed after foretell_pretension()
  ContactSolution solve_with_pretension(ContactModel &model, ContactSolver &solver,
                                        const Discretization &discretization, Journal &journal);

  /// Collective. The same where some bolts are locked before the present time: first their strains are found,
  /// one time after the other, with the conditions and loads of those. What a bolt is locked with depends on
  /// no load step, as nothing depends on its history.
  /// @param start a displacement to begin with; null for none
  /// @return the solution of an earlier time where that has failed
  ContactSolution solve_with_locked_pretension(ContactModel &model, ContactSolver &solver,
                                               const Discretization &discretization, const Vector *start,
                                               Journal &journal);
} // namespace Signorini

#endif
