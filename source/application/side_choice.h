// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_side_choice_h
#define signorini_source_application_side_choice_h

#include "pair_maker.h"

#include <signorini/application/contact_checks.h>

#include <optional>
#include <set>
#include <vector>

namespace Signorini
{
  /// All pairs on a mesh with their couplings, and which sides are the nonmortar ones where a user leaves
  /// that open: a side that could carry no contact stress, because it is that of other pairs, too, or held,
  /// is turned round if less is lost then, and so is one by which nodes of rigid faces would take part.
  class SideChoice
  {
  public:
    /// Collective. Couples the pairs with the choice of another mesh, or the default one. All must outlive
    /// the object.
    /// @param before the choice of a coarser mesh; empty on the first one
    SideChoice(const ContactModel &model, const ConstrainedSpace &constrained,
               const std::vector<PairChoice> &before, Journal &journal);

    /// Collective. Turns what is better turned: descends in what is lost. On the first mesh; on others only
    /// if the choice would be refused.
    void improve();

    /// By pair.
    std::vector<PairChoice>   choices() const;
    std::vector<ContactPair>  pairs;
    std::vector<PairCoupling> couplings;

  private:
    ContactPair make(const unsigned int p, const bool is_turned);
    void        note_chosen() const;
    /// Turns it if the mapping has many errors one way and few the other way: where a rim of one part lies
    /// over that of another one, or between smooth surfaces if it gets much of the faces wrong.
    void turn_for_mapping(const unsigned int p);
    /// Turns it if the mortar surface ends within the nonmortar one, but not the other way round, and the
    /// sides are alike otherwise: of the faces that the rim of the mortar surface cuts, nodes outside of it
    /// have a share in the weighted gaps, which then see little of where the bodies are. Not where surfaces
    /// have sharp edges: which side is better there is a matter of the mapping.
    void turn_for_rim(const unsigned int p);
    /// By pair.
    std::vector<LossOfChoice> losses() const;
    /// Changes to another choice and couples again.
    void turn(const std::vector<bool> &choice);
    /// Whether the sides of a pair may be swapped for what it loses: not those that were swapped for the
    /// mapping, unless they would be refused.
    bool may_turn(const unsigned int p, const LossOfChoice &loss) const;
    /// The choices that differ in one such pair that loses much, or in all of them.
    std::vector<std::vector<bool>> neighbours(const std::vector<LossOfChoice> &now) const;
    /// The one with the least loss, or the present choice if that is not clearly less. Leaves any of them.
    std::vector<bool> best_neighbour(const std::vector<LossOfChoice> &now);

    const ContactModel     &model;
    const ConstrainedSpace &constrained;
    PairMaker               maker;
    Journal                &journal;
    const bool              is_first;
    /// By pair, where there was one: the choice of the mesh before.
    const std::vector<PairChoice> before;
    /// By pair: whether the second side is the nonmortar one unless it is turned, and whether it is.
    std::vector<bool> prefers_second, turned;
    /// By pair: whether it was turned because of its mapping, on this mesh.
    std::vector<bool> is_for_mapping;
    /// What has been tried.
    std::set<std::vector<bool>> seen;
    /// By pair, where there are several: the moments of all that it covers.
    std::vector<std::vector<FaceMoments>> covered;
    /// By pair, where it has been made: the pair in the orientation that is not in use.
    std::vector<std::optional<ContactPair>> others;
  };
} // namespace Signorini

#endif
