// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "motion_columns.h"

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/free_bodies.h>
#include <signorini/application/journal.h>
#include <signorini/application/loose_motions.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/point_holds.h>
#include <signorini/discretization/motion_description.h>

#include <algorithm>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    struct PointHoldRule
    {
      /// Of nodes whose motions differ by less than this share the first one is taken: the choice must not
      /// depend on rounding, on symmetric meshes.
      double alike = 1e-3;
      /// The largest moment of a hold, relative to that of the contact force with the size of the surfaces as
      /// its arm. A ball in a socket: 1.3e-2 with 12 faces around it, 3e-3 with 40; a force that misses the
      /// centre of the ball: its arm over the radius.
      double drifting = .05;
      /// The same of motions that the surfaces oppose by next to nothing: normal parts are 1e-5 of these at
      /// most (LooseMotionRule::next_to_nothing), and so are tangential parts of the contact forces.
      double unopposed = 1e-4;
      /// The force of a hold of a motion along an obstacle, relative to that, and in the turn of normals
      /// within a face: a node carries all at a place up to half a face away from where the bodies touch, and
      /// its normal is turned by as much.
      double sliding = .6;
      /// Displacements of this share of those that they are a part of may be rounding.
      double rounding = 1e-8;
      /// By what share of the largest displacement a point may be held beside where the body would be.
      double settled = .005;
    };

    /// Where a node may be held.
    struct Candidate
    {
      unsigned int start_vertex;
      Point<3>     position;
      int          part;
      /// Whether nothing is prescribed there; else only what the conditions leave is moved, along axes.
      bool is_free;
    };

    std::set<NodeIndex> nodes_of_boundaries(const NodalSpace &space, const std::set<types::boundary_id> &ids)
    {
      std::set<NodeIndex> nodes;
      for (const NodalSpace::BoundaryFace &face : space.boundary_faces())
        if (ids.count(face.id) > 0)
          {
            const NodalSpace::Cell &cell = space.cells()[face.cell];
            for (const unsigned int v : CellShape::face(cell.n_vertices, face.face))
              nodes.insert(space.nodes(cell)[v]);
          }
      return nodes;
    }

    std::set<types::boundary_id> contact_boundaries(const ContactModel &model)
    {
      std::set<types::boundary_id> ids;
      for (const PairModel &pair : model.pairs())
        for (const PairModel::Side &side : pair.sides)
          ids.insert(side.ids.begin(), side.ids.end());
      return ids;
    }

    /// Those on which something acts.
    std::set<types::boundary_id> boundaries_in_use(const ContactModel &model)
    {
      std::set<types::boundary_id> ids = contact_boundaries(model);
      for (const Traction &traction : model.loads().tractions)
        ids.insert(traction.ids.begin(), traction.ids.end());
      for (const RigidFaceCondition &rigid : model.loads().rigid_faces)
        ids.insert(rigid.ids.begin(), rigid.ids.end());
      return ids;
    }

    /// Collective. Nodes without conditions; if there are none (in plane strain), those with some.
    std::vector<Candidate> find_candidates(const ContactModel &model, const Discretization &d)
    {
      const NodalSpace         &space  = d.nodal();
      const NodePlaces          places = node_places(model.bodies(), space);
      const std::set<NodeIndex> in_use = nodes_of_boundaries(space, boundaries_in_use(model));
      std::vector<Candidate>    result;
      for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
        {
          const NodeIndex        node   = d.partition().to_global(i);
          const std::size_t      r      = space.relevant().index_within_set(node);
          const unsigned int     vertex = space.start_vertices()[r];
          const FixedDirections &fixed  = d.dirichlet().fixed[r];
          if (vertex != StartNodes::none && places.parts[i] >= 0 && fixed.is_along_axes() && !fixed.all() &&
              !space.hanging_nodes().is_constrained(node) && in_use.count(node) == 0)
            result.push_back({vertex, places.positions[i], places.parts[i], !fixed.any()});
        }
      std::set<int> has_free;
      for (const Candidate &one : result)
        if (one.is_free)
          has_free.insert(one.part);
      const std::vector<int> with_free = gather_lists(std::vector<int>(has_free.begin(), has_free.end()),
                                                      space.communicator(), Receivers::all);
      has_free                         = std::set<int>(with_free.begin(), with_free.end());
      result.erase(
          std::remove_if(result.begin(), result.end(),
                         [&](const Candidate &one) { return !one.is_free && has_free.count(one.part) > 0; }),
          result.end());
      return result;
    }

    /// Collective. A displacement less its least squares fit by some fields; zero where next to nothing would
    /// be left.
    Vector without_fields(const std::vector<Vector> &fields, const Vector &displacement)
    {
      const auto      n = static_cast<Eigen::Index>(fields.size());
      Eigen::MatrixXd gram(n, n);
      Eigen::VectorXd work(n);
      for (Eigen::Index k = 0; k < n; ++k)
        {
          work[k] = fields[k] * displacement;
          for (Eigen::Index l = 0; l < n; ++l)
            gram(k, l) = fields[k] * fields[l];
        }
      const Eigen::VectorXd share = least_squares(gram, work);
      Vector                rest  = displacement;
      for (Eigen::Index k = 0; k < n; ++k)
        rest.add(-share[k], fields[k]);
      if (rest.linfty_norm() < PointHoldRule().rounding * displacement.linfty_norm())
        rest = 0.;
      return rest;
    }

    /// What a combination of free motions does to each part.
    std::vector<PartMotion> by_part(const std::vector<FreeMotion> &free,
                                    const std::vector<double>     &coefficients)
    {
      std::map<unsigned int, PartMotion> result;
      for (std::size_t m = 0; m < free.size(); ++m)
        for (const unsigned int part : free[m].parts)
          {
            const Vector3 rotation = coefficients[m] / free[m].length * free[m].rotation;
            PartMotion   &sum      = result[part];
            sum.part               = part;
            sum.rotation += rotation;
            sum.at_origin +=
                coefficients[m] * free[m].translation - cross_product_3d(rotation, Vector3(free[m].centre));
          }
      std::vector<PartMotion> list;
      for (const auto &entry : result)
        list.push_back(entry.second);
      return list;
    }

    /// The displacements of motions at a point, by column.
    Eigen::MatrixXd displacements(const std::vector<FreeMotion> &motions, const Eigen::MatrixXd &basis,
                                  const Point<3> &x, const int part)
    {
      Eigen::MatrixXd each = Eigen::MatrixXd::Zero(dim, basis.rows());
      for (Eigen::Index m = 0; m < basis.rows(); ++m)
        if (motions[m].moves(part))
          for (unsigned int c = 0; c < dim; ++c)
            each(c, m) = motions[m](x)[c];
      return each * basis;
    }

    /// Collective. The root mean square of motions on the surfaces of pairs that they move.
    double size_at_contact(const ContactModel &model, const Discretization &d, const Eigen::MatrixXd &basis)
    {
      const NodePlaces places  = node_places(model.bodies(), d.nodal());
      double           sums[2] = {0., 0.};
      for (const NodeIndex node : nodes_of_boundaries(d.nodal(), contact_boundaries(model)))
        if (d.partition().owns(node))
          {
            const unsigned int i = d.partition().to_local(node);
            const double       square =
                displacements(d.free_motions(), basis, places.positions[i], places.parts[i]).squaredNorm();
            sums[0] += square;
            sums[1] += square > 0.;
          }
      for (double &s : sums)
        s = Utilities::MPI::sum(s, d.nodal().communicator());
      return std::sqrt(sums[0] / std::max(sums[1], 1.));
    }

    struct Choice
    {
      Candidate    candidate;
      unsigned int component;
      /// The displacements of the motions along it.
      Eigen::VectorXd row;
    };

    /// Collective. The node and the component in which the motions are largest; none if they are zero.
    std::optional<Choice> choose(const std::vector<Candidate>  &candidates,
                                 const std::vector<FreeMotion> &motions, const Eigen::MatrixXd &basis,
                                 const MPI_Comm communicator)
    {
      constexpr PointHoldRule rule;
      double                  largest = 0.;
      for (const Candidate &one : candidates)
        largest = std::max(
            largest,
            displacements(motions, basis, one.position, one.part).rowwise().squaredNorm().maxCoeff());
      largest = Utilities::MPI::max(largest, communicator);
      if (largest <= 0.)
        return {};
      const auto component_of = [&](const Candidate &one) {
        const Eigen::VectorXd squares =
            displacements(motions, basis, one.position, one.part).rowwise().squaredNorm();
        for (unsigned int c = 0; c < dim; ++c)
          if (squares[c] >= (1. - rule.alike) * largest)
            return c;
        return static_cast<unsigned int>(dim);
      };
      unsigned int first = StartNodes::none;
      for (const Candidate &one : candidates)
        if (one.start_vertex < first && component_of(one) < dim)
          first = one.start_vertex;
      first = Utilities::MPI::min(first, communicator);
      std::vector<Candidate> chosen;
      for (const Candidate &one : candidates)
        if (one.start_vertex == first)
          chosen.push_back(one);
      chosen               = gather_lists(std::move(chosen), communicator, Receivers::all);
      const unsigned int c = component_of(chosen[0]);
      return Choice{chosen[0], c,
                    displacements(motions, basis, chosen[0].position, chosen[0].part).row(c).transpose()};
    }

    /// The motions among those of a basis that a row leaves.
    Eigen::MatrixXd without(const Eigen::MatrixXd &basis, const Eigen::VectorXd &row)
    {
      return basis * orthonormal_columns(row, row.size()).rightCols(row.size() - 1);
    }

    /// PointHold::largest_share.
    double largest_share(const Drift &drift)
    {
      constexpr PointHoldRule rule;
      switch (drift.reason)
        {
          case HoldReason::unopposed:
            return rule.unopposed;
          case HoldReason::sliding:
            return std::max(rule.drifting, rule.sliding * drift.turn);
          case HoldReason::drifting:
            break;
        }
      return rule.drifting;
    }

    /// An orthonormal basis of motions, by column.
    Eigen::MatrixXd orthonormal(const std::vector<std::vector<double>> &motions)
    {
      return orthonormal_columns(as_columns(motions), static_cast<Eigen::Index>(motions.size()));
    }
  } // namespace



  std::vector<PointHold> choose_point_holds(const ContactModel &model, const Discretization &d,
                                            const Drift &drift)
  {
    const std::vector<FreeMotion> &free       = d.free_motions();
    const std::vector<Candidate>   candidates = find_candidates(model, d);
    Eigen::MatrixXd                basis      = orthonormal(drift.motions);
    const double                   size       = size_at_contact(model, d, basis);
    std::vector<PointHold>         result;
    while (basis.cols() > 0)
      {
        const std::optional<Choice> choice = choose(candidates, free, basis, d.nodal().communicator());
        if (!choice)
          break;
        const Eigen::VectorXd held = basis * choice->row / choice->row.norm();
        PointHold             hold;
        hold.body         = model.bodies().part(choice->candidate.part).body;
        hold.start_vertex = choice->candidate.start_vertex;
        hold.component    = choice->component;
        hold.position     = choice->candidate.position;
        const std::vector<double> coefficients(held.data(), held.data() + held.size());
        hold.moves          = by_part(free, coefficients);
        hold.motion         = describe_motion(free, coefficients, model.bodies());
        hold.is_translation = is_translation(free, coefficients);
        hold.arm            = size > 0. ? choice->row.norm() / size : 0.;
        hold.largest_share  = largest_share(drift);
        result.push_back(hold);
        basis = without(basis, choice->row);
      }
    return result;
  }



  std::optional<Vector> settle_point_holds(ContactModel &model, const Discretization &d,
                                           const Vector &displacement)
  {
    const std::vector<PointHold> &holds = model.point_holds();
    if (holds.empty())
      return {};
    const NodePlaces    places = node_places(model.bodies(), d.nodal());
    std::vector<Vector> fields(holds.size());
    for (std::size_t k = 0; k < holds.size(); ++k)
      {
        fields[k].reinit(displacement);
        for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
          for (const PartMotion &one : holds[k].moves)
            if (places.parts[i] == static_cast<int>(one.part))
              {
                const Vector3 u =
                    one.at_origin + cross_product_3d(one.rotation, Vector3(places.positions[i]));
                for (unsigned int c = 0; c < dim; ++c)
                  fields[k].local_element(dim * i + c) = u[c];
              }
      }
    Vector rest = without_fields(fields, displacement);
    struct Value
    {
      std::size_t hold;
      double      value;
    };
    std::vector<Value> values;
    for (unsigned int i = 0; i < d.partition().n_owned(); ++i)
      {
        const unsigned int vertex =
            d.nodal().start_vertices()[d.nodal().relevant().index_within_set(d.partition().to_global(i))];
        for (std::size_t k = 0; k < holds.size(); ++k)
          if (vertex == holds[k].start_vertex)
            values.push_back({k, rest.local_element(dim * i + holds[k].component)});
      }
    values            = gather_lists(std::move(values), d.nodal().communicator(), Receivers::all);
    const double seen = PointHoldRule().settled * displacement.linfty_norm();
    if (std::none_of(values.begin(), values.end(),
                     [&](const Value &one) { return std::abs(one.value - holds[one.hold].value) > seen; }))
      return {};
    for (const Value &one : values)
      model.set_hold_value(one.hold, one.value);
    rest.update_ghost_values();
    return rest;
  }



  void leave_drift(const ContactModel &model, const Discretization &d, const ContactSolution &solution,
                   Journal &journal)
  {
    if (solution.drift.motions.empty())
      return;
    if (solution.displacement.size() == 0)
      refuse_flight(model, d.free_motions(), solution.drift.motions[0]);
    warn_of_facets(model, d.free_motions(), solution.drift.motions, journal);
  }
} // namespace Signorini
