// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_certificate_h
#define signorini_application_certificate_h

#include <signorini/application/contact_evaluation.h>

namespace Signorini
{
  /// Whether a mortar edge without an image is nearer to an active node of this rank than two of its faces,
  /// or than the farthest mortar node that it couples.
  /// @param active by row of the coupling
  bool has_lost_edges_near(const ContactPair &pair, const PairCoupling &coupling,
                           const std::vector<unsigned char> &active);

  /// Collective. Whether the contact conditions hold, of the solver and of the true bodies.
  /// @param tolerance of the solver: what a user asked for is enough
  /// @param has_converged on all meshes
  Certificate certify(const ContactModel &model, const Discretization &discretization,
                      const ContactSolution &solution, const ContactEvaluation &evaluation,
                      const double tolerance, const bool has_converged);
} // namespace Signorini

#endif
