// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_node_phases_h
#define signorini_solvers_node_phases_h

#include <signorini/solvers/relative_couplings.h>

#include <vector>

namespace Signorini
{
  /// In which phase of a sweep a node is visited (doc/algorithm.md, chapter 8): one of three, of
  /// six where ranks have few nodes. All
  /// ranks work in each phase. Nodes that ranks share get phases such that few and weak couplings between
  /// ranks join nodes of the same one; the inner nodes of a rank fill up the phases until all ranks take
  /// equally long. On one rank there is one phase.
  class NodePhases
  {
  public:
    /// Collective.
    NodePhases(const NodeBlockMatrix &matrix, const RelativeCouplings &couplings);

    /// Number of phases, the same on all ranks.
    unsigned int size() const
    {
      return n_phases;
    }

    /// The phase of a local node, owned or ghost.
    unsigned int operator[](const unsigned int local_node) const
    {
      return of_node[local_node];
    }

    /// Whether an owned node is a ghost elsewhere.
    bool is_shared(const unsigned int row) const
    {
      return shared[row];
    }

  private:
    struct Coupling
    {
      unsigned int row, ghost;
      double       norm;
    };

    void move_shared_nodes(const NodeBlockMatrix &matrix, const std::vector<Coupling> &couplings,
                           const unsigned int pass);
    void fill_up(const NodeBlockMatrix &matrix);

    unsigned int               n_phases = 1;
    std::vector<unsigned char> of_node;
    std::vector<bool>          shared;
  };
} // namespace Signorini

#endif
