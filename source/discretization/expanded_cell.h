// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_source_discretization_expanded_cell_h
#define signorini_source_discretization_expanded_cell_h

#include <signorini/discretization/elasticity.h>
#include <signorini/discretization/element.h>
#include <signorini/discretization/vertex_expansion.h>

namespace Signorini
{
  /// Stiffness and load of a cell.
  struct CellData
  {
    Element                            element;
    dealii::ArrayView<const NodeIndex> vertices;
    std::array<double, 576>            stiffness;
    std::array<Vector3, 8>             load;
    /// ½ eps0 : C : eps0 over the cell.
    double initial_energy = 0.;

    unsigned int n() const
    {
      return element.n_vertices();
    }

    /// The block of two vertices.
    const double *block(const unsigned int a, const unsigned int b) const
    {
      return stiffness.data() + 9 * (n() * a + b);
    }
  };

  /// Scatters cells with hanging or coupled vertices: K̂ = Cᵀ K C with the expansion C of the vertices.
  class ExpandedCell
  {
  public:
    void scatter(LinearSystem &system, const CellData &data, const VertexExpansion &expansion);

  private:
    using Term = VertexExpansion::Term;

    void collect(const CellData &data, const VertexExpansion &expansion, const NodePartition &partition);

    /// What a row has mirrored are the columns behind the diagonal up to mirrored_end.
    void find_mirrored(const NodeBlockMatrix &matrix);

    /// Row l of the result += a term of vertex a, transposed, times row a of K C: columns begin to end - 1.
    void add_row(const std::size_t l, const std::size_t begin, const std::size_t end, const unsigned int a,
                 const Term &term);

    void add_to(LinearSystem &system) const;

    /// Local nodes that the vertices depend on, ascending.
    std::vector<unsigned int>                                nodes;
    std::vector<std::size_t>                                 mirrored_end;
    std::array<std::vector<unsigned int>, 8>                 locals;
    std::array<std::vector<Term>, 8>                         buffer;
    std::array<std::vector<std::pair<std::size_t, Term>>, 8> terms;
    /// K C and Cᵀ K C.
    std::vector<double>  product, result;
    std::vector<Vector3> load;
  };
} // namespace Signorini

#endif
