// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_discretization_vertex_expansion_h
#define signorini_discretization_vertex_expansion_h

#include <signorini/algebra/interface_coupling.h>
#include <signorini/algebra/row_projection.h>
#include <signorini/discretization/rigid_faces.h>
#include <signorini/mesh/nodal_space.h>

namespace Signorini
{
  /// How the displacement of a mesh vertex depends on the unknowns û: hanging nodes are resolved, u = T û
  /// with T = I + A S (with the links of chains) is applied at nonmortar nodes (doc/algorithm.md, (25)), and
  /// nodes of rigid faces follow their carriers.
  class VertexExpansion
  {
  public:
    /// One term of u at a vertex: W û, with a block W.
    struct Term
    {
      /// Whose unknown û, and a scalar (pure number).
      NodeIndex node;
      double    weight;
      /// A_p of the nonmortar node it comes from, or what a node of a rigid face takes from a carrier; null
      /// for the identity.
      const Block *block;

      /// target += source W, blocks of nine numbers, with W = weight * block.
      void add_product(double *const target, const double *const source) const;

      /// target += Wᵀ source.
      void add_transposed_product(double *const target, const double *const source) const;

      /// Wᵀ source.
      Vector3 transposed_product(const Vector3 &source) const;
    };

    /// All arguments must outlive the object. coupling: S, with the links of chains (BasisTransformation).
    /// projections: A_p of its rows. rigid: null without rigid faces.
    VertexExpansion(const NodalSpace &space, const InterfaceCoupling &coupling,
                    const std::vector<RowProjection> &projections, const RigidFaces *const rigid);

    /// Whether a relevant node is neither hanging nor coupled: its expansion is itself.
    bool is_plain(const NodeIndex node) const
    {
      return !special[space.relevant().index_within_set(node)];
    }

    /// The terms of the displacement of a relevant node; replaces what is in the list.
    void expand(const NodeIndex node, std::vector<Term> &terms) const;

  private:
    void add_conforming(const NodeIndex node, const double weight, std::vector<Term> &terms) const;

    const NodalSpace        &space;
    const InterfaceCoupling &coupling;
    const RigidFaces *const  rigid;
    /// A_p by row of the coupling, and whether it is the identity.
    std::vector<Block> blocks;
    std::vector<bool>  is_identity;
    std::vector<bool>  special;
  };



  inline void VertexExpansion::Term::add_product(double *const target, const double *const source) const
  {
    if (block == nullptr)
      for (unsigned int i = 0; i < dim * dim; ++i)
        target[i] += source[i] * weight;
    else
      {
        const Block product = weight * (read_block(source) * *block);
        for (unsigned int i = 0; i < dim * dim; ++i)
          target[i] += product[i / dim][i % dim];
      }
  }



  inline void VertexExpansion::Term::add_transposed_product(double *const       target,
                                                            const double *const source) const
  {
    if (block == nullptr)
      for (unsigned int i = 0; i < dim * dim; ++i)
        target[i] += weight * source[i];
    else
      {
        const Block product = weight * (transpose(*block) * read_block(source));
        for (unsigned int i = 0; i < dim * dim; ++i)
          target[i] += product[i / dim][i % dim];
      }
  }



  inline Vector3 VertexExpansion::Term::transposed_product(const Vector3 &source) const
  {
    return block == nullptr ? weight * source : weight * (source * *block);
  }
} // namespace Signorini

#endif
