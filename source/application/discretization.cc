// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/application/contact_checks.h>
#include <signorini/application/discretization.h>
#include <signorini/application/facing_sides.h>
#include <signorini/application/journal.h>
#include <signorini/application/pair_pieces.h>
#include <signorini/application/ties.h>
#include <signorini/mesh/facing_parts.h>
#include <signorini/mesh/surface_extraction.h>
#include <signorini/mortar/face_claims.h>
#include <signorini/mortar/face_shares.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  Discretization::Discretization(std::shared_ptr<const ConstrainedSpace> space,
                                 std::vector<ContactPair>                some_pairs,
                                 std::vector<PairCoupling> some_couplings, std::vector<bool> turned)
    : constrained(std::move(space))
    , pairs(std::move(some_pairs))
    , couplings(std::move(some_couplings))
    , turned(std::move(turned))
  {
    std::vector<std::string> names;
    for (const ContactPair &pair : pairs)
      names.push_back(pair.name);
    const JoinedCouplings owned = join_couplings(couplings, names, partition());
    for (std::size_t row = 0; row < owned.pairs.size(); ++row)
      {
        tied.push_back(pairs[owned.pairs[row]].is_tied);
        projections.push_back(tied.back() ? RowProjection::tied(owned.fixed[row], owned.normals[row])
                                          : RowProjection(owned.fixed[row], owned.normals[row]));
      }
    std::vector<NodeIndex> nodes(owned.coupling.rows);
    nodes.insert(nodes.end(), partition().ghosts().begin(), partition().ghosts().end());
    const NodeRequest request(partition(), sorted_nodes(std::move(nodes)));
    coupling        = import_rows(owned.coupling, request);
    gaps            = import_row_values(owned.coupling, owned.gaps, request);
    tied            = import_row_values(owned.coupling, tied, request);
    projections     = import_row_values(owned.coupling, projections, request);
    n_contact_nodes = Utilities::MPI::sum(owned.coupling.n_rows(), nodal().communicator());
    const bool any  = std::find(tied.begin(), tied.end(), 1) != tied.end();
    has_tied_rows   = Utilities::MPI::max(static_cast<int>(any), nodal().communicator()) > 0;
    refuse_rigid_mortar_nodes();
    if (has_ties())
      lifted = std::make_unique<const DirichletData>(lift_ties(*constrained, coupling, projections, tied));
    transformation =
        std::make_unique<const BasisTransformation>(nodal(), partition(), dirichlet(), coupling, projections);
  }



  void Discretization::refuse_rigid_mortar_nodes() const
  {
    if (dirichlet().rigid == nullptr)
      return;
    std::string error;
    for (const auto &entry : coupling.entries)
      if (const RigidFaces::Dependence *const node = dirichlet().rigid->find(entry.node))
        {
          std::ostringstream place;
          place << node->position;
          error = "a contact surface has nodes in common with a rigid face, at (" + place.str() +
                  ") for example. Leave them out of the surface (First region, Second region), or make "
                  "their surface the nonmortar one.";
          break;
        }
    throw_everywhere(error, nodal().communicator());
  }



  Discretization::Discretization(const Discretization &other, std::shared_ptr<const ConstrainedSpace> space)
    : Discretization(std::move(space), other.pairs, other.couplings, other.turned)
  {
  }



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
                                  const bool is_turned, const Bodies &bodies, Journal &journal)
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
        {
          journal.note("pair " + pair.name + ": \"" + bodies.body_name(sides[softer].body) +
                       "\" is the nonmortar side (the softer body, then the finer mesh).");
          return softer;
        }
      const unsigned int chosen = pair.nonmortar == NonmortarChoice::first ? 0 : 1;
      if (young[chosen] > 10. * young[1 - chosen])
        journal.note(
            "warning: pair " + pair.name +
            ": the nonmortar side is the stiffer body; the contact nodes need a direct solver this way.");
      return chosen;
    }

    void map_pair(ContactPair &pair, const MPI_Comm comm, Journal &journal)
    {
      const unsigned int    rank      = Utilities::MPI::this_mpi_process(comm);
      const ContactSurface &nonmortar = pair.nonmortar.surface;
      {
        PhaseTimes::Scope time = journal.measure(Phase::mapping);
        pair.mapping           = std::make_shared<const ContactMapping>(
            nonmortar.mesh, pair.mortar.surface.mesh,
            [&](const unsigned int t) { return nonmortar.faces[nonmortar.triangle_face[t]].worker == rank; },
            comm);
        if (Utilities::MPI::sum(pair.mapping->report().n_cells, comm) == 0)
          throw InputError("Pair " + pair.name + ": the surfaces \"" + pair.nonmortar.name + "\" and \"" +
                           pair.mortar.name +
                           "\" do not face each other anywhere: there is not a single overlay cell.");
        pair.mapping_time = time.stop();
      }
      const auto time = journal.measure(Phase::mortar);
      pair.halo       = std::make_shared<const SurfaceHalo>(nonmortar, comm);
      pair.moments    = pair.halo->add_ghosts(compute_face_moments(
             nonmortar, pair.mortar.surface, pair.mapping->overlay(), pair.prescribed_gap, comm));
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

    /// Turns pair models into pairs on a mesh.
    class PairMaker
    {
    public:
      PairMaker(const ContactModel &model, const ConstrainedSpace &constrained, Journal &journal)
        : model(model)
        , constrained(constrained)
        , journal(journal)
      {
      }

      ContactPair make(const PairModel &definition, const bool is_turned) const
      {
        ContactPair pair;
        pair.name           = definition.definition.name;
        pair.is_tied        = definition.is_tied();
        pair.prescribed_gap = definition.definition.prescribed_gap;
        pair.obstacle       = definition.definition.obstacle;
        {
          const auto               time = journal.measure(Phase::mesh);
          std::vector<ContactSide> sides;
          for (const PairModel::Side &side : definition.sides)
            sides.push_back(extract_side(definition, side, model, constrained));
          leave_out_blind_parts(sides, definition, model.communicator(), journal);
          const unsigned int non = pair.obstacle ? 0
                                                 : choose_nonmortar(definition.definition, sides, is_turned,
                                                                    model.bodies(), journal);
          pair.nonmortar         = std::move(sides[non]);
          if (pair.obstacle)
            pair.mortar.name = pair.obstacle->description();
          else
            pair.mortar = std::move(sides[1 - non]);
        }
        share(pair);
        if (pair.obstacle)
          {
            meet_obstacle(pair, model.communicator(), journal);
            return pair;
          }
        map_pair(pair, model.communicator(), journal);
        if (const auto behind = faces_with_images_behind(pair, model.communicator()); !behind.empty())
          {
            leave_out(pair.nonmortar.surface, behind);
            share(pair);
            map_pair(pair, model.communicator(), journal);
          }
        return pair;
      }

      /// Of all ranks, in words.
      std::string mapping_errors(const ContactPair &pair) const
      {
        return describe_errors(sum_reports(pair.mapping->report(), model.communicator()));
      }

    private:
      void share(ContactPair &pair) const
      {
        const auto time = journal.measure(Phase::mesh);
        share_faces(pair.nonmortar.surface, pair.mortar.surface,
                    Utilities::MPI::n_mpi_processes(model.communicator()));
      }

      const ContactModel     &model;
      const ConstrainedSpace &constrained;
      Journal                &journal;
    };

    /// Couples pairs whose moments are still those of all that they cover.
    std::vector<PairCoupling> couple_pairs(std::vector<ContactPair> &pairs, const MPI_Comm comm)
    {
      std::vector<ClaimedFaces> claims;
      for (ContactPair &pair : pairs)
        claims.push_back({pair.nonmortar.surface, pair.moments, pair.is_tied});
      if (pairs.size() > 1)
        leave_faces_to_nearest(claims, comm);
      std::vector<std::set<NodeIndex>> nonmortar_nodes, mortar_nodes;
      for (const ContactPair &pair : pairs)
        {
          nonmortar_nodes.push_back(touched_nonmortar_nodes(pair.nonmortar.surface, pair.moments));
          mortar_nodes.push_back(touched_mortar_nodes(pair.mortar.surface, pair.moments));
        }
      const auto                excluded = excluded_nodes(nonmortar_nodes, mortar_nodes, comm);
      std::vector<PairCoupling> couplings;
      for (unsigned int p = 0; p < pairs.size(); ++p)
        couplings.push_back(couple({pairs[p].nonmortar.surface, pairs[p].mortar.surface, *pairs[p].halo},
                                   pairs[p].moments, excluded[p],
                                   static_cast<bool>(pairs[p].prescribed_gap)));
      return couplings;
    }

    bool has_sharp_edges(const ContactPair &pair)
    {
      return FacingParts(pair.nonmortar.surface).n_parts() > 1 ||
             FacingParts(pair.mortar.surface).n_parts() > 1;
    }

    /// Turns the automatic choice of a pair's sides if the mapping has errors one way and none the other way,
    /// as it may have where a rim of one part lies over that of another one. Elsewhere errors are where
    /// surfaces turn away from each other, and the choice matters for other pairs.
    bool turn_for_mapping(ContactPair &pair, const PairMaker &maker, const PairModel &definition,
                          Journal &journal)
    {
      if (!pair.mapping || definition.definition.nonmortar != NonmortarChoice::automatic ||
          maker.mapping_errors(pair).empty() || !has_sharp_edges(pair))
        return false;
      ContactPair other = maker.make(definition, true);
      if (!maker.mapping_errors(other).empty())
        return false;
      pair = std::move(other);
      journal.note("pair " + pair.name +
                   ": its sides are swapped, because the mapping has errors the other way round.");
      return true;
    }

    /// The pairs whose automatic choice of sides is to be turned round now; none of them was before.
    std::vector<unsigned int> pairs_to_turn(const ContactModel &model, const std::vector<ContactPair> &pairs,
                                            const std::vector<PairCoupling> &couplings,
                                            const std::vector<bool> &turned, Journal &journal)
    {
      std::vector<unsigned int> result;
      for (unsigned int p = 0; p < pairs.size(); ++p)
        {
          if (pairs[p].obstacle || turned[p] ||
              model.pairs()[p].definition.nonmortar != NonmortarChoice::automatic)
            continue;
          if (const std::string reason = reason_to_turn(pairs[p], couplings[p], model.communicator());
              !reason.empty())
            {
              result.push_back(p);
              journal.note("pair " + pairs[p].name + ": its sides are swapped, because " + reason + ".");
            }
        }
      return result;
    }

    void use_nodal_gaps(PairCoupling &coupling, const ContactPair &pair)
    {
      const double size = pair.nonmortar.surface.extent();
      for (std::size_t row = 0; row < coupling.gaps.size(); ++row)
        if (pair.prescribed_gap)
          coupling.gaps[row] = pair.prescribed_gap(coupling.positions[row]);
        else if (double gap; pair.obstacle->gap(gap, coupling.positions[row], coupling.normals[row], size))
          coupling.gaps[row] = gap;
    }

    /// What is said of several pairs at once, for there may be many: "pair a, cycle 0", "pairs a, b, cycle
    /// 0".
    struct NotedPairs
    {
      std::vector<std::string> names, values;

      void add(const std::string &name, const std::string &value)
      {
        names.push_back(name);
        values.push_back(value);
      }

      std::string in_cycle(const unsigned int cycle) const
      {
        return (names.size() > 1 ? "pairs " : "pair ") + Patterns::Tools::to_string(names) + ", cycle " +
               std::to_string(cycle) + ": ";
      }
    };

    void note_mapping_errors(const std::vector<ContactPair> &pairs, const unsigned int cycle,
                             const MPI_Comm comm, Journal &journal)
    {
      NotedPairs noted;
      for (const ContactPair &pair : pairs)
        if (pair.mapping)
          if (const std::string errors = describe_errors(sum_reports(pair.mapping->report(), comm));
              !errors.empty())
            noted.add(pair.name, errors);
      if (!noted.names.empty())
        journal.note(
            "warning: " + noted.in_cycle(cycle) + "the contact mapping has errors (" +
            (noted.values.size() == 1 ? noted.values[0] : "of each pair: mappings/errors in summary.json") +
            "): pressures and forces near those places are wrong. Look at the surfaces with "
            "signorini-map; a finer or smoother mesh on the bent or folded parts, or the other side "
            "as nonmortar side, helps.");
    }

    void note_dropped_nodes(const CoupledPairs &coupled, const unsigned int cycle, Journal &journal)
    {
      std::vector<NotedPairs> noted(DroppedNode::n_reasons);
      for (unsigned int p = 0; p < coupled.pairs.size(); ++p)
        {
          std::vector<unsigned int> counts(DroppedNode::n_reasons, 0);
          for (const DroppedNode &node : coupled.couplings[p].dropped)
            ++counts[node.reason];
          Utilities::MPI::sum(counts, coupled.model.communicator(), counts);
          for (unsigned int reason = 0; reason < counts.size(); ++reason)
            if (counts[reason] > 0)
              noted[reason].add(coupled.pairs[p].name, std::to_string(counts[reason]));
        }
      for (unsigned int reason = 0; reason < noted.size(); ++reason)
        if (!noted[reason].names.empty())
          journal.note(noted[reason].in_cycle(cycle) + Patterns::Tools::to_string(noted[reason].values) +
                       " nonmortar nodes without multiplier (" +
                       to_string(static_cast<DroppedNode::Reason>(reason)) + ").");
      for (unsigned int p = 0; p < coupled.pairs.size(); ++p)
        if (const PairCoupling &coupling = coupled.couplings[p]; coupling.lost_area > 1e-12 * coupling.area)
          journal.note("pair " + coupled.pairs[p].name + ": an area of " +
                       std::to_string(coupling.lost_area) + " is covered but carries no multiplier.");
    }

    void note_overlap(const CoupledPairs &coupled, const unsigned int p, Journal &journal)
    {
      const PairDefinition &definition = coupled.model.pairs()[p].definition;
      const PairCoupling   &c          = coupled.couplings[p];
      const MPI_Comm        comm       = coupled.model.communicator();
      const double          smallest =
          Utilities::MPI::min(c.gaps.empty() ? 0. : *std::min_element(c.gaps.begin(), c.gaps.end()), comm);
      const double size = width_of_rows(c, comm);
      // Faceted curved surfaces overlap by rounding and by their sagitta; report what exceeds rounding.
      if (!(smallest < -1e-12 * size) || coupled.pairs[p].is_tied)
        return;
      refuse_large_overlap(coupled, p);
      // The weighted gap is negative where surfaces bend within a face, too.
      const double gap =
          smallest_initial_gap(coupled.pairs[p], coupled.constrained.nodal().communicator()).value;
      if (!(gap < -1e-12 * size))
        return;
      std::ostringstream text;
      text << "pair " << definition.name << ": initial penetration of " << -gap;
      if (definition.penetration == InitialPenetration::refuse)
        throw InputError(text.str() + "; \"Initial penetration = refuse\" does not allow it.");
      journal.note(text.str() + ", resolved as an interference fit.");
    }
  } // namespace



  std::unique_ptr<const Discretization> discretize(const ContactModel                     &model,
                                                   std::shared_ptr<const ConstrainedSpace> constrained,
                                                   const std::vector<bool>                &turned_before,
                                                   const unsigned int cycle, Journal &journal)
  {
    std::vector<bool> turned = turned_before;
    turned.resize(model.pairs().size(), false);
    const PairMaker          maker(model, *constrained, journal);
    std::vector<ContactPair> pairs;
    for (unsigned int p = 0; p < turned.size(); ++p)
      {
        pairs.push_back(maker.make(model.pairs()[p], turned[p]));
        turned[p] = turned[p] || turn_for_mapping(pairs[p], maker, model.pairs()[p], journal);
      }

    const auto                            time = journal.measure(Phase::mortar);
    std::vector<std::vector<FaceMoments>> covered;
    if (pairs.size() > 1)
      for (const ContactPair &pair : pairs)
        covered.push_back(pair.moments);
    std::vector<PairCoupling> couplings = couple_pairs(pairs, model.communicator());
    while (true)
      {
        const auto some = pairs_to_turn(model, pairs, couplings, turned, journal);
        if (some.empty())
          break;
        for (const unsigned int p : some)
          {
            turned[p] = true;
            pairs[p]  = maker.make(model.pairs()[p], true);
            if (pairs.size() > 1)
              covered[p] = pairs[p].moments;
          }
        for (unsigned int p = 0; p < covered.size(); ++p)
          pairs[p].moments = covered[p];
        couplings = couple_pairs(pairs, model.communicator());
      }
    const CoupledPairs coupled{model, *constrained, pairs, couplings};
    refuse_lost_contact(coupled);
    refuse_dense_coupling(coupled);
    note_mapping_errors(pairs, cycle, model.communicator(), journal);
    note_dropped_nodes(coupled, cycle, journal);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (model.pairs()[p].definition.gap == GapKind::nodal)
          use_nodal_gaps(couplings[p], pairs[p]);
        if (cycle == 0)
          note_overlap(coupled, p, journal);
      }
    for (unsigned int p = 0; p < pairs.size(); ++p)
      keep_piece(pairs[p], couplings[p], model.communicator());
    return std::make_unique<const Discretization>(constrained, std::move(pairs), std::move(couplings),
                                                  std::move(turned));
  }
} // namespace Signorini
