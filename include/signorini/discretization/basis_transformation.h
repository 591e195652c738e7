// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_basis_transformation_h
#define signorini_discretization_basis_transformation_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/node_partition.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/nodal_space.h>
#include <signorini/solvers/obstacle_problem.h>

#include <vector>

namespace Signorini
{
  /// u = u_D + T v with T = I + A S (S + S² + ... if pairs form chains), and back (doc/algorithm.md, (25)). v
  /// is the unknown of the obstacle problem: relative displacement at nodes with a multiplier, zero in fixed
  /// components.
  class BasisTransformation
  {
  public:
    /// All arguments must outlive the object.
    /// @param coupling S
    /// @param expansion what T has in its place: with links of chains
    /// @param projections A_p of the rows of both
    BasisTransformation(const NodalSpace &space, const NodePartition &space_partition,
                        const DirichletData &dirichlet, const InterfaceCoupling &coupling,
                        const InterfaceCoupling &expansion, const std::vector<RowProjection> &projections);

    /// Collective. The physical displacement of all relevant nodes, hanging ones included, on the
    /// partition of the space. `unknowns` is the partition of v; it knows the columns of owned rows.
    Vector to_displacement(const Vector &v, const NodePartition &unknowns) const;

    /// Collective. v from a physical displacement: T⁻¹ (u - u_D), zero in fixed components and hanging
    /// nodes. Sets the owned entries of v.
    void from_displacement(Vector &v, const Vector &u) const;

    /// Collective. Tᵀ f of nodal forces (force by node, on the partition of the space, none at hanging
    /// nodes), on the partition of v.
    Vector restrict_forces(const Vector &forces, const NodePartition &unknowns) const;

    /// Collective. u_D at all relevant nodes, hanging ones included, on the partition of the space.
    Vector lift() const;

    /// Collective. The bounds of the half-spaces for v, along RowProjection::direction():
    /// (g_p - n_p·(u_D,p - (S u_D)_p)) / |m_p|. Both lists are ordered like the rows of the coupling, of
    /// which each rank has its own.
    std::vector<double> reduce_gaps(const std::vector<double> &gaps) const;

    /// Sets hanging nodes to their interpolated values and updates the ghosts.
    void interpolate_hanging_nodes(Vector &u) const;

  private:
    /// u at the owned nodes of rigid faces, from the unknowns of the carriers.
    void move_rigid_faces(Vector &u, const std::vector<Vector3> &carriers) const;

    /// The unknowns of the carriers, from the motions that are nearest to u at the nodes of the faces.
    void fit_rigid_faces(Vector &v, const Vector &u) const;

    /// The part of Tᵀ f that belongs to rigid faces.
    void gather_rigid_forces(Vector &result, const Vector &forces) const;

    const NodalSpace                 &space;
    const NodePartition              &partition;
    const DirichletData              &dirichlet;
    const InterfaceCoupling          &coupling, &expansion;
    const std::vector<RowProjection> &projections;
    /// Rows of the coupling that this rank owns: position, local node.
    std::vector<std::pair<std::size_t, unsigned int>> owned_rows;
    /// Sorted nodes in the columns of the coupling, as this rank has it.
    std::vector<NodeIndex> column_nodes;
  };
} // namespace Signorini

#endif
