// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include "side_choice.h"

#include <signorini/algebra/common_error.h>
#include <signorini/algebra/interface_rows.h>
#include <signorini/application/contact_checks.h>
#include <signorini/application/discretization.h>
#include <signorini/application/journal.h>
#include <signorini/application/pair_pieces.h>
#include <signorini/application/ties.h>
#include <signorini/mortar/pair_conflicts.h>
#include <signorini/surface/mapping_quality.h>

#include <deal.II/base/utilities.h>

namespace Signorini
{
  using namespace dealii;

  Discretization::Discretization(std::shared_ptr<const ConstrainedSpace> space,
                                 std::vector<ContactPair>                some_pairs,
                                 std::vector<PairCoupling>               some_couplings,
                                 std::vector<PairChoice>                 some_choices)
    : constrained(std::move(space))
    , pairs(std::move(some_pairs))
    , couplings(std::move(some_couplings))
    , choices(std::move(some_choices))
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
    coupling = import_rows(owned.coupling, request);
    if (owned.chained)
      chained = import_rows(*owned.chained, request);
    gaps            = import_row_values(owned.coupling, owned.gaps, request);
    tied            = import_row_values(owned.coupling, tied, request);
    projections     = import_row_values(owned.coupling, projections, request);
    n_contact_nodes = Utilities::MPI::sum(owned.coupling.n_rows(), nodal().communicator());
    const bool any  = std::find(tied.begin(), tied.end(), 1) != tied.end();
    has_tied_rows   = Utilities::MPI::max(static_cast<int>(any), nodal().communicator()) > 0;
    refuse_rigid_mortar_nodes();
    if (has_ties())
      lifted = std::make_unique<const DirichletData>(lift_ties(*constrained, coupling, projections, tied));
    transformation = std::make_unique<const BasisTransformation>(nodal(), partition(), dirichlet(), coupling,
                                                                 expansion(), projections);
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
                  ") for example. Leave them out of the surface (First region, Second region; start faces "
                  "that reach from there to where the bodies touch want more Initial levels first); where "
                  "some of its nodes are free it may be the nonmortar one. A contact surface that is all "
                  "rigid should be an obstacle, or the rigid face a boundary behind it.";
          break;
        }
    throw_everywhere(error, nodal().communicator());
  }



  Discretization::Discretization(const Discretization &other, std::shared_ptr<const ConstrainedSpace> space)
    : Discretization(std::move(space), other.pairs, other.couplings, other.choices)
  {
  }



  namespace
  {
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

    void note_images_behind(const std::vector<ContactPair> &pairs, const unsigned int cycle, Journal &journal)
    {
      NotedPairs noted;
      for (const ContactPair &pair : pairs)
        if (pair.n_images_behind > 0)
          noted.add(pair.name, std::to_string(pair.n_images_behind));
      if (!noted.names.empty())
        journal.note(noted.in_cycle(cycle) + Patterns::Tools::to_string(noted.values) +
                     " nonmortar faces are left out because the other side lies only behind their own body, "
                     "seen along their normals.");
    }

    void note_dropped_nodes(const CoupledPairs &coupled, const unsigned int cycle, Journal &journal)
    {
      std::vector<NotedPairs> noted(DroppedNode::n_reasons);
      for (unsigned int p = 0; p < coupled.pairs.size(); ++p)
        {
          std::vector<unsigned int> counts(DroppedNode::n_reasons, 0);
          for (const DroppedNode &node : coupled.couplings[p].nodes_without_multiplier())
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
                       Patterns::Tools::to_string(coupling.lost_area) +
                       " is covered but carries no multiplier.");
    }

    void note_overlap(const CoupledPairs &coupled, const unsigned int p, Journal &journal)
    {
      const PairDefinition &definition = coupled.model.pairs()[p].definition;
      const PairCoupling   &c          = coupled.couplings[p];
      const MPI_Comm        comm       = coupled.model.communicator();
      const double          smallest =
          Utilities::MPI::min(c.gaps.empty() ? 0. : *std::min_element(c.gaps.begin(), c.gaps.end()), comm);
      const double size = width_of_rows(c, comm);
      // Faceted curved surfaces overlap by rounding and by their sagitta; report what exceeds rounding, that
      // of coordinates far from the origin as well.
      double coordinate = 0.;
      for (const Point<3> &x : c.positions)
        for (unsigned int i = 0; i < dim; ++i)
          coordinate = std::max(coordinate, std::abs(x[i]));
      const double rounding = std::max(1e-12 * size, 1e-15 * Utilities::MPI::max(coordinate, comm));
      if (!(smallest < -rounding) || coupled.pairs[p].is_tied)
        return;
      refuse_large_overlap(coupled, p);
      // The weighted gap is negative where surfaces bend within a face, too.
      const SmallestGap gap =
          smallest_initial_gap(coupled.pairs[p], coupled.constrained.nodal().communicator());
      if (!(gap.value < -rounding))
        return;
      std::ostringstream text;
      text << "pair " << definition.name << ": ";
      if (!gap.overlaps)
        {
          text << "the surfaces overlap by " << -gap.value << ", less than their facets leave open ("
               << gap.doubt << ").";
          journal.note(text.str());
          return;
        }
      text << "initial penetration of " << -gap.value;
      if (definition.penetration == InitialPenetration::refuse)
        throw InputError(text.str() + "; \"Initial penetration = refuse\" does not allow it.");
      journal.note(text.str() + ", resolved as an interference fit.");
    }

    /// What is tied across a gap moves as if there were none.
    void note_tied_gap(const CoupledPairs &coupled, const unsigned int p, Journal &journal)
    {
      // Of the width of a face; the facets of a circle of n faces lie inside of it by π/4n of that.
      constexpr double   told = .1;
      const ContactPair &pair = coupled.pairs[p];
      if (!pair.is_tied || coupled.couplings[p].n_rows_of_all == 0)
        return;
      const MappingQuality quality = assess_mapping(*pair.mapping, pair.nonmortar.surface.mesh,
                                                    pair.mortar.surface.mesh, coupled.model.communicator());
      const double         gap     = std::max(std::abs(quality.min_gap), std::abs(quality.max_gap)),
                   width           = std::sqrt(coupled.couplings[p].area /
                                               static_cast<double>(coupled.couplings[p].n_rows_of_all));
      if (!(gap > told * width))
        return;
      std::ostringstream text;
      text << "pair " << pair.name << ": its tied surfaces are up to " << gap
           << " apart. They move together as if they touched; moments of the forces across that gap are not "
              "carried.";
      journal.note(text.str());
    }
  } // namespace



  std::unique_ptr<const Discretization> discretize(const ContactModel                     &model,
                                                   std::shared_ptr<const ConstrainedSpace> constrained,
                                                   const std::vector<PairChoice>          &before,
                                                   const unsigned int cycle, Journal &journal)
  {
    SideChoice choice(model, *constrained, before, journal);
    choice.improve();
    const auto                 time      = journal.measure(Phase::mortar);
    std::vector<ContactPair>  &pairs     = choice.pairs;
    std::vector<PairCoupling> &couplings = choice.couplings;
    const CoupledPairs         coupled{model, *constrained, pairs, couplings};
    refuse_lost_contact(coupled);
    refuse_dense_coupling(coupled);
    note_mapping_errors(pairs, cycle, model.communicator(), journal);
    note_images_behind(pairs, cycle, journal);
    note_dropped_nodes(coupled, cycle, journal);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (model.pairs()[p].definition.gap == GapKind::nodal)
          use_nodal_gaps(couplings[p], pairs[p]);
        if (cycle == 0)
          {
            note_overlap(coupled, p, journal);
            note_tied_gap(coupled, p, journal);
          }
      }
    for (unsigned int p = 0; p < pairs.size(); ++p)
      keep_piece(pairs[p], couplings[p], model.communicator());
    return std::make_unique<const Discretization>(constrained, std::move(pairs), std::move(couplings),
                                                  choice.choices());
  }
} // namespace Signorini
