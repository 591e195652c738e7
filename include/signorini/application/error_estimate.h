// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_error_estimate_h
#define signorini_application_error_estimate_h

#include <signorini/application/contact_solve.h>

#include <vector>

namespace Signorini
{
  /// Collective. Squared error indicators (energy) of the cells of the space, which must have inner faces:
  /// residuals, and what contact or ties leave at the surfaces.
  std::vector<double> estimate_error(const ContactModel &model, const Discretization &discretization,
                                     const ContactSolution &solution);

  /// Collective. The square root of the sum over the owned cells of all ranks.
  double total_indicator(const NodalSpace &space, const std::vector<double> &indicator);

  /// Collective. The estimated error of the stresses of all bodies together, as a part of them
  /// (NodalStress::errors()).
  double estimate_stress_error(const ContactModel &model, const Discretization &discretization,
                               const ContactSolution &solution);

  /// About how many unknowns a space would have after refinement of the marked cells. Collective.
  double expected_dofs(const NodalSpace &space, const std::vector<bool> &marked);
} // namespace Signorini

#endif
