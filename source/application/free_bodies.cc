// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/discretization/motion_description.h>

#include <Eigen/Dense>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct FreedomRule
    {
      /// The mean square of the normal parts of a motion at active nodes, relative to that of the motion that
      /// moves these most: zero to rounding; what facets of round surfaces give.
      double not_opposed = 1e-10, hardly_opposed = 1e-4;
      /// How far surfaces may slide along a motion that facets oppose, in widths of a face: on a radius of
      /// ten faces that is a hundredth of a radian. Solutions that drift slide by 1e2 to 1e6 of them.
      double slip = .1;
      /// The work of loads on a rotation that surfaces allow, relative to that of all loads with the size of
      /// the surfaces as their arm, which may come from facets: 1e-4 to 1e-2 for balls of tetrahedra.
      double work_of_facets = .05;
    };
  } // namespace



  void check_free_parts(const ContactModel &model, const FreeParts &parts, const SolverMethod method,
                        Journal &journal)
  {
    std::set<unsigned int> in_contact;
    for (const PairModel &pair : model.pairs())
      for (const PairModel::Side &side : pair.sides)
        in_contact.merge(model.parts_of(side));
    const auto &motions = parts.motions;
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (in_contact.count(motions[m].part) == 0 || method == SolverMethod::active_set_amg)
        {
          std::vector<double> coefficients(motions.size(), 0.);
          coefficients[m] = 1.;
          throw InputError("Body " + model.bodies().body_name(motions[m].body) +
                           "/Dirichlet: the conditions do not exclude a rigid motion (" +
                           describe_motion(motions, coefficients, model.bodies()) + ")" +
                           (in_contact.count(motions[m].part) == 0
                                ? " and no boundary of what moves belongs to a contact pair"
                                : ", which \"Solver/Method = active set amg\" needs") +
                           ". Prescribe displacements on more of its boundaries, e.g. a symmetry plane "
                           "\"name: (0, *, *)\".");
        }
    std::set<std::string> names;
    for (const FreeMotion &motion : motions)
      names.insert(model.bodies().part_name(motion.part));
    for (const std::string &name : names)
      journal.note(name + ": its Dirichlet conditions do not hold it, contact must.");
  }



  std::vector<Vector> motions_of_unknowns(const ContactModel &model, const ConstrainedSpace &constrained,
                                          const NodePartition       &unknowns,
                                          const BasisTransformation &transformation)
  {
    Vector lift, nothing;
    unknowns.reinit(lift);
    constrained.partition.reinit(nothing);
    nothing.update_ghost_values();
    transformation.from_displacement(lift, nothing);
    std::vector<Vector> result;
    for (const Vector &field : motion_fields(constrained.free_parts.motions, model.bodies(),
                                             constrained.nodal(), constrained.partition))
      {
        result.emplace_back();
        unknowns.reinit(result.back());
        transformation.from_displacement(result.back(), field);
        result.back() -= lift;
      }
    return result;
  }



  void refuse_flight(const ContactModel &model, const std::vector<FreeMotion> &motions,
                     const std::vector<double> &flight)
  {
    throw InputError("The loads press no body into contact that could hold it: " +
                     describe_motion(motions, flight, model.bodies()) +
                     ", would fly away. Prescribe displacements, or change the loads.");
  }



  namespace
  {
    /// What contact and loads make of the rigid motions of free parts.
    struct RigidProblem
    {
      RigidProblem(const ContactModel &model, const Discretization &d, const NodePartition &unknowns,
                   const ObstacleProblem &problem)
        : fields(motions_of_unknowns(model, *d.constrained, unknowns, *d.transformation))
        , work(fields.size())
        , loads(problem.rhs.l1_norm())
        , own(owned_rows(d.coupling, d.partition()))
        , rows(fields.size() * own.size())
      {
        for (const std::size_t p : own)
          {
            nodes.push_back(unknowns.to_local(d.coupling.rows[p]));
            directions.push_back(d.projections[p].direction());
          }
        for (std::size_t m = 0; m < fields.size(); ++m)
          {
            // Zero to the rounding of sums.
            work[m] = problem.rhs * fields[m];
            work[m] = std::abs(work[m]) > 1e-10 * loads ? work[m] : 0.;
            for (std::size_t p = 0; p < own.size(); ++p)
              rows[fields.size() * p + m] = directions[p] * nodal_value(fields[m], nodes[p]);
          }
      }

      /// Collective. Whether a motion turns surfaces in each other, loaded by no more than what facets may
      /// make of loads that do not turn it.
      bool turns_freely(const std::vector<FreeMotion> &motions, const std::vector<double> &motion) const
      {
        constexpr FreedomRule rule;
        // Squares of normal parts and of whole motions, number of nodes.
        double sums[3] = {0., 0., static_cast<double>(nodes.size())};
        double done    = 0.;
        for (std::size_t p = 0; p < nodes.size(); ++p)
          {
            Vector3 moved;
            for (std::size_t m = 0; m < fields.size(); ++m)
              moved += motion[m] * nodal_value(fields[m], nodes[p]);
            sums[0] += Utilities::fixed_power<2>(directions[p] * moved);
            sums[1] += moved.norm_square();
          }
        for (double &s : sums)
          s = Utilities::MPI::sum(s, fields[0].get_mpi_communicator());
        for (std::size_t m = 0; m < fields.size(); ++m)
          done += work[m] * motion[m];
        return is_rotation(motions, motion) && sums[0] <= rule.hardly_opposed * sums[1] &&
               std::abs(done) <= rule.work_of_facets * loads * std::sqrt(sums[1] / std::max(sums[2], 1.));
      }

      /// The motions; work of the loads on them; sum of the loads (force).
      const std::vector<Vector> fields;
      std::vector<double>       work;
      const double              loads;
      /// Contact nodes of this rank: rows of the coupling, nodes, normals.
      const std::vector<std::size_t> own;
      std::vector<unsigned int>      nodes;
      std::vector<Vector3>           directions;
      /// Normal parts of all motions, node by node.
      std::vector<double> rows;
    };
  } // namespace



  std::vector<double> settle_free_parts(Vector &v, const ContactModel &model, const Discretization &d,
                                        const NodePartition &unknowns, const ObstacleProblem &problem)
  {
    const RigidProblem  rigid(model, d, unknowns, problem);
    const std::size_t   n      = rigid.fields.size();
    std::vector<double> bounds = select_values(d.transformation->reduce_gaps(d.gaps), rigid.own);
    std::vector<double> rows   = rigid.rows;
    // What touches may hold the bodies where they are.
    std::vector<double> touching_rows, touching_gaps;
    for (std::size_t p = 0; p < rigid.own.size(); ++p)
      {
        bounds[p] -= rigid.directions[p] * nodal_value(v, rigid.nodes[p]);
        if (bounds[p] > 0.)
          continue;
        touching_gaps.push_back(bounds[p]);
        touching_rows.insert(touching_rows.end(), rows.begin() + n * p, rows.begin() + n * (p + 1));
      }
    for (std::vector<double> *const list : {&touching_rows, &touching_gaps, &rows, &bounds})
      *list = gather_lists(std::move(*list), d.nodal().communicator(), Receivers::all);
    if (!v.all_zero() && balance_rigid_motions(touching_rows, touching_gaps, rigid.work).is_held)
      return {};
    const RigidBalance balance = balance_rigid_motions(rows, bounds, rigid.work);
    if (!balance.is_held && rigid.turns_freely(d.free_motions(), balance.flight))
      return balance.flight;
    if (!balance.is_held)
      refuse_flight(model, d.free_motions(), balance.flight);
    for (std::size_t m = 0; m < n; ++m)
      v.add(balance.settling[m], rigid.fields[m]);
    return {};
  }



  LooseMotions find_loose_motions(const std::vector<FreeMotion> &motions, const std::vector<Vector> &fields,
                                  const HalfSpaces &spaces, const std::vector<unsigned char> &active)
  {
    const auto n = static_cast<Eigen::Index>(fields.size());
    // Normal parts of two motions; in the last column whole motions.
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n + 1);
    for (std::size_t p = 0; p < spaces.size(); ++p)
      if (active[p])
        for (Eigen::Index i = 0; i < n; ++i)
          {
            for (Eigen::Index j = 0; j < n; ++j)
              sums(i, j) += spaces.normal_part(p, fields[i]) * spaces.normal_part(p, fields[j]);
            for (unsigned int c = 0; c < dim; ++c)
              sums(i, n) += Utilities::fixed_power<2>(fields[i].local_element(dim * spaces.nodes[p] + c));
          }
    for (Eigen::Index i = 0; i < sums.size(); ++i)
      sums.data()[i] = Utilities::MPI::sum(sums.data()[i], fields[0].get_mpi_communicator());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(sums.leftCols(n));
    const double                                         scale = sums.col(n).maxCoeff();
    const FreedomRule                                    rule;
    LooseMotions                                         result;
    for (Eigen::Index k = 0; k < n; ++k)
      {
        const double              opposed = eigen.eigenvalues()[k];
        const std::vector<double> motion(eigen.eigenvectors().col(k).data(),
                                         eigen.eigenvectors().col(k).data() + n);
        if (opposed <= rule.not_opposed * scale)
          result.undetermined.push_back(motion);
        else if (opposed <= rule.hardly_opposed * scale)
          result.hardly_held.push_back(motion);
      }
    result.undetermined = separate_motions(motions, result.undetermined);
    return result;
  }



  namespace
  {
    /// How far a solution slides along the span of some motions (length).
    double slip_along(const std::vector<std::vector<double>> &motions, const std::vector<Vector> &fields,
                      const HalfSpaces &spaces, const Vector &v)
    {
      const auto      n = static_cast<Eigen::Index>(motions.size());
      Eigen::MatrixXd coefficients(fields.size(), n);
      for (Eigen::Index k = 0; k < n; ++k)
        coefficients.col(k) = Eigen::Map<const Eigen::VectorXd>(motions[k].data(), coefficients.rows());
      const auto at = [&](const std::size_t p) {
        Eigen::MatrixXd each(dim, fields.size());
        for (std::size_t i = 0; i < fields.size(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            each(c, i) = fields[i].local_element(dim * spaces.nodes[p] + c);
        return Eigen::MatrixXd(each * coefficients);
      };
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(n, n + 1);
      for (std::size_t p = 0; p < spaces.size(); ++p)
        {
          const Eigen::MatrixXd moved = at(p);
          sums.leftCols(n) += moved.transpose() * moved;
          sums.col(n) +=
              moved.transpose() * Eigen::Map<const Eigen::Vector3d>(v.begin() + dim * spaces.nodes[p]);
        }
      for (Eigen::Index i = 0; i < sums.size(); ++i)
        sums.data()[i] = Utilities::MPI::sum(sums.data()[i], v.get_mpi_communicator());
      const Eigen::VectorXd share   = sums.leftCols(n).completeOrthogonalDecomposition().solve(sums.col(n));
      double                largest = 0.;
      for (std::size_t p = 0; p < spaces.size(); ++p)
        largest = std::max(largest, (at(p) * share).norm());
      return Utilities::MPI::max(largest, v.get_mpi_communicator());
    }
  } // namespace



  std::vector<std::vector<double>> find_drift(const std::vector<FreeMotion> &motions,
                                              const std::vector<Vector> &fields, const HalfSpaces &spaces,
                                              const LooseMotions &loose, const Vector &v, const double width)
  {
    if (loose.hardly_held.empty() ||
        slip_along(loose.hardly_held, fields, spaces, v) <= FreedomRule().slip * width)
      return {};
    // Few nodes may be active in a solution that drifts: these need not show what the surfaces allow.
    const LooseMotions anywhere =
        find_loose_motions(motions, fields, spaces, std::vector<unsigned char>(spaces.size(), 1));
    return anywhere.hardly_held.empty() ? loose.hardly_held : anywhere.hardly_held;
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



  void remove_motions(Vector &v, const std::vector<std::vector<double>> &motions,
                      const std::vector<Vector> &fields, const HalfSpaces &spaces)
  {
    std::vector<Vector> kernel;
    for (const std::vector<double> &motion : motions)
      {
        kernel.emplace_back();
        kernel.back().reinit(v);
        for (std::size_t i = 0; i < fields.size(); ++i)
          kernel.back().add(motion[i], fields[i]);
      }
    if (kernel.empty())
      return;
    orthonormalize(kernel);
    Vector shifted = v;
    subtract_projection(shifted, kernel);
    // On curved surfaces the shift may run into something: then the displacement stays as it is.
    bool admissible = true;
    for (std::size_t p = 0; p < spaces.size(); ++p)
      admissible = admissible &&
                   spaces.normal_part(p, shifted) <= std::max(spaces.normal_part(p, v), spaces.bounds[p]);
    if (Utilities::MPI::min(static_cast<int>(admissible), v.get_mpi_communicator()) != 0)
      v = shifted;
  }
} // namespace Signorini
