// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "motion_columns.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/loose_motions.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/discretization/motion_description.h>


#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Sums of products of motions over active nodes: of their normal parts; of the whole motions.
    struct MotionsAtContact
    {
      Eigen::MatrixXd normal, whole;
    };

    void sum_over_ranks(Eigen::MatrixXd &values, const MPI_Comm communicator)
    {
      const auto n = static_cast<std::size_t>(values.size());
      Utilities::MPI::sum(ArrayView<const double>(values.data(), n), communicator,
                          ArrayView<double>(values.data(), n));
    }

    /// The displacements of motions at a node, by column.
    Eigen::MatrixXd motions_at(const std::vector<Vector> &fields, const unsigned int node)
    {
      Eigen::MatrixXd result(dim, fields.size());
      for (std::size_t i = 0; i < fields.size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          result(c, i) = fields[i].local_element(dim * node + c);
      return result;
    }

    MotionsAtContact at_contact(const std::vector<Vector> &fields, const HalfSpaces &spaces,
                                const std::vector<unsigned char> &active)
    {
      const auto      n    = static_cast<Eigen::Index>(fields.size());
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, 2 * n);
      for (std::size_t p = 0; p < spaces.size(); ++p)
        if (active[p])
          {
            Eigen::VectorXd normal(n);
            for (Eigen::Index i = 0; i < n; ++i)
              normal[i] = spaces.normal_part(p, fields[i]);
            const Eigen::MatrixXd whole = motions_at(fields, spaces.nodes[p]);
            sums.leftCols(n) += normal * normal.transpose();
            sums.rightCols(n) += whole.transpose() * whole;
          }
      sum_over_ranks(sums, fields[0].get_mpi_communicator());
      return {sums.leftCols(n), sums.rightCols(n)};
    }

    /// Collective. The sum of products of the normal parts of combinations of motions (columns) over active
    /// nodes: to rounding of the normal parts, which the sum of products of all motions is not.
    Eigen::MatrixXd normal_products(const Eigen::MatrixXd &combinations, const std::vector<Vector> &fields,
                                    const HalfSpaces &spaces, const std::vector<unsigned char> &active)
    {
      const Eigen::Index n      = combinations.cols();
      Eigen::MatrixXd    result = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd    normal(combinations.rows());
      for (std::size_t p = 0; p < spaces.size(); ++p)
        if (active[p])
          {
            for (Eigen::Index i = 0; i < normal.size(); ++i)
              normal[i] = spaces.normal_part(p, fields[i]);
            const Eigen::VectorXd parts = combinations.transpose() * normal;
            result += parts * parts.transpose();
          }
      sum_over_ranks(result, fields[0].get_mpi_communicator());
      return result;
    }
  } // namespace



  LooseMotions find_loose_motions(const std::vector<FreeMotion> &motions, const std::vector<Vector> &fields,
                                  const HalfSpaces &spaces, const std::vector<unsigned char> &active)
  {
    const MotionsAtContact sums  = at_contact(fields, spaces, active);
    const SymmetricEigen   eigen = symmetric_eigen(sums.normal);
    const double           scale = sums.whole.diagonal().maxCoeff();
    const LooseMotionRule  rule;
    // Eigenvalues ascend.
    const auto   count = [&](const double bound) { return (eigen.values.array() <= bound * scale).count(); };
    LooseMotions result;
    const auto   add = [](std::vector<std::vector<double>> &list, const Eigen::VectorXd &motion) {
      list.emplace_back(motion.begin(), motion.end());
    };
    const Eigen::Index n_undetermined = count(rule.next_to_nothing);
    for (Eigen::Index k = 0; k < n_undetermined; ++k)
      add(result.undetermined, eigen.vectors.col(k));
    for (Eigen::Index k = n_undetermined; k < count(rule.hardly_opposed); ++k)
      {
        const Eigen::VectorXd motion = eigen.vectors.col(k);
        add(result.hardly_held, motion);
        // A long bar rolls about its axis by little.
        if (eigen.values[k] <= rule.hardly_opposed * motion.dot(sums.whole * motion))
          add(result.slides_on_facets, motion);
      }
    if (n_undetermined > 0)
      {
        const Eigen::MatrixXd span  = eigen.vectors.leftCols(n_undetermined);
        const SymmetricEigen  exact = symmetric_eigen(normal_products(span, fields, spaces, active));
        for (Eigen::Index k = 0; k < n_undetermined; ++k)
          if (exact.values[k] > rule.not_opposed * scale)
            add(result.next_to_undetermined, span * exact.vectors.col(k));
      }
    result.undetermined = separate_motions(motions, result.undetermined);
    return result;
  }



  namespace
  {
    /// Collective. Whether the normal parts of a motion (its coefficients are pure numbers, and so are these)
    /// at active nodes are no more than what they change by within a face.
    /// @param turned what a rotation changes them by
    bool would_be_unopposed_beside(const std::vector<double> &motion, const double turned,
                                   const std::vector<Vector> &fields, const HalfSpaces &spaces,
                                   const std::vector<unsigned char> &active, const FacesAtContact &faces)
    {
      bool is_opposed = false;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        if (active[p])
          {
            double  part = 0.;
            Vector3 whole;
            for (std::size_t i = 0; i < fields.size(); ++i)
              {
                part += motion[i] * spaces.normal_part(p, fields[i]);
                whole += motion[i] * nodal_value(fields[i], spaces.nodes[p]);
              }
            is_opposed =
                is_opposed || std::abs(part) > LooseMotionRule().offset *
                                                   std::max(turned, faces.change_of_normal_part(p, whole));
          }
      return Utilities::MPI::max(static_cast<int>(is_opposed), fields[0].get_mpi_communicator()) == 0;
    }

    /// How far a solution slides along the span of some motions (length).
    double slip_along(const std::vector<std::vector<double>> &motions, const std::vector<Vector> &fields,
                      const HalfSpaces &spaces, const Vector &v)
    {
      const auto            n            = static_cast<Eigen::Index>(motions.size());
      const Eigen::MatrixXd coefficients = as_columns(motions);
      const auto            at           = [&](const std::size_t p) {
        return Eigen::MatrixXd(motions_at(fields, spaces.nodes[p]) * coefficients);
      };
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n + 1);
      for (std::size_t p = 0; p < spaces.size(); ++p)
        {
          const Eigen::MatrixXd moved = at(p);
          sums.leftCols(n) += moved.transpose() * moved;
          sums.col(n) +=
              moved.transpose() * Eigen::Map<const Eigen::Vector3d>(v.begin() + dim * spaces.nodes[p]);
        }
      sum_over_ranks(sums, v.get_mpi_communicator());
      const Eigen::VectorXd share   = least_squares(sums.leftCols(n), sums.col(n));
      double                largest = 0.;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        largest = std::max(largest, (at(p) * share).norm());
      return Utilities::MPI::max(largest, v.get_mpi_communicator());
    }
  } // namespace



  namespace
  {
    /// The parts that motions move.
    std::set<unsigned int> moved_parts(const std::vector<FreeMotion>          &motions,
                                       const std::vector<std::vector<double>> &moving)
    {
      std::set<unsigned int> parts;
      for (const std::vector<double> &motion : moving)
        for (std::size_t m = 0; m < motions.size(); ++m)
          if (std::abs(motion[m]) > LooseMotionRule().moves)
            parts.insert(motions[m].first_part());
      return parts;
    }
  } // namespace



  std::vector<std::vector<double>> of_same_parts(const std::vector<FreeMotion>          &motions,
                                                 const std::vector<std::vector<double>> &candidates,
                                                 const std::vector<std::vector<double>> &moving)
  {
    const std::set<unsigned int>     parts = moved_parts(motions, moving);
    std::vector<std::vector<double>> result;
    for (const std::vector<double> &motion : candidates)
      {
        const std::set<unsigned int> own = moved_parts(motions, {motion});
        if (std::any_of(own.begin(), own.end(),
                        [&](const unsigned int part) { return parts.count(part) > 0; }))
          result.push_back(motion);
      }
    return result;
  }



  namespace
  {
    /// Motions of bodies that touch only each other and move as one: surfaces that are mapped onto each other
    /// across a distance oppose them a little, where their images lie beside the normals. Each free motion
    /// counts by what it moves at contact nodes: parts have many or few of these.
    std::vector<std::vector<double>> common_motions(const std::vector<Vector> &fields,
                                                    const HalfSpaces          &spaces)
    {
      constexpr LooseMotionRule rule;
      const MotionsAtContact sums  = at_contact(fields, spaces, std::vector<unsigned char>(spaces.size(), 1));
      const double           least = rule.next_to_nothing * sums.whole.diagonal().maxCoeff();
      std::vector<std::vector<double>> result;
      if (!(least > 0.) || !(sums.whole.diagonal().minCoeff() > least))
        return result;
      const Eigen::MatrixXd scale    = sums.whole.diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
      const SymmetricEigen  relative = symmetric_eigen(scale * sums.whole * scale);
      const Eigen::Index    n        = (relative.values.array() <= rule.common).count();
      if (n == 0)
        return result;
      const Eigen::MatrixXd span    = scale * relative.vectors.leftCols(n);
      const SymmetricEigen  opposed = symmetric_eigen(span.transpose() * sums.normal * span);
      for (Eigen::Index k = 0; k < n; ++k)
        if (opposed.values[k] > rule.next_to_nothing && opposed.values[k] <= rule.hardly_opposed)
          {
            const Eigen::VectorXd motion = (span * opposed.vectors.col(k)).normalized();
            result.emplace_back(motion.begin(), motion.end());
          }
      return result;
    }
  } // namespace



  std::vector<std::vector<double>> find_drift(const std::vector<FreeMotion> &motions,
                                              const std::vector<Vector> &fields, const HalfSpaces &spaces,
                                              const LooseMotions &loose, const Vector &v, const double width)
  {
    const auto drifts = [&](const std::vector<std::vector<double>> &along) {
      return !along.empty() && slip_along(along, fields, spaces, v) > LooseMotionRule().slip * width;
    };
    const bool                             slides           = drifts(loose.hardly_held);
    const std::vector<std::vector<double>> common           = common_motions(fields, spaces);
    const bool                             drifts_on_facets = slides || !common.empty();
    if (!drifts_on_facets && !drifts(loose.next_to_undetermined))
      return {};
    // Few nodes may be active in a solution that drifts: these need not show what the surfaces allow.
    const LooseMotions anywhere =
        find_loose_motions(motions, fields, spaces, std::vector<unsigned char>(spaces.size(), 1));
    std::vector<std::vector<double>> result;
    if (drifts_on_facets)
      result = anywhere.hardly_held.empty() ? loose.hardly_held : anywhere.hardly_held;
    if (!slides)
      result = of_same_parts(motions, result, common);
    const auto undetermined =
        of_same_parts(motions, anywhere.undetermined, drifts_on_facets ? result : loose.next_to_undetermined);
    result.insert(result.end(), undetermined.begin(), undetermined.end());
    return result.empty() ? loose.next_to_undetermined : result;
  }



  std::vector<Vector3> normals_of_partners(const Discretization &d)
  {
    // The ranks that work on a surface tell those that own its nodes.
    struct RowOfPair
    {
      NodeIndex   node;
      std::size_t pair;
    };
    ListsByRank<RowOfPair> parcels;
    std::vector<double>    sizes;
    for (std::size_t p = 0; p < d.pairs.size(); ++p)
      {
        sizes.push_back(d.pairs[p].nonmortar.surface.extent());
        if (d.pairs[p].obstacle)
          for (const NodeIndex node : d.couplings[p].coupling.rows)
            parcels[d.partition().owner(node)].push_back({node, p});
      }
    std::map<NodeIndex, std::size_t> pair_of_node;
    for (const auto &[sender, rows] : send_lists(parcels, d.nodal().communicator()))
      for (const auto &[node, pair] : rows)
        pair_of_node[node] = pair;
    std::vector<Vector3> result;
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      if (!d.tied[row] && d.owns_row(row))
        {
          const Vector3  &own  = d.projections[row].direction();
          const NodeIndex node = d.coupling.rows[row];
          double          distance;
          Vector3         normal;
          if (const auto one = pair_of_node.find(node); one == pair_of_node.end())
            result.push_back(own);
          else
            result.push_back(d.pairs[one->second].obstacle->contact_normal(
                                 normal, distance, d.nodal().position(node), own, sizes[one->second])
                                 ? normal
                                 : Vector3());
        }
    return result;
  }



  namespace
  {
    /// Motions that lead along all obstacles.
    struct MotionsAlongObstacles
    {
      /// An orthonormal basis of them, by column: coefficients of the free motions.
      Eigen::MatrixXd span;
      /// The largest mean square of a motion at the contact nodes times their number.
      double scale;
    };

    MotionsAlongObstacles motions_along_obstacles(const FreeSolution         &solution,
                                                  const std::vector<Vector3> &partners)
    {
      HalfSpaces of_partners = solution.half_spaces;
      of_partners.normals    = partners;
      const MotionsAtContact sums =
          at_contact(solution.fields, of_partners, std::vector<unsigned char>(partners.size(), 1));
      const SymmetricEigen eigen = symmetric_eigen(sums.normal);
      const double         scale = sums.whole.diagonal().maxCoeff();
      return {
          eigen.vectors.leftCols((eigen.values.array() <= LooseMotionRule().next_to_nothing * scale).count()),
          scale};
    }
  } // namespace



  void refuse_loads_along_obstacles(const FreeSolution &solution, const std::vector<Vector3> &partners,
                                    const Vector &loads, const ContactModel &model)
  {
    const auto [span, scale] = motions_along_obstacles(solution, partners);
    if (span.cols() == 0)
      return;
    Eigen::VectorXd all(solution.fields.size());
    for (std::size_t m = 0; m < solution.fields.size(); ++m)
      all[m] = loads * solution.fields[m];
    const Eigen::VectorXd work = span.transpose() * all;
    const double          n_nodes =
        Utilities::MPI::sum(static_cast<double>(partners.size()), loads.get_mpi_communicator());
    const double mean = std::sqrt(scale / std::max(n_nodes, 1.));
    if (!(work.norm() > LooseMotionRule().work_of_mesh * loads.l1_norm() * mean))
      return;
    const Eigen::VectorXd motion = span * work / work.norm();
    refuse_flight(model, solution.motions, std::vector<double>(motion.begin(), motion.end()),
                  {std::vector<double>(all.begin(), all.end()), loads.l1_norm()});
  }



  std::vector<std::vector<double>> find_sliding(const FreeSolution         &solution,
                                                const std::vector<Vector3> &partners, const double width)
  {
    constexpr LooseMotionRule rule;
    const auto &[motions, fields, spaces, active, v] = solution;
    const auto [span, scale]                         = motions_along_obstacles(solution, partners);
    if (span.cols() == 0)
      return {};
    const SymmetricEigen             own = symmetric_eigen(normal_products(span, fields, spaces, active));
    std::vector<std::vector<double>> result;
    for (Eigen::Index k = 0; k < span.cols(); ++k)
      if (own.values[k] > rule.next_to_nothing * scale)
        {
          const Eigen::VectorXd motion = span * own.vectors.col(k);
          result.emplace_back(motion.begin(), motion.end());
        }
    return !result.empty() && slip_along(result, fields, spaces, v) > rule.slip * width
               ? result
               : std::vector<std::vector<double>>();
  }



  std::vector<std::vector<double>> find_motions_of_the_mesh(const FreeSolution   &solution,
                                                            const FacesAtContact &faces)
  {
    constexpr LooseMotionRule rule;
    const auto &[motions, fields, spaces, active, v] = solution;
    std::map<unsigned int, std::vector<Eigen::Index>> parts;
    for (std::size_t m = 0; m < motions.size(); ++m)
      parts[motions[m].first_part()].push_back(m);
    const MotionsAtContact           sums = at_contact(fields, spaces, active);
    std::vector<std::vector<double>> result;
    for (const auto &[part, own] : parts)
      {
        const Eigen::MatrixXd whole = sums.whole(own, own);
        const SymmetricEigen  eigen = symmetric_eigen(sums.normal(own, own));
        for (Eigen::Index k = 0; k < eigen.values.size(); ++k)
          {
            const double          opposed  = eigen.values[k];
            const Eigen::VectorXd x        = eigen.vectors.col(k);
            Vector3               rotation = {};
            std::vector<double>   motion(motions.size(), 0.);
            for (std::size_t i = 0; i < own.size(); ++i)
              {
                motion[own[i]] = x[i];
                rotation += x[i] / motions[own[i]].length * motions[own[i]].rotation;
              }
            if (opposed > rule.next_to_nothing * whole.diagonal().maxCoeff() &&
                opposed <= rule.slides * x.dot(whole * x) &&
                would_be_unopposed_beside(motion, faces.width * rotation.norm(), fields, spaces, active,
                                          faces) &&
                slip_along({motion}, fields, spaces, v) > rule.slip * faces.width)
              result.push_back(motion);
          }
      }
    return result;
  }



  void warn_of_facets(const ContactModel &model, const std::vector<FreeMotion> &motions,
                      const std::vector<std::vector<double>> &hardly_held, Journal &journal)
  {
    for (const std::vector<double> &motion : hardly_held)
      journal.note("warning: " + describe_motion(motions, motion, model.bodies()) +
                   ": frictionless contact does not hold it but for the facets of the surfaces. How far the "
                   "body moves that way, and what depends on it, is no property of the true bodies; "
                   "prescribe a displacement there.");
  }
} // namespace Signorini
