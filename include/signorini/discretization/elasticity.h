// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_elasticity_h
#define signorini_discretization_elasticity_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/node_block_matrix.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/discretization/vertex_expansion.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <unordered_map>
#include <vector>

namespace Signorini
{
  /// The discrete problem in the unknowns û - lift: Â = Tᵀ A T with fixed components eliminated, and
  /// b̂ = Tᵀ (b - A u_D), where u_D is the Dirichlet lift that is zero at free components.
  struct LinearSystem
  {
    /// Â and b̂ on a partition of the nodes.
    NodeBlockMatrix matrix;
    Vector          rhs;
    /// Fixed components of all local nodes of the matrix; hanging nodes are fixed altogether.
    std::vector<FixedDirections> fixed;
  };

  /// Collective. coupling: S, with the links of chains (BasisTransformation). projections: A_p of its rows.
  /// An empty coupling gives the decoupled linear problem. Errors: InputError for cells with nonpositive
  /// Jacobian.
  LinearSystem assemble_elasticity(const Bodies &bodies, const NodalSpace &space, const Loads &loads,
                                   const DirichletData &dirichlet, const InterfaceCoupling &coupling,
                                   const std::vector<RowProjection> &projections);

  /// Adds forces and moments on rigid faces to a right hand side.
  void add_rigid_forces(Vector &rhs, const NodePartition &partition, const DirichletData &dirichlet);

  /// Collective. A u - f by node in the physical basis, hanging nodes resolved: at free components what is
  /// left is the contact force, at fixed ones the reaction too. u has the layout of `partition` (owned and
  /// relevant nodes), hanging values included, ghosts up to date.
  Vector physical_residual(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                           const Loads &loads, const Vector &u);

  /// Collective. ½uᵀAu of a displacement (as in physical_residual()).
  double strain_energy(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                       const Vector &u);

  /// Collective. The potential energy ½uᵀAu - fᵀu + ½∫ε0:C:ε0 of a displacement (as in physical_residual()),
  /// prescribed displacements included and strains ε0 without stress, whose forces are in f: what meshes can
  /// be compared by.
  double potential_energy(const Bodies &bodies, const NodalSpace &space, const NodePartition &partition,
                          const Loads &loads, const Vector &u);
} // namespace Signorini

#endif
