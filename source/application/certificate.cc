// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// The certificate: whether the contact conditions hold, of the solver and of the true bodies.

#include <signorini/application/contact_problem.h>
#include <signorini/mortar/geometric_penetration.h>
#include <signorini/surface/mapping_quality.h>

#include <iomanip>
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

    double largest_modulus(const std::vector<BodyParameters> &bodies)
    {
      double young = 0.;
      for (const BodyParameters &body : bodies)
        young = std::max(young, body.young);
      return young;
    }

    /// Of the surfaces with contact nodes.
    double largest_width(const std::vector<PairCoupling> &couplings)
    {
      double size = 0.;
      for (const PairCoupling &coupling : couplings)
        for (const Point<3> &x : coupling.positions)
          size = std::max(size, x.distance(coupling.positions[0]));
      return size;
    }
  } // namespace



  void ContactProblem::measure_contact(PairResult &result, const unsigned int p,
                                       const std::vector<bool> &is_active, const ContactForces &forces) const
  {
    const ContactPair &pair = discretization.pairs[p];
    if (!(result.contact_area > 0.) || pair_definitions[p].parameters.contact == "tied")
      return;
    const auto compliance = [&](const unsigned int body) {
      const Material &m = bodies.material_of_body(body);
      return (1. - m.poisson * m.poisson) / m.young;
    };
    // As in Hertz' contact, from the mean pressure: single peaks of a wrong one must not hide it.
    const double width = std::sqrt(result.contact_area);
    result.approach    = 4. / 3. * result.load / width *
                      (compliance(pair.nonmortar_body) + (pair.obstacle ? 0. : compliance(pair.mortar_body)));
    if (!pair.prescribed_gap)
      result.gap_doubt = pair.obstacle ? sample_gap_doubt(pair.nonmortar, is_active, comm)
                                       : sample_gap_doubt(pair.nonmortar, pair.mortar,
                                                          pair.mapping->overlay(), is_active, comm);
    // With a prescribed gap the surfaces need not lie where they touch.
    if (!pair.obstacle && !pair.prescribed_gap && result.load > 0.)
      result.moment_balance = (forces.nonmortar.moment + forces.mortar.moment).norm() / (result.load * width);
  }



  void ContactProblem::certify()
  {
    Discretization &d       = discretization;
    Certificate    &c       = results.certificate;
    const double    u       = d.displacement.linfty_norm();
    double          largest = 0., tension = 0., penetration = 0., product = 0.;
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      {
        if (d.tied[row])
          continue;
        // What is left of the pressure where nothing touches is rounding, and no scale.
        if (d.active[row])
          largest = std::max(largest, d.pressure[row]);
        tension     = std::max(tension, -d.pressure[row]);
        penetration = std::max(penetration, -d.opening[row]);
        product     = std::max(product, std::abs(d.pressure[row] * d.opening[row]));
      }
    // Where nothing touches: the stress of such displacements over such a length.
    const double young = largest_modulus(parameters.bodies), size = largest_width(d.couplings);
    const double scale = largest > 0. ? largest : size > 0. ? young * u / size : 0.;
    c.penetration      = u > 0. ? penetration / u : 0.;
    c.tension          = scale > 0. ? tension / scale : 0.;
    c.complementarity  = u > 0. && scale > 0. ? product / (scale * u) : 0.;
    c.energy           = results.cycles.back().nonlinear.energy;
    c.potential_energy = potential_energy(bodies, *d.space, *d.partition, loads, d.displacement);
    results.cycles.back().potential_energy = c.potential_energy;
    for (const PairResult &pair : results.pairs)
      {
        // An obstacle takes what the body gives.
        // The forces on a closed surface may add up to nothing: their norm is no scale.
        const double scale_of_forces = std::max(pair.load, pair.force.norm());
        if (scale_of_forces > 0. && !d.pairs[&pair - results.pairs.data()].obstacle)
          c.force_balance =
              std::max(c.force_balance, (pair.force + pair.force_on_mortar).norm() / scale_of_forces);
        if (pair.approach > 0.)
          {
            c.geometric_penetration = std::max(c.geometric_penetration, pair.max_penetration / pair.approach);
            c.gap_doubt             = std::max(c.gap_doubt, pair.gap_doubt / pair.approach);
          }
        c.moment_balance   = std::max(c.moment_balance, pair.moment_balance);
        std::size_t active = 0;
        for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
          active += d.active[row] && results.pairs[d.origin[row].first].name == pair.name;
        if (active == 0)
          note("pair " + pair.name + ": the surfaces are separated, there is no contact force.");
      }
    object();
  }



  double ContactProblem::force_scale() const
  {
    return largest_modulus(parameters.bodies) * discretization.displacement.linfty_norm() *
           largest_width(discretization.couplings);
  }



  // Errors of the mapping at faces in contact or up to two faces away; elsewhere a note must do.
  std::string ContactProblem::errors_in_contact(const unsigned int p) const
  {
    const Discretization &d    = discretization;
    const ContactPair    &pair = d.pairs[p];
    if (!pair.mapping)
      return "";
    const MappingReport report = sum_reports(pair.mapping->report(), comm);
    std::vector<bool>   is_near(pair.nonmortar.mesh.vertices.size(), false);
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      if (d.origin[row].first == p && d.active[row])
        is_near[d.couplings[p].vertices[d.origin[row].second]] = true;
    const auto touches = [&](const auto &vertices) {
      return std::any_of(vertices.begin(), vertices.end(), [&](const unsigned int v) { return is_near[v]; });
    };
    for (unsigned int ring = 0; ring < 2; ++ring)
      {
        std::vector<unsigned int> found;
        for (const ContactSurface::Face &face : pair.nonmortar.faces)
          if (touches(face.corners))
            found.insert(found.end(), face.corners.begin(), face.corners.end());
        for (const unsigned int v : found)
          is_near[v] = true;
      }
    const SurfaceTopology &topology = pair.mapping->nonmortar_topology();
    const bool             any      = !report.lost_edges.empty() ||
                     std::any_of(report.wrong_triangles.begin(), report.wrong_triangles.end(),
                                 [&](const unsigned int t) { return touches(topology.triangles[t]); }) ||
                     std::any_of(report.torn_edges.begin(), report.torn_edges.end(),
                                 [&](const unsigned int e) { return touches(topology.edges[e]); });
    return any ? describe_errors(report) : "";
  }



  void ContactProblem::object()
  {
    const CertificateRule rule;
    Certificate          &c      = results.certificate;
    const auto            object = [&](const std::string &text) { c.objections.push_back(text); };
    if (!results.converged)
      object("the iteration did not converge; see convergence.csv");
    // What a user asked for is enough. Where bodies only move all forces are rounding.
    const double asked       = 10. * parameters.solver.tolerance;
    const bool   has_forces  = results.largest_nodal_force > rule.rounding * force_scale();
    const double equilibrium = has_forces ? c.equilibrium : 0.;
    if (c.penetration > std::max(rule.penetration, asked) || c.tension > std::max(rule.tension, asked) ||
        equilibrium > std::max(rule.equilibrium, asked))
      object("the solver left " + text_of(std::max({c.penetration, c.tension, equilibrium})) +
             " of penetration, tension or forces; try a smaller Solver/Tolerance");
    if (results.converged && has_forces &&
        std::max({c.force_balance, c.body_force_balance, c.body_moment_balance}) >
            std::max(rule.balance, asked))
      object("forces or moments on a body do not balance; please report this");
    for (unsigned int p = 0; p < results.pairs.size(); ++p)
      {
        const PairResult &pair = results.pairs[p];
        const std::string name = "pair " + pair.name + ": ";
        if (!(pair.approach > 0.))
          continue;
        if (pair.gap_doubt > rule.gap_doubt * pair.approach)
          object(name + "the gap may be wrong by " + text_of(pair.gap_doubt) + ", " +
                 text_of(pair.gap_doubt / pair.approach) +
                 " of what contact does there, for the facets of the " +
                 "mesh stand for the surface; give Boundary shapes, a finer mesh, or Surface = " +
                 (pair_definitions[p].parameters.surface == "automatic" ? "smooth" : "automatic"));
        if (pair.max_penetration > rule.geometric_penetration * pair.approach)
          object(name + "between the nodes the true surfaces penetrate by " + text_of(pair.max_penetration) +
                 ", " + text_of(pair.max_penetration / pair.approach) +
                 " of what contact does there; refine the contact surfaces");
        if (const std::string errors = errors_in_contact(p); !errors.empty())
          object(name + "the contact mapping has errors where the bodies touch (" + errors +
                 "); look at the surfaces with signorini-map, or refine where they are bent or folded");
        if (pair.moment_balance > rule.moment_balance)
          object(name + "the moments of the contact forces on both sides differ by " +
                 text_of(pair.moment_balance) + " of force times width; refine, or give Boundary shapes");
      }
  }
} // namespace Signorini
