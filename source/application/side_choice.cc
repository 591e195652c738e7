// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "side_choice.h"

#include <signorini/application/journal.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/pair_conflicts.h>

#include <algorithm>
#include <set>

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

    bool is_less(const std::pair<double, double> &one, const std::pair<double, double> &other)
    {
      constexpr double clearly = .9;
      return one.first < other.first || (one.first == other.first && one.second < clearly * other.second);
    }
  } // namespace



  SideChoice::SideChoice(const ContactModel &model, const ConstrainedSpace &constrained,
                         const std::vector<bool> &turned_before, Journal &journal)
    : turned(turned_before)
    , model(model)
    , maker(model, constrained, journal)
    , journal(journal)
    , is_first(turned_before.empty())
    , others(model.pairs().size())
  {
    turned.resize(model.pairs().size(), false);
    for (unsigned int p = 0; p < turned.size(); ++p)
      {
        pairs.push_back(maker.make(p, turned[p]));
        if (!turned[p] && is_open(p))
          turn_for_mapping(p);
      }
    turned_for_mapping = turned;
    const auto time    = journal.measure(Phase::mortar);
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
    ContactPair other = maker.make(p, true);
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



  void SideChoice::turn(const std::vector<bool> &choice)
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (choice[p] != turned[p])
        {
          if (!others[p])
            others[p] = maker.make(p, choice[p]);
          std::swap(pairs[p], *others[p]);
          // Those of a pair that is not in use are of all that it covers.
          if (!covered.empty())
            {
              others[p]->moments = std::move(covered[p]);
              covered[p]         = pairs[p].moments;
            }
        }
    turned = choice;
    for (unsigned int p = 0; p < covered.size(); ++p)
      pairs[p].moments = covered[p];
    couplings = claim_and_couple(pairs, model.communicator());
  }



  std::vector<std::vector<bool>> SideChoice::neighbours(const std::vector<LossOfChoice> &now) const
  {
    const bool                     is_refused = measure(now).first > 0.;
    std::vector<bool>              all        = turned;
    std::vector<std::vector<bool>> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (is_open(p) && now[p].share > 0. && (is_refused || !turned_for_mapping[p]))
        {
          all[p] = !all[p];
          result.push_back(turned);
          result.back()[p] = !turned[p];
        }
    if (result.size() > 1)
      result.push_back(all);
    return result;
  }



  void SideChoice::improve()
  {
    const auto                  time = journal.measure(Phase::mortar);
    std::set<std::vector<bool>> seen = {turned};
    while (true)
      {
        const std::vector<LossOfChoice> now = losses();
        // Shares fall from mesh to mesh: what was tried on the first one is not tried again.
        if (!is_first && !(measure(now).first > 0.))
          return;
        const std::vector<bool>   before = turned;
        std::vector<bool>         best   = turned;
        std::pair<double, double> least  = measure(now);
        for (const std::vector<bool> &choice : neighbours(now))
          if (seen.insert(choice).second)
            {
              turn(choice);
              if (const auto measured = measure(losses()); is_less(measured, least))
                {
                  least = measured;
                  best  = choice;
                }
              turn(before);
            }
        if (best == before)
          return;
        turn(best);
        for (unsigned int p = 0; p < pairs.size(); ++p)
          if (best[p] != before[p])
            journal.note("pair " + pairs[p].name + ": its sides are swapped, because " + now[p].reason + ".");
      }
  }
} // namespace Signorini
