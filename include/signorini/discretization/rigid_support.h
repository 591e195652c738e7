// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_rigid_support_h
#define signorini_discretization_rigid_support_h

#include <signorini/algebra/node_partition.h>
#include <signorini/discretization/boundary_conditions.h>

#include <algorithm>
#include <array>
#include <vector>

namespace Signorini
{
  /// Connected parts of bodies (Bodies::part()) that ties make move as one, ascending.
  using TiedParts = std::vector<unsigned int>;

  /// A rigid motion of a connected part of a body, or of several that are tied together, that Dirichlet
  /// conditions do not exclude: translation + rotation x (x - centre) / length.
  struct FreeMotion
  {
    /// What moves, and the bodies that it belongs to; middle and half diagonal of that (lengths); the motion.
    TiedParts                 parts;
    std::vector<unsigned int> bodies;
    dealii::Point<3>          centre;
    double                    length;
    Vector3                   translation, rotation;

    /// Stands for all that moves: no other motions move it but those that move the same parts.
    unsigned int first_part() const
    {
      return parts[0];
    }

    /// Whether it moves a part; there is none with a negative number.
    bool moves(const int part) const
    {
      return part >= 0 && std::binary_search(parts.begin(), parts.end(), static_cast<unsigned int>(part));
    }

    /// The displacement at a point, of the size of the translation.
    Vector3 operator()(const dealii::Point<3> &x) const
    {
      return translation + cross_product_3d(rotation, (x - centre) / length);
    }
  };

  /// Every connected part of the bodies on its own.
  std::vector<TiedParts> separate_parts(const Bodies &bodies);

  /// Collective. An orthonormal basis of the motions that the conditions leave to groups of parts, each part
  /// in one of them. Empty if all are held.
  std::vector<FreeMotion> free_motions(const Bodies &bodies, const NodalSpace &space,
                                       const DirichletData &dirichlet, const std::vector<TiedParts> &groups);

  /// Owned nodes of a level.
  struct NodePlaces
  {
    /// (length)
    std::vector<dealii::Point<3>> positions;
    /// Bodies::part(), or -1 at nodes of no owned cell.
    std::vector<int> parts;
  };

  /// Collective. Those of a space.
  NodePlaces node_places(const Bodies &bodies, const NodalSpace &space);

  /// Collective. The displacements of the motions, each zero on all other parts, on a partition of the nodes;
  /// ghosts up to date.
  /// @param places of its owned nodes
  std::vector<Vector> motion_fields(const std::vector<FreeMotion> &motions, const NodePlaces &places,
                                    const NodePartition &partition);

  /// Collective. The same on the nodes of a space.
  std::vector<Vector> motion_fields(const std::vector<FreeMotion> &motions, const Bodies &bodies,
                                    const NodalSpace &space, const NodePartition &partition);

  /// Whether contact can hold the bodies: whether pressures lambda >= 0 with G^T lambda = f exist.
  struct RigidBalance
  {
    /// By Farkas' lemma: if not, f - G^T lambda is a motion on which the loads do work and that all contacts
    /// allow. Zero if the bodies are held.
    std::vector<double> flight;
    bool                is_held = true;
    /// A motion that closes the gaps of the nodes that hold the bodies.
    std::vector<double> settling;
  };

  /// @param motions row by row, n_motions each: the normal relative displacement of every contact node in
  ///   every motion (G)
  /// @param gaps of the contact nodes
  /// @param loads the work of the loads on every motion (f)
  RigidBalance balance_rigid_motions(const std::vector<double> &motions, const std::vector<double> &gaps,
                                     const std::vector<double> &loads);

  /// The point of a polyhedron that is nearest to a target: min |x - target|, G x <= bounds. The origin must
  /// be in it (Lawson & Hanson 1974, chapter 23, problem LDP).
  /// @param rows G row by row
  /// @param bounds not negative
  std::vector<double> nearest_admissible(const std::vector<double> &rows, const std::vector<double> &bounds,
                                         const std::vector<double> &target);

  /// Another basis of the span of some motions, given by their coefficients: motions of a single part before
  /// those of several, translations before rotations.
  std::vector<std::vector<double>> separate_motions(const std::vector<FreeMotion>          &motions,
                                                    const std::vector<std::vector<double>> &basis);
} // namespace Signorini

#endif
