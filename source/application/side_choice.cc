// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "side_choice.h"

#include <signorini/application/journal.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/pair_conflicts.h>
#include <signorini/output/final_words.h>

#include <algorithm>
#include <cmath>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Couples pairs whose moments are still those of all that they cover.
    /// @param before the choices of the mesh before; empty on the first one
    std::vector<PairCoupling> claim_and_couple(std::vector<ContactPair>      &pairs,
                                               const std::vector<PairChoice> &before, const MPI_Comm comm)
    {
      std::vector<ClaimedFaces> claims;
      for (ContactPair &pair : pairs)
        claims.push_back({pair.nonmortar.surface, pair.moments, pair.is_tied});
      if (pairs.size() > 1)
        leave_faces_to_nearest(claims, comm);
      std::vector<PairToCouple> several;
      // Each obstacle is a body of its own.
      unsigned int obstacle = numbers::invalid_unsigned_int;
      for (unsigned int p = 0; p < pairs.size(); ++p)
        {
          const ContactPair &pair = pairs[p];
          several.push_back({{pair.nonmortar.surface, pair.mortar.surface, *pair.halo},
                             pair.moments,
                             static_cast<bool>(pair.prescribed_gap),
                             pair.is_tied,
                             pair.nonmortar.body,
                             pair.obstacle ? obstacle-- : pair.mortar.body,
                             before.empty() ? std::vector<PartingPair>() : before[p].partings});
        }
      return couple_pairs(several, comm);
    }

    bool has_sharp_edges(const ContactPair &pair)
    {
      return FacingParts(pair.nonmortar.surface).n_pieces() > 1 ||
             FacingParts(pair.mortar.surface).n_pieces() > 1;
    }

    /// Collective. Whether rows have columns of nodes of rigid faces, which are refused: mortar nodes, or
    /// nodes of the nonmortar side that are held there.
    bool has_rigid_columns(const PairCoupling &coupling, const RigidFaces *const rigid, const MPI_Comm comm)
    {
      const auto &entries = coupling.coupling.entries;
      const bool  mine    = rigid != nullptr &&
                        std::any_of(entries.begin(), entries.end(),
                                    [&](const auto &entry) { return rigid->find(entry.node) != nullptr; });
      return Utilities::MPI::max(static_cast<int>(mine), comm) > 0;
    }

    /// Pure numbers.
    struct SideRule
    {
      /// Of what a pair covers: less than this is no reason to swap sides, which then are so on all finer
      /// meshes. Two torn edges at the rim of a hole are less: a bolted joint whose sides were swapped for
      /// them presses on the rim, verdict NO.
      double least_share = .02;
      /// Of the loss of the pairs that are swapped, what that has to save.
      double least_gain = .1;
      /// From this ratio of Young's moduli on, the stiffer side is nonmortar only where the pair would be
      /// refused.
      double much_stiffer = 10.;
      /// Of what a pair covers, faces that the rim of the other surface cuts: less than this is no reason to
      /// swap sides.
      double least_cut = .25;
      /// Of that, what faces of the other side are cut has to be less than.
      double much_less_cut = .1;
      /// Of what a pair covers, where surfaces are smooth, what of the faces the mapping has to get wrong for
      /// the sides to be swapped: bodies may touch elsewhere. A cord in a groove, 12 shapes: up to .43 all
      /// five forces were right as they were, and off by a tenth on grooves of coarse faces the other way
      /// round; from .46 on they were 1.3 to 6 times the right ones, and .93 to 1.24 times with swapped
      /// sides.
      double least_wrong = .5;
      /// Of what the mapping gets wrong of the pair's faces, or of how deep the surfaces lie in each other by
      /// it, what these have to be less than with swapped sides. (Few wrong cells matter where they seem to
      /// penetrate: contact is there then. A thread with 23 such cells of 19,000, 16 clearances deep, turned
      /// by 6 degrees.)
      double much_less_wrong = .1;
    };

    /// Of all pairs.
    struct TotalLoss
    {
      double refused = 0., share = 0.;

      explicit TotalLoss(const std::vector<LossOfChoice> &losses)
      {
        for (const LossOfChoice &loss : losses)
          {
            refused += loss.refused;
            share += loss.share;
          }
      }

      /// @param margin by which the share has to be less
      bool is_less_than(const TotalLoss &other, const double margin) const
      {
        constexpr double rounding = 1e-9;
        if (std::abs(refused - other.refused) > rounding * other.refused)
          return refused < other.refused;
        return share < other.share - margin;
      }
    };
  } // namespace



  SideChoice::SideChoice(const ContactModel &model, const ConstrainedSpace &constrained,
                         const std::vector<PairChoice> &before, Journal &journal)
    : model(model)
    , constrained(constrained)
    , maker(model, constrained, journal)
    , journal(journal)
    , is_first(before.empty())
    , before(before)
    , is_for_mapping(model.pairs().size(), false)
    , others(model.pairs().size())
  {
    Assert(is_first || before.size() == model.pairs().size(),
           ExcDimensionMismatch(before.size(), model.pairs().size()));
    for (unsigned int p = 0; p < model.pairs().size(); ++p)
      {
        turned.push_back(!is_first && before[p].is_turned);
        prefers_second.push_back(is_first ? maker.prefers_second(p)
                                          : before[p].is_second != before[p].is_turned);
        pairs.push_back(make(p, turned[p]));
        if (!turned[p] && maker.is_open(p))
          turn_for_mapping(p);
      }
    if (is_first)
      note_chosen();
    const auto time = journal.measure(Phase::mortar);
    if (pairs.size() > 1)
      for (const ContactPair &pair : pairs)
        covered.push_back(pair.moments);
    couplings = claim_and_couple(pairs, before, model.communicator());
  }



  ContactPair SideChoice::make(const unsigned int p, const bool is_turned)
  {
    return maker.make(p, prefers_second[p] != is_turned);
  }



  std::vector<PairChoice> SideChoice::choices() const
  {
    std::vector<PairChoice> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      result.push_back({prefers_second[p] != turned[p], turned[p],
                        is_first ? std::vector<PartingPair>() : before[p].partings});
    return result;
  }



  void SideChoice::note_chosen() const
  {
    std::vector<std::string> chosen;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (!turned[p] && maker.is_open(p))
        chosen.push_back("\"" + model.bodies().body_name(pairs[p].nonmortar.body) + "\" of pair " +
                         pairs[p].name);
    if (!chosen.empty())
      journal.note("nonmortar side (the softer body, then the finer mesh): " +
                   Patterns::Tools::to_string(chosen) + ".");
  }



  void SideChoice::turn_for_mapping(const unsigned int p)
  {
    const double wrong        = maker.wrong_share(pairs[p]),
                 least        = has_sharp_edges(pairs[p]) ? SideRule().least_share : SideRule().least_wrong;
    constexpr double rounding = 1e-6;
    const bool       are_many = wrong > (1. + rounding) * least;
    const bool       may_be_few =
        !pairs[p].is_tied && wrong > 0. &&
        pairs[p].mortar.material.young <= SideRule().much_stiffer * pairs[p].nonmortar.material.young;
    const double depth = !are_many && may_be_few ? maker.depth(pairs[p]) : 0.;
    if (!are_many && !(depth > 0.))
      return;
    ContactPair other = make(p, true);
    if (maker.wrong_share(other) > SideRule().much_less_wrong * wrong ||
        (!are_many && maker.depth(other) > SideRule().much_less_wrong * depth))
      return;
    pairs[p]          = std::move(other);
    turned[p]         = true;
    is_for_mapping[p] = true;
    journal.note("pair " + pairs[p].name +
                 ": its sides are swapped, because the mapping has errors the other way round" +
                 (are_many ? "" : ", by which the surfaces lie in each other") + "; nonmortar is \"" +
                 model.bodies().body_name(pairs[p].nonmortar.body) + "\".");
  }



  std::vector<LossOfChoice> SideChoice::losses() const
  {
    std::vector<LossOfChoice> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        result.push_back(loss_of_choice(pairs[p], couplings[p], model.communicator()));
        if (has_rigid_columns(couplings[p], constrained.dirichlet.rigid.get(), model.communicator()))
          result.back() = {1., 1.,
                           "nodes that it has in common with a rigid face would take part in contact"};
      }
    return result;
  }



  void SideChoice::turn(const std::vector<bool> &choice)
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (choice[p] != turned[p])
        {
          if (!others[p])
            others[p] = make(p, choice[p]);
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
    couplings = claim_and_couple(pairs, before, model.communicator());
  }



  bool SideChoice::may_turn(const unsigned int p, const LossOfChoice &loss) const
  {
    const bool is_much_stiffer =
        pairs[p].mortar.material.young > SideRule().much_stiffer * pairs[p].nonmortar.material.young;
    return maker.is_open(p) &&
           (loss.refused > 0. || (is_first && loss.share > 0. && !is_for_mapping[p] && !is_much_stiffer));
  }



  std::vector<std::vector<bool>> SideChoice::neighbours(const std::vector<LossOfChoice> &now) const
  {
    std::vector<bool>              all = turned;
    std::vector<std::vector<bool>> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (may_turn(p, now[p]))
        {
          all[p] = !all[p];
          if (now[p].share > SideRule().least_share)
            {
              result.push_back(turned);
              result.back()[p] = !turned[p];
            }
        }
    // A body that two others share may lose much in one pair and little in the other one.
    if (!result.empty())
      result.push_back(all);
    return result;
  }



  std::vector<bool> SideChoice::best_neighbour(const std::vector<LossOfChoice> &now)
  {
    const std::vector<bool> before = turned;
    std::vector<bool>       best   = turned;
    TotalLoss               least(now);
    for (const std::vector<bool> &choice : neighbours(now))
      if (seen.insert(choice).second)
        {
          double of_turned = 0.;
          for (unsigned int p = 0; p < pairs.size(); ++p)
            if (choice[p] != before[p])
              of_turned += now[p].share;
          turn(choice);
          const TotalLoss loss(losses());
          if (loss.is_less_than(TotalLoss(now), SideRule().least_gain * of_turned) &&
              loss.is_less_than(least, 0.))
            {
              least = loss;
              best  = choice;
            }
        }
    return best;
  }



  void SideChoice::turn_for_rim(const unsigned int p)
  {
    const double     cut      = maker.cut_share(pairs[p]);
    constexpr double rounding = 1e-6;
    if (cut < (1. + rounding) * SideRule().least_cut || !maker.sides_are_alike(p) ||
        has_sharp_edges(pairs[p]))
      return;
    const TotalLoss         before(losses());
    const std::vector<bool> now   = turned;
    std::vector<bool>       other = turned;
    other[p]                      = true;
    turn(other);
    if (!(maker.cut_share(pairs[p]) < SideRule().much_less_cut * cut) ||
        maker.wrong_share(pairs[p]) > SideRule().least_share || before.is_less_than(TotalLoss(losses()), 0.))
      {
        turn(now);
        return;
      }
    const std::string share = percent_text(cut, 3);
    journal.note("pair " + pairs[p].name + ": its sides are swapped, because \"" + pairs[p].nonmortar.name +
                 "\" ends over \"" + pairs[p].mortar.name + "\" and cuts " + share +
                 " of its faces; nonmortar is \"" + model.bodies().body_name(pairs[p].nonmortar.body) +
                 "\".");
  }



  void SideChoice::improve()
  {
    const auto time = journal.measure(Phase::mortar);
    seen            = {turned};
    while (true)
      {
        const std::vector<LossOfChoice> now = losses();
        // Shares fall from mesh to mesh: what was tried on the first one is not tried again.
        if (!is_first && !(TotalLoss(now).refused > 0.))
          break;
        const std::vector<bool> before = turned, best = best_neighbour(now);
        if (best != turned)
          turn(best);
        if (best == before)
          break;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          if (best[p] != before[p])
            journal.note("pair " + pairs[p].name + ": its sides are swapped, because " + now[p].reason +
                         "; nonmortar is \"" + model.bodies().body_name(pairs[p].nonmortar.body) + "\".");
      }
    for (unsigned int p = 0; p < pairs.size() && is_first; ++p)
      if (maker.is_open(p) && !turned[p])
        turn_for_rim(p);
    others.clear();
    for (const ContactPair &pair : pairs)
      if (!pair.obstacle &&
          pair.nonmortar.material.young > SideRule().much_stiffer * pair.mortar.material.young)
        journal.note(
            "warning: pair " + pair.name +
            ": the nonmortar side is the stiffer body; the contact nodes need a direct solver this way.");
  }
} // namespace Signorini
