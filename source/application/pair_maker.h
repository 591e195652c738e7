// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_application_pair_maker_h
#define signorini_source_application_pair_maker_h

#include <signorini/application/discretization.h>

namespace Signorini
{
  /// Turns pair models into pairs on a mesh: surfaces, what of them is mapped, mapping and moments.
  class PairMaker
  {
  public:
    /// Collective. Extracts the surfaces of all pairs. All arguments must outlive the object.
    PairMaker(const ContactModel &model, const ConstrainedSpace &constrained, Journal &journal);

    /// Collective. Moments are those of all that the pair covers. Only pairs whose nonmortar side is open can
    /// be made again.
    /// @param pair its number
    /// @param is_turned whether the automatic choice of the nonmortar side is turned round
    ContactPair make(const unsigned int pair, const bool is_turned);

    /// Whether the nonmortar side of a pair is chosen automatically.
    bool is_open(const unsigned int pair) const
    {
      const PairDefinition &definition = model.pairs()[pair].definition;
      return !definition.obstacle && definition.nonmortar == NonmortarChoice::automatic;
    }

    /// Collective. Of all ranks, in words; empty if there are none.
    std::string mapping_errors(const ContactPair &pair) const;

  private:
    void share(ContactPair &pair) const;

    const ContactModel &model;
    Journal            &journal;
    /// By pair: what of the surfaces is mapped, in the order of the definition.
    std::vector<std::vector<ContactSide>> sides;
  };
} // namespace Signorini

#endif
