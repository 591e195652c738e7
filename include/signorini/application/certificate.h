// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_certificate_h
#define signorini_application_certificate_h

#include <signorini/application/contact_evaluation.h>
#include <signorini/application/unseen_penetration.h>

namespace Signorini
{
  /// The first of the mortar edges without an image that is nearer to an active node of this rank than two of
  /// its faces, or than the farthest mortar node that it couples; their number if none is.
  /// @param active by row of the coupling
  std::size_t lost_edge_near(const ContactPair &pair, const PairCoupling &coupling,
                             const std::vector<unsigned char> &active);

  /// When a result is certified. Set so that every example and every test with a right result passes, and the
  /// wrong ones of `application/wrong_results` do not.
  struct CertificateRule
  {
    /// Of the solver: far above what converged runs leave (1e-16 to 1e-9).
    double penetration = 1e-7, tension = 1e-6, equilibrium = 1e-5, balance = 1e-5;
    /// Of the discretization, relative to the approach. A pressure is wrong by about this share at single
    /// nodes.
    double gap_doubt             = .1;
    double geometric_penetration = .5;
    /// Right results have 3e-6 at most. A ball that was moved sideways on a plane by .8 of a face, two fifths
    /// of its contact's radius: .1, and 13 % too much force. (An edge that presses on faces wider than its
    /// contact: .24, .07 and .005 on three meshes; its force depends on the mesh, from either side.)
    double loaded_gap = .08;
    /// Of a contact that was missed, relative to the largest approach of all pairs: with Hertz' law it
    /// carries 3 % of the largest force.
    double missed_penetration = .1;
    /// Forces that are smaller than this part of E·u·width are rounding, and what contact does than that of
    /// u.
    double rounding = 1e-11;
    /// The area of faces where the mapping has errors, relative to that of contact, and the force on them. A
    /// taper of 1,500 nodes with one triangle that is covered wrongly: 2e-3, and the force to all digits.
    double wrongly_mapped = .01;
    /// Of the load, on nodes of sharp edges. Bodies under pressure from all sides, where contact is uniform:
    /// with steps of one cell .64 to .93, and the mean pressure is wrong by 26 to 32 %, with two cells a step
    /// .16 and 9 %, .07 and 5 % (single nodes by a half in both), with four cells 0 and nothing.
    double share_on_edges = .1;
    /// Directions that contradict each other.
    double moment_balance = .05;
  };

  /// What is known of the iteration.
  struct SolverOutcome
  {
    /// What a user asked for is enough.
    double tolerance;
    /// On all meshes.
    bool has_converged;
  };

  /// Collective. Whether the contact conditions hold, of the solver and of the true bodies.
  /// @param unseen where bodies lie in each other and no pair looks: find_unseen_penetrations() of the
  ///   solution
  Certificate certify(const ContactModel &model, const Discretization &discretization,
                      const ContactSolution &solution, const ContactEvaluation &evaluation,
                      const std::vector<UnseenPenetration> &unseen, const SolverOutcome &solver);
} // namespace Signorini

#endif
