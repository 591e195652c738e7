// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "nodal_contact_forces.h"

#include <signorini/algebra/collectives.h>
#include <signorini/algebra/gathered_lists.h>
#include <signorini/application/contact_evaluation.h>
#include <signorini/application/contact_spots.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/discretization/elasticity.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mesh/symmetry_planes.h>
#include <signorini/mortar/contact_forces.h>
#include <signorini/mortar/geometric_penetration.h>
#include <signorini/mortar/surface_values.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// @param pressure by row
    GeometricPenetration penetration_of(const Discretization &d, const unsigned int p,
                                        const Vector &displacement, const std::vector<double> &row_pressure,
                                        const std::vector<bool> &is_active)
    {
      const MPI_Comm     comm      = d.nodal().communicator();
      const ContactPair &pair      = d.pairs[p];
      const auto         pressure  = spread_rows(d.couplings[p], *pair.halo, row_pressure);
      const auto         displaced = vertex_values(pair.nonmortar.surface, d.partition(), displacement);
      // Ties and prescribed gaps are taken as they are.
      const std::vector<bool> doubted =
          pair.is_tied || pair.prescribed_gap ? std::vector<bool>(is_active.size(), false) : is_active;
      const ContactAtVertices contact{pressure, doubted};
      if (pair.obstacle)
        return sample_rigid_penetration(pair.nonmortar.surface, *pair.obstacle, displaced, contact,
                                        faces_of_pair(pair), comm);
      const std::vector<OverlayTriangle> overlay = covered_overlay(pair);
      const FacingSurfaces facing{pair.nonmortar.surface, pair.mortar.surface, overlay, sharp_vertices(pair)};
      const auto           mortar = vertex_values(pair.mortar.surface, d.partition(), displacement);
      return sample_geometric_penetration(facing, displaced, mortar, contact, pair.prescribed_gap, comm);
    }

    double doubt_of_gap(const ContactPair &pair, const std::vector<bool> &is_near, const MPI_Comm comm)
    {
      return pair.obstacle ? sample_gap_doubt(pair.nonmortar.surface, is_near, comm)
                           : sample_gap_doubt(pair.nonmortar.surface, pair.mortar.surface,
                                              covered_overlay(pair), is_near, comm);
    }

    /// PairResult::approach over that of a load on an area in Hertz' contact, from the mean pressure: single
    /// peaks of a wrong one must not hide it. Halves and quarters have the approach of the whole.
    double approach_of(const double load, const double area, const ContactPair &pair, const double images)
    {
      return 4. / 3. * load / std::sqrt(area) * std::sqrt(images) *
             (pair.nonmortar.material.contact_compliance() +
              (pair.obstacle ? 0. : pair.mortar.material.contact_compliance()));
    }

    /// What contact does where bodies touch.
    /// @param images of the contact, by symmetry planes
    /// @param moments sum of those on both sides
    void measure_contact(PairResult &result, const ContactPair &pair, const double images,
                         const Vector3 &moments)
    {
      if (!(result.contact_area > 0.) || pair.is_tied)
        return;
      const double width = std::sqrt(result.contact_area);
      result.approach    = approach_of(result.load, result.contact_area, pair, images);
      // With a prescribed gap the surfaces need not lie where they touch.
      if (!pair.obstacle && !pair.prescribed_gap && result.load > 0.)
        result.moment_balance = moments.norm() / (result.load * width);
    }
  } // namespace



  namespace
  {
    /// Collective. Area, load and centre of pressure of the active nodes; returns which vertices these are,
    /// around the faces of this rank.
    std::vector<bool> sum_active(PairResult &result, const ContactPair &pair, const PairCoupling &coupling,
                                 const ContactStress &stress, const MPI_Comm comm)
    {
      for (std::size_t i = 0; i < stress.active.size(); ++i)
        if (stress.active[i])
          {
            const double force = coupling.areas[i] * stress.pressure[i];
            result.contact_area += coupling.areas[i];
            result.load += force;
            result.centre += force * Vector3(coupling.positions[i]);
          }
      result.contact_area = Utilities::MPI::sum(result.contact_area, comm);
      result.load         = Utilities::MPI::sum(result.load, comm);
      result.centre       = sum(Vector3(result.centre), comm);
      if (result.load > 0.)
        result.centre /= result.load;
      const auto active = spread_rows(coupling, *pair.halo, stress.active);
      return std::vector<bool>(active.begin(), active.end());
    }

    /// Collective. PairResult::share_on_edges.
    double share_of_load_on_edges(const PairCoupling &coupling, const ContactStress &stress,
                                  const double load, const MPI_Comm comm)
    {
      double on_edges = 0.;
      for (std::size_t row = 0; row < coupling.vertices.size(); ++row)
        if (stress.active[row] && coupling.on_sharp_edge[row])
          on_edges += coupling.areas[row] * stress.pressure[row];
      on_edges = Utilities::MPI::sum(on_edges, comm);
      return load > 0. ? on_edges / load : 0.;
    }

    /// Collective. PairResult::narrow_share.
    double share_of_narrow_contact(const ContactPair &pair, const PairCoupling &coupling,
                                   const ContactStress &stress, const std::vector<bool> &is_active,
                                   const MPI_Comm comm)
    {
      const auto is_row =
          spread_rows(coupling, *pair.halo, std::vector<unsigned char>(coupling.vertices.size(), 1));
      std::vector<bool> is_wide(is_active.size(), false);
      for (const ContactSurface::Face &face : pair.nonmortar.surface.faces)
        if (std::all_of(face.corners.begin(), face.corners.end(),
                        [&](const unsigned int v) { return is_row[v] == 0 || is_active[v]; }))
          for (const unsigned int v : face.corners)
            is_wide[v] = true;
      double narrow = 0., all = 0.;
      for (std::size_t row = 0; row < coupling.vertices.size(); ++row)
        if (stress.active[row])
          {
            const double force = coupling.areas[row] * stress.pressure[row];
            all += force;
            narrow += is_wide[coupling.vertices[row]] ? 0. : force;
          }
      all = Utilities::MPI::sum(all, comm);
      return all > 0. ? Utilities::MPI::sum(narrow, comm) / all : 0.;
    }

    /// Collective. Extrema of the multipliers, and where the largest one is: at the first of several nodes.
    void find_extrema(PairResult &result, const PairCoupling &coupling, const ContactStress &stress,
                      const MPI_Comm comm)
    {
      if (coupling.n_rows_of_all == 0)
        return;
      struct Extrema
      {
        double    least, largest;
        NodeIndex node;
        Point<3>  place;
      };
      std::vector<Extrema> extrema;
      if (!stress.pressure.empty())
        {
          const auto [least, largest] = std::minmax_element(stress.pressure.begin(), stress.pressure.end());
          const auto row              = static_cast<std::size_t>(
              std::find(stress.pressure.begin(), stress.pressure.end(), *largest) - stress.pressure.begin());
          extrema.push_back({*least, *largest, coupling.coupling.rows[row], coupling.positions[row]});
        }
      extrema             = gather_lists(std::move(extrema), comm, Receivers::all);
      result.min_pressure = extrema[0].least;
      const Extrema *best = nullptr;
      for (const Extrema &one : extrema)
        {
          result.min_pressure = std::min(result.min_pressure, one.least);
          if (best == nullptr || one.largest > best->largest ||
              (one.largest == best->largest && one.node < best->node))
            best = &one;
        }
      result.max_pressure    = best->largest;
      result.max_pressure_at = best->place;
    }
  } // namespace



  namespace
  {
    /// Collective. PairResult::missed_penetration, of a gap and the place where it is.
    double missed_penetration(const LeastGap &gap, const ContactPair &pair, const PairCoupling &coupling,
                              const MPI_Comm comm)
    {
      const MissedContactRule rule;
      if (pair.is_tied || pair.prescribed_gap || coupling.n_rows_of_all == 0 || !(gap.value() < 0.))
        return 0.;
      const double width   = std::sqrt(coupling.area / static_cast<double>(coupling.n_rows_of_all));
      const auto  &surface = pair.nonmortar.surface;
      // What is known of the faces around that place; meshes are graded.
      std::vector<bool> is_near(surface.mesh.vertices.size(), false);
      for (const ContactSurface::Face &face : surface.faces)
        {
          const Point<3> &first = surface.mesh.vertices[face.corners[0]];
          double          reach = 0.;
          for (const unsigned int v : face.corners)
            reach = std::max(reach, 2. * first.distance(surface.mesh.vertices[v]));
          if (first.distance(gap.place()) <= reach)
            for (const unsigned int v : face.corners)
              is_near[v] = true;
        }
      const double missed = -gap.value() - doubt_of_gap(pair, is_near, comm);
      return missed > rule.rounding * width ? missed : 0.;
    }

    /// Collective. Penetrations by the spots that a pair touches in, and away from them.
    void look_at_spots(PairResult &result, const ContactPair &pair, const PairCoupling &coupling,
                       const ContactSpots &spots, const double images, const MPI_Comm comm)
    {
      // Forces that are rounding are none.
      LeastGap missed = spots.elsewhere;
      if (result.approach <= MissedContactRule().idle * result.max_penetration)
        missed.add(result.min_gap, result.min_gap_at);
      result.missed_penetration = missed_penetration(missed, pair, coupling, comm);
      if (result.missed_penetration > 0.)
        result.missed_at = missed.place();
      result.spot_penetration = result.max_penetration;
      result.spot_approach    = result.approach;
      result.spot_at          = result.min_gap_at;
      double largest          = 0.;
      for (const ContactSpot &spot : spots.spots)
        largest = std::max(largest, spot.load);
      for (const ContactSpot &spot : spots.spots)
        if (const double approach = approach_of(spot.load, spot.area, pair, images);
            spot.load > ContactSpotRule().least_load * largest &&
            -spot.gap.value() * result.spot_approach > result.spot_penetration * approach)
          {
            result.spot_penetration = -spot.gap.value();
            result.spot_approach    = approach;
            result.spot_at          = spot.gap.place();
          }
    }
  } // namespace



  double approach_without_images(const Discretization &d, const ContactSolution &solution,
                                 const unsigned int p)
  {
    const ContactPair &pair = d.pairs[p];
    PairResult         result;
    sum_active(result, pair, d.couplings[p], stress_of_pair(d, solution.stress, p), d.nodal().communicator());
    return result.contact_area > 0. && !pair.is_tied ? approach_of(result.load, result.contact_area, pair, 1.)
                                                     : 0.;
  }



  PairResult evaluate_pair(const Discretization &d, const ContactSolution &solution, const unsigned int p)
  {
    const ContactPair  &pair     = d.pairs[p];
    const PairCoupling &coupling = d.couplings[p];
    const ContactStress stress   = stress_of_pair(d, solution.stress, p);
    PairResult          result;
    result.name          = pair.name;
    result.nonmortar     = pair.nonmortar.name;
    result.mortar        = pair.mortar.name;
    result.coverage      = coupling.area > 0. ? coupling.covered_area / coupling.area : 0.;
    result.lost_area     = coupling.lost_area;
    const MPI_Comm comm  = d.nodal().communicator();
    result.dropped_nodes = Utilities::MPI::sum(coupling.nodes_without_multiplier().size(), comm);
    find_extrema(result, coupling, stress, comm);
    const std::vector<bool> is_active = sum_active(result, pair, coupling, stress, comm);
    if (!pair.is_tied)
      {
        result.narrow_share   = share_of_narrow_contact(pair, coupling, stress, is_active, comm);
        result.share_on_edges = share_of_load_on_edges(coupling, stress, result.load, comm);
      }
    const ContactForces forces =
        compute_contact_forces(pair.nonmortar.surface, pair.mortar.surface, coupling, stress.traction);
    result.force           = sum(forces.nonmortar.force, comm);
    result.force_on_mortar = pair.obstacle ? -result.force : sum(forces.mortar.force, comm);
    result.moment          = sum(forces.nonmortar.moment, comm);
    const double images    = std::exp2(count_symmetry_planes(pair.nonmortar.surface, is_active, comm));
    measure_contact(result, pair, images, sum(forces.nonmortar.moment + forces.mortar.moment, comm));
    const auto penetration     = penetration_of(d, p, solution.displacement, stress.pressure, is_active);
    result.min_gap             = penetration.min_gap;
    result.min_gap_at          = penetration.min_gap_at;
    result.max_penetration     = std::max(0., penetration.max_penetration());
    result.loaded_gap          = pair.prescribed_gap ? 0. : penetration.loaded_gap;
    result.gap_doubt           = penetration.gap_doubt;
    result.gap_doubt_at        = penetration.gap_doubt_at;
    result.mean_pressure       = result.contact_area > 0. ? result.load / result.contact_area : 0.;
    result.initial_penetration = std::max(0., -penetration.min_initial_gap);
    if (!pair.is_tied)
      look_at_spots(result, pair, coupling,
                    find_contact_spots(pair, coupling, stress.pressure, is_active, penetration.of_faces),
                    images, comm);
    return result;
  }



  namespace
  {
    /// Collective. @param rows those of all ranks, on rank 0
    void find_largest_recovered(PairResult &pair, const std::vector<PressureRow> &rows, const MPI_Comm comm)
    {
      for (const PressureRow &row : rows)
        if (row.recovered_pressure > pair.max_recovered_pressure)
          {
            pair.max_recovered_pressure    = row.recovered_pressure;
            pair.max_recovered_pressure_at = row.position;
          }
      std::tie(pair.max_recovered_pressure, pair.max_recovered_pressure_at) =
          broadcast_value(std::make_tuple(pair.max_recovered_pressure, pair.max_recovered_pressure_at), comm);
    }

    /// PairResult::pressure_scatter. A median: at the edge of a contact and at sharp edges of bodies the
    /// pressure is far from its mean on any mesh.
    double scatter(const std::vector<PressureRow> &rows)
    {
      std::vector<std::pair<double, double>> difference_and_load;
      double                                 load = 0.;
      for (const PressureRow &row : rows)
        if (row.active && row.pressure > 0. && row.recovered_pressure > 0.)
          {
            difference_and_load.emplace_back(std::abs(row.pressure / row.recovered_pressure - 1.),
                                             row.area * row.pressure);
            load += difference_and_load.back().second;
          }
      std::sort(difference_and_load.begin(), difference_and_load.end());
      double sum = 0.;
      for (const auto &[difference, part] : difference_and_load)
        if ((sum += part) >= .5 * load)
          return difference;
      return 0.;
    }
  } // namespace



  ContactEvaluation evaluate_contact(const ContactModel &model, const Discretization &d,
                                     const ContactSolution &solution)
  {
    ContactEvaluation result;
    result.equilibrium = evaluate_equilibrium(model, d, solution);
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        PairResult &pair = result.pairs.emplace_back(evaluate_pair(d, solution, p));
        const auto  rows = pressure_rows(model.bodies(), d, solution.stress, p);
        find_largest_recovered(pair, rows, model.communicator());
        // Ties pull and push.
        if (!d.pairs[p].is_tied)
          pair.pressure_scatter = Utilities::MPI::broadcast(model.communicator(), scatter(rows), 0);
        result.pressure.insert(result.pressure.end(), rows.begin(), rows.end());
        const auto mortar = mortar_pressure_rows(model.bodies(), d, solution.stress, p);
        result.mortar_pressure.insert(result.mortar_pressure.end(), mortar.begin(), mortar.end());
      }
    return result;
  }
} // namespace Signorini
