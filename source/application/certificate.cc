// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/certificate.h>
#include <signorini/application/pair_fields.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/output/final_words.h>
#include <signorini/surface/mapping_quality.h>

#include <iomanip>
#include <limits>
#include <map>
#include <sstream>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    std::string text_of(const double x)
    {
      std::ostringstream text;
      text << std::setprecision(3) << x;
      return text.str();
    }

    /// Of the surfaces with contact nodes.
    double largest_width(const Discretization &d)
    {
      double size = 0.;
      for (const PairCoupling &coupling : d.couplings)
        size = std::max(size, width_of_rows(coupling, d.nodal().communicator()));
      return size;
    }

    /// Of contact nodes.
    double largest_coordinate(const Discretization &d)
    {
      double largest = 0.;
      for (const PairCoupling &coupling : d.couplings)
        for (const Point<3> &x : coupling.positions)
          for (unsigned int c = 0; c < dim; ++c)
            largest = std::max(largest, std::abs(x[c]));
      return Utilities::MPI::max(largest, d.nodal().communicator());
    }

    /// What a problem is measured by: largest displacement (length), and the stress and the force of such a
    /// displacement over the width of the contact surfaces; what rounding leaves of the approach of a pair
    /// (length); the largest approach of all pairs (length).
    struct Scales
    {
      double displacement, stress, force, rounding, approach = 0.;

      Scales(const Bodies &bodies, const Discretization &d, const Vector &u,
             const std::vector<PairResult> &pairs)
        : displacement(u.linfty_norm())
        , rounding(std::max(CertificateRule().rounding * displacement,
                            16. * std::numeric_limits<double>::epsilon() * largest_coordinate(d)))
      {
        const double width = largest_width(d), product = bodies.largest_modulus() * displacement;
        stress = width > 0. ? product / width : 0.;
        force  = product * width;
        for (const PairResult &pair : pairs)
          if (!is_idle(pair))
            approach = std::max(approach, pair.approach);
      }

      /// Whether a pair touches with forces of rounding only (of ties nothing is known): gaps of rounding
      /// are large beside what it does.
      bool is_idle(const PairResult &pair) const
      {
        return pair.approach > 0. && pair.approach <= rounding;
      }
    };

    /// How well the discrete conditions hold at the contact nodes.
    void add_conditions(Certificate &c, const Discretization &d, const ContactStress &stress,
                        const Scales &scales)
    {
      double largest = 0., tension = 0., penetration = 0., product = 0.;
      for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
        {
          if (d.tied[row] || !d.owns_row(row))
            continue;
          // What is left of the pressure where nothing touches is rounding, and no scale.
          if (stress.active[row])
            largest = std::max(largest, stress.pressure[row]);
          tension     = std::max(tension, -stress.pressure[row]);
          penetration = std::max(penetration, -stress.opening[row]);
          product     = std::max(product, std::abs(stress.pressure[row] * stress.opening[row]));
        }
      for (double *const value : {&largest, &tension, &penetration, &product})
        *value = Utilities::MPI::max(*value, d.nodal().communicator());
      // Where nothing touches, or only with pressures that are rounding: the stress of such displacements
      // over such a length.
      const double u     = scales.displacement,
                   scale = largest > CertificateRule().rounding * scales.stress ? largest : scales.stress;
      c.penetration      = u > 0. ? penetration / u : 0.;
      c.tension          = scale > 0. ? tension / scale : 0.;
      c.complementarity  = u > 0. && scale > 0. ? product / (scale * u) : 0.;
    }

    void add_pair(Certificate &c, const PairResult &pair, const bool has_obstacle, const Scales &scales)
    {
      if (scales.is_idle(pair))
        return;
      // An obstacle takes what the body gives.
      // The forces on a closed surface may add up to nothing: their norm is no scale.
      const double scale_of_forces = std::max(pair.load, pair.force.norm());
      if (scale_of_forces > 0. && !has_obstacle)
        c.force_balance =
            std::max(c.force_balance, (pair.force + pair.force_on_mortar).norm() / scale_of_forces);
      if (pair.approach > 0.)
        {
          c.geometric_penetration =
              std::max(c.geometric_penetration, pair.spot_penetration / pair.spot_approach);
          c.loaded_gap = std::max(c.loaded_gap, pair.loaded_gap / pair.approach);
          c.gap_doubt  = std::max(c.gap_doubt, pair.gap_doubt / pair.approach);
        }
      c.moment_balance = std::max(c.moment_balance, pair.moment_balance);
    }

  } // namespace



  std::size_t lost_edge_near(const ContactPair &pair, const PairCoupling &coupling,
                             const std::vector<unsigned char> &active)
  {
    std::size_t result = pair.lost_edges.size();
    if (pair.lost_edges.empty())
      return result;
    const ContactSurface         &mortar = pair.mortar.surface;
    std::map<NodeIndex, Point<3>> positions;
    for (unsigned int v = 0; v < mortar.vertex_node.size(); ++v)
      positions[mortar.vertex_node[v]] = mortar.mesh.vertices[v];
    for (std::size_t row = 0; row < active.size(); ++row)
      if (active[row])
        {
          const Point<3> &here  = coupling.positions[row];
          double          reach = 2. * std::sqrt(coupling.areas[row]);
          for (const auto *entry = coupling.coupling.begin(row); entry != coupling.coupling.end(row); ++entry)
            if (const auto column = positions.find(entry->node); column != positions.end())
              reach = std::max(reach, here.distance(column->second));
          for (std::size_t e = 0; e < result; ++e)
            if (const ContactPair::LostEdge &edge = pair.lost_edges[e];
                edge.middle.distance(here) < .5 * edge.length + reach)
              result = e;
        }
    return result;
  }



  namespace
  {
    /// Errors of a mapping where bodies touch.
    struct ErrorsInContact
    {
      /// In words, with the place of one; empty if there are none.
      std::string text;
      /// Their area, and the pressure on it (area, force); infinite if pieces are lost whose area is not
      /// known.
      double area = 0., force = 0.;
    };

    /// Those at faces in contact or up to two faces away; elsewhere a note must do.
    ErrorsInContact errors_in_contact(const Discretization &d, const ContactStress &stress,
                                      const unsigned int p)
    {
      const ContactPair &pair = d.pairs[p];
      if (!pair.mapping)
        return {};
      const MappingReport        report  = sum_reports(pair.mapping->report(), d.nodal().communicator());
      const auto                 active  = stress_of_pair(d, stress, p).active;
      std::vector<unsigned char> is_near = spread_rows(d.couplings[p], *pair.halo, active);
      const auto                 touches = [&](const auto &vertices) {
        return std::any_of(vertices.begin(), vertices.end(),
                                           [&](const unsigned int v) { return is_near[v] != 0; });
      };
      for (unsigned int ring = 0; ring < 2; ++ring)
        {
          std::vector<unsigned int> found;
          for (const ContactSurface::Face &face : pair.nonmortar.surface.faces)
            if (touches(face.corners))
              found.insert(found.end(), face.corners.begin(), face.corners.end());
          for (const unsigned int v : found)
            is_near[v] = 1;
          pair.halo->update(is_near);
        }
      const std::vector<double> pressure =
          spread_rows(d.couplings[p], *pair.halo, stress_of_pair(d, stress, p).pressure);
      struct Error
      {
        std::size_t number;
        double      area, force;
        /// The least of its vertices.
        std::array<double, 3> place;
      };
      const auto &x           = pair.nonmortar.surface.mesh.vertices;
      const auto  coordinates = [&](const unsigned int v) {
        return std::array<double, 3>{{x[v][0], x[v][1], x[v][2]}};
      };
      std::vector<Error> places;
      for (const ContactPair::WrongPlace &place : pair.wrong_places)
        if (touches(place.vertices))
          {
            double largest = 0.;
            auto   least   = coordinates(place.vertices[0]);
            for (const unsigned int v : place.vertices)
              {
                largest = std::max(largest, pressure[v]);
                least   = std::min(least, coordinates(v));
              }
            places.push_back({place.number, place.area, largest * place.area, least});
          }
      // Several ranks may know of one, each of some of its vertices.
      std::map<std::size_t, Error> errors;
      for (const Error &one : gather_lists(std::move(places), d.nodal().communicator(), Receivers::all))
        {
          Error &error = errors.insert({one.number, one}).first->second;
          error.force  = std::max(error.force, one.force);
          error.place  = std::min(error.place, one.place);
        }
      ErrorsInContact result;
      Point<3>        place;
      double          largest = -1.;
      for (const auto &[number, error] : errors)
        {
          result.area += error.area;
          result.force += error.force;
          if (error.force > largest)
            place = Point<3>(error.place[0], error.place[1], error.place[2]);
          largest = std::max(largest, error.force);
        }
      const std::size_t lost =
          Utilities::MPI::min(lost_edge_near(pair, d.couplings[p], active), d.nodal().communicator());
      if (lost < pair.lost_edges.size())
        {
          result.area = std::numeric_limits<double>::infinity();
          place       = pair.lost_edges[lost].middle;
        }
      if (result.area > 0.)
        result.text = describe_errors(report) + ", here at " + place_text(place);
      return result;
    }

    /// Why the discrete solution is not one.
    void object_to_solver(Certificate &c, const SolverOutcome &solver, const bool has_forces)
    {
      const CertificateRule rule;
      if (!solver.has_converged)
        c.objections.push_back("the iteration did not converge; see convergence.csv");
      const double asked       = 10. * solver.tolerance;
      const double equilibrium = has_forces ? c.equilibrium : 0.;
      if (c.penetration > std::max(rule.penetration, asked) || c.tension > std::max(rule.tension, asked) ||
          equilibrium > std::max(rule.equilibrium, asked))
        c.objections.push_back("the solver left " +
                               text_of(std::max({c.penetration, c.tension, equilibrium})) +
                               " of penetration, tension or forces; try a smaller Solver/Tolerance");
      if (solver.has_converged && has_forces &&
          std::max({c.force_balance, c.body_force_balance, c.body_moment_balance}) >
              std::max(rule.balance, asked))
        c.objections.push_back("forces or moments on a body do not balance; please report this");
    }

    /// Why forces on one body, which may be small beside those on others, are not in equilibrium.
    void object_to_bodies(Certificate &c, const ContactModel &model, const Equilibrium &equilibrium,
                          const double tolerance)
    {
      const CertificateRule rule;
      // What is rounding on a stiff body passes to a soft one.
      const std::vector<std::size_t> linked = model.linked_bodies();
      std::vector<Equilibrium::Rest> largest(linked.size(), Equilibrium::Rest{});
      for (unsigned int b = 0; b < linked.size(); ++b)
        for (const auto entry :
             {&Equilibrium::Rest::young, &Equilibrium::Rest::displacement, &Equilibrium::Rest::size})
          largest[linked[b]].*entry = std::max(largest[linked[b]].*entry, equilibrium.of_bodies[b].*entry);
      for (unsigned int b = 0; b < equilibrium.of_bodies.size(); ++b)
        {
          const Equilibrium::Rest &rest = equilibrium.of_bodies[b], &group = largest[linked[b]];
          if (rest.force > std::max(rule.balance, 10. * tolerance) * rest.scale &&
              rest.force > std::max(rule.rounding, tolerance) * group.young * group.displacement * group.size)
            c.objections.push_back(
                "body " + model.bodies().body_name(b) + ": of forces of " + text_of(rest.scale) +
                " a rest of " + text_of(rest.force) +
                " does not balance; they are small beside those on other bodies, which the "
                "iteration goes by: solve these bodies in a file of their own");
        }
    }

    /// Why the solution of the discrete problem is not that of the bodies.
    void object_to_pair(Certificate &c, const PairResult &pair, const PairModel &model,
                        const ErrorsInContact &mapping_errors, const Scales &scales)
    {
      const SurfaceKind     surface = model.definition.surface;
      const CertificateRule rule;
      const std::string     name      = "pair " + pair.name + ": ";
      const bool            is_missed = pair.missed_penetration > rule.missed_penetration * scales.approach;
      if (is_missed)
        c.objections.push_back(
            name + "the true surfaces penetrate by " + text_of(pair.missed_penetration) + " at " +
            place_text(pair.missed_at) +
            ", and no contact force acts there: the contact is narrower than the faces; "
            "refine the contact surfaces" +
            (model.definition.obstacle ? "" : ", or choose the other side as \"Nonmortar\""));
      if (!(pair.approach > 0.) || scales.is_idle(pair))
        return;
      if (pair.gap_doubt > rule.gap_doubt * pair.approach)
        c.objections.push_back(
            name + "the gap may be wrong by " + text_of(pair.gap_doubt) + ", " +
            text_of(pair.gap_doubt / pair.approach) + " of what contact does there, for the facets of the " +
            "mesh stand for the surface, most at " + place_text(pair.gap_doubt_at) +
            "; give Boundary shapes" +
            (surface == SurfaceKind::smooth      ? " or a finer start mesh"
             : surface == SurfaceKind::automatic ? ", a finer start mesh, or Surface = smooth"
                                                 : ", a finer start mesh, or Surface = automatic"));
      if (pair.spot_penetration > rule.geometric_penetration * pair.spot_approach &&
          !(is_missed && pair.spot_at == pair.missed_at))
        c.objections.push_back(
            name + "between the nodes the true surfaces penetrate by " + text_of(pair.spot_penetration) +
            ", " + text_of(pair.spot_penetration / pair.spot_approach) + " of what contact does there, at " +
            place_text(pair.spot_at) + "; refine the contact surfaces");
      if (pair.loaded_gap > rule.loaded_gap * pair.approach)
        c.objections.push_back(
            name + "contact forces act where the true surfaces are " + text_of(pair.loaded_gap) + " apart, " +
            text_of(pair.loaded_gap / pair.approach) +
            " of what contact does there; refine the contact surfaces" +
            (model.definition.obstacle ? "" : ", or choose the other side as \"Nonmortar\"") +
            ". If it stays, surfaces slide that far around a bend, which linear kinematics do not follow");
      if (mapping_errors.area > rule.wrongly_mapped * pair.contact_area ||
          mapping_errors.force > rule.wrongly_mapped * pair.load)
        c.objections.push_back(
            name + "the contact mapping has errors where the bodies touch (" + mapping_errors.text +
            "); look at the surfaces with signorini-map, or refine where they are bent or folded");
      if (pair.share_on_edges > rule.share_on_edges)
        c.objections.push_back(
            name + text_of(pair.share_on_edges) +
            " of the contact force acts at sharp edges, in the mean direction of the faces that "
            "meet there, since these faces have no other nodes: refine until they are two "
            "cells wide or more" +
            (model.definition.obstacle ? "" : ", or choose the other side as \"Nonmortar\""));
      if (pair.moment_balance > rule.moment_balance)
        c.objections.push_back(name + "the moments of the contact forces on both sides differ by " +
                               text_of(pair.moment_balance) +
                               " of force times width; refine, or give Boundary shapes");
    }

    /// Where bodies lie in each other although a pair should keep them apart.
    void object_to_unseen(Certificate &c, const ContactModel &model,
                          const std::vector<UnseenPenetration> &unseen, const Scales &scales)
    {
      const double scale = scales.approach > 0. ? scales.approach : scales.displacement;
      for (const UnseenPenetration &one : unseen)
        if (one.has_pair && one.depth > CertificateRule().missed_penetration * scale)
          c.objections.push_back(describe_unseen(model, one));
    }
  } // namespace



  Certificate certify(const ContactModel &model, const Discretization &d, const ContactSolution &solution,
                      const ContactEvaluation &evaluation, const std::vector<UnseenPenetration> &unseen,
                      const SolverOutcome &solver)
  {
    const Scales scales(model.bodies(), d, solution.displacement, evaluation.pairs);
    Certificate  c;
    add_conditions(c, d, solution.stress, scales);
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      add_pair(c, evaluation.pairs[p], d.pairs[p].obstacle.has_value(), scales);
    c.equilibrium         = evaluation.equilibrium.residual;
    c.body_force_balance  = evaluation.equilibrium.force_balance;
    c.body_moment_balance = evaluation.equilibrium.moment_balance;
    c.energy              = solution.report.energy;
    c.potential_energy =
        potential_energy(model.bodies(), d.nodal(), d.partition(), model.loads(), solution.displacement);
    // Where bodies only move all forces are rounding, or what the solver has left of them.
    const bool has_forces = evaluation.equilibrium.largest_nodal_force >
                            std::max(CertificateRule().rounding, solver.tolerance) * scales.force;
    const std::size_t n_before = c.objections.size();
    object_to_solver(c, solver, has_forces);
    if (c.objections.size() == n_before)
      object_to_bodies(c, model, evaluation.equilibrium, solver.tolerance);
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ErrorsInContact mapping_errors = errors_in_contact(d, solution.stress, p);
        if (!mapping_errors.text.empty())
          c.wrongly_mapped_pairs.push_back(p);
        object_to_pair(c, evaluation.pairs[p], model.pairs()[p], mapping_errors, scales);
      }
    object_to_unseen(c, model, unseen, scales);
    return c;
  }
} // namespace Signorini
