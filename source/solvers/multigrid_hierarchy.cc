// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/galerkin_product.h>
#include <signorini/solvers/multigrid_hierarchy.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// Directions in which a diagonal block has no stiffness get the stiffness `scale`.
    void fill_empty_directions(double *const block, const double scale)
    {
      SymmetricTensor<2, dim> s;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = c; d < dim; ++d)
          s[c][d] = .5 * (block[dim * c + d] + block[dim * d + c]);
      const double mean = trace(s) / dim;
      // Well away from singular: the common case.
      if (mean > 1e-10 * scale && determinant(s) > 1e-8 * mean * mean * mean)
        return;
      const auto   pairs     = eigenvectors(s, SymmetricTensorEigenvectorMethod::jacobi);
      const double reference = std::max(pairs[0].first, 0.);
      for (const auto &[value, direction] : pairs)
        if (value <= 1e-11 * std::max(reference, 1e-3 * scale))
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              block[dim * c + d] +=
                  (reference > 1e-10 * scale ? reference : scale) * direction[c] * direction[d];
    }

    std::vector<unsigned int> all_rows(const NodeBlockMatrix &matrix)
    {
      std::vector<unsigned int> rows(matrix.n_rows());
      std::iota(rows.begin(), rows.end(), 0u);
      return rows;
    }
  } // namespace



  void restrict_defect(const MultigridLevel &level, Vector &coarse_defect, const Vector &residual)
  {
    level.to_finer.restrict_and_add(coarse_defect, residual);
    for (unsigned int i = 0; i < level.matrix.n_rows(); ++i)
      if (level.fixed[i] != 0)
        for (unsigned int c = 0; c < dim; ++c)
          if (level.fixed[i] & (1u << c))
            coarse_defect.local_element(dim * i + c) = 0.;
  }



  void eliminate_fixed_components(NodeBlockMatrix &matrix, const std::vector<FixedMask> &fixed,
                                  const std::vector<unsigned int> &rows, const double scale)
  {
    for (const unsigned int i : rows)
      {
        for (const BlockRange &range : matrix.ranges(i))
          for (std::size_t k = range.begin; k < range.end; ++k)
            {
              const FixedMask row_mask = fixed[i], column_mask = fixed[matrix.column(k)];
              if (row_mask == 0 && column_mask == 0)
                continue;
              const bool    is_diagonal = k == matrix.diagonal(i);
              double *const b           = matrix.block(k);
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  if ((row_mask & (1u << c)) || (column_mask & (1u << d)))
                    {
                      if (is_diagonal && c == d)
                        b[dim * c + d] = b[dim * c + d] > 0. ? b[dim * c + d] : scale;
                      else
                        b[dim * c + d] = 0.;
                    }
            }
        fill_empty_directions(matrix.block(matrix.diagonal(i)), scale);
      }
  }



  MultigridHierarchy::MultigridHierarchy(NodeBlockMatrix &&matrix, std::vector<FixedMask> fixed)
  {
    levels.push_back(std::make_unique<MultigridLevel>());
    levels[0]->matrix = std::move(matrix);
    levels[0]->fixed  = std::move(fixed);
    levels[0]->scale  = diagonal_scale(levels[0]->matrix);
    eliminate_fixed_components(levels[0]->matrix, levels[0]->fixed, all_rows(levels[0]->matrix),
                               levels[0]->scale);
    levels[0]->smoother = std::make_unique<ProjectedGaussSeidel>(levels[0]->matrix);
  }



  void MultigridHierarchy::add_coarser_level(NodalTransfer &&transfer, const IndexSet &owned_coarse,
                                             const std::vector<FixedMask> &fixed)
  {
    const NodeBlockMatrix &fine = levels.back()->matrix;
    levels.push_back(std::make_unique<MultigridLevel>());
    MultigridLevel &level = *levels.back();
    level.to_finer        = std::move(transfer);
    if (levels.size() == 2 && expected_nodes.size() > 0)
      {
        truncate_transfer(expected_planes, expected_nodes);
        for (Vector *vector : {&expected_planes, &expected_nodes})
          vector->reinit(0);
      }
    reinit_galerkin(level.matrix, fine, level.to_finer, owned_coarse);
    level.fixed = import_ghost_masks(level.matrix.partition(), fixed);
    compute_galerkin(level.matrix, fine, level.to_finer);
    level.scale = diagonal_scale(level.matrix);
    eliminate_fixed_components(level.matrix, level.fixed, all_rows(level.matrix), level.scale);
    level.smoother = std::make_unique<ProjectedGaussSeidel>(level.matrix);
  }



  void MultigridHierarchy::set_interface(const std::vector<NodeIndex> &contact_nodes, const bool may_be_slow)
  {
    const NodeBlockMatrix &matrix = coarsest().matrix;
    std::vector<bool>      is_contact(matrix.partition().n_local(), false);
    for (const NodeIndex node : contact_nodes)
      if (const unsigned int local = matrix.partition().to_local(node);
          local != numbers::invalid_unsigned_int)
        is_contact[local] = true;
    const std::vector<unsigned int> rows =
        matrix.rows_with_column([&](const unsigned int column) { return is_contact[column]; });
    coarsest().smoother->set_interface(rows);
    if (may_be_slow && coarsest().smoother->correct_slow_interface(contact_nodes))
      slow_interface = true;
  }



  void MultigridHierarchy::finish(LevelZero new_level_zero)
  {
    level_zero = std::move(new_level_zero);
    if (levels.size() == 1)
      {
        const NodePartition &partition = levels[0]->matrix.partition();
        NodeRows             rows;
        for (unsigned int i = 0; i < partition.n_local(); ++i)
          {
            rows.add(partition.to_global(i), 1.);
            rows.finish_row();
          }
        NodalTransfer identity;
        identity.reinit(rows, {}, partition.n_owned());
        IndexSet owned(partition.n_global());
        owned.add_range(partition.first_owned(), partition.first_owned() + partition.n_owned());
        const std::vector<FixedMask> fixed(levels[0]->fixed.begin(),
                                           levels[0]->fixed.begin() + partition.n_owned());
        add_coarser_level(std::move(identity), owned, fixed);
        levels.back()->contact = level_zero.contact;
      }
    level_zero_changed = true;
  }



  const LevelZeroSolver &MultigridHierarchy::coarse_solver()
  {
    if (level_zero_changed)
      level_zero_solver.setup(levels.back()->matrix, level_zero);
    level_zero_changed = false;
    return level_zero_solver;
  }



  MultigridHierarchy::WithoutFinest::WithoutFinest(MultigridHierarchy &hierarchy)
    : hierarchy(hierarchy)
    , finest(std::move(hierarchy.levels.front()))
  {
    hierarchy.levels.erase(hierarchy.levels.begin());
  }



  MultigridHierarchy::WithoutFinest::~WithoutFinest()
  {
    hierarchy.levels.insert(hierarchy.levels.begin(), std::move(finest));
  }



  void MultigridHierarchy::expect_active_set(const ObstacleProblem &problem, const Vector &start)
  {
    Assert(levels.size() == 1, ExcMessage("The coarser levels are there already."));
    ProjectedGaussSeidel &smoother = *levels[0]->smoother;
    Vector                v        = start;
    smoother.set_half_spaces(problem.half_spaces);
    smoother.find_active(v, problem.rhs);
    set_truncated(problem.half_spaces, smoother.active(), expected_planes, expected_nodes);
    was_expected = true;
  }



  bool MultigridHierarchy::set_truncated(const HalfSpaces                 &half_spaces,
                                         const std::vector<unsigned char> &active, Vector &planes,
                                         Vector &changed)
  {
    const NodePartition        &partition = levels[0]->matrix.partition();
    std::vector<unsigned char> &truncated = levels[0]->truncated;
    truncated.resize(half_spaces.size(), 0);
    const bool any_change = !std::equal(truncated.begin(), truncated.end(), active.begin());
    if (Utilities::MPI::max(static_cast<int>(any_change), partition.communicator()) == 0)
      return false;
    partition.reinit(planes);
    partition.reinit(changed);
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      {
        changed.local_element(dim * half_spaces.nodes[p]) = truncated[p] != active[p];
        if (active[p])
          for (unsigned int c = 0; c < dim; ++c)
            planes.local_element(dim * half_spaces.nodes[p] + c) = half_spaces.normals[p][c];
        truncated[p] = active[p];
      }
    planes.update_ghost_values();
    changed.update_ghost_values();
    return true;
  }



  void MultigridHierarchy::truncate_transfer(const Vector &planes, const Vector &changed)
  {
    for (unsigned int i = 0; i < levels[0]->matrix.partition().n_local(); ++i)
      if (changed.local_element(dim * i) != 0.)
        {
          Vector3 normal;
          for (unsigned int c = 0; c < dim; ++c)
            normal[c] = planes.local_element(dim * i + c);
          levels[1]->to_finer.set_plane(i, normal);
        }
  }



  bool MultigridHierarchy::truncate(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active)
  {
    const NodeBlockMatrix &fine = levels[0]->matrix;
    Vector                 planes, changed;
    if (!set_truncated(half_spaces, active, planes, changed))
      return false;
    truncate_transfer(planes, changed);

    std::vector<unsigned int> rows = fine.rows_with_column(
        [&](const unsigned int column) { return changed.local_element(dim * column) != 0.; });
    for (std::size_t l = 1; l < levels.size(); ++l)
      {
        MultigridLevel &level  = *levels[l];
        const auto      marked = mark_coarse_nodes(level.to_finer, rows);
        compute_galerkin(level.matrix, levels[l - 1]->matrix, level.to_finer, marked);
        rows.clear();
        for (unsigned int i = 0; i < level.matrix.n_rows(); ++i)
          if (marked[i])
            rows.push_back(i);
        eliminate_fixed_components(level.matrix, level.fixed, rows, level.scale);
        level.smoother->update(rows);
      }
    level_zero_changed = true;
    return true;
  }
} // namespace Signorini
