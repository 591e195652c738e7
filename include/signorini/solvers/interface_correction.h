// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_interface_correction_h
#define signorini_solvers_interface_correction_h

#include <signorini/algebra/node_block_matrix.h>
#include <signorini/solvers/obstacle_problem.h>

#include <memory>
#include <vector>

namespace Signorini
{
  /// The half-spaces of a smoother, as a sweep sees them.
  struct ContactState
  {
    const HalfSpaces &half_spaces;
    /// Index of the half-space at each owned node, or -1.
    const std::vector<int> &half_space_of_row;
    /// For each half-space whether the last visit ended on its plane.
    std::vector<unsigned char> &active;
  };

  /// Minimizes over the contact nodes of both sides at once, in their half-spaces, where sweeps node by node
  /// are slow: on a stiff nonmortar side. There each motion of a mortar node takes the stiff surface along
  /// (û stays), which costs stiff energy; the soft motions are those in which û compensates. Many nodes have
  /// to move for that, and no single one can begin.
  ///
  /// A sparse Cholesky factorization (CHOLMOD) on rank 0, where the contact nodes are gathered: O(N^(2/3))
  /// of them. With half-spaces a primal-dual active set method around it.
  class InterfaceCorrection
  {
  public:
    /// The contact nodes of both sides: global numbers, sorted, the same on all ranks. The matrix must
    /// outlive the object.
    InterfaceCorrection(const NodeBlockMatrix &matrix, const std::vector<NodeIndex> &contact_nodes);
    ~InterfaceCorrection();

    /// For each local node whether it is one of the contact nodes.
    const std::vector<bool> &contact_rows() const
    {
      return is_contact;
    }

    /// The owned ones.
    const std::vector<unsigned int> &owned_rows() const
    {
      return rows;
    }

    /// Rows of the matrix have changed.
    void update(const std::vector<unsigned int> &rows);

    /// Collective. v <- minimizer of the energy over the contact nodes. If the active sets do not settle, the
    /// best step that keeps active nodes on their planes, as far as the other half-spaces allow. The energy
    /// never rises.
    void apply(Vector &v, const Vector &rhs, const ContactState &contact);

  private:
    struct Gathered;

    void gather_matrix();

    const NodeBlockMatrix    &matrix;
    bool                      is_current = false;
    std::vector<NodeIndex>    nodes;
    std::vector<unsigned int> rows;
    /// Whether a local node is one of the contact nodes.
    std::vector<bool> is_contact;
    /// On rank 0.
    std::unique_ptr<Gathered> gathered;
  };
} // namespace Signorini

#endif
