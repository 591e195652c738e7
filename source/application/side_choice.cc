// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "side_choice.h"

#include <signorini/application/journal.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/pair_conflicts.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Couples pairs whose moments are still those of all that they cover.
    std::vector<PairCoupling> claim_and_couple(std::vector<ContactPair> &pairs, const MPI_Comm comm)
    {
      std::vector<ClaimedFaces> claims;
      for (ContactPair &pair : pairs)
        claims.push_back({pair.nonmortar.surface, pair.moments, pair.is_tied});
      if (pairs.size() > 1)
        leave_faces_to_nearest(claims, comm);
      std::vector<PairToCouple> several;
      // Each obstacle is a body of its own.
      unsigned int obstacle = numbers::invalid_unsigned_int;
      for (const ContactPair &pair : pairs)
        several.push_back({{pair.nonmortar.surface, pair.mortar.surface, *pair.halo},
                           pair.moments,
                           static_cast<bool>(pair.prescribed_gap),
                           pair.is_tied,
                           pair.obstacle ? obstacle-- : pair.mortar.body});
      return couple_pairs(several, comm);
    }

    bool has_sharp_edges(const ContactPair &pair)
    {
      return FacingParts(pair.nonmortar.surface).n_parts() > 1 ||
             FacingParts(pair.mortar.surface).n_parts() > 1;
    }

    /// What would be refused, at worst, then what is lost at all.
    std::pair<double, double> measure(const std::vector<LossOfChoice> &losses)
    {
      std::pair<double, double> result = {0., 0.};
      for (const LossOfChoice &loss : losses)
        {
          result.first = std::max(result.first, loss.refused);
          result.second += loss.share;
        }
      return result;
    }
  } // namespace



  SideChoice::SideChoice(const ContactModel &model, const ConstrainedSpace &constrained,
                         const std::vector<bool> &turned_before, Journal &journal)
    : turned(turned_before)
    , model(model)
    , maker(model, constrained, journal)
    , journal(journal)
  {
    turned.resize(model.pairs().size(), false);
    for (unsigned int p = 0; p < turned.size(); ++p)
      {
        pairs.push_back(maker.make(model.pairs()[p], turned[p]));
        if (!turned[p] && is_open(p))
          turn_for_mapping(p);
      }
    tried           = turned;
    const auto time = journal.measure(Phase::mortar);
    if (pairs.size() > 1)
      for (const ContactPair &pair : pairs)
        covered.push_back(pair.moments);
    couplings = claim_and_couple(pairs, model.communicator());
  }



  bool SideChoice::is_open(const unsigned int p) const
  {
    return !pairs[p].obstacle && model.pairs()[p].definition.nonmortar == NonmortarChoice::automatic;
  }



  void SideChoice::turn_for_mapping(const unsigned int p)
  {
    if (maker.mapping_errors(pairs[p]).empty() || !has_sharp_edges(pairs[p]))
      return;
    ContactPair other = maker.make(model.pairs()[p], true);
    if (!maker.mapping_errors(other).empty())
      return;
    pairs[p]  = std::move(other);
    turned[p] = true;
    journal.note("pair " + pairs[p].name +
                 ": its sides are swapped, because the mapping has errors the other way round.");
  }



  std::vector<LossOfChoice> SideChoice::losses() const
  {
    std::vector<LossOfChoice> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      result.push_back(loss_of_choice(pairs[p], couplings[p], model.communicator()));
    return result;
  }



  void SideChoice::couple_again()
  {
    for (unsigned int p = 0; p < covered.size(); ++p)
      pairs[p].moments = covered[p];
    couplings = claim_and_couple(pairs, model.communicator());
  }



  bool SideChoice::try_turned(const std::vector<unsigned int> &some, const std::vector<LossOfChoice> &before)
  {
    std::vector<ContactPair> old;
    for (const unsigned int p : some)
      {
        old.push_back(std::move(pairs[p]));
        pairs[p] = maker.make(model.pairs()[p], true);
        if (!covered.empty())
          {
            old.back().moments = std::move(covered[p]);
            covered[p]         = pairs[p].moments;
          }
      }
    couple_again();
    const bool is_better = measure(losses()) < measure(before);
    for (std::size_t k = 0; k < some.size(); ++k)
      if (const unsigned int p = some[k]; is_better)
        {
          turned[p] = true;
          journal.note("pair " + pairs[p].name + ": its sides are swapped, because " + before[p].reason +
                       ".");
        }
      else
        {
          pairs[p] = std::move(old[k]);
          if (!covered.empty())
            covered[p] = pairs[p].moments;
        }
    if (!is_better)
      couple_again();
    return is_better;
  }



  void SideChoice::improve()
  {
    const auto time = journal.measure(Phase::mortar);
    while (true)
      {
        const std::vector<LossOfChoice> now = losses();
        std::vector<unsigned int>       some;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          if (is_open(p) && !tried[p] && now[p].share > 0.)
            some.push_back(p);
        if (some.empty())
          return;
        if (some.size() == 1 || !try_turned(some, now))
          {
            // The worst one alone.
            const unsigned int worst =
                *std::max_element(some.begin(), some.end(), [&](const unsigned int p, const unsigned int q) {
                  return now[p].share < now[q].share;
                });
            some = {worst};
            try_turned(some, now);
          }
        for (const unsigned int p : some)
          tried[p] = true;
      }
  }
} // namespace Signorini
