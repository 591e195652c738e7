// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/application/contact_problem.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// "body: boundary".
    std::pair<std::string, std::string> split_side(const std::string &text, const std::string &where)
    {
      const std::size_t colon = text.find(':');
      if (colon == std::string::npos)
        throw InputError(where + ": \"" + text + "\" should read \"body: boundary\".");
      return {Utilities::trim(text.substr(0, colon)), Utilities::trim(text.substr(colon + 1))};
    }

    double average_face_area(const ContactSurface &surface)
    {
      double area = 0.;
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        area += triangle_area(surface.mesh, t);
      return surface.faces.empty() ? 0. : area / static_cast<double>(surface.faces.size());
    }
  } // namespace



  void ContactProblem::define_pairs()
  {
    for (const PairParameters &p : parameters.pairs)
      {
        PairDefinition    definition;
        const std::string section     = "Pair " + p.name + "/";
        definition.parameters         = p;
        const std::string *sides[2]   = {&p.first, &p.second};
        const std::string *regions[2] = {&p.first_region, &p.second_region};
        const char        *names[2]   = {"First", "Second"};
        definition.has_obstacle       = !Utilities::trim(p.obstacle).empty();
        if (definition.has_obstacle)
          {
            if (!Utilities::trim(p.second).empty())
              throw InputError(section + "Obstacle: a pair has either a second surface or an obstacle.");
            if (!Utilities::trim(p.second_region).empty() || p.nonmortar == "second")
              throw InputError(section + "Obstacle: there is no second surface that \"Second region\" or "
                                         "\"Nonmortar = second\" could mean.");
            definition.obstacle = RigidObstacle(p.obstacle, section + "Obstacle");
          }
        for (unsigned int i = 0; i < definition.n_sides(); ++i)
          {
            const std::string where     = section + names[i];
            const auto [body, boundary] = split_side(*sides[i], where);
            definition.body[i]          = bodies.body_index(body, where);
            definition.boundary[i]      = boundary;
            bodies.boundary_ids(definition.body[i], boundary, where);
            definition.has_region[i] = !Utilities::trim(*regions[i]).empty();
            if (definition.has_region[i])
              definition.region[i] = Expression(*regions[i], where + " region");
          }
        definition.has_gap = Utilities::trim(p.initial_gap) != "geometry";
        if (definition.has_gap)
          definition.gap = Expression(p.initial_gap, section + "Initial gap");
        if (definition.has_gap && definition.has_obstacle)
          throw InputError(section + "Initial gap: the obstacle gives the gap; write it as \"Obstacle = "
                                     "function: ...\" to prescribe it.");
        if (p.gap == "nodal" && !definition.has_gap && !definition.has_obstacle)
          throw InputError(section + "Gap: nodal gaps need an obstacle or a prescribed initial gap.");
        if (p.contact == "tied" && definition.has_obstacle)
          throw InputError(
              section + "Contact: a body cannot be tied to an obstacle; prescribe its displacement instead.");
        if (p.contact != "tied" && is_linear(parameters.solver.method))
          throw InputError(section +
                           "Contact: the solvers multigrid and multigrid cg (Solver/Method) are for linear "
                           "problems. Choose accelerated, or tie the pair.");
        if (p.penetration != "resolve" && p.penetration != "refuse")
          throw InputError(section + "Initial penetration: use resolve or refuse.");
        pair_definitions.push_back(definition);
      }
  }



  unsigned int ContactProblem::choose_nonmortar(const PairDefinition &definition,
                                                const ContactSurface (&surfaces)[2])
  {
    const double young[2] = {parameters.bodies[definition.body[0]].young,
                             parameters.bodies[definition.body[1]].young};
    unsigned int softer   = 0;
    if (std::abs(young[0] - young[1]) > 1e-6 * std::max(young[0], young[1]))
      softer = young[0] < young[1] ? 0 : 1;
    else
      softer = average_face_area(surfaces[0]) <= average_face_area(surfaces[1]) * (1. + 1e-9) ? 0 : 1;
    if (definition.parameters.nonmortar == "auto")
      {
        note("pair " + definition.parameters.name + ": \"" + bodies.body_name(definition.body[softer]) +
             "\" is the nonmortar side (the softer body, then the finer mesh).");
        return softer;
      }
    const unsigned int chosen = definition.parameters.nonmortar == "first" ? 0 : 1;
    if (young[chosen] > 10. * young[1 - chosen])
      note("warning: pair " + definition.parameters.name +
           ": the nonmortar side is the stiffer body; the contact nodes need a direct solver this way.");
    return chosen;
  }



  ContactPair ContactProblem::make_pair(const PairDefinition &definition, CycleResult &cycle)
  {
    Discretization &d = discretization;
    Timer           time;
    ContactSurface  surfaces[2];
    for (unsigned int i = 0; i < definition.n_sides(); ++i)
      {
        surfaces[i] = extract_contact_surface(
            *d.space, bodies.boundary_ids(definition.body[i], definition.boundary[i]),
            [&](const NodeIndex node) {
              return d.dirichlet.mask[d.space->relevant().index_within_set(node)];
            },
            definition.has_region[i] ? [&](const Point<3> &p) { return definition.region[i](p) > 0.; }
                                     : std::function<bool(const Point<3> &)>());
        if (surfaces[i].faces.empty())
          throw InputError("Pair " + definition.parameters.name + ": the boundary \"" +
                           definition.boundary[i] + "\" of body \"" + bodies.body_name(definition.body[i]) +
                           "\" has no faces in its region.");
      }

    const unsigned int non = definition.has_obstacle ? 0 : choose_nonmortar(definition, surfaces);
    ContactPair        pair;
    pair.name           = definition.parameters.name;
    pair.nonmortar_body = definition.body[non];
    pair.mortar_body    = definition.has_obstacle ? numbers::invalid_unsigned_int : definition.body[1 - non];
    pair.nonmortar_name = bodies.body_name(pair.nonmortar_body) + ": " + definition.boundary[non];
    pair.mortar_name    = definition.has_obstacle
                              ? definition.obstacle.description()
                              : bodies.body_name(pair.mortar_body) + ": " + definition.boundary[1 - non];
    pair.nonmortar      = std::move(surfaces[non]);
    pair.nonmortar_ids  = bodies.boundary_ids(definition.body[non], definition.boundary[non]);
    if (!definition.has_obstacle)
      pair.mortar_ids = bodies.boundary_ids(definition.body[1 - non], definition.boundary[1 - non]);
    pair.mortar = std::move(surfaces[1 - non]);
    if (definition.has_gap)
      pair.prescribed_gap = [gap = definition.gap](const Point<3> &p) { return gap(p); };
    cycle.times["mesh"] += time.wall_time();
    if (definition.has_obstacle)
      {
        time.restart();
        pair.obstacle = std::make_unique<RigidObstacle>(definition.obstacle);
        pair.moments  = compute_rigid_moments(pair.nonmortar, *pair.obstacle, comm);
        if (std::none_of(pair.moments.begin(), pair.moments.end(),
                         [](const FaceMoments &m) { return m.covered > 0.; }))
          throw InputError("Pair " + pair.name + ": the surface \"" + pair.nonmortar_name +
                           "\" does not face the obstacle \"" + pair.mortar_name +
                           "\" anywhere: no outward normal meets it from outside.");
        cycle.times["mortar"] += time.wall_time();
      }
    else
      map_pair(pair, cycle);
    return pair;
  }



  void ContactProblem::map_pair(ContactPair &pair, CycleResult &cycle)
  {
    Timer              time;
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    pair.mapping            = std::make_unique<ContactMapping>(
        pair.nonmortar.mesh, pair.mortar.mesh,
        [&](const unsigned int t) {
          return pair.nonmortar.faces[pair.nonmortar.triangle_face[t]].owner == rank;
        },
        comm);
    if (Utilities::MPI::sum(pair.mapping->report().n_cells, comm) == 0)
      throw InputError("Pair " + pair.name + ": the surfaces \"" + pair.nonmortar_name + "\" and \"" +
                       pair.mortar_name +
                       "\" do not face each other anywhere: there is not a single overlay cell.");
    pair.mapping_time = time.wall_time();
    cycle.times["mapping"] += pair.mapping_time;
    if (const std::string errors = describe_errors(sum_reports(pair.mapping->report(), comm));
        !errors.empty())
      note("warning: pair " + pair.name + ", cycle " + std::to_string(cycle.cycle) +
           ": the contact mapping has errors (" + errors +
           "): pressures and forces near those places are wrong. Look at the surfaces with signorini-map; a "
           "finer "
           "or smoother mesh on the bent or folded parts, or the other side as nonmortar side, helps.");

    time.restart();
    pair.moments =
        compute_face_moments(pair.nonmortar, pair.mortar, pair.mapping->overlay(), pair.prescribed_gap, comm);
    cycle.times["mortar"] += time.wall_time();
  }



  void ContactProblem::use_nodal_gaps(PairCoupling &coupling, const ContactPair &pair) const
  {
    const double size = surface_size(pair.nonmortar);
    for (std::size_t row = 0; row < coupling.gaps.size(); ++row)
      if (pair.prescribed_gap)
        coupling.gaps[row] = pair.prescribed_gap(coupling.positions[row]);
      else if (double gap; pair.obstacle->gap(gap, coupling.positions[row], coupling.normals[row], size))
        coupling.gaps[row] = gap;
  }



  void ContactProblem::setup_contact(CycleResult &cycle)
  {
    Discretization &d = discretization;
    d.pairs.clear();
    for (const PairDefinition &definition : pair_definitions)
      d.pairs.push_back(make_pair(definition, cycle));

    Timer                            time;
    std::vector<std::set<NodeIndex>> nonmortar_nodes, mortar_nodes;
    std::vector<std::string>         names;
    for (const ContactPair &pair : d.pairs)
      {
        nonmortar_nodes.push_back(touched_nonmortar_nodes(pair.nonmortar, pair.moments));
        mortar_nodes.push_back(touched_mortar_nodes(pair.mortar, pair.moments));
        names.push_back(pair.name);
      }
    const auto excluded = excluded_nodes(nonmortar_nodes, mortar_nodes);
    d.couplings.clear();
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair &pair = d.pairs[p];
        d.couplings.push_back(couple(pair.nonmortar, pair.mortar, pair.moments, excluded[p],
                                     static_cast<bool>(pair.prescribed_gap)));
        PairCoupling &c = d.couplings.back();
        if (pair_definitions[p].parameters.gap == "nodal")
          use_nodal_gaps(c, pair);
        std::map<std::string, unsigned int> reasons;
        for (const DroppedNode &node : c.dropped)
          ++reasons[to_string(node.reason)];
        for (const auto &[reason, n] : reasons)
          note("pair " + pair.name + ", cycle " + std::to_string(cycle.cycle) + ": " + std::to_string(n) +
               " nonmortar nodes without multiplier (" + reason + ").");
        if (c.lost_area > 1e-12 * c.area)
          note("pair " + pair.name + ": an area of " + std::to_string(c.lost_area) +
               " is covered but carries no multiplier.");
        const double smallest = c.gaps.empty() ? 0. : *std::min_element(c.gaps.begin(), c.gaps.end());
        double       size     = 0.;
        for (const Point<3> &x : c.positions)
          size = std::max(size, x.distance(c.positions[0]));
        // Faceted curved surfaces overlap by rounding and by their sagitta; report what exceeds rounding.
        if (smallest < -1e-12 * size && cycle.cycle == 0 && pair_definitions[p].parameters.contact != "tied")
          {
            std::ostringstream text;
            text << "pair " << pair.name << ": initial penetration of " << -smallest << " (weighted gap)";
            if (pair_definitions[p].parameters.penetration == "refuse")
              throw InputError(text.str() + "; \"Initial penetration = refuse\" does not allow it.");
            note(text.str() + ", resolved as an interference fit.");
          }
      }
    d.origin = join_couplings(d.coupling, d.couplings, names);
    d.row_masks.clear();
    d.normals.clear();
    d.gaps.clear();
    d.tied.clear();
    for (const auto &[p, row] : d.origin)
      {
        d.tied.push_back(pair_definitions[p].parameters.contact == "tied");
        d.row_masks.push_back(d.couplings[p].fixed[row]);
        d.normals.push_back(d.couplings[p].normals[row]);
        d.gaps.push_back(d.couplings[p].gaps[row]);
      }
    tie_lift();
    d.transformation =
        std::make_unique<BasisTransformation>(*d.space, *d.partition, d.dirichlet, d.coupling, d.row_masks);
    cycle.times["mortar"] += time.wall_time();
  }
} // namespace Signorini
