// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mesh_nodal_space_h
#define signorini_mesh_nodal_space_h

#include <signorini/algebra/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>

#include <vector>

namespace Signorini
{
  /// Trilinear nodal space on a triangulation: numbers the nodes (one scalar dof of FE_Q(1) each,
  /// hanging ones included), keeps the hanging node constraints and the node positions.
  ///
  /// Positions are a field of our own, because moved vertices do not survive refinement on a
  /// distributed triangulation: a conforming node lies at its mesh vertex, a hanging node at the
  /// constrained mean of its parents, so that the geometry has no cracks.
  class NodalSpace
  {
  public:
    explicit NodalSpace(const dealii::Triangulation<3> &triangulation);

    const dealii::DoFHandler<3> &dof_handler() const
    {
      return dofs;
    }

    MPI_Comm communicator() const
    {
      return dofs.get_communicator();
    }

    /// Closed hanging node constraints u_h = sum_k C_hk u_k of the locally relevant nodes.
    const dealii::AffineConstraints<double> &hanging_nodes() const
    {
      return constraints;
    }

    NodeIndex n_nodes() const
    {
      return dofs.n_dofs();
    }

    /// Number of nodes that are not hanging, over all ranks.
    NodeIndex n_conforming_nodes() const
    {
      return n_conforming;
    }

    const dealii::IndexSet &owned() const
    {
      return dofs.locally_owned_dofs();
    }

    /// Owned nodes, nodes of ghost cells, and parents of hanging ones among them.
    const dealii::IndexSet &relevant() const
    {
      return relevant_nodes;
    }

    /// Position of a relevant node.
    const dealii::Point<3> &position(const NodeIndex node) const
    {
      return positions[relevant_nodes.index_within_set(node)];
    }

    /// The 8 nodes of an owned or ghost cell, in deal.II's vertex order.
    void cell_nodes(const dealii::DoFHandler<3>::active_cell_iterator &cell,
                    std::array<NodeIndex, 8>                          &nodes) const;

  private:
    void set_positions();

    const dealii::FE_Q<3>             fe;
    dealii::DoFHandler<3>             dofs;
    dealii::IndexSet                  relevant_nodes;
    dealii::AffineConstraints<double> constraints;
    std::vector<dealii::Point<3>>     positions;
    NodeIndex                         n_conforming = 0;
  };
} // namespace Signorini

#endif
