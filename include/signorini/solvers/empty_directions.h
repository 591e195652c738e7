// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_empty_directions_h
#define signorini_solvers_empty_directions_h

#include <signorini/algebra/node_block_matrix.h>

#include <map>
#include <vector>

namespace Signorini
{
  /// Directions in which a node of a coarse level has no stiffness: truncation leaves such ones behind, and
  /// functions of background levels that hardly reach a node. They get some, so that diagonal blocks have
  /// inverses and the level is definite. The levels below must not see it: they would be too stiff.
  class EmptyDirections
  {
  public:
    /// Fills the empty directions of the diagonal blocks of some owned rows.
    /// @param scale the largest diagonal entry of the level
    void fill(NodeBlockMatrix &matrix, const std::vector<unsigned int> &rows, const double scale);

    /// Takes out of the matrix what was filled in. Returns the rows, to be filled again.
    std::vector<unsigned int> restore(NodeBlockMatrix &matrix);

    /// Makes residual = b - A v of the filled matrix that of the matrix without: the equations of the levels
    /// below. What the filling leaves of a residual there would be a load that nothing opposes.
    /// @param matrix the filled one
    void leave_out(Vector &residual, const NodeBlockMatrix &matrix, const Vector &v) const;

  private:
    /// The blocks as they are without.
    std::map<unsigned int, Block> originals;
  };
} // namespace Signorini

#endif
