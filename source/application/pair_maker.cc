// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "pair_maker.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/facing_sides.h>
#include <signorini/application/journal.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/face_shares.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    double average_face_area(const ContactSurface &surface)
    {
      double area = 0.;
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        area += triangle_area(surface.mesh, t);
      return surface.faces.empty() ? 0. : area / static_cast<double>(surface.faces.size());
    }

    /// Exact where there is only one material.
    IsotropicMaterial mean_material(const ContactSurface &surface, const Bodies &bodies)
    {
      std::map<std::pair<double, double>, double> areas;
      double                                      total = 0.;
      for (unsigned int t = 0; t < surface.mesh.triangles.size(); ++t)
        {
          const Material &m    = bodies.material(surface.faces[surface.triangle_face[t]].material);
          const double    area = triangle_area(surface.mesh, t);
          areas[{m.young, m.poisson}] += area;
          total += area;
        }
      if (areas.size() == 1)
        return {areas.begin()->first.first, areas.begin()->first.second};
      IsotropicMaterial mean{0., 0.};
      for (const auto &[material, area] : areas)
        {
          mean.young += area / total * material.first;
          mean.poisson += area / total * material.second;
        }
      return mean;
    }

    ContactSide extract_side(const PairModel &pair, const PairModel::Side &side, const ContactModel &model,
                             const ConstrainedSpace &constrained)
    {
      const NodalSpace &space = constrained.nodal();
      ContactSide       result;
      result.body = side.body;
      result.name = model.bodies().body_name(side.body) + ": " + side.boundary;
      result.ids  = side.ids;
      std::function<bool(const Point<3> &)> region;
      if (side.region)
        region = [&side](const Point<3> &p) { return side.region(p) > 0.; };
      result.surface = extract_contact_surface(
          space, side.ids,
          [&](const NodeIndex node) {
            const DirichletData &data = constrained.dirichlet;
            return data.rigid != nullptr && data.rigid->find(node) != nullptr
                       ? FixedDirections(all_fixed)
                       : data.fixed[space.relevant().index_within_set(node)];
          },
          region, side.shapes);
      if (result.surface.faces.empty())
        throw InputError("Pair " + pair.definition.name + ": the boundary \"" + side.boundary +
                         "\" of body \"" + model.bodies().body_name(side.body) +
                         "\" has no faces in its region.");
      result.material = mean_material(result.surface, model.bodies());
      return result;
    }

    unsigned int choose_nonmortar(const PairDefinition &pair, const std::vector<ContactSide> &sides,
                                  const bool is_turned)
    {
      const double young[2] = {sides[0].material.young, sides[1].material.young};
      unsigned int softer   = 0;
      if (std::abs(young[0] - young[1]) > 1e-6 * std::max(young[0], young[1]))
        softer = young[0] < young[1] ? 0 : 1;
      else
        softer =
            average_face_area(sides[0].surface) <= average_face_area(sides[1].surface) * (1. + 1e-9) ? 0 : 1;
      if (is_turned)
        return 1 - softer;
      if (pair.nonmortar == NonmortarChoice::automatic)
        return softer;
      return pair.nonmortar == NonmortarChoice::first ? 0 : 1;
    }

    std::shared_ptr<ContactMapping> map_surfaces(ContactPair &pair, const MPI_Comm comm, Journal &journal)
    {
      const unsigned int    rank      = Utilities::MPI::this_mpi_process(comm);
      const ContactSurface &nonmortar = pair.nonmortar.surface;
      PhaseTimes::Scope     time      = journal.measure(Phase::mapping);
      auto                  mapping   = std::make_shared<ContactMapping>(
          nonmortar.mesh, pair.mortar.surface.mesh,
          [&](const unsigned int t) { return nonmortar.faces[nonmortar.triangle_face[t]].worker == rank; },
          comm);
      if (Utilities::MPI::sum(mapping->report().n_cells, comm) == 0)
        throw InputError("Pair " + pair.name + ": the surfaces \"" + pair.nonmortar.name + "\" and \"" +
                         pair.mortar.name +
                         "\" do not face each other anywhere: there is not a single overlay cell.");
      pair.mapping_time += time.stop();
      return mapping;
    }

    void integrate(ContactPair &pair, const MPI_Comm comm, Journal &journal)
    {
      const auto time = journal.measure(Phase::mortar);
      pair.halo       = std::make_shared<const SurfaceHalo>(pair.nonmortar.surface, comm);
      pair.moments    = pair.halo->add_ghosts(compute_face_moments(
             pair.nonmortar.surface, pair.mortar.surface, pair.mapping->overlay(), pair.prescribed_gap, comm));
    }

    void meet_obstacle(ContactPair &pair, const MPI_Comm comm, Journal &journal)
    {
      const auto time = journal.measure(Phase::mortar);
      pair.halo       = std::make_shared<const SurfaceHalo>(pair.nonmortar.surface, comm);
      pair.moments =
          pair.halo->add_ghosts(compute_rigid_moments(pair.nonmortar.surface, *pair.obstacle, comm));
      const bool meets = std::any_of(pair.moments.begin(), pair.moments.end(),
                                     [](const FaceMoments &m) { return m.covered > 0.; });
      if (Utilities::MPI::max(static_cast<int>(meets), comm) == 0)
        throw InputError("Pair " + pair.name + ": the surface \"" + pair.nonmortar.name +
                         "\" does not face the obstacle \"" + pair.mortar.name +
                         "\" anywhere: no outward normal meets it from outside.");
    }
  } // namespace



  PairMaker::PairMaker(const ContactModel &model, const ConstrainedSpace &constrained, Journal &journal)
    : model(model)
    , journal(journal)
  {
    const auto time = journal.measure(Phase::mesh);
    for (const PairModel &pair : model.pairs())
      {
        sides.emplace_back();
        for (const PairModel::Side &side : pair.sides)
          sides.back().push_back(extract_side(pair, side, model, constrained));
      }
    leave_out_blind_parts(sides, model.pairs(), model.communicator(), journal);
  }



  ContactPair PairMaker::make(const unsigned int p, const bool is_turned)
  {
    const PairDefinition &definition = model.pairs()[p].definition;
    ContactPair           pair;
    pair.name              = definition.name;
    pair.is_tied           = model.pairs()[p].is_tied();
    pair.prescribed_gap    = definition.prescribed_gap;
    pair.obstacle          = definition.obstacle;
    const unsigned int non = pair.obstacle ? 0 : choose_nonmortar(definition, sides[p], is_turned);
    // Whole surfaces are large.
    const auto take = [&](const unsigned int s) { return is_open(p) ? sides[p][s] : std::move(sides[p][s]); };
    pair.nonmortar  = take(non);
    if (pair.obstacle)
      pair.mortar.name = pair.obstacle->description();
    else
      pair.mortar = take(1 - non);
    if (pair.obstacle)
      {
        share(pair);
        pair.nonmortar.whole.reset();
        meet_obstacle(pair, model.communicator(), journal);
        return pair;
      }
    leave_out_images_behind(
        pair,
        [&] {
          share(pair);
          return map_surfaces(pair, model.communicator(), journal);
        },
        model.communicator());
    integrate(pair, model.communicator(), journal);
    return pair;
  }



  std::string PairMaker::mapping_errors(const ContactPair &pair) const
  {
    return describe_errors(sum_reports(pair.mapping->report(), model.communicator()));
  }



  void PairMaker::share(ContactPair &pair) const
  {
    const auto time = journal.measure(Phase::mesh);
    share_faces(pair.nonmortar.surface, pair.mortar.surface,
                Utilities::MPI::n_mpi_processes(model.communicator()));
  }
} // namespace Signorini
