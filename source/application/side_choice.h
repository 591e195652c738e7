// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_side_choice_h
#define signorini_source_application_side_choice_h

#include "pair_maker.h"

#include <signorini/application/contact_checks.h>

#include <vector>

namespace Signorini
{
  /// All pairs on a mesh with their couplings, and which sides are the nonmortar ones where a user leaves
  /// that open: a side that could carry no contact stress, because it is that of other pairs, too, or held,
  /// is turned round if less is lost then.
  class SideChoice
  {
  public:
    /// Collective. Couples the pairs with the choice of another mesh, or the default one. All must outlive
    /// the object.
    SideChoice(const ContactModel &model, const ConstrainedSpace &constrained,
               const std::vector<bool> &turned_before, Journal &journal);

    /// Collective. Turns what is better turned.
    void improve();

    /// By pair, and whether the automatic choice is turned round.
    std::vector<ContactPair>  pairs;
    std::vector<PairCoupling> couplings;
    std::vector<bool>         turned;

  private:
    bool is_open(const unsigned int p) const;
    /// Turns it if the mapping has errors one way and none the other way, as it may have where a rim of one
    /// part lies over that of another one. Elsewhere errors are where surfaces turn away from each other, and
    /// the choice matters for other pairs.
    void turn_for_mapping(const unsigned int p);
    /// By pair.
    std::vector<LossOfChoice> losses() const;
    void                      couple_again();
    /// Turns some pairs, which are never tried again; back if not less is lost than before.
    bool try_turned(const std::vector<unsigned int> &some, const std::vector<LossOfChoice> &before);

    const ContactModel &model;
    const PairMaker     maker;
    Journal            &journal;
    /// By pair, where there are several: the moments of all that it covers.
    std::vector<std::vector<FaceMoments>> covered;
    /// By pair: whether it was turned, with success or without.
    std::vector<bool> tried;
  };
} // namespace Signorini

#endif
