// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_foreign_levels_h
#define signorini_solvers_foreign_levels_h

#include <signorini/solvers/multigrid_hierarchy.h>
#include <signorini/solvers/v_cycle.h>

#include <set>

namespace Signorini
{
  /// How the numbers of a foreign problem (deal.II's, Trilinos') belong to nodes: dof = n_components * node +
  /// component, the numbering of deal.II's vertex elements, scalar or with components. Components beyond the
  /// last one are fixed.
  struct ForeignNumbering
  {
    /// 1, 2 or 3.
    unsigned int n_components = 1;

    /// Mask of the components that a node does not have.
    FixedMask missing() const
    {
      return static_cast<FixedMask>(all_fixed & ~((1u << n_components) - 1u));
    }

    /// The owned nodes of a rank; its dofs come node by node.
    dealii::IndexSet nodes(const dealii::IndexSet &dofs) const;

    /// Masks of the owned nodes: missing components, and dofs whose value is prescribed (zero).
    std::vector<FixedDirections> fixed(const dealii::IndexSet &owned_dofs,
                                       const dealii::IndexSet &prescribed) const;
  };



  /// Collective. A symmetric matrix with deal.II's iterators over rows (SparseMatrix,
  /// TrilinosWrappers::SparseMatrix) as a matrix of the hierarchy: a copy, 9 numbers for each pair of nodes.
  template <typename Matrix>
  NodeBlockMatrix read_matrix(const Matrix &matrix, const ForeignNumbering &numbering,
                              const dealii::IndexSet &owned_dofs, const MPI_Comm communicator);

  /// A prolongation matrix of the same kind, from the dofs of a coarse level to those of the next finer one,
  /// as rows by node of the owned fine nodes. All components of a node have the weights of the first one.
  template <typename Matrix>
  NodeRows read_prolongation(const Matrix &prolongation, const ForeignNumbering &numbering,
                             const dealii::IndexSet &owned_fine_dofs);



  /// The levels of a foreign hierarchy, from read_prolongation(); coarse matrices are Galerkin products.
  class ForeignLevels : public LevelSource
  {
  public:
    /// One level below another.
    struct Level
    {
      /// Of the owned nodes of the finer level.
      NodeRows rows;
      /// Owned nodes and their masks (ForeignNumbering).
      dealii::IndexSet             owned;
      std::vector<FixedDirections> fixed;
    };

    /// Finest first: levels[0] is the one below the finest. Every node of the finest level may have a
    /// half-space.
    /// @param half_spaces those of the problem: coarse nodes that are nodes of the finest level get theirs,
    /// for a start from the coarser levels. Empty: none. (A coarse node gets none if another rank owns the
    /// fine one.)
    explicit ForeignLevels(std::vector<Level> &&levels, const HalfSpaces &half_spaces = HalfSpaces())
      : levels(std::move(levels))
      , half_spaces(half_spaces)
    {
    }

    std::optional<CoarserLevel> next(const NodePartition &finer) override;

    LevelZero level_zero(const NodePartition &) override
    {
      return LevelZero();
    }

  private:
    /// Those of a coarse level from those of the level above it.
    HalfSpaces inject(const Level &level) const;

    std::vector<Level> levels;
    /// Of the level that was described last.
    HalfSpaces  half_spaces;
    std::size_t n_described = 0;
  };



  /// The V-cycle of a hierarchy as a preconditioner for deal.II's solvers (SolverCG): symmetric and positive
  /// definite. Vectors are those of the numbering.
  class VCyclePreconditioner
  {
  public:
    /// The hierarchy must outlive the object and not be truncated.
    VCyclePreconditioner(MultigridHierarchy &hierarchy, const ForeignNumbering &numbering,
                         const SmoothingParameters &smoothing = SmoothingParameters())
      : numbering(numbering)
      , cycle(hierarchy, smoothing, hierarchy.n_levels() - 1)
      , first(hierarchy.finest().matrix.partition().first_owned())
    {
      for (Vector *vector : {&correction, &defect})
        hierarchy.finest().matrix.partition().reinit(*vector);
      fixed = hierarchy.finest().fixed;
    }

    /// Collective. dst = (approximate inverse of the matrix) src; prescribed dofs are handed through.
    template <typename VectorType>
    void vmult(VectorType &dst, const VectorType &src) const;

  private:
    const ForeignNumbering       numbering;
    mutable VCycle               cycle;
    const NodeIndex              first;
    std::vector<FixedDirections> fixed;
    mutable Vector               correction, defect;
  };



  template <typename Matrix>
  NodeBlockMatrix read_matrix(const Matrix &matrix, const ForeignNumbering &numbering,
                              const dealii::IndexSet &owned_dofs, const MPI_Comm communicator)
  {
    const dealii::IndexSet owned = numbering.nodes(owned_dofs);
    const unsigned int     n     = numbering.n_components;
    NodePattern            pattern;
    std::set<NodeIndex>    columns;
    for (const NodeIndex node : owned)
      {
        columns.clear();
        for (unsigned int c = 0; c < n; ++c)
          for (auto entry = matrix.begin(n * node + c); entry != matrix.end(n * node + c); ++entry)
            columns.insert(entry->column() / n);
        pattern.columns.insert(pattern.columns.end(), columns.begin(), columns.end());
        pattern.row_start.push_back(pattern.columns.size());
      }
    NodeBlockMatrix result;
    result.reinit(owned, pattern, dealii::IndexSet(owned.size()), communicator);
    for (const NodeIndex node : owned)
      for (unsigned int c = 0; c < n; ++c)
        for (auto entry = matrix.begin(n * node + c); entry != matrix.end(n * node + c); ++entry)
          {
            const unsigned int row    = result.partition().to_local(node);
            const unsigned int column = result.partition().to_local(entry->column() / n);
            if (result.stores(row, column))
              result.block(result.find(row, column))[dim * c + entry->column() % n] = entry->value();
          }
    return result;
  }



  template <typename Matrix>
  NodeRows read_prolongation(const Matrix &prolongation, const ForeignNumbering &numbering,
                             const dealii::IndexSet &owned_fine_dofs)
  {
    const unsigned int n = numbering.n_components;
    NodeRows           rows;
    for (const NodeIndex node : numbering.nodes(owned_fine_dofs))
      {
        for (auto entry = prolongation.begin(n * node); entry != prolongation.end(n * node); ++entry)
          if (entry->value() != 0.)
            rows.add(entry->column() / n, entry->value());
        rows.finish_row();
      }
    return rows;
  }



  template <typename VectorType>
  void VCyclePreconditioner::vmult(VectorType &dst, const VectorType &src) const
  {
    const unsigned int n = numbering.n_components;
    defect               = 0.;
    const auto for_each  = [&](const auto &action) {
      for (unsigned int i = 0; dim * i < defect.locally_owned_size(); ++i)
        for (unsigned int c = 0; c < n; ++c)
          action(n * (first + i) + c, dim * i + c, (fixed[i].components() & (1u << c)) != 0);
    };
    for_each([&](const NodeIndex dof, const unsigned int local, const bool is_fixed) {
      defect.local_element(local) = is_fixed ? 0. : src(dof);
    });
    cycle.apply(correction, defect);
    for_each([&](const NodeIndex dof, const unsigned int local, const bool is_fixed) {
      dst(dof) = is_fixed ? src(dof) : correction.local_element(local);
    });
    dst.compress(dealii::VectorOperation::insert);
  }
} // namespace Signorini

#endif
