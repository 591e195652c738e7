// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_error_indicator_h
#define signorini_discretization_error_indicator_h

#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>
#include <signorini/mesh/bodies.h>
#include <signorini/mesh/nodal_space.h>

#include <map>
#include <vector>

namespace Signorini
{
  /// A traction t on a part of a boundary face, as far as the residual needs it.
  struct FaceTraction
  {
    /// Integrals of the corner functions times t (force), corners in the order of CellShape::face.
    std::array<Vector3, 4> moments;
    /// Integral of |t|^2 (force^2 / area).
    double square = 0.;
  };

  /// Collective. The squared residual indicator (energy, doc/algorithm.md, (62)) of every cell of the space;
  /// only those of owned cells are meaningful:
  ///   h^2 |f + div sigma|^2 / (2 mu)  in the cell,
  ///   h_F |[sigma n]|^2 / (mu_1 + mu_2)  half for each cell of an inner face (subface by subface),
  ///   h_F |sigma n - t|^2 / (2 mu)  on boundary faces, in the components that are not prescribed.
  /// Loads are taken as they are, so that the oscillation of the data is in it.
  /// @param displacement at the nodes of partition, hanging ones and ghosts too
  /// @param contact tractions of contact by index of the boundary face; added to the loads
  std::vector<double> residual_indicator(const Bodies &bodies, const NodalSpace &space,
                                         const NodePartition &partition, const Loads &loads,
                                         const Vector                               &displacement,
                                         const std::map<unsigned int, FaceTraction> &contact);

  /// Collective. Marks the fewest owned cells that have the share `fraction` of the sum of the (squared)
  /// indicators together (Doerfler).
  std::vector<bool> mark_share_of_error(const NodalSpace &space, const std::vector<double> &indicator,
                                        const double fraction);

  /// Collective. Marks the share `fraction` of the cells with the largest indicators.
  std::vector<bool> mark_share_of_cells(const NodalSpace &space, const std::vector<double> &indicator,
                                        const double fraction);
} // namespace Signorini

#endif
