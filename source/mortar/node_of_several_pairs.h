// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_mortar_node_of_several_pairs_h
#define signorini_source_mortar_node_of_several_pairs_h

#include <signorini/mortar/pair_conflicts.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace Signorini
{
  /// That a pair touches a node on one of its sides.
  struct Touch
  {
    NodeIndex    node;
    unsigned int pair;
    bool         is_mortar, is_tied;
    unsigned int mortar_body;
    /// Of the nonmortar side: whether the node may be mortar in other pairs; sum of the normals of this
    /// rank's faces around the node with their covered areas.
    bool    may_chain;
    Vector3 normal;
    /// The rank that says so; set on arrival.
    unsigned int sender;
  };



  /// Which pairs have mortar bodies that part.
  class Partings
  {
  public:
    /// Both must outlive the object.
    Partings(const std::vector<PairToCouple> &pairs, const SharedRowRule &rule)
      : pairs(pairs)
      , rule(rule)
    {
    }

    bool part(const unsigned int pair, const unsigned int other) const
    {
      return shift(pair, other).norm() > 0.;
    }

    /// Whether a node with an outward normal (of any length) is more open to the body of a pair than to that
    /// of another one, from which it parts.
    bool yields(const unsigned int pair, const unsigned int other, const Vector3 &normal) const
    {
      const Vector3 by = shift(pair, other);
      return normal * by > rule.along * normal.norm() * by.norm();
    }

  private:
    Vector3 shift(const unsigned int pair, const unsigned int other) const
    {
      for (const PartingPair &one : pairs[pair].partings)
        if (one.other == other)
          return one.shift;
      for (const PartingPair &one : pairs[other].partings)
        if (one.other == pair)
          return -one.shift;
      return {};
    }

    const std::vector<PairToCouple> &pairs;
    const SharedRowRule             &rule;
  };



  /// What the pairs make of one node that they touch: which of them have it as a row, if any.
  class NodeOfSeveralPairs
  {
  public:
    /// None of them has it.
    NodeOfSeveralPairs() = default;

    /// @param are_beside whether different bodies cover nothing one over the other around the node
    NodeOfSeveralPairs(const std::vector<Touch> &touches, const SharedRowRule &rule, const Partings &partings,
                       const bool are_beside)
    {
      const bool is_mortar =
          std::any_of(touches.begin(), touches.end(), [](const Touch &touch) { return touch.is_mortar; });
      std::map<unsigned int, Touch> sums;
      for (const Touch &touch : touches)
        {
          if (touch.is_mortar)
            continue;
          if (is_mortar && !touch.may_chain)
            return;
          const auto [entry, is_new] = sums.insert({touch.pair, touch});
          if (!is_new)
            entry->second.normal += touch.normal;
        }
      // What bodies cover, and the pairs that they are mortar in.
      std::map<unsigned int, double>                 areas;
      std::map<unsigned int, std::set<unsigned int>> pairs;
      for (const auto &[pair, touch] : sums)
        {
          areas[touch.mortar_body] += touch.normal.norm();
          pairs[touch.mortar_body].insert(pair);
        }
      const auto fit = [&](const Touch &a, const Touch &b) {
        return a.is_tied == b.is_tied && (!a.is_tied || areas.size() == 1) &&
               a.normal * b.normal >= rule.least_cosine * a.normal.norm() * b.normal.norm();
      };
      for (const auto &one : sums)
        for (const auto &other : sums)
          if (!fit(one.second, other.second))
            return;
      Vector3 normal;
      for (const auto &one : sums)
        normal += one.second.normal;
      const auto yields_here = [&](const unsigned int body) {
        for (const unsigned int pair : pairs[body])
          for (const auto &other : sums)
            if (partings.yields(pair, other.first, normal))
              return true;
        return false;
      };
      // Of bodies that cover as much that of the first pair.
      unsigned int best = sums.begin()->second.mortar_body;
      for (const auto &[pair, touch] : sums)
        if (const bool is_better = !yields_here(touch.mortar_body), was_better = !yields_here(best);
            is_better != was_better ? is_better : areas[touch.mortar_body] > rule.greater * areas[best])
          best = touch.mortar_body;
      owners = pairs[best];
      if (are_beside)
        for (const auto &one : sums)
          if (std::none_of(owners.begin(), owners.end(), [&](const unsigned int owner) {
                const Vector3 &a = one.second.normal, &b = sums.at(owner).normal;
                return partings.part(one.first, owner) ||
                       (one.second.mortar_body != best && a * b < rule.flat_cosine * a.norm() * b.norm());
              }))
            owners.insert(one.first);
    }

    bool is_excluded() const
    {
      return owners.empty();
    }

    bool is_ceded_by(const unsigned int pair) const
    {
      return !owners.empty() && owners.count(pair) == 0;
    }

    bool is_ceded_by_any(const std::vector<Touch> &touches) const
    {
      return std::any_of(touches.begin(), touches.end(),
                         [&](const Touch &touch) { return !touch.is_mortar && is_ceded_by(touch.pair); });
    }

    /// What has become of it does not work: something else. Pairs that share the row keep it, then it is
    /// excluded.
    void change(const bool is_row)
    {
      if (!is_row || is_kept || owners.size() == 1)
        owners.clear();
      else
        is_kept = true;
    }

    std::set<unsigned int> owners;
    bool                   is_kept = false;
  };
} // namespace Signorini

#endif
