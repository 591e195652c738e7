// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/gathered_lists.h>
#include <signorini/algebra/input_error.h>
#include <signorini/application/body_evaluation.h>
#include <signorini/application/deck_results.h>
#include <signorini/application/journal.h>
#include <signorini/application/nodal_sums.h>
#include <signorini/application/pair_fields.h>
#include <signorini/output/field_output.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <unordered_map>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// An owned node: its number in the space, the vertex of the start mesh at it, and numbers at it (three
    /// of the position, three of the displacement, six of the stress).
    struct NodeRow
    {
      NodeIndex              node;
      unsigned int           start_vertex;
      std::array<double, 12> values;
    };

    /// A contact node with its opening (length) and pressure (force per area).
    struct ContactRow
    {
      NodeIndex node;
      double    opening, pressure;
    };

    std::vector<NodeRow> owned_rows(const ContactModel &model, const Discretization &d,
                                    const ContactSolution &solution)
    {
      const NodalSpace &space = d.nodal();
      const auto        u     = relevant_values(d, solution.displacement);
      const auto        stress =
          NodalStress({model.bodies(), model.loads(), space, d.dirichlet().fixed, u}).values();
      std::vector<NodeRow> rows;
      for (const NodeIndex node : space.owned())
        {
          const std::size_t i = space.relevant().index_within_set(node);
          NodeRow           row{node, space.start_vertices()[i], {}};
          for (unsigned int c = 0; c < 3; ++c)
            {
              row.values[c]     = space.position(node)[c];
              row.values[3 + c] = u[3 * i + c];
            }
          for (unsigned int c = 0; c < 6; ++c)
            row.values[6 + c] = stress[i][c];
          rows.push_back(row);
        }
      return rows;
    }

    /// The nodes of a cell, 8 or 4.
    struct CellRow
    {
      unsigned int             n_nodes;
      std::array<NodeIndex, 8> nodes;
    };

    std::vector<CellRow> owned_cells(const NodalSpace &space)
    {
      std::vector<CellRow> cells;
      for (const NodalSpace::Cell &cell : space.cells())
        if (cell.is_owned)
          {
            CellRow row{cell.n_vertices, {}};
            std::copy(space.nodes(cell).begin(), space.nodes(cell).end(), row.nodes.begin());
            cells.push_back(row);
          }
      return cells;
    }

    /// Numbers of the deck for the nodes of a space; new ones for the others.
    std::unordered_map<NodeIndex, long> label_nodes(const DeckProblem &deck, const Bodies &bodies,
                                                    const std::vector<NodeRow> &rows)
    {
      std::unordered_map<unsigned int, long> of_vertex;
      for (unsigned int b = 0; b < deck.labels.size(); ++b)
        for (unsigned int v = 0; v < deck.labels[b].node_of_vertex.size(); ++v)
          of_vertex[bodies.start_vertex(b, v)] = deck.labels[b].node_of_vertex[v];
      std::unordered_map<NodeIndex, long> labels;
      long                                next = deck.largest_node_label;
      for (const NodeRow &row : rows)
        {
          const auto it = of_vertex.find(row.start_vertex);
          labels[row.node] =
              it != of_vertex.end() && it->second != DeckProblem::no_label ? it->second : ++next;
        }
      return labels;
    }

    /// Collective. Those of all ranks, on rank 0.
    std::vector<ContactRow> gather_contact(const Discretization &d, const ContactSolution &solution)
    {
      std::vector<ContactRow> rows;
      for (unsigned int p = 0; p < d.pairs.size(); ++p)
        {
          const ContactStress stress = stress_of_pair(d, solution.stress, p);
          for (std::size_t i = 0; i < stress.pressure.size(); ++i)
            rows.push_back({d.couplings[p].coupling.rows[i], d.couplings[p].mean_gap(i, stress.opening[i]),
                            stress.pressure[i]});
        }
      return gather_lists(std::move(rows), d.nodal().communicator(), Receivers::rank_zero);
    }

    FrdField contact_field(const std::vector<ContactRow>             &rows,
                           const std::unordered_map<NodeIndex, long> &labels)
    {
      // Opening and pressure by node; a node of two pairs has the larger pressure.
      std::map<long, std::pair<double, double>> values;
      for (const ContactRow &row : rows)
        if (const auto it = labels.find(row.node); it != labels.end())
          {
            const std::pair<double, double> value(row.opening, row.pressure);
            const auto [entry, is_new] = values.insert({it->second, value});
            if (!is_new && value.second > entry->second.second)
              entry->second = value;
          }
      FrdField field{"CONTACT", {}, {}};
      for (const auto &[label, value] : values)
        {
          field.labels.push_back(label);
          for (const double component : {value.first, 0., 0., value.second, 0., 0.})
            field.values.push_back(component);
        }
      return field;
    }

    /// What the ranks have gathered.
    struct Gathered
    {
      std::vector<NodeRow>    rows;
      std::vector<CellRow>    cells;
      std::vector<ContactRow> contact;
    };

    void write(std::ostream &out, const DeckProblem &deck, const ContactModel &model,
               const Gathered &gathered)
    {
      const auto &[rows, cells, contact] = gathered;
      auto labels                        = label_nodes(deck, model.bodies(), rows);
      bool is_refined                    = false;
      for (const NodeRow &row : rows)
        is_refined = is_refined || row.start_vertex == StartNodes::none;
      // Not those that only our cells have: centres of faces of quadratic elements.
      for (auto it = labels.begin(); it != labels.end();)
        it = !is_refined && it->second > deck.largest_node_label ? labels.erase(it) : std::next(it);
      FrdMesh  mesh;
      FrdField displacement{"DISP", {}, {}}, stress{"STRESS", {}, {}};
      for (const NodeRow &row : rows)
        {
          const auto labelled = labels.find(row.node);
          if (labelled == labels.end())
            continue;
          const long label = labelled->second;
          mesh.labels.push_back(label);
          mesh.positions.emplace_back(row.values[0], row.values[1], row.values[2]);
          displacement.labels.push_back(label);
          stress.labels.push_back(label);
          displacement.values.insert(displacement.values.end(), row.values.begin() + 3,
                                     row.values.begin() + 6);
          stress.values.insert(stress.values.end(), row.values.begin() + 6, row.values.end());
        }
      if (!is_refined)
        for (const DeckProblem::BodyLabels &body : deck.labels)
          mesh.elements.insert(mesh.elements.end(), body.elements.begin(), body.elements.end());
      else
        for (const CellRow &cell : cells)
          {
            static constexpr unsigned int around[8] = {0, 1, 3, 2, 4, 5, 7, 6};
            mesh.elements.push_back({static_cast<long>(mesh.elements.size() + 1), {}});
            for (unsigned int v = 0; v < cell.n_nodes; ++v)
              mesh.elements.back().nodes.push_back(labels.at(cell.nodes[cell.n_nodes == 8 ? around[v] : v]));
          }
      std::vector<FrdField> fields = {displacement, stress};
      if (!contact.empty())
        fields.push_back(contact_field(contact, labels));
      write_frd(out, mesh, fields, 1.);
    }
  } // namespace



  void write_deck_results(const DeckProblem &deck, const ContactModel &model, const Discretization &d,
                          const ContactSolution &solution, const std::string &folder)
  {
    const MPI_Comm comm = model.communicator();
    Gathered       all;
    all.rows    = gather_lists(owned_rows(model, d, solution), comm, Receivers::rank_zero);
    all.cells   = gather_lists(owned_cells(d.nodal()), comm, Receivers::rank_zero);
    all.contact = gather_contact(d, solution);
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      return;
    std::ofstream out(folder + "results.frd");
    write(out, deck, model, all);
    out.close();
    if (!out)
      throw InputError("the file \"" + folder + "results.frd\" cannot be written: is the disk full?");
  }



  void judge_linear_kinematics(const DeckProblem &deck, const ContactModel &model, NestedSolution &nested,
                               Journal &journal)
  {
    if (!deck.nonlinear_geometry)
      return;
    Distortion k;
    for (const Distortion &body :
         largest_distortions(model, *nested.discretization, nested.solution.displacement))
      k = {std::max(k.rotation, body.rotation), std::max(k.strain, body.strain)};
    const double       degrees = k.rotation * 180. / numbers::PI;
    std::ostringstream text;
    // Green's strain has ½ HᵀH beside the linear one: ½ θ² of a rotation, ½ ε² of a strain.
    text << std::setprecision(2) << "NLGEOM: cells rotate by at most " << degrees
         << " degrees and are strained by at most " << 100. * k.strain
         << " %; what linear kinematics leaves out is of the order of " << 50. * k.rotation * k.rotation
         << " % strain by rotation and " << 50. * k.strain << " % of the strains.";
    if (degrees > KinematicsRule::largest_rotation || k.strain > KinematicsRule::largest_strain)
      nested.results.certificate.objections.push_back(text.str() +
                                                      " That is too much for linear kinematics.");
    else
      journal.note(text.str());
  }
} // namespace Signorini
