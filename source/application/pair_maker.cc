// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "pair_maker.h"

#include <signorini/algebra/input_error.h>
#include <signorini/application/facing_sides.h>
#include <signorini/application/journal.h>
#include <signorini/mesh/surface_creases.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/edge_normals.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/face_seats.h>
#include <signorini/mortar/face_shares.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// What sides differ by at most that are taken for alike, as ratios of the larger number to the smaller.
    struct AlikeRule
    {
      double young = 2., face_area = 2.;
    };

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
      mark_creases(result.surface);
      result.material = mean_material(result.surface, model.bodies());
      return result;
    }

    /// Collective. The whole of it, on all ranks.
    SurfaceMesh boundary_of(const NodalSpace &space, const Bodies &bodies, const unsigned int body)
    {
      std::set<types::boundary_id> ids;
      for (unsigned int i = 0; i < bodies.boundary_names(body).size(); ++i)
        ids.insert(bodies.boundary_id(body, i));
      return extract_contact_surface(space, ids, [](const NodeIndex) { return FixedDirections(); }, {}).mesh;
    }

    /// By body: whether conditions leave it a rotation, or did before points were held for one.
    std::vector<bool> bodies_that_may_turn(const ContactModel &model, const ConstrainedSpace &constrained)
    {
      constexpr double  rounding = 1e-10;
      std::vector<bool> result(model.bodies().n_bodies(), false);
      for (const FreeMotion &motion : constrained.free_parts.motions)
        if (motion.rotation.norm() > rounding * motion.translation.norm())
          for (const unsigned int body : motion.bodies)
            result[body] = true;
      for (const PointHold &hold : model.point_holds())
        result[hold.body] = true;
      return result;
    }

    /// Before anything is measured along normals.
    /// @param may_turn whether the nonmortar body may turn, but for contact
    void turn_edges_of(ContactPair &pair, const bool may_turn, Journal &journal)
    {
      const auto      time    = journal.measure(Phase::mapping);
      ContactSurface &surface = pair.nonmortar.surface;
      if (pair.obstacle)
        {
          turn_edges(surface, sight_of(*pair.obstacle, surface.extent()));
          // A ball would roll until the node that is pressed lies under its centre.
          if (const auto normal = pair.obstacle->constant_normal(); normal && !may_turn)
            face_plane(surface, *normal);
        }
      else if (!pair.is_tied && !pair.prescribed_gap)
        turn_edges(surface, sight_of(pair.mortar.surface));
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
      const auto time            = journal.measure(Phase::mortar);
      pair.halo                  = std::make_shared<const SurfaceHalo>(pair.nonmortar.surface, comm);
      ContactSurface &nonmortar  = pair.nonmortar.surface;
      const bool      has_gap    = !pair.is_tied && !pair.prescribed_gap;
      const auto      moments_of = [&](const std::vector<OverlayTriangle> &overlay) {
        return compute_face_moments(nonmortar, pair.mortar.surface, overlay, pair.prescribed_gap, comm);
      };
      if (!has_gap)
        {
          pair.moments = pair.halo->add_ghosts(moments_of(pair.mapping->overlay()));
          return;
        }
      const SeatedOverlay seated = without_flanks(nonmortar, pair.mortar.surface, pair.mapping->overlay());
      std::vector<FaceMoments> moments = moments_of(seated.overlay);
      for (FaceMoments &m : moments)
        m.lie = seated.lies[m.face];
      pair.moments = pair.halo->add_ghosts(std::move(moments));
      leave_flanks(nonmortar, *pair.halo, pair.moments);
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
                         "\" anywhere: no outward normal meets it from outside. If its faces are wider than "
                         "the obstacle, refine it first (Initial levels).");
    }
  } // namespace



  PairMaker::PairMaker(const ContactModel &model, const ConstrainedSpace &constrained, Journal &journal)
    : model(model)
    , space(constrained.nodal())
    , may_turn(bodies_that_may_turn(model, constrained))
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



  bool PairMaker::prefers_second(const unsigned int p) const
  {
    if (!is_open(p))
      return !model.pairs()[p].definition.obstacle &&
             model.pairs()[p].definition.nonmortar == NonmortarChoice::second;
    const double young[2] = {sides[p][0].material.young, sides[p][1].material.young};
    if (std::abs(young[0] - young[1]) > 1e-6 * std::max(young[0], young[1]))
      return young[1] < young[0];
    return average_face_area(sides[p][0].surface) > average_face_area(sides[p][1].surface) * (1. + 1e-9);
  }



  bool PairMaker::sides_are_alike(const unsigned int p) const
  {
    const auto is_alike = [](const double a, const double b, const double ratio) {
      return std::max(a, b) < ratio * std::min(a, b);
    };
    return is_alike(sides[p][0].material.young, sides[p][1].material.young, AlikeRule().young) &&
           is_alike(average_face_area(sides[p][0].surface), average_face_area(sides[p][1].surface),
                    AlikeRule().face_area);
  }



  ContactPair PairMaker::make(const unsigned int p, const bool second_is_nonmortar)
  {
    const PairDefinition &definition = model.pairs()[p].definition;
    ContactPair           pair;
    pair.name              = definition.name;
    pair.is_tied           = model.pairs()[p].is_tied();
    pair.prescribed_gap    = definition.prescribed_gap;
    pair.obstacle          = definition.obstacle;
    const unsigned int non = second_is_nonmortar ? 1 : 0;
    // Whole surfaces are large.
    const auto take = [&](const unsigned int s) { return is_open(p) ? sides[p][s] : std::move(sides[p][s]); };
    pair.nonmortar  = take(non);
    if (pair.obstacle)
      pair.mortar.name = pair.obstacle->description();
    else
      pair.mortar = take(1 - non);
    pair.nonmortar.surface.take_row_normals();
    turn_edges_of(pair, may_turn[pair.nonmortar.body], journal);
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
        [&] { return boundary_of(space, model.bodies(), pair.nonmortar.body); }, model.communicator());
    integrate(pair, model.communicator(), journal);
    return pair;
  }



  double PairMaker::wrong_share(const ContactPair &pair) const
  {
    const MappingReport report = sum_reports(pair.mapping->report(), model.communicator());
    if (covers_twice(report))
      return 1.;
    const SurfaceTopology &topology = pair.mapping->nonmortar_topology();
    std::set<unsigned int> wrong(report.wrong_triangles.begin(), report.wrong_triangles.end());
    for (const unsigned int e : report.torn_edges)
      for (const unsigned int t : topology.edge_triangles[e])
        if (t != SurfaceTopology::none)
          wrong.insert(t);
    double area = 0.;
    for (const unsigned int t : wrong)
      area += triangle_area(pair.nonmortar.surface.mesh, t);
    // What is turned counts with a negative area in what is covered.
    if (!(area > 0.))
      return report.area_covered > 0. ? 0. : 1.;
    return area / std::max(area, report.area_covered);
  }



  double PairMaker::depth(const ContactPair &pair) const
  {
    return std::max(0., -assess_mapping(*pair.mapping, pair.nonmortar.surface.mesh, pair.mortar.surface.mesh,
                                        model.communicator())
                             .min_gap);
  }



  double PairMaker::cut_share(const ContactPair &pair) const
  {
    constexpr double rounding = 1e-6;
    double           cut = 0., covered = 0.;
    for (const FaceMoments &m : pair.moments)
      if (pair.halo->owns_face(m.face) && m.covered > 0. && !is_far(m))
        {
          covered += m.covered;
          if (m.covered < (1. - rounding) * m.area)
            cut += m.covered;
        }
    covered = Utilities::MPI::sum(covered, model.communicator());
    cut     = Utilities::MPI::sum(cut, model.communicator());
    return covered > 0. ? cut / covered : 0.;
  }



  void PairMaker::share(ContactPair &pair) const
  {
    const auto time = journal.measure(Phase::mesh);
    share_faces(pair.nonmortar.surface, pair.mortar.surface,
                Utilities::MPI::n_mpi_processes(model.communicator()));
  }
} // namespace Signorini
