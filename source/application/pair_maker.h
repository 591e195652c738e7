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
    /// @param second_is_nonmortar as prefers_second() has it unless the nonmortar side is open
    ContactPair make(const unsigned int pair, const bool second_is_nonmortar);

    /// Whether the nonmortar side of a pair is its second one: as it is given, or else the softer one, then
    /// the finer one on this mesh. Before make().
    bool prefers_second(const unsigned int pair) const;

    /// Whether the nonmortar side of a pair is chosen automatically.
    bool is_open(const unsigned int pair) const
    {
      const PairDefinition &definition = model.pairs()[pair].definition;
      return !definition.obstacle && definition.nonmortar == NonmortarChoice::automatic;
    }

    /// Collective. Of what the mapping covers, the area of the nonmortar triangles with errors of it or
    /// beside torn edges; 1 where it covers something twice, or nothing.
    double wrong_share(const ContactPair &pair) const;

    /// Collective. How deep the facets of a pair lie in each other, as the mapping has it (length).
    double depth(const ContactPair &pair) const;

    /// Collective. Of what the pair covers and is not far from, the area of the nonmortar faces that it
    /// covers only partly: the other surface ends over them.
    double cut_share(const ContactPair &pair) const;

    /// Whether both sides of a pair are about as soft and as fine as each other.
    bool sides_are_alike(const unsigned int pair) const;

  private:
    void share(ContactPair &pair) const;

    const ContactModel &model;
    const NodalSpace   &space;
    /// By body.
    const std::vector<bool> may_turn;
    Journal                &journal;
    /// By pair: what of the surfaces is mapped, in the order of the definition.
    std::vector<std::vector<ContactSide>> sides;
  };
} // namespace Signorini

#endif
