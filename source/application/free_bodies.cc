// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/nodal_sums.h>

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



  void settle_free_parts(Vector &v, const ContactModel &model, const Discretization &d,
                         const NodePartition &unknowns, const ObstacleProblem &problem)
  {
    const auto        fields = motions_of_unknowns(model, *d.constrained, unknowns, *d.transformation);
    const std::size_t n      = fields.size();
    // By contact node of this rank.
    const std::vector<std::size_t> own    = owned_rows(d.coupling, d.partition());
    const std::size_t              n_rows = own.size();
    std::vector<double>            bounds = select_values(d.transformation->reduce_gaps(d.gaps), own);
    std::vector<double>            rows(n * n_rows), work(n);
    // The work of the loads on a motion, zero to the rounding of their sums.
    const double scale = problem.rhs.l1_norm();
    for (std::size_t m = 0; m < n; ++m)
      {
        work[m] = problem.rhs * fields[m];
        work[m] = std::abs(work[m]) > 1e-10 * scale ? work[m] : 0.;
        for (std::size_t p = 0; p < n_rows; ++p)
          rows[n * p + m] = d.projections[own[p]].direction() *
                            nodal_value(fields[m], unknowns.to_local(d.coupling.rows[own[p]]));
      }
    // What touches may hold the bodies where they are.
    std::vector<double> touching_rows, touching_gaps;
    for (std::size_t p = 0; p < n_rows; ++p)
      {
        bounds[p] -=
            d.projections[own[p]].direction() * nodal_value(v, unknowns.to_local(d.coupling.rows[own[p]]));
        if (bounds[p] > 0.)
          continue;
        touching_gaps.push_back(bounds[p]);
        touching_rows.insert(touching_rows.end(), rows.begin() + n * p, rows.begin() + n * (p + 1));
      }
    for (std::vector<double> *const list : {&touching_rows, &touching_gaps, &rows, &bounds})
      *list = gather_lists(std::move(*list), d.nodal().communicator(), Receivers::all);
    if (!v.all_zero() && balance_rigid_motions(touching_rows, touching_gaps, work).is_held)
      return;
    const RigidBalance balance = balance_rigid_motions(rows, bounds, work);
    if (!balance.is_held)
      throw InputError("The loads press no body into contact that could hold it: " +
                       describe_motion(d.free_motions(), balance.flight, model.bodies()) +
                       ", would fly away. Prescribe displacements, or change the loads.");
    for (std::size_t m = 0; m < n; ++m)
      v.add(balance.settling[m], fields[m]);
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
