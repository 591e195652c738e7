// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_contact_checks_h
#define signorini_application_contact_checks_h

#include <signorini/application/discretization.h>

namespace Signorini
{
  /// The pairs of a mesh with their couplings, before they are joined. References to what it is made of.
  struct CoupledPairs
  {
    /// The problem, its space and conditions on this mesh.
    const ContactModel     &model;
    const ConstrainedSpace &constrained;
    /// By pair: surfaces and mapping, the coupling between them.
    const std::vector<ContactPair>  &pairs;
    const std::vector<PairCoupling> &couplings;
  };

  /// What the choice of its nonmortar side costs a pair.
  struct LossOfChoice
  {
    /// Of what the pair covers, the share whose nodes carry no contact stress, or only toward the body of
    /// another pair, for a reason that the other choice may not have; zero if there is none.
    double share = 0.;
    /// The share that other pairs take away where that is so much that the pair is refused, all of it where
    /// it is refused for another reason; else zero.
    double refused = 0.;
    /// Why something is lost, in words.
    std::string reason;
  };

  /// Collective.
  LossOfChoice loss_of_choice(const ContactPair &pair, const PairCoupling &coupling, const MPI_Comm comm);

  /// Collective. Errors: InputError for pairs of which conditions or other pairs take away the multipliers,
  /// and for prescribed displacements that make both sides overlap.
  void refuse_lost_contact(const CoupledPairs &coupled);

  /// Collective. Errors: InputError for nonmortar surfaces so much coarser than their partners that their
  /// rows would fill the matrix.
  void refuse_dense_coupling(const CoupledPairs &coupled);

  /// The smallest distance of two surfaces: its length along the normal, negative where they overlap, and
  /// where that is on the nonmortar side.
  struct SmallestGap
  {
    /// Along the normal (length).
    double value = std::numeric_limits<double>::max();
    /// On the nonmortar side (length).
    dealii::Point<3> place;
    /// Of the nonmortar side there (1).
    Vector3 normal;
    /// What overlaps by less may only touch: a part of the height of the true surfaces over the facets there
    /// (length).
    double doubt = 0.;
    /// Whether surfaces overlap by more than that anywhere, not only here.
    bool overlaps = false;
    /// What is less may be rounding of the coordinates (length).
    double rounding = 0.;
  };

  /// Collective. That of the true surfaces before anything moves, at the corners of the overlay (with an
  /// obstacle, at the vertices) where they face each other.
  SmallestGap smallest_initial_gap(const ContactPair &pair, const MPI_Comm comm);

  /// Collective. Errors: InputError for an initial overlap that is more than the definition of a pair allows,
  /// or of the order of a body.
  void refuse_large_overlap(const CoupledPairs &coupled, const unsigned int pair);
} // namespace Signorini

#endif
