// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_vertex_expansion_h
#define signorini_discretization_vertex_expansion_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/mesh/nodal_space.h>

namespace Signorini
{
  /// How the displacement of a mesh vertex depends on the unknowns û: hanging nodes are resolved, and
  /// u = T û with T = I + E S is applied at nonmortar nodes (method.md, section 4).
  class VertexExpansion
  {
  public:
    struct Term
    {
      NodeIndex node;
      double    weight;
      /// Components in which the term does not act (the fixed ones of the nonmortar node it comes from).
      FixedMask blocked;
    };

    VertexExpansion(const NodalSpace &space, const InterfaceCoupling &coupling,
                    const std::vector<FixedMask> &row_masks);

    /// Whether a relevant node is neither hanging nor coupled: its expansion is itself.
    bool is_plain(const NodeIndex node) const
    {
      return !special[space.relevant().index_within_set(node)];
    }

    void expand(const NodeIndex node, std::vector<Term> &terms) const;

  private:
    void add_conforming(const NodeIndex node, const double weight, std::vector<Term> &terms) const;

    const NodalSpace             &space;
    const InterfaceCoupling      &coupling;
    const std::vector<FixedMask> &row_masks;
    std::vector<bool>             special;
  };
} // namespace Signorini

#endif
