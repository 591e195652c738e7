// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_exact_error_h
#define signorini_discretization_exact_error_h

#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/field.h>
#include <signorini/mesh/nodal_space.h>

namespace Signorini
{
  /// Distance of a discrete displacement of a body from a known one, and the norms of the known one.
  struct ExactError
  {
    /// L2 norms (length^2.5); energy norms sqrt(int eps : C : eps), eps as the stress of the cells has it
    /// (with mean dilatation or without), less the strain without stress.
    double l2 = 0., l2_norm = 0., energy = 0., energy_norm = 0.;
  };

  /// The displacement of a body.
  struct KnownDisplacement
  {
    /// Index of the body.
    unsigned int body;
    /// At points of the undeformed body (length).
    VectorField displacement;
  };

  /// Collective. Integrates with the quadrature of the elements; gradients of the known displacement by
  /// central differences over a thousandth of the cell.
  ExactError compute_exact_error(const Bodies &bodies, const Loads &loads, const NodalSpace &space,
                                 const NodePartition &partition, const Vector &displacement,
                                 const KnownDisplacement &known);
} // namespace Signorini

#endif
