// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/node_request.h>
#include <signorini/algebra/sent_lists.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/parting_bodies.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// How far a node is from the mortar body of one pair after deformation (length).
    struct Opening
    {
      NodeIndex    node;
      unsigned int pair;
      double       value;
    };

    /// Two pairs.
    struct Couple
    {
      unsigned int first, second;

      bool operator<(const Couple &other) const
      {
        return std::tie(first, second) < std::tie(other.first, other.second);
      }
    };

    bool have_one_mortar_body(const ContactPair &a, const ContactPair &b)
    {
      return !a.obstacle && !b.obstacle && a.mortar.body == b.mortar.body;
    }

    /// Whether any other pair may share rows with this one.
    bool may_share(const Discretization &d, const unsigned int p)
    {
      for (unsigned int q = 0; q < d.pairs.size(); ++q)
        if (q != p && !d.pairs[p].is_tied && !d.pairs[q].is_tied &&
            d.pairs[q].nonmortar.body == d.pairs[p].nonmortar.body &&
            !have_one_mortar_body(d.pairs[p], d.pairs[q]))
          return true;
      return false;
    }

    /// Collective. Those of the rows of one pair, each by its own gap and columns.
    std::vector<Opening> openings_of(const Discretization &d, const Vector &displacement,
                                     const unsigned int p)
    {
      const PairCoupling      &pair     = d.couplings[p];
      const InterfaceCoupling &coupling = pair.coupling;
      std::vector<NodeIndex>   nodes(coupling.rows);
      for (const InterfaceCoupling::Entry &entry : coupling.entries)
        nodes.push_back(entry.node);
      const NodeRequest request(d.partition(), sorted_nodes(std::move(nodes)));
      const auto        values =
          request.fetch([&](const unsigned int local) { return nodal_value(displacement, local); });
      const auto value = [&](const NodeIndex node) {
        return values[static_cast<std::size_t>(
            std::lower_bound(request.nodes().begin(), request.nodes().end(), node) -
            request.nodes().begin())];
      };
      std::vector<Opening> result;
      for (std::size_t i = 0; i < coupling.n_rows(); ++i)
        {
          Vector3 jump = value(coupling.rows[i]);
          for (const auto *entry = coupling.begin(i); entry != coupling.end(i); ++entry)
            jump -= entry->weight * value(entry->node);
          result.push_back({coupling.rows[i], p, pair.gaps[i] - pair.normals[i] * jump});
        }
      return result;
    }

    /// The couples of one node that differ by more than they may.
    void add_apart(std::set<Couple> &apart, const std::vector<Opening> &openings, const Discretization &d,
                   const std::vector<double> &approaches, const PartingRule &rule)
    {
      double least = 0., approach = 0.;
      for (const Opening &one : openings)
        {
          least    = std::min(least, one.value);
          approach = std::max(approach, approaches[one.pair]);
        }
      const double largest = *std::max_element(approaches.begin(), approaches.end());
      if (approach <= rule.idle * largest || -least <= rule.depth * approach)
        return;
      for (const Opening &a : openings)
        for (const Opening &b : openings)
          if (b.value - a.value > rule.depth * approach &&
              !have_one_mortar_body(d.pairs[a.pair], d.pairs[b.pair]))
            apart.insert({std::min(a.pair, b.pair), std::max(a.pair, b.pair)});
    }
  } // namespace



  bool part_bodies(std::vector<PairChoice> &choices, const Discretization &d, const ContactSolution &solution,
                   Journal &journal, const PartingRule &rule)
  {
    if (!solution.report.converged || !solution.drift.motions.empty())
      return false;
    const MPI_Comm       comm = d.nodal().communicator();
    ListsByRank<Opening> sent;
    std::vector<double>  approaches(d.pairs.size(), 0.);
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      if (may_share(d, p))
        {
          approaches[p] = approach_without_images(d, solution, p);
          for (const Opening &opening : openings_of(d, solution.displacement, p))
            sent[d.partition().owner(opening.node)].push_back(opening);
        }
    std::map<NodeIndex, std::vector<Opening>> met;
    for (const auto &[sender, list] : send_lists(sent, comm))
      for (const Opening &opening : list)
        met[opening.node].push_back(opening);
    std::set<Couple> mine;
    for (const auto &[node, openings] : met)
      add_apart(mine, openings, d, approaches, rule);
    std::set<Couple> apart;
    for (const Couple &couple :
         gather_lists(std::vector<Couple>(mine.begin(), mine.end()), comm, Receivers::all))
      apart.insert(couple);
    for (const auto &[p, q] : apart)
      {
        choices[p].apart_from.push_back(q);
        journal.note("pairs " + d.pairs[p].name + " and " + d.pairs[q].name +
                     ": what they touch does not stay beside each other under \"" +
                     d.pairs[p].nonmortar.name + "\"; each node there is carried by one of them (" +
                     std::to_string(solution.report.iterations) + " iterations before that was seen).");
      }
    return !apart.empty();
  }
} // namespace Signorini
