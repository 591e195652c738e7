// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/contact_problem.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/contact_indicator.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The contact stress lambda n (force per area) of a pair at all vertices of its nonmortar surface.
    std::vector<Vector3> contact_stress(const Discretization &d, const unsigned int p)
    {
      const ContactSurface &surface = d.pairs[p].nonmortar;
      std::vector<Vector3>  stress(surface.vertex_node.size());
      std::vector<bool>     known(stress.size(), false);
      for (std::size_t row = 0; row < d.coupling.n_rows(); ++row)
        if (d.origin[row].first == p)
          {
            const unsigned int v = d.couplings[p].vertices[d.origin[row].second];
            stress[v]            = d.traction[row];
            known[v]             = true;
          }
      // Vertices without a multiplier: the mean of the neighbours that have one.
      std::vector<Vector3>      sum(stress.size());
      std::vector<unsigned int> n(stress.size(), 0);
      for (const ContactSurface::Face &face : surface.faces)
        for (unsigned int a = 0; a < face.n_corners; ++a)
          for (unsigned int b = 0; b < face.n_corners; ++b)
            if (!known[face.corners[a]] && known[face.corners[b]])
              {
                sum[face.corners[a]] += stress[face.corners[b]];
                ++n[face.corners[a]];
              }
      for (std::size_t v = 0; v < stress.size(); ++v)
        if (!known[v] && n[v] > 0)
          stress[v] = sum[v] / static_cast<double>(n[v]);
      for (std::size_t v = 0; v < stress.size(); ++v)
        if (!surface.hanging[v].empty())
          {
            stress[v] = Vector3();
            for (const auto &[parent, weight] : surface.hanging[v])
              stress[v] += weight * stress[parent];
          }
      return stress;
    }
  } // namespace



  std::vector<double> ContactProblem::estimate()
  {
    Discretization                              &d = discretization;
    std::map<unsigned int, FaceTraction>         tractions;
    std::vector<std::pair<unsigned int, double>> violations;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair         &pair   = d.pairs[p];
        const std::vector<Vector3> stress = contact_stress(d, p);
        const ContactFaces         non(*d.space, pair.nonmortar, pair.nonmortar_ids);
        const auto                 own = nonmortar_tractions(pair.nonmortar, pair.moments, stress);
        for (unsigned int f = 0; f < own.size(); ++f)
          non.add(tractions, f, own[f]);
        const Material &material      = bodies.material_of_body(pair.nonmortar_body);
        const double    shear_modulus = .5 * material.young / (1. + material.poisson);
        const auto      displacement  = vertex_values(pair.nonmortar, *d.partition, d.displacement);
        const auto      add           = [&](const std::vector<double> &violation) {
          for (unsigned int f = 0; f < violation.size(); ++f)
            if (const int cell = non.cell(f); cell >= 0)
              violations.emplace_back(cell, violation[f]);
        };
        if (pair.obstacle)
          {
            add(contact_violation(pair.nonmortar, rigid_images(pair.nonmortar, *pair.obstacle), stress,
                                  displacement, shear_modulus, Utilities::MPI::this_mpi_process(comm)));
            continue;
          }
        const ContactFaces mor(*d.space, pair.mortar, pair.mortar_ids);
        const auto         image =
            mortar_tractions(pair.nonmortar, pair.mortar, pair.mapping->overlay(), stress, comm);
        for (unsigned int f = 0; f < image.size(); ++f)
          mor.add(tractions, f, image[f]);
        const auto  mortar_displacement = vertex_values(pair.mortar, *d.partition, d.displacement);
        const auto &overlay             = pair.mapping->overlay();
        add(pair_definitions[p].parameters.contact == "tied"
                ? tie_violation({pair.nonmortar, pair.mortar, overlay}, displacement, mortar_displacement,
                                shear_modulus)
                : contact_violation({pair.nonmortar, pair.mortar, overlay}, stress, displacement,
                                    mortar_displacement, pair.prescribed_gap, shear_modulus));
      }
    std::vector<double> indicator =
        residual_indicator(bodies, *d.space, *d.partition, loads, d.displacement, tractions);
    for (const auto &[cell, value] : violations)
      indicator[cell] += value;
    return indicator;
  }



  std::vector<bool> ContactProblem::mark(const unsigned int cycle, const std::vector<double> &indicator)
  {
    const NodalSpace &space = *discretization.space;
    if (!refinement.is_adaptive(cycle))
      return refinement.mark(space, cycle);
    const CycleResult          &last = results.cycles[results.cycles.size() - 2];
    const RefinementParameters &p    = parameters.refinement;
    // The indicator of an exact solution is rounding: 1e-8 of what a difference of squares consists of.
    if (last.indicator * last.indicator <= 1e-14 * std::abs(last.nonlinear.energy))
      {
        note("cycle " + std::to_string(last.cycle) +
             ": the error indicator is at the level of rounding, there is nothing to refine.");
        return std::vector<bool>(space.cells().size(), false);
      }
    const std::vector<bool> marked = p.marking == "cells"
                                         ? mark_share_of_cells(space, indicator, p.marking_fraction)
                                         : mark_share_of_error(space, indicator, p.marking_fraction);
    if (p.max_dofs > 0)
      {
        // Each marked cell becomes eight; the closure of tetrahedral meshes refines about as many again.
        double weight = 0.;
        for (std::size_t c = 0; c < marked.size(); ++c)
          if (marked[c])
            weight += space.cells()[c].n_vertices == CellShape::tetrahedron ? 14. : 7.;
        const double expected =
            dim * static_cast<double>(space.n_conforming_nodes()) *
            (1. + Utilities::MPI::sum(weight, comm) / static_cast<double>(space.n_global_cells()));
        if (expected > p.max_dofs)
          {
            note("cycle " + std::to_string(cycle) + " would have about " +
                 std::to_string(static_cast<std::size_t>(expected)) +
                 " dofs, more than \"Max dofs\": no further adaptive refinement.");
            return std::vector<bool>(marked.size(), false);
          }
      }
    return marked;
  }



  void ContactProblem::compare_cycles()
  {
    Discretization &d = discretization;
    for (std::size_t k = 0; k < earlier_displacements.size() && k + 1 < results.cycles.size(); ++k)
      {
        Vector &difference = earlier_displacements[k];
        difference -= d.displacement;
        difference.update_ghost_values();
        results.cycles[k].error_to_last =
            std::sqrt(2. * std::max(0., strain_energy(bodies, *d.space, *d.partition, difference)));
      }
    earlier_displacements.clear();
  }
} // namespace Signorini
