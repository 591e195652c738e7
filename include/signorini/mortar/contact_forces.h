// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_mortar_contact_forces_h
#define signorini_mortar_contact_forces_h

#include <signorini/mortar/pair_coupling.h>

#include <vector>

namespace Signorini
{
  /// The forces of a contact stress on the nodes of both sides of a pair.
  struct ContactForces
  {
    /// A force on a node (force).
    struct NodalForce
    {
      /// Which node, and where (length).
      NodeIndex        node;
      dealii::Point<3> position;
      Vector3          force;
    };

    /// One side, sorted by node, with the sum of the forces and of their moments about the origin.
    struct Side
    {
      /// The forces, their sum, and the sum of their moments (force, force times length).
      std::vector<NodalForce> nodes;
      Vector3                 force, moment;
    };

    /// Of the two sides.
    Side nonmortar, mortar;
  };

  /// F_non,j = -sum_k D_kj lambda_k n_k and F_mor,q = +sum_k M_kq lambda_k n_k (doc/algorithm.md, (20)). The
  /// sums of both sides cancel to rounding, the moments up to sum_k lambda_k int psi_k (x - Phi(x)) x n_k.
  /// Of the rows of this rank: those of all ranks add up.
  /// @param traction contact stress, lambda_k n_k or any (force per area), in the order of the rows of the
  /// pair
  ContactForces compute_contact_forces(const ContactSurface &nonmortar, const ContactSurface &mortar,
                                       const PairCoupling &pair, const std::vector<Vector3> &traction);

  /// When a recovered pressure is that of a whole patch. Pure number.
  struct RecoveryRule
  {
    /// Of the integral of a vertex's function, to the mean of those on its faces: at the edge of a sharp
    /// punch a node with 5e-4 of its neighbours' area had a multiplier 200 times theirs.
    double smallest_share = .05;
  };

  /// Collective. A smoother contact pressure than the multipliers, by vertex of the nonmortar surface: the
  /// means int phi_v lambda_h / int phi_v over the covered part (doc/algorithm.md, (66)). On quadrilaterals
  /// lambda_h = sum lambda_p phi_p; on triangles, where multipliers scatter more, its mean on each face. The
  /// total force and constants stay, what jumps from node to node goes. Vertices without a multiplier do not
  /// count; without any near them the mean is zero. Given at the vertices of this rank and at the corners of
  /// its faces.
  /// @param moments of own and ghost faces
  /// @param pressure per row of the pair
  std::vector<double> recover_pressure(const ContactSurface &nonmortar, const SurfaceHalo &halo,
                                       const std::vector<FaceMoments> &moments, const PairCoupling &pair,
                                       const std::vector<double> &pressure);

  /// Collective. What arrives of values at the rows on the mortar side, by vertex of its surface: the means
  /// sum_p M_pq value_p / sum_p M_pq, zero where nothing is covered. Of contact stresses or pressures (force
  /// per area).
  /// @param partition of the nodes: their owners sum up
  std::vector<Vector3> mortar_means(const ContactSurface &mortar, const PairCoupling &pair,
                                    const std::vector<Vector3> &of_rows, const NodePartition &partition);
  std::vector<double>  mortar_means(const ContactSurface &mortar, const PairCoupling &pair,
                                    const std::vector<double> &of_rows, const NodePartition &partition);
} // namespace Signorini

#endif
