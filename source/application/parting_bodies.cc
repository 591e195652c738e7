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
#include <utility>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// How far a node is from the mortar body of one pair after deformation (length), with the weight of that
    /// pair in the row (area).
    struct Opening
    {
      NodeIndex    node;
      unsigned int pair;
      double       value, weight;
    };

    /// How deep a node lies in the body of one pair (length), out of which another one goes, or lies less
    /// deep in.
    struct Depth
    {
      unsigned int pair, other;
      double       value;
    };

    /// The deepest of each two pairs.
    class Depths
    {
    public:
      void add(const Depth &depth)
      {
        double &value = values[{depth.pair, depth.other}];
        value         = std::max(value, depth.value);
      }

      std::vector<Depth> list() const
      {
        std::vector<Depth> result;
        for (const auto &[pairs, value] : values)
          result.push_back({pairs.first, pairs.second, value});
        return result;
      }

      double of(const unsigned int pair, const unsigned int other) const
      {
        const auto entry = values.find({pair, other});
        return entry != values.end() ? entry->second : 0.;
      }

    private:
      std::map<std::pair<unsigned int, unsigned int>, double> values;
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
          result.push_back({coupling.rows[i], p, pair.gaps[i] - pair.normals[i] * jump, coupling.weight[i]});
        }
      return result;
    }

    /// Those of one node whose openings differ by more than they may. What a pair says that covers a sliver
    /// is an extrapolation over a whole face: each counts with twice its share, or once.
    void add_depths(Depths &depths, std::vector<Opening> openings, const Discretization &d,
                    const std::vector<double> &approaches, const PartingRule &rule)
    {
      double all = 0., approach = 0.;
      for (const Opening &one : openings)
        {
          all += one.weight;
          approach = std::max(approach, approaches[one.pair]);
        }
      if (approach <= rule.idle * *std::max_element(approaches.begin(), approaches.end()))
        return;
      for (Opening &one : openings)
        one.value *= std::min(1., 2. * one.weight / all);
      for (const Opening &a : openings)
        for (const Opening &b : openings)
          if (-a.value > rule.depth * approach && b.value - a.value > rule.depth * approach &&
              !have_one_mortar_body(d.pairs[a.pair], d.pairs[b.pair]))
            depths.add({a.pair, b.pair, -a.value});
    }
  } // namespace



  std::vector<PartedPairs> find_parted_bodies(const Discretization &d, const ContactSolution &solution,
                                              const PartingRule &rule)
  {
    if (!solution.report.converged || !solution.drift.motions.empty())
      return {};
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
    Depths mine, all;
    for (const auto &[node, openings] : met)
      add_depths(mine, openings, d, approaches, rule);
    for (const Depth &depth : gather_lists(mine.list(), comm, Receivers::all))
      all.add(depth);
    std::vector<PartedPairs> result;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      for (unsigned int q = 0; q < d.pairs.size(); ++q)
        if (const double depth = all.of(p, q), of_other = all.of(q, p);
            depth > of_other || (depth > 0. && depth == of_other && p < q))
          result.push_back({p, q});
    return result;
  }



  std::string describe_parted(const PartedPairs &parted, const Discretization &d)
  {
    return "pairs " + d.pairs[parted.stays].name + " and " + d.pairs[parted.yields].name +
           ": what they touch does not stay beside each other under \"" +
           d.pairs[parted.stays].nonmortar.name + "\"";
  }



  bool part_bodies(std::vector<PairChoice> &choices, const Discretization &d, const ContactSolution &solution,
                   Journal &journal, const PartingRule &rule)
  {
    const std::vector<PartedPairs> parted = find_parted_bodies(d, solution, rule);
    for (const PartedPairs &pairs : parted)
      {
        choices[pairs.yields].yields_to.push_back(pairs.stays);
        journal.note(describe_parted(pairs, d) + "; the nodes between them are those of " +
                     d.pairs[pairs.stays].name + " (" + std::to_string(solution.report.iterations) +
                     " iterations before that was seen).");
      }
    return !parted.empty();
  }
} // namespace Signorini
