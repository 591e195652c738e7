// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/input_error.h>
#include <signorini/algebra/replicated_data.h>
#include <signorini/application/contact_problem.h>
#include <signorini/discretization/element.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/geometric_penetration.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    Vector3 sum(const Vector3 &v, const MPI_Comm comm)
    {
      Vector3 result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = Utilities::MPI::sum(v[c], comm);
      return result;
    }
  } // namespace



  void ContactProblem::collect_pairs()
  {
    Discretization &d = discretization;
    results.pairs.clear();
    results.pressure.clear();
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair  &pair     = d.pairs[p];
        const PairCoupling &coupling = d.couplings[p];
        PairResult          result;
        result.name          = pair.name;
        result.nonmortar     = pair.nonmortar_name;
        result.mortar        = pair.mortar_name;
        result.coverage      = coupling.area > 0. ? coupling.covered_area / coupling.area : 0.;
        result.lost_area     = coupling.lost_area;
        result.dropped_nodes = coupling.dropped.size();
        result.min_pressure  = std::numeric_limits<double>::max();
        result.max_pressure  = -result.min_pressure;
        std::vector<Vector3> traction(coupling.coupling.n_rows());
        for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
          if (d.origin[row].first == p)
            {
              const std::size_t i = d.origin[row].second;
              traction[i]         = d.traction[row];
              result.min_pressure = std::min(result.min_pressure, d.pressure[row]);
              result.max_pressure = std::max(result.max_pressure, d.pressure[row]);
              if (d.active[row])
                result.contact_area += coupling.areas[i];
              results.pressure.push_back({coupling.positions[i], coupling.areas[i], d.pressure[row],
                                          d.opening[row], d.active[row] != 0});
            }
        const ContactForces forces = compute_contact_forces(pair.nonmortar, pair.mortar, coupling, traction);
        result.force               = forces.nonmortar.force;
        result.force_on_mortar     = pair.obstacle ? -forces.nonmortar.force : forces.mortar.force;
        result.moment              = forces.nonmortar.moment;

        const auto displaced = vertex_values(pair.nonmortar, *d.partition, d.displacement);
        const auto penetration =
            pair.obstacle
                ? sample_rigid_penetration(pair.nonmortar, *pair.obstacle, displaced, comm)
                : sample_geometric_penetration(
                      pair.nonmortar, pair.mortar, pair.mapping->overlay(), displaced,
                      vertex_values(pair.mortar, *d.partition, d.displacement), pair.prescribed_gap, comm);
        result.min_gap             = penetration.min_gap;
        result.max_penetration     = std::max(0., penetration.max_penetration());
        result.initial_penetration = std::max(0., -penetration.min_initial_gap);
        if (result.min_pressure > result.max_pressure)
          result.min_pressure = result.max_pressure = 0.;
        results.pairs.push_back(result);
      }
  }



  void ContactProblem::collect_reactions()
  {
    Discretization &d        = discretization;
    Vector          residual = physical_residual(bodies, *d.space, *d.partition, loads, d.displacement);
    double          scale    = residual.l2_norm();
    // What is left once the contact forces are put on the other side.
    const auto subtract = [&](const NodeIndex node, const Vector3 &force) {
      if (d.partition->owns(node))
        for (unsigned int c = 0; c < dim; ++c)
          residual.local_element(dim * d.partition->to_local(node) + c) -= force[c];
    };
    for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
      {
        const Vector3 force = d.coupling.weight[row] * d.traction[row];
        subtract(d.coupling.rows[row], -force);
        for (const auto *entry = d.coupling.begin(row); entry != d.coupling.end(row); ++entry)
          subtract(entry->node, entry->weight * force);
      }
    std::vector<Vector3> reactions(loads.dirichlet.size());
    double               unbalanced = 0.;
    for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
      {
        const std::size_t r = d.space->relevant().index_within_set(d.partition->to_global(i));
        if (d.space->hanging_nodes().is_constrained(d.partition->to_global(i)))
          continue;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double f = residual.local_element(dim * i + c);
            if (d.dirichlet.condition[r][c] >= 0)
              reactions[d.dirichlet.condition[r][c]][c] += f;
            else
              unbalanced += f * f;
          }
      }
    results.certificate.equilibrium =
        scale > 0. ? std::sqrt(Utilities::MPI::sum(unbalanced, comm)) / scale : 0.;
    for (std::size_t i = 0; i < reactions.size(); ++i)
      results.boundaries.push_back(
          {bodies.body_name(loads.dirichlet[i].body), loads.dirichlet[i].boundary, sum(reactions[i], comm)});
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
    double young = 0., size = 0.;
    for (const BodyParameters &body : parameters.bodies)
      young = std::max(young, body.young);
    for (const PairCoupling &coupling : d.couplings)
      for (const Point<3> &x : coupling.positions)
        size = std::max(size, x.distance(coupling.positions[0]));
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
        if (pair.force.norm() > 0. && !d.pairs[&pair - results.pairs.data()].obstacle)
          c.force_balance =
              std::max(c.force_balance, (pair.force + pair.force_on_mortar).norm() / pair.force.norm());
        if (u > 0. && pair_definitions[&pair - results.pairs.data()].parameters.contact != "tied")
          c.geometric_penetration = std::max(c.geometric_penetration, pair.max_penetration / u);
        std::size_t active = 0;
        for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
          active += d.active[row] && results.pairs[d.origin[row].first].name == pair.name;
        if (active == 0)
          note("pair " + pair.name + ": the surfaces are separated, there is no contact force.");
      }
  }



  void ContactProblem::compare_with_exact(CycleResult &cycle)
  {
    Discretization &d = discretization;
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      if (const std::string &text = parameters.exact_displacements[b]; !text.empty())
        {
          const std::string         where   = "Body " + bodies.body_name(b) + "/Exact displacement";
          const auto                entries = split_vector(text, where);
          std::array<Expression, 3> exact;
          for (unsigned int c = 0; c < dim; ++c)
            exact[c] = Expression(entries[c], where);
          cycle.exact_errors[bodies.body_name(b)] =
              compute_exact_error(bodies, b, *d.space, *d.partition, d.displacement, exact);
        }
  }



  void ContactProblem::collect_probes()
  {
    Discretization &d = discretization;
    for (unsigned int b = 0; b < bodies.n_bodies(); ++b)
      for (const auto &[name, text] :
           split_named_entries(parameters.probes[b], "Body " + bodies.body_name(b) + "/Probes"))
        {
          const std::string where   = "Body " + bodies.body_name(b) + "/Probes, \"" + name + "\"";
          const auto        entries = split_vector(text, where);
          Point<3>          point;
          for (unsigned int c = 0; c < dim; ++c)
            point[c] = Expression(entries[c], where)(Point<3>());
          // The cell whose reference coordinates of the point stick out least.
          double  best = std::numeric_limits<double>::max();
          Vector3 value;
          for (const NodalSpace::Cell &cell : d.space->cells())
            if (cell.is_owned && bodies.body_of_material(cell.material) == b)
              {
                const Element element(*d.space, cell);
                const double  reach = element.diameter();
                if (point.distance(element.corner(0)) > 2. * reach)
                  continue;
                Point<3> reference;
                if (!element.invert_map(reference, point))
                  continue;
                const double outside = element.outside(reference);
                if (outside >= best)
                  continue;
                best              = outside;
                value             = Vector3();
                const auto values = element.shape_values(reference);
                for (unsigned int v = 0; v < cell.n_vertices; ++v)
                  for (unsigned int c = 0; c < dim; ++c)
                    value[c] += values[v] * d.displacement.local_element(
                                                dim * d.partition->to_local(d.space->nodes(cell)[v]) + c);
              }
          const auto nearest = Utilities::MPI::min_max_avg(best, comm);
          if (!(nearest.min < .05))
            throw InputError(where + ": the point lies outside of the body.");
          const bool mine = Utilities::MPI::this_mpi_process(comm) == nearest.min_index;
          results.probes.push_back(
              {bodies.body_name(b) + ": " + name, point, sum(mine ? value : Vector3(), comm)});
        }
  }



  void ContactProblem::finish()
  {
    collect_pairs();
    collect_reactions();
    collect_probes();
    certify();
  }
} // namespace Signorini
