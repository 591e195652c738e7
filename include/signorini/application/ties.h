// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_application_ties_h
#define signorini_application_ties_h

#include <signorini/application/contact_solve.h>
#include <signorini/discretization/elasticity.h>

namespace Signorini
{
  // Tied pairs: the mortar coupling as an equality. The relative displacement û_p of a tied node is a fixed
  // component of the transformed problem, and zero, because the lift has no jump at tied nodes.

  /// Collective. The conditions of a space with a lift that moves along with that of the other side at tied
  /// nodes, so that it has no jump there.
  DirichletData lift_ties(const ConstrainedSpace &constrained, const InterfaceCoupling &coupling,
                          const std::vector<RowProjection> &projections,
                          const std::vector<unsigned char> &tied);

  /// Fixes the unknowns at tied nodes, at zero.
  void fix_tied_unknowns(LinearSystem &system, const Discretization &discretization);

  /// Sets the unknowns of tied nodes that this rank owns to zero.
  void clear_tied_unknowns(Vector &v, const NodePartition &unknowns, const Discretization &discretization);

  /// Collective. Sets the stress at tied nodes, which are not in the matrix: what the equilibrium of the
  /// displacement lacks.
  void set_tie_stress(ContactStress &stress, const ContactModel &model, const Discretization &discretization,
                      const Vector &displacement);
} // namespace Signorini

#endif
