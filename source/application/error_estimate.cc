// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/application/error_estimate.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/discretization/error_indicator.h>
#include <signorini/discretization/nodal_stress.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/contact_indicator.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Collective. Values of faces, from the ranks that worked on them to those that own the cells.
    template <typename T>
    std::vector<T> send_to_owners(const ContactSurface &surface, const SurfaceHalo &halo,
                                  const std::vector<T> &of_faces)
    {
      struct FaceValue
      {
        unsigned int face;
        T            value;
      };
      ListsByRank<FaceValue> parcels;
      for (unsigned int f = 0; f < of_faces.size(); ++f)
        if (halo.owns_face(f))
          parcels[surface.faces[f].owner].push_back({surface.number_of_face(f), of_faces[f]});
      std::vector<T> result(of_faces.size());
      for (const auto &[sender, values] : send_lists(parcels, halo.communicator()))
        for (const auto &[face, value] : values)
          result[surface.face_of_number(face)] = value;
      return result;
    }

    /// How far a pair is from its conditions, face by face of the nonmortar surface.
    std::vector<double> violation_of(const Discretization &d, const ContactPair &pair,
                                     const CornerValues &stress, const Vector &displacement)
    {
      const ContactSurface &non = pair.nonmortar.surface, &mor = pair.mortar.surface;
      const double          mu  = pair.nonmortar.material.mu();
      const auto            own = vertex_values(non, d.partition(), displacement);
      if (pair.obstacle)
        return contact_violation(non, rigid_images(non, *pair.obstacle), stress, own, mu,
                                 faces_of_pair(pair));
      const auto other   = vertex_values(mor, d.partition(), displacement);
      const auto overlay = covered_overlay(pair);
      if (pair.is_tied)
        return tie_violation({non, mor, overlay}, own, other, mu);
      const FacingSurfaces facing{non, mor, overlay, sharp_vertices(pair)};
      return contact_violation(facing, stress, own, other, pair.prescribed_gap, mu);
    }
  } // namespace



  std::vector<double> estimate_error(const ContactModel &model, const Discretization &d,
                                     const ContactSolution &solution)
  {
    std::map<unsigned int, FaceTraction>         tractions;
    std::vector<std::pair<unsigned int, double>> violations;
    for (unsigned int p = 0; p < d.pairs.size(); ++p)
      {
        const ContactPair &pair   = d.pairs[p];
        const CornerValues stress = stress_at_corners(d, solution.stress, p);
        const ContactFaces non(d.nodal(), pair.nonmortar.surface, pair.nonmortar.ids);
        const auto         add = [&](const ContactFaces &faces, const std::vector<FaceTraction> &list) {
          for (unsigned int f = 0; f < list.size(); ++f)
            faces.add(tractions, f, list[f]);
        };
        add(non, send_to_owners(pair.nonmortar.surface, *pair.halo,
                                nonmortar_tractions(pair.nonmortar.surface, pair.moments, stress)));
        if (!pair.obstacle)
          add(ContactFaces(d.nodal(), pair.mortar.surface, pair.mortar.ids),
              mortar_tractions(pair.nonmortar.surface, pair.mortar.surface, covered_overlay(pair), stress,
                               model.communicator()));
        const auto violation = send_to_owners(pair.nonmortar.surface, *pair.halo,
                                              violation_of(d, pair, stress, solution.displacement));
        for (unsigned int f = 0; f < violation.size(); ++f)
          if (const int cell = non.cell(f); cell >= 0)
            violations.emplace_back(cell, violation[f]);
      }
    std::vector<double> indicator = residual_indicator(model.bodies(), d.nodal(), d.partition(),
                                                       model.loads(), solution.displacement, tractions);
    for (const auto &[cell, value] : violations)
      indicator[cell] += value;
    return indicator;
  }



  double total_indicator(const NodalSpace &space, const std::vector<double> &indicator)
  {
    double total = 0.;
    for (std::size_t c = 0; c < indicator.size(); ++c)
      if (space.cells()[c].is_owned)
        total += indicator[c];
    return std::sqrt(Utilities::MPI::sum(total, space.communicator()));
  }



  double estimate_stress_error(const ContactModel &model, const Discretization &d,
                               const ContactSolution &solution)
  {
    const auto  u = relevant_values(d, solution.displacement);
    StressError all;
    for (const StressError &body :
         NodalStress({model.bodies(), model.loads(), d.nodal(), d.dirichlet().fixed, u}).errors())
      all.add(body);
    return all.relative();
  }



  double expected_dofs(const NodalSpace &space, const std::vector<bool> &marked)
  {
    // Each marked cell becomes eight; the closure of tetrahedral meshes refines about as many again.
    double weight = 0.;
    for (std::size_t c = 0; c < marked.size(); ++c)
      if (marked[c])
        weight += space.cells()[c].n_vertices == CellShape::tetrahedron ? 14. : 7.;
    return dim * static_cast<double>(space.n_conforming_nodes()) *
           (1. +
            Utilities::MPI::sum(weight, space.communicator()) / static_cast<double>(space.n_global_cells()));
  }
} // namespace Signorini
