// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/node_partition.h>
#include <signorini/mesh/nodal_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

namespace Signorini
{
  using namespace dealii;

  NodalSpace::NodalSpace(const Triangulation<3> &triangulation)
    : fe(1)
    , dofs(triangulation)
  {
    dofs.distribute_dofs(fe);
    DoFTools::extract_locally_relevant_dofs(dofs, relevant_nodes);
    constraints.reinit(relevant_nodes);
    DoFTools::make_hanging_node_constraints(dofs, constraints);
    constraints.close();

    // Parents of hanging nodes can lie outside of the cells this rank sees.
    std::vector<NodeIndex> parents;
    for (const auto &line : constraints.get_lines())
      for (const auto &entry : line.entries)
        if (!relevant_nodes.is_element(entry.first))
          parents.push_back(entry.first);
    std::sort(parents.begin(), parents.end());
    parents.erase(std::unique(parents.begin(), parents.end()), parents.end());
    relevant_nodes.add_indices(parents.begin(), parents.end());
    relevant_nodes.compress();

    set_positions();
    NodeIndex hanging = 0;
    for (const auto &line : constraints.get_lines())
      hanging += dofs.locally_owned_dofs().is_element(line.index);
    n_conforming = dofs.n_dofs() - Utilities::MPI::sum(hanging, dofs.get_communicator());
  }



  void NodalSpace::set_positions()
  {
    positions.resize(relevant_nodes.n_elements());
    std::array<NodeIndex, 8> nodes;
    for (const auto &cell : dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell_nodes(cell, nodes);
          for (unsigned int v = 0; v < 8; ++v)
            positions[relevant_nodes.index_within_set(nodes[v])] = cell->vertex(v);
        }
    if (Utilities::MPI::n_mpi_processes(dofs.get_communicator()) > 1)
      {
        const NodePartition partition(dofs.locally_owned_dofs(), relevant_nodes, dofs.get_communicator());
        Vector              field;
        partition.reinit(field);
        for (unsigned int i = 0; i < partition.n_owned(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            field.local_element(dim * i + c) = position(partition.to_global(i))[c];
        field.update_ghost_values();
        for (unsigned int i = partition.n_owned(); i < partition.n_local(); ++i)
          for (unsigned int c = 0; c < dim; ++c)
            positions[relevant_nodes.index_within_set(partition.to_global(i))][c] =
                field.local_element(dim * i + c);
      }
    // The constraints are closed: parents are conforming nodes.
    for (const auto &line : constraints.get_lines())
      {
        Point<3> mean;
        for (const auto &[parent, weight] : line.entries)
          mean += weight * position(parent);
        positions[relevant_nodes.index_within_set(line.index)] = mean;
      }
  }



  void NodalSpace::cell_nodes(const DoFHandler<3>::active_cell_iterator &cell,
                              std::array<NodeIndex, 8>                  &nodes) const
  {
    for (unsigned int v = 0; v < 8; ++v)
      nodes[v] = cell->vertex_dof_index(v, 0);
  }
} // namespace Signorini
