// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "multiplier_nodes.h"
#include "node_of_several_pairs.h"

#include <signorini/algebra/sent_lists.h>
#include <signorini/mesh/surface_normals.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/pair_conflicts.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    void insert_conforming(std::set<NodeIndex> &nodes, const ContactSurface &surface, const unsigned int v)
    {
      if (surface.hanging[v].empty())
        nodes.insert(surface.vertex_node[v]);
      else
        for (const auto &parent : surface.hanging[v])
          nodes.insert(surface.vertex_node[parent.first]);
    }
  } // namespace



  std::set<NodeIndex> touched_nonmortar_nodes(const ContactSurface           &nonmortar,
                                              const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      if (!is_empty(m))
        for (const unsigned int v : nonmortar.faces[m.face].corners)
          insert_conforming(nodes, nonmortar, v);
    return nodes;
  }



  std::set<NodeIndex> touched_mortar_nodes(const ContactSurface           &mortar,
                                           const std::vector<FaceMoments> &moments)
  {
    std::set<NodeIndex> nodes;
    for (const FaceMoments &m : moments)
      for (const auto &entry : m.coupling)
        insert_conforming(nodes, mortar, entry.first);
    return nodes;
  }



  namespace
  {
    /// Bodies from which pairs lead back to themselves, from the nonmortar to the mortar side.
    std::set<unsigned int> bodies_in_cycles(const std::vector<PairToCouple> &pairs)
    {
      std::map<unsigned int, std::set<unsigned int>> next;
      for (const PairToCouple &pair : pairs)
        next[pair.nonmortar_body].insert(pair.mortar_body);
      std::set<unsigned int> result;
      for (const auto &[body, others] : next)
        {
          std::vector<unsigned int> reached(others.begin(), others.end());
          std::set<unsigned int>    known = others;
          for (std::size_t k = 0; k < reached.size(); ++k)
            if (const auto more = next.find(reached[k]); more != next.end())
              for (const unsigned int other : more->second)
                if (known.insert(other).second)
                  reached.push_back(other);
          if (known.count(body) > 0)
            result.insert(body);
        }
      return result;
    }

    std::set<NodeIndex> nodes_with_conditions(const ContactSurface &surface)
    {
      std::set<NodeIndex> result;
      for (unsigned int v = 0; v < surface.vertex_node.size(); ++v)
        if (surface.hanging[v].empty() && surface.vertex_fixed[v].any())
          result.insert(surface.vertex_node[v]);
      return result;
    }

    /// The nonmortar nodes that a pair touches on this rank.
    std::map<NodeIndex, Vector3> touched_normals(const PairToCouple &pair)
    {
      const ContactSurface        &surface = pair.surfaces.nonmortar;
      std::map<NodeIndex, Vector3> normals;
      for (const NodeIndex node : touched_nonmortar_nodes(surface, pair.moments))
        normals[node] = Vector3();
      for (const FaceMoments &m : pair.moments)
        if (const ContactSurface::Face &face = surface.faces[m.face];
            !is_empty(m) && pair.surfaces.halo.owns_face(m.face))
          {
            const Vector3       normal = m.covered / m.area * area_vector(surface, face);
            std::set<NodeIndex> nodes;
            for (const unsigned int v : face.corners)
              insert_conforming(nodes, surface, v);
            for (const NodeIndex node : nodes)
              normals[node] += normal;
          }
      return normals;
    }

    /// The nodes that several pairs touch. They meet on some rank, whichever it is; that rank decides, the
    /// others get to know what it has decided of the nodes that they touch.
    class NodesOfSeveralPairs
    {
    public:
      /// Collective.
      NodesOfSeveralPairs(const std::vector<PairToCouple> &pairs, const MPI_Comm communicator,
                          const SharedRowRule &rule)
        : comm(communicator)
        , n_ranks(Utilities::MPI::n_mpi_processes(communicator))
        , rule(rule)
        , known(pairs.size())
      {
        meet(pairs);
        const DoublyCovered    doubly_covered = meet_faces(pairs);
        std::vector<NodeIndex> decided;
        const Partings         partings(pairs, rule);
        for (const auto &[node, some] : touches)
          {
            nodes.emplace(node, doubly_covered.by_one_body.count(node) > 0
                                    ? NodeOfSeveralPairs()
                                    : NodeOfSeveralPairs(some, rule, partings,
                                                         doubly_covered.by_several.count(node) == 0));
            decided.push_back(node);
          }
        tell(decided);
      }

      /// What a pair has to know.
      const NodesOfOtherPairs &of_pair(const unsigned int pair) const
      {
        return known[pair];
      }

      /// Collective. Decides again on nodes that are a row in one pair and a column in another, or that some
      /// pairs cede and none has as a row. Returns whether there are any.
      bool settle(const std::vector<PairCoupling> &couplings)
      {
        struct Use
        {
          NodeIndex    node;
          unsigned int pair;
          bool         is_row;
        };
        ListsByRank<Use> sent;
        for (unsigned int p = 0; p < couplings.size(); ++p)
          {
            const auto send = [&](const NodeIndex node, const bool is_row) {
              if (owned.count(node) > 0)
                sent[meeting_at(node)].push_back({node, p, is_row});
            };
            for (const NodeIndex node : couplings[p].coupling.rows)
              send(node, true);
            for (const NodeIndex node : couplings[p].r_nodes)
              send(node, false);
          }
        std::set<NodeIndex> columns;
        row_pairs.clear();
        for (const auto &[sender, list] : send_lists(sent, comm))
          for (const Use &use : list)
            if (!use.is_row)
              columns.insert(use.node);
            else if (const auto [entry, is_new] = row_pairs.insert({use.node, use.pair}); !is_new)
              entry->second = std::min(entry->second, use.pair);
        std::vector<NodeIndex> changed;
        for (auto &[node, some] : nodes)
          if (const bool is_row = row_pairs.count(node) > 0;
              is_row ? columns.count(node) > 0 : some.is_ceded_by_any(touches.at(node)))
            {
              some.change(is_row);
              changed.push_back(node);
            }
        tell(changed);
        return Utilities::MPI::sum(changed.size(), comm) > 0;
      }

      /// Collective. What pairs cover around nodes that they cede counts for the pair that has the row: the
      /// force at the node is one pressure times all of it.
      void give_areas(std::vector<PairCoupling> &couplings) const
      {
        ListsByRank<PairCoupling::CededNode> sent;
        for (const PairCoupling &pair : couplings)
          for (const PairCoupling::CededNode &node : pair.ceded)
            sent[meeting_at(node.node)].push_back(node);
        // In an order that does not depend on the ranks.
        std::map<NodeIndex, std::multiset<double>> parts;
        for (const auto &[sender, list] : send_lists(sent, comm))
          for (const PairCoupling::CededNode &node : list)
            parts[node.node].insert(node.area);
        struct Gain
        {
          NodeIndex    node;
          unsigned int pair;
          double       area;
        };
        ListsByRank<Gain> gains;
        for (const auto &[node, areas] : parts)
          if (const auto row = row_pairs.find(node); row != row_pairs.end())
            for (const Touch &touch : touches.at(node))
              if (touch.pair == row->second)
                gains[touch.sender].push_back(
                    {node, touch.pair, std::accumulate(areas.begin(), areas.end(), 0.)});
        for (const auto &[sender, list] : send_lists(gains, comm))
          for (const Gain &gain : list)
            {
              PairCoupling &pair = couplings[gain.pair];
              if (const std::ptrdiff_t row = pair.coupling.find(gain.node); row >= 0)
                {
                  pair.coupling.weight[row] += gain.area;
                  pair.areas[row] += gain.area;
                }
            }
      }

    private:
      unsigned int meeting_at(const NodeIndex node) const
      {
        return static_cast<unsigned int>(node % n_ranks);
      }

      void meet(const std::vector<PairToCouple> &pairs)
      {
        ListsByRank<Touch>           sent;
        const std::set<unsigned int> in_cycles = bodies_in_cycles(pairs);
        for (unsigned int p = 0; p < pairs.size(); ++p)
          {
            Touch      touch{0, p, false, pairs[p].is_tied, pairs[p].mortar_body, false, Vector3(), 0};
            const bool may_chain  = !pairs[p].is_tied && in_cycles.count(pairs[p].nonmortar_body) == 0;
            const auto conditions = nodes_with_conditions(pairs[p].surfaces.nonmortar);
            for (const auto &[node, normal] : touched_normals(pairs[p]))
              {
                touch.node      = node;
                touch.normal    = normal;
                touch.may_chain = may_chain && conditions.count(node) == 0;
                sent[meeting_at(node)].push_back(touch);
              }
            touch.is_mortar = true;
            for (const NodeIndex node : touched_mortar_nodes(pairs[p].surfaces.mortar, pairs[p].moments))
              {
                touch.node = node;
                sent[meeting_at(node)].push_back(touch);
              }
          }
        for (const auto &[sender, list] : send_lists(sent, comm))
          for (Touch touch : list)
            {
              touch.sender = sender;
              touches[touch.node].push_back(touch);
            }
        for (auto entry = touches.begin(); entry != touches.end();)
          {
            const std::vector<Touch> &some = entry->second;
            const bool                has_conflict =
                std::any_of(some.begin(), some.end(), [](const Touch &touch) { return !touch.is_mortar; }) &&
                std::any_of(some.begin(), some.end(), [&](const Touch &touch) {
                  return touch.pair != some[0].pair || touch.is_mortar != some[0].is_mortar;
                });
            entry = has_conflict ? std::next(entry) : touches.erase(entry);
          }
      }

      /// Nodes of faces that pairs cover one over the other, with the same mortar body and with several.
      struct DoublyCovered
      {
        std::set<NodeIndex> by_one_body, by_several;
      };

      /// Collective. Of the nodes that meet here.
      DoublyCovered meet_faces(const std::vector<PairToCouple> &pairs) const
      {
        struct Cover
        {
          FaceName     face;
          unsigned int mortar_body, pair;
          double       share;
        };
        struct Corner
        {
          NodeIndex node;
          bool      is_of_one_body;
        };
        ListsByRank<Cover>  covers;
        ListsByRank<Corner> corners;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          for (const FaceMoments &m : pairs[p].moments)
            if (!is_empty(m) && pairs[p].surfaces.halo.owns_face(m.face))
              {
                const FaceName name = name_of(pairs[p].surfaces.nonmortar, m.face);
                covers[meeting_at(name[0])].push_back({name, pairs[p].mortar_body, p, m.covered / m.area});
              }
        // In the order of the pairs.
        std::map<FaceName, std::map<unsigned int, Cover>> by_face;
        for (const auto &[sender, list] : send_lists(covers, comm))
          for (const Cover &cover : list)
            by_face[cover.face][cover.pair] = cover;
        for (const auto &[face, by_pair] : by_face)
          {
            double                                                  all = 0.;
            std::map<unsigned int, std::pair<unsigned int, double>> of_body;
            for (const auto &[pair, cover] : by_pair)
              {
                auto &[n_pairs, of_all] = of_body[cover.mortar_body];
                ++n_pairs;
                of_all += cover.share;
                all += cover.share;
              }
            const bool is_of_one_body = std::any_of(of_body.begin(), of_body.end(), [this](const auto &body) {
              return body.second.first > 1 && body.second.second > rule.greater;
            });
            if (is_of_one_body || (of_body.size() > 1 && all > rule.beside))
              for (const NodeIndex node : face)
                corners[meeting_at(node)].push_back({node, is_of_one_body});
          }
        DoublyCovered result;
        for (const auto &[sender, list] : send_lists(corners, comm))
          for (const Corner &corner : list)
            (corner.is_of_one_body ? result.by_one_body : result.by_several).insert(corner.node);
        return result;
      }

      /// Collective. Tells those that touch some nodes what has become of them.
      void tell(const std::vector<NodeIndex> &decided)
      {
        struct Decision
        {
          NodeIndex    node;
          unsigned int pair;
          bool         is_excluded, is_ceded, is_kept;
        };
        ListsByRank<Decision> sent;
        for (const NodeIndex node : decided)
          for (const Touch &touch : touches.at(node))
            {
              const NodeOfSeveralPairs &some = nodes.at(node);
              sent[touch.sender].push_back({node, touch.pair, some.is_excluded(),
                                            !touch.is_mortar && some.is_ceded_by(touch.pair), some.is_kept});
            }
        for (const auto &[sender, list] : send_lists(sent, comm))
          for (const Decision &decision : list)
            {
              NodesOfOtherPairs &pair = known[decision.pair];
              if (decision.is_excluded)
                pair.excluded.insert(decision.node);
              else if (decision.is_ceded)
                pair.ceded.insert(decision.node);
              else if (decision.is_kept)
                pair.kept.insert(decision.node);
              if (decision.is_excluded)
                owned.erase(decision.node);
              else
                owned.insert(decision.node);
            }
      }

      const MPI_Comm      comm;
      const unsigned int  n_ranks;
      const SharedRowRule rule;
      /// The nodes that meet here, what the pairs make of them, and the first pair that has them as rows.
      std::map<NodeIndex, std::vector<Touch>> touches;
      std::map<NodeIndex, NodeOfSeveralPairs> nodes;
      std::map<NodeIndex, unsigned int>       row_pairs;
      /// What this rank got to know, by pair; nodes that are rows of some pair.
      std::vector<NodesOfOtherPairs> known;
      std::set<NodeIndex>            owned;
    };
  } // namespace



  std::vector<PairCoupling> couple_pairs(const std::vector<PairToCouple> &pairs, const MPI_Comm communicator,
                                         const DroppingRule &rule, const SharedRowRule &shared_rule)
  {
    NodesOfSeveralPairs several(pairs, communicator, shared_rule);
    // Each round changes what becomes of at least one node, and none is changed more than twice; one or two
    // rounds are the rule.
    while (true)
      {
        std::vector<PairCoupling> couplings;
        for (unsigned int p = 0; p < pairs.size(); ++p)
          {
            DroppingRule rule_of_pair      = rule;
            rule_of_pair.drops_sharp_edges = rule.drops_sharp_edges && !pairs[p].is_tied;
            couplings.push_back(couple(pairs[p].surfaces, pairs[p].moments, several.of_pair(p),
                                       pairs[p].prescribed_gap, rule_of_pair));
          }
        if (several.settle(couplings))
          continue;
        several.give_areas(couplings);
        return couplings;
      }
  }
} // namespace Signorini
