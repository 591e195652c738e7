// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_motion_functions_h
#define signorini_solvers_motion_functions_h

#include <signorini/algebra/node_block_matrix.h>

#include <vector>

namespace Signorini
{
  /// The rigid motions of bodies that only contact holds as functions beside those of a coarse level, set to
  /// zero at the contact nodes. On levels of meshes whose new nodes moved to a curved boundary the
  /// rotations are no coarse functions: interpolated, they have an energy, next to nothing beside that of
  /// other functions and far too much for a body that nothing else holds.
  ///
  /// Three functions share a node of the gathered problem. As A m = 0, the products of a function are those
  /// of the values that it lacks, at the contact nodes (doc/algorithm.md, (58c)).
  class MotionFunctions
  {
  public:
    /// What keeps them apart from coarse functions.
    struct Rule
    {
      /// Part of their energy that is added to it. What coarse functions can do as well is left to these
      /// then; otherwise the matrix would be singular with bodies that are held, too. Without it, and 1e-9 of
      /// all diagonal entries instead, a shaft in a V-block under next to no load takes 83 iterations for 7.
      double stiffer = 1e-9;
    };

    /// @param motions orthonormal, with A m = 0; may be empty, and must outlive the object
    /// @param rows of the contact nodes that this rank owns
    MotionFunctions(const std::vector<Vector> &motions, std::vector<unsigned int> rows);

    /// How many nodes of the gathered problem stand for them. Functions of the last one may be missing.
    unsigned int n_nodes() const
    {
      return static_cast<unsigned int>((motions.size() + dim - 1) / dim);
    }

    /// Their part of the matrix of a contact subspace.
    struct Couplings
    {
      /// With the nodes that this rank owns: n_nodes() for each of them.
      std::vector<Block> with_nodes;
      /// Among themselves, row by row; the same on all ranks.
      std::vector<Block> own;
    };

    /// Collective.
    /// @param matrix of the subspace without them
    /// @param numbers local ones in there of the contact nodes that this rank owns
    /// @param scale the diagonal entry of missing functions
    Couplings couple(const NodeBlockMatrix &matrix, const std::vector<unsigned int> &numbers,
                     const double scale) const;

    /// Collective. The work of a residual on the functions; zero for missing ones.
    std::vector<Vector3> work(const Vector &residual) const;

    /// Adds a combination of the functions to a vector, which has no ghost values.
    void add(Vector &v, const std::vector<Vector3> &coefficients) const;

  private:
    const std::vector<Vector>      &motions;
    const std::vector<unsigned int> rows;
  };
} // namespace Signorini

#endif
