// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/algebra/vector_span.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/loose_motions.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/ties.h>
#include <signorini/discretization/motion_description.h>

#include <Eigen/Dense>

#include <iomanip>
#include <numeric>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct FreedomRule
    {
      /// The work of loads on a rotation that surfaces allow, relative to that of all loads with the size of
      /// the surfaces as their arm, which may come from facets: 1e-4 to 1e-2 for balls of tetrahedra.
      double work_of_facets = .05;
      /// The energy of a motion in ties, relative to what it would be if no two nodes moved together, that is
      /// not seen.
      double opposed_by_ties = 1e-11;
      /// The net force of loads on what flies away, relative to their sum, below which they may have been
      /// meant to balance: a clothes peg with tractions on the meshes of both arms had 1.5e-7.
      double nearly_balanced = .01;
      /// What there is of a motion of the size of 1 that should be zero: 1e-16 of matching surfaces of a
      /// body.
      double rounding = 1e-12;
      /// How far nodes that touch may be apart in a start from a coarser mesh, relative to the largest
      /// displacement there, and to the largest coordinate: rounding of the former (1e-14 of a block of which
      /// every second node of a side had a gap), and of the latter.
      double touching = 1e-8, touching_by_coordinates = 1e-14;
    };

    /// By motion: whether contact of any pair may oppose it, with an obstacle or with what does not move
    /// along.
    std::vector<bool> contact_may_hold(const std::vector<FreeMotion> &motions, const ContactModel &model)
    {
      std::vector<bool> result(motions.size(), false);
      for (const PairModel &pair : model.pairs())
        if (!pair.is_tied())
          {
            std::set<unsigned int> parts;
            for (const PairModel::Side &side : pair.sides)
              parts.merge(model.parts_of(side));
            for (std::size_t m = 0; m < motions.size(); ++m)
              {
                const auto n_moved = static_cast<std::size_t>(
                    std::count_if(parts.begin(), parts.end(),
                                  [&](const unsigned int part) { return motions[m].moves(part); }));
                if (n_moved > 0 && (pair.sides.size() == 1 || n_moved < parts.size()))
                  result[m] = true;
              }
          }
      return result;
    }
  } // namespace



  void check_free_parts(const ContactModel &model, const FreeParts &parts, const SolverMethod method,
                        Journal &journal)
  {
    // Ties hold parts to each other, and none that contact must hold.
    std::set<unsigned int> in_contact;
    for (const PairModel &pair : model.pairs())
      if (!pair.is_tied())
        for (const PairModel::Side &side : pair.sides)
          in_contact.merge(model.parts_of(side));
    const auto &motions = parts.motions;
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (const bool touches = std::any_of(in_contact.begin(), in_contact.end(),
                                           [&](const unsigned int part) { return motions[m].moves(part); });
          !touches || method == SolverMethod::active_set_amg)
        {
          std::vector<double> coefficients(motions.size(), 0.);
          coefficients[m] = 1.;
          throw InputError("Body " + model.bodies().body_name(motions[m].bodies[0]) +
                           "/Dirichlet: the conditions do not exclude a rigid motion (" +
                           describe_motion(motions, coefficients, model.bodies()) + ")" +
                           (!touches ? " and no boundary of what moves belongs to a contact pair"
                                     : ", which \"Solver/Method = active set amg\" needs") +
                           ". Prescribe displacements on more of its boundaries, e.g. a symmetry plane "
                           "\"name: (0, *, *)\"." +
                           model.bodies().hint_at_volumes(motions[m].bodies[0]));
        }
    std::set<std::string>   names;
    const std::vector<bool> may_be_held = contact_may_hold(motions, model);
    for (std::size_t m = 0; m < motions.size(); ++m)
      if (may_be_held[m])
        names.insert(name_of_moving(motions[m], model.bodies()));
    // Said before points were held.
    if (!names.empty() && model.point_holds().empty())
      journal.note("contact must hold " + Patterns::Tools::to_string(names) +
                   ": Dirichlet conditions alone do not.");
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
        // Motions are of the size of 1. Those of a body that touches itself are zero at its contact nodes,
        // and what is left of that by rounding is no energy that anything could be divided by.
        for (double &x : result.back())
          if (std::abs(x) < FreedomRule().rounding)
            x = 0.;
      }
    return result;
  }



  std::vector<Vector> motions_of_unknowns(const ContactModel &model, const Discretization &d,
                                          const NodePartition &unknowns)
  {
    std::vector<Vector> result = motions_of_unknowns(model, *d.constrained, unknowns, *d.transformation);
    for (Vector &motion : result)
      clear_tied_unknowns(motion, unknowns, d);
    return result;
  }



  void refuse_opposed_motions(const NodeBlockMatrix &matrix, const std::vector<Vector> &motions,
                              const ContactModel &model, const Discretization &d)
  {
    for (std::size_t m = 0; m < motions.size(); ++m)
      {
        const Vector &motion = motions[m];
        Vector        product;
        product.reinit(motion);
        matrix.vmult(product, motion);
        double if_alone = 0.;
        for (unsigned int row = 0; row < matrix.n_rows(); ++row)
          for (unsigned int c = 0; c < dim; ++c)
            if_alone += matrix.block(matrix.diagonal(row))[(dim + 1) * c] *
                        Utilities::fixed_power<2>(motion.local_element(dim * row + c));
        if_alone = Utilities::MPI::sum(if_alone, matrix.partition().communicator());
        if (motion * product <= FreedomRule().opposed_by_ties * if_alone)
          continue;
        const FreeMotion &moving = d.free_motions()[m];
        throw InputError(
            "Contact alone should hold " + name_of_moving(moving, model.bodies()) +
            (moving.parts.size() == 1 ? " (tied to itself)" : "") +
            ", but the tied surfaces are apart in places (a layer between them, or curved ones on "
            "meshes that do not match), and such ties oppose rotations that they should not. Hold "
            "one of these bodies by Dirichlet conditions, or make the tied meshes match.");
      }
  }



  namespace
  {
    /// The net load in a flight, and what it is if it is small.
    std::string describe_load(const ContactModel &model, const std::vector<FreeMotion> &motions,
                              const std::vector<double> &flight, const WorkOfLoads &loads)
    {
      if (loads.work.empty() || !(loads.sum > 0.))
        return ", would fly away.";
      const double       work = std::inner_product(flight.begin(), flight.end(), loads.work.begin(), 0.);
      const FlightLoad   load = load_of_flight(motions, flight, work, model.bodies());
      std::ostringstream text;
      text << std::setprecision(2) << ", would fly away with a net "
           << (load.moment == 0. ? "force of " : "moment of ") << load.force + load.moment;
      if (load.moment == 0. && load.force < FreedomRule().nearly_balanced * loads.sum)
        text << ", " << load.force / loads.sum
             << " of the loads and what prescribed displacements do: if the loads should balance, integrals "
                "over different meshes may be the reason. "
                "Give Forces instead of tractions and pressures, or hold one of these bodies.";
      else
        text << ".";
      return text.str();
    }
  } // namespace



  void refuse_flight(const ContactModel &model, const std::vector<FreeMotion> &motions,
                     const std::vector<double> &flight, const WorkOfLoads &loads)
  {
    throw InputError("The loads press no body into contact that could hold it: " +
                     describe_flight(motions, flight, model.bodies()) +
                     describe_load(model, motions, flight, loads) +
                     " Prescribe displacements, or change the loads.");
  }



  namespace
  {
    /// What contact and loads make of the rigid motions of free parts.
    struct RigidProblem
    {
      RigidProblem(const ContactModel &model, const Discretization &d, const NodePartition &unknowns,
                   const ObstacleProblem &problem)
        : fields(motions_of_unknowns(model, d, unknowns))
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
        return is_rotation(motions, motion) && sums[0] <= LooseMotionRule().hardly_opposed * sums[1] &&
               std::abs(done) <=
                   FreedomRule().work_of_facets * loads * std::sqrt(sums[1] / std::max(sums[2], 1.));
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



  namespace
  {
    /// Collective. Gaps of a start that are none (length).
    double rounding_of_gaps(const Vector &v, const RigidProblem &rigid, const Discretization &d)
    {
      const FreedomRule rule;
      double            result = 0.;
      for (std::size_t p = 0; p < rigid.own.size(); ++p)
        result = std::max(
            {result, rule.touching * nodal_value(v, rigid.nodes[p]).norm(),
             rule.touching_by_coordinates * d.nodal().position(d.coupling.rows[rigid.own[p]]).norm()});
      return Utilities::MPI::max(result, d.nodal().communicator());
    }
  } // namespace



  std::vector<double> settle_free_parts(Vector &v, const ContactModel &model, const Discretization &d,
                                        const NodePartition &unknowns, const ObstacleProblem &problem)
  {
    const RigidProblem  rigid(model, d, unknowns, problem);
    const std::size_t   n      = rigid.fields.size();
    std::vector<double> bounds = select_values(d.transformation->reduce_gaps(d.gaps), rigid.own);
    std::vector<double> rows   = rigid.rows;
    // What touches may hold the bodies where they are.
    const double        rounding = rounding_of_gaps(v, rigid, d);
    std::vector<double> touching_rows, touching_gaps;
    for (std::size_t p = 0; p < rigid.own.size(); ++p)
      {
        bounds[p] -= rigid.directions[p] * nodal_value(v, rigid.nodes[p]);
        if (bounds[p] > rounding)
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
      refuse_flight(model, d.free_motions(), balance.flight, {rigid.work, rigid.loads});
    for (std::size_t m = 0; m < n; ++m)
      v.add(balance.settling[m], rigid.fields[m]);
    return {};
  }
} // namespace Signorini
