// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/dense_matrix.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/node_request.h>
#include <signorini/algebra/sent_lists.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/parting_bodies.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <map>
#include <utility>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// How far a node is from the mortar body of one pair after deformation (length), with the weight of that
    /// pair in the row (area), and the outward normal.
    struct Opening
    {
      NodeIndex    node;
      unsigned int pair;
      double       value, weight;
      Vector3      normal;
    };

    /// What the nodes that two pairs share say of the shift between their bodies: by how much more a node is
    /// open to the first one than to the second is n·shift, in the sense of least squares.
    struct ShiftSums
    {
      unsigned int pair, other;
      /// How many of them lie too deep in one of the bodies.
      double                  n_deep = 0.;
      SymmetricTensor<2, dim> normals;
      Vector3                 differences;

      void add(const ShiftSums &sums)
      {
        n_deep += sums.n_deep;
        normals += sums.normals;
        differences += sums.differences;
      }

      /// The smallest one where normals leave directions open.
      Vector3 shift() const
      {
        constexpr double least = 1e-3;
        Eigen::Matrix3d  matrix;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            matrix(i, j) = normals[i][j];
        const SymmetricEigen eigen = symmetric_eigen(matrix);
        Vector3              result;
        for (unsigned int k = 0; k < dim; ++k)
          if (eigen.values[k] > least * eigen.values[dim - 1])
            {
              const Eigen::Vector3d axis = eigen.vectors.col(k);
              const Vector3         direction({axis[0], axis[1], axis[2]});
              result += (direction * differences) / eigen.values[k] * direction;
            }
        return result;
      }
    };

    /// Those of all couples of pairs.
    class Shifts
    {
    public:
      void add(const ShiftSums &sums)
      {
        const auto [entry, is_new] = couples.insert({{sums.pair, sums.other}, sums});
        if (!is_new)
          entry->second.add(sums);
      }

      std::vector<ShiftSums> list() const
      {
        std::vector<ShiftSums> result;
        for (const auto &couple : couples)
          result.push_back(couple.second);
        return result;
      }

    private:
      std::map<std::pair<unsigned int, unsigned int>, ShiftSums> couples;
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
          result.push_back({coupling.rows[i], p, pair.gaps[i] - pair.normals[i] * jump, coupling.weight[i],
                            pair.normals[i]});
        }
      return result;
    }

    /// What one node says. What a pair says that covers a sliver is an extrapolation over a whole face: each
    /// counts with twice its share, or once.
    void add_node(Shifts &shifts, const std::vector<Opening> &openings, const Discretization &d,
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
      const auto counts = [all](const Opening &one) { return std::min(1., 2. * one.weight / all); };
      for (const Opening &a : openings)
        for (const Opening &b : openings)
          if (a.pair < b.pair && !have_one_mortar_body(d.pairs[a.pair], d.pairs[b.pair]))
            {
              const double of_a = counts(a) * a.value, of_b = counts(b) * b.value,
                           weight = counts(a) * counts(b);
              ShiftSums sums{a.pair, b.pair, 0., weight * symmetrize(outer_product(a.normal, a.normal)),
                             weight * (a.value - b.value) * a.normal};
              if (-std::min(of_a, of_b) > rule.depth * approach &&
                  std::abs(of_a - of_b) > rule.depth * approach)
                sums.n_deep = 1.;
              shifts.add(sums);
            }
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
    Shifts mine, all;
    for (const auto &[node, openings] : met)
      add_node(mine, openings, d, approaches, rule);
    for (const ShiftSums &sums : gather_lists(mine.list(), comm, Receivers::all))
      all.add(sums);
    std::vector<PartedPairs> result;
    for (const ShiftSums &sums : all.list())
      if (const Vector3 shift = sums.shift(); sums.n_deep > 0. && shift.norm() > 0.)
        result.push_back({sums.pair, {sums.other, shift}});
    return result;
  }



  std::string describe_parted(const PartedPairs &parted, const Discretization &d)
  {
    return "pairs " + d.pairs[parted.pair].name + " and " + d.pairs[parted.from.other].name +
           ": what they touch does not stay beside each other under \"" +
           d.pairs[parted.pair].nonmortar.name + "\"";
  }



  bool part_bodies(std::vector<PairChoice> &choices, const Discretization &d, const ContactSolution &solution,
                   Journal &journal, const PartingRule &rule)
  {
    const std::vector<PartedPairs> parted = find_parted_bodies(d, solution, rule);
    for (const PartedPairs &pairs : parted)
      {
        choices[pairs.pair].partings.push_back(pairs.from);
        journal.note(describe_parted(pairs, d) + "; each node between them is carried by one of them (" +
                     std::to_string(solution.report.iterations) + " iterations before that was seen).");
      }
    return !parted.empty();
  }
} // namespace Signorini
