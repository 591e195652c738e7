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

    Vector3 nodal(const Vector &field, const unsigned int i)
    {
      return Vector3(
          {field.local_element(dim * i), field.local_element(dim * i + 1), field.local_element(dim * i + 2)});
    }

    /// What is left of the forces on one body, and of their moments about its centre of nodes.
    class BodyBalance
    {
    public:
      /// A nodal force before those that balance it are taken off.
      void add_scale(const Point<3> &x, const Vector3 &force)
      {
        scale += force.norm();
        n_nodes += 1.;
        centre += Vector3(x);
        square += x.square();
      }

      void add_rest(const Point<3> &x, const Vector3 &f)
      {
        force += f;
        moment += cross_product_3d(Vector3(x), f);
      }

      /// Over all ranks. Returns the sum of the norms of the nodal forces.
      double sum(const MPI_Comm comm)
      {
        force   = Signorini::sum(force, comm);
        moment  = Signorini::sum(moment, comm);
        centre  = Signorini::sum(centre, comm);
        scale   = Utilities::MPI::sum(scale, comm);
        n_nodes = Utilities::MPI::sum(n_nodes, comm);
        square  = Utilities::MPI::sum(square, comm);
        if (n_nodes > 0.)
          centre /= n_nodes;
        return scale;
      }

      double relative_force(const double scale) const
      {
        return scale > 0. ? force.norm() / scale : 0.;
      }

      double relative_moment(const double scale) const
      {
        // Root mean square of the distances from the centre.
        const double size =
            n_nodes > 0. ? std::sqrt(std::max(0., square / n_nodes - centre.norm_square())) : 0.;
        return scale * size > 0. ? (moment - cross_product_3d(centre, force)).norm() / (scale * size) : 0.;
      }

    private:
      Vector3 force, moment, centre;
      double  scale = 0., n_nodes = 0., square = 0.;
    };
  } // namespace



  std::vector<unsigned int> ContactProblem::bodies_of_nodes() const
  {
    const Discretization     &d = discretization;
    std::vector<unsigned int> body(d.partition->n_owned(), numbers::invalid_unsigned_int);
    for (const NodalSpace::Cell &cell : d.space->cells())
      for (const NodeIndex node : d.space->nodes(cell))
        if (d.partition->owns(node))
          body[d.partition->to_local(node)] = bodies.body_of_material(cell.material);
    return body;
  }



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
        std::vector<double>  pressure(traction.size(), 0.);
        std::vector<bool>    is_active(pair.nonmortar.mesh.vertices.size(), false);
        for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
          if (d.origin[row].first == p)
            {
              pressure[d.origin[row].second]                     = d.pressure[row];
              is_active[coupling.vertices[d.origin[row].second]] = d.active[row] != 0;
            }
        const auto recovered = recover_pressure(pair.nonmortar, pair.moments, coupling, pressure);
        for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
          if (d.origin[row].first == p)
            {
              const std::size_t i = d.origin[row].second;
              traction[i]         = d.traction[row];
              result.min_pressure = std::min(result.min_pressure, d.pressure[row]);
              result.max_pressure = std::max(result.max_pressure, d.pressure[row]);
              if (d.active[row])
                {
                  result.contact_area += coupling.areas[i];
                  result.load += coupling.areas[i] * d.pressure[row];
                  result.centre += coupling.areas[i] * d.pressure[row] * Vector3(coupling.positions[i]);
                }
              results.pressure.push_back({coupling.positions[i], coupling.areas[i], d.pressure[row],
                                          recovered[coupling.vertices[i]],
                                          coupling.mean_gap(i, d.opening[row]), d.active[row] != 0});
            }
        if (result.load > 0.)
          result.centre /= result.load;
        const ContactForces forces = compute_contact_forces(pair.nonmortar, pair.mortar, coupling, traction);
        result.force               = forces.nonmortar.force;
        result.force_on_mortar     = pair.obstacle ? -forces.nonmortar.force : forces.mortar.force;
        result.moment              = forces.nonmortar.moment;
        measure_contact(result, p, is_active, forces);

        const auto displaced = vertex_values(pair.nonmortar, *d.partition, d.displacement);
        const auto penetration =
            pair.obstacle
                ? sample_rigid_penetration(pair.nonmortar, *pair.obstacle, displaced, comm)
                : sample_geometric_penetration(
                      {pair.nonmortar, pair.mortar, pair.mapping->overlay()}, displaced,
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
    const std::vector<unsigned int> body_of_node = bodies_of_nodes();
    std::vector<BodyBalance>        balance(bodies.n_bodies());
    for (unsigned int i = 0; i < d.partition->n_owned(); ++i)
      if (body_of_node[i] != numbers::invalid_unsigned_int)
        balance[body_of_node[i]].add_scale(d.space->position(d.partition->to_global(i)), nodal(residual, i));
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
        Vector3 rest;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double f = residual.local_element(dim * i + c);
            if (d.dirichlet.condition[r][c] >= 0)
              reactions[d.dirichlet.condition[r][c]][c] += f;
            else
              {
                unbalanced += f * f;
                rest[c] = f;
              }
          }
        if (body_of_node[i] != numbers::invalid_unsigned_int)
          balance[body_of_node[i]].add_rest(d.space->position(d.partition->to_global(i)), rest);
      }
    results.largest_nodal_force = scale;
    double largest              = 0.;
    for (BodyBalance &b : balance)
      largest = std::max(largest, b.sum(comm));
    for (const BodyBalance &b : balance)
      {
        results.certificate.body_force_balance =
            std::max(results.certificate.body_force_balance, b.relative_force(largest));
        results.certificate.body_moment_balance =
            std::max(results.certificate.body_moment_balance, b.relative_moment(largest));
      }
    results.certificate.equilibrium =
        scale > 0. ? std::sqrt(Utilities::MPI::sum(unbalanced, comm)) / scale : 0.;
    for (std::size_t i = 0; i < reactions.size(); ++i)
      results.boundaries.push_back(
          {bodies.body_name(loads.dirichlet[i].body), loads.dirichlet[i].boundary, sum(reactions[i], comm)});
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
