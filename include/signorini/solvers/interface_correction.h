// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_interface_correction_h
#define signorini_solvers_interface_correction_h

#include <signorini/solvers/gathered_obstacle_problem.h>
#include <signorini/solvers/smoother.h>

#include <vector>

namespace Signorini
{
  /// Minimizes over the contact nodes of both sides at once, in their half-spaces, where sweeps node by node
  /// are slow: on a stiff nonmortar side. There each motion of a mortar node takes the stiff surface along
  /// (û stays), which costs stiff energy; the soft motions are those in which û compensates. Many nodes have
  /// to move for that, and no single one can begin.
  ///
  /// A sparse Cholesky factorization (CHOLMOD) on rank 0, where the contact nodes are gathered: O(N^(2/3))
  /// of them. With half-spaces a primal-dual active set method around it.
  class InterfaceCorrection : public SmoothingStage
  {
  public:
    /// The contact nodes of both sides: global numbers, sorted, the same on all ranks. The matrix must
    /// outlive the object.
    InterfaceCorrection(const NodeBlockMatrix &matrix, const std::vector<NodeIndex> &contact_nodes);

    /// For each local node whether it is one of the contact nodes.
    const std::vector<bool> &contact_rows() const
    {
      return is_contact;
    }

    /// The owned ones.
    const std::vector<unsigned int> &rows() const override
    {
      return owned;
    }

    void update(const std::vector<unsigned int> &rows) override;

    /// Collective. v <- minimizer of the energy over the contact nodes. If the active sets do not settle, the
    /// best step that keeps active nodes on their planes, as far as the other half-spaces allow. It is the
    /// same in both directions.
    void run(Vector &v, const Vector &rhs, ContactState &contact, const Direction direction) override;

  private:
    void gather_matrix();

    bool                      is_current = false;
    std::vector<NodeIndex>    nodes;
    std::vector<unsigned int> owned;
    /// Whether a local node is one of the contact nodes.
    std::vector<bool>       is_contact;
    GatheredObstacleProblem problem;
  };
} // namespace Signorini

#endif
