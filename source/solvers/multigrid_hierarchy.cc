// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/galerkin_product.h>
#include <signorini/solvers/multigrid_hierarchy.h>

#include <deal.II/base/mpi.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    /// The mean of those of the diagonal entries of a block that are not zero, or `scale` if all are: not
    /// the entry of other nodes, beside which the block's own ones may look like rounding.
    double mean_stiffness(const double *const b, const double scale)
    {
      double sum = 0., n = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        if (const double entry = b[dim * c + c]; entry > 0.)
          {
            sum += entry;
            n += 1.;
          }
      return n > 0. ? sum / n : scale;
    }

    /// Rows and columns of prescribed components; the diagonal stays what it is.
    void eliminate_components(double *const b, const FixedMask of_row, const FixedMask of_column,
                              const bool is_diagonal, const double scale)
    {
      const double filling = is_diagonal ? mean_stiffness(b, scale) : 0.;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          if ((of_row & (1u << c)) || (of_column & (1u << d)))
            {
              if (is_diagonal && c == d)
                b[dim * c + d] = b[dim * c + d] > 0. ? b[dim * c + d] : filling;
              else
                b[dim * c + d] = 0.;
            }
    }

    /// E_p B E_q, and the mean stiffness of the prescribed directions in these on the diagonal.
    void eliminate_directions(double *const b, const FixedDirections &of_row,
                              const FixedDirections &of_column, const bool is_diagonal, const double scale)
    {
      const Block block = read_block(b), free_row = of_row.free_block();
      Block       result = free_row * block * of_column.free_block();
      if (is_diagonal)
        {
          const Block  fixed     = static_cast<Block>(unit_symmetric_tensor<dim>()) - free_row;
          const double stiffness = trace(fixed * block) / trace(fixed);
          result += (stiffness > 0. ? stiffness : mean_stiffness(b, scale)) * fixed;
        }
      write_block(b, result);
    }
  } // namespace



  std::vector<unsigned int> all_rows(const NodeBlockMatrix &matrix)
  {
    std::vector<unsigned int> rows(matrix.n_rows());
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
  }



  void restrict_defect(const MultigridLevel &level, Vector &coarse_defect, const Vector &residual)
  {
    level.to_finer.restrict_and_add(coarse_defect, residual);
    for (unsigned int i = 0; i < level.matrix.n_rows(); ++i)
      if (level.fixed[i].any())
        project_free(level.fixed[i], coarse_defect, i);
  }



  void eliminate_fixed_components(NodeBlockMatrix &matrix, const std::vector<FixedDirections> &fixed,
                                  const std::vector<unsigned int> &rows, const double scale)
  {
    for (const unsigned int i : rows)
      for (const BlockRange &range : matrix.stored(i))
        for (std::size_t k = range.begin; k < range.end; ++k)
          {
            const FixedDirections &of_row = fixed[i], &of_column = fixed[matrix.column(k)];
            if (!of_row.any() && !of_column.any())
              continue;
            const bool is_diagonal = k == matrix.diagonal(i);
            if (of_row.is_along_axes() && of_column.is_along_axes())
              eliminate_components(matrix.block(k), of_row.components(), of_column.components(), is_diagonal,
                                   scale);
            else
              eliminate_directions(matrix.block(k), of_row, of_column, is_diagonal, scale);
          }
  }



  ContactState find_active(MultigridLevel &level, const HalfSpaces &half_spaces, const Vector &rhs, Vector &v)
  {
    ContactState contact(level.matrix, half_spaces);
    contact.project(v);
    level.smoother->smooth(v, rhs, contact, {0, 0, 1}, Direction::forward);
    return contact;
  }



  MultigridHierarchy::MultigridHierarchy(HierarchyParts &&parts)
    : level_zero_solver(std::move(parts.coarse_solver))
    , was_expected(parts.start != nullptr)
  {
    add_finest(parts);
    if (parts.levels == nullptr)
      return;
    while (auto description = parts.levels->next(levels.back()->matrix.partition()))
      add_coarser(std::move(*description), parts);
    LevelZero level_zero = parts.levels->level_zero(levels.back()->matrix.partition());
    if (levels.size() == 1)
      add_coarser(copy_of_finest(level_zero.contact), parts);
    for (const Vector &motion : level_zero.free_motions)
      level_zero.motion_weights.push_back(weights_of_motion(motion));
    if (!level_zero_solver)
      level_zero_solver = std::make_unique<LevelZeroSolver>(std::move(level_zero));
    level_zero_changed = true;
  }



  MultigridHierarchy::MultigridHierarchy(NodeBlockMatrix &&matrix, std::vector<FixedDirections> fixed)
  {
    HierarchyParts parts;
    parts.matrix = std::move(matrix);
    parts.fixed  = std::move(fixed);
    add_finest(parts);
  }



  void MultigridHierarchy::make_smoother(MultigridLevel &level, const LevelInterface &interface,
                                         const HierarchyParts &parts)
  {
    level.smoother      = parts.make_smoother ? parts.make_smoother(level.matrix, interface)
                                              : std::make_unique<StagedSmoother>(level.matrix, interface);
    level.contact_nodes = interface.contact_nodes;
    slow_interface      = slow_interface || level.smoother->is_slow_at_interface();
  }



  void MultigridHierarchy::add_finest(HierarchyParts &parts)
  {
    levels.push_back(std::make_unique<MultigridLevel>());
    MultigridLevel &level = *levels.back();
    level.matrix          = std::move(parts.matrix);
    level.fixed           = import_ghost_masks(level.matrix.partition(), parts.fixed);
    level.scale           = diagonal_scale(level.matrix);
    eliminate_fixed_components(level.matrix, level.fixed, all_rows(level.matrix), level.scale);
    level.empty.fill(level.matrix, all_rows(level.matrix), level.scale);
    // Coarser levels are computed anew where contact changes.
    if (parts.levels != nullptr)
      level.matrix.split();
    make_smoother(level, parts.interface, parts);
  }



  void MultigridHierarchy::add_coarser(CoarserLevel &&description, const HierarchyParts &parts)
  {
    MultigridLevel        &finer = *levels.back();
    const NodeBlockMatrix &fine  = finer.matrix;
    if (levels.size() == 1 && parts.start != nullptr)
      truncate_expected(parts, description.transfer);
    levels.push_back(std::make_unique<MultigridLevel>());
    MultigridLevel &level = *levels.back();
    level.to_finer        = std::move(description.transfer);
    level.correction      = description.correction;
    level.contact         = std::move(description.contact);
    level.half_spaces     = std::move(description.half_spaces);
    reinit_galerkin(level.matrix, fine, level.to_finer, description.owned);
    level.fixed                            = import_ghost_masks(level.matrix.partition(), description.fixed);
    const std::vector<unsigned int> filled = finer.empty.restore(finer.matrix);
    compute_galerkin(level.matrix, fine, level.to_finer);
    finer.empty.fill(finer.matrix, filled, finer.scale);
    level.scale = diagonal_scale(level.matrix);
    eliminate_fixed_components(level.matrix, level.fixed, all_rows(level.matrix), level.scale);
    level.empty.fill(level.matrix, all_rows(level.matrix), level.scale);
    make_smoother(level, description.interface, parts);
  }



  CoarserLevel MultigridHierarchy::copy_of_finest(const HalfSpaces &contact) const
  {
    const MultigridLevel &finest    = *levels.front();
    const NodePartition  &partition = finest.matrix.partition();
    NodeRows              rows;
    for (unsigned int i = 0; i < partition.n_local(); ++i)
      {
        rows.add(partition.to_global(i), 1.);
        rows.finish_row();
      }
    CoarserLevel copy;
    copy.transfer.reinit(rows, {}, partition.n_owned());
    copy.owned.set_size(partition.n_global());
    copy.owned.add_range(partition.first_owned(), partition.first_owned() + partition.n_owned());
    copy.fixed.assign(finest.fixed.begin(), finest.fixed.begin() + partition.n_owned());
    copy.contact = contact;
    return copy;
  }



  Vector MultigridHierarchy::weights_of_motion(const Vector &motion) const
  {
    Vector values;
    levels.back()->matrix.partition().reinit(values);
    values.copy_locally_owned_data_from(motion);
    for (std::size_t k = levels.size() - 1; k > 0; --k)
      {
        Vector finer;
        levels[k - 1]->matrix.partition().reinit(finer);
        levels[k]->to_finer.prolongate(finer, values);
        values.swap(finer);
      }
    for (std::size_t k = 1; k < levels.size(); ++k)
      {
        Vector coarser;
        levels[k]->matrix.partition().reinit(coarser);
        restrict_defect(*levels[k], coarser, values);
        values.swap(coarser);
      }
    return values;
  }



  void MultigridHierarchy::strengthen_smoothers()
  {
    if (!strong_smoothers)
      for (unsigned int l = 1; l < n_levels(); ++l)
        level(l).smoother->strengthen();
    strong_smoothers = true;
  }



  const CoarseSolver &MultigridHierarchy::coarse_solver()
  {
    if (level_zero_changed)
      level_zero_solver->setup(levels.back()->matrix);
    level_zero_changed = false;
    return *level_zero_solver;
  }



  namespace
  {
    /// Removes the planes' normals from the changed block rows of a transfer.
    void truncate_transfer(NodalTransfer &transfer, const unsigned int n_local, const Vector &planes,
                           const Vector &changed)
    {
      for (unsigned int i = 0; i < n_local; ++i)
        if (changed.local_element(dim * i) != 0.)
          {
            Vector3 normal;
            for (unsigned int c = 0; c < dim; ++c)
              normal[c] = planes.local_element(dim * i + c);
            transfer.set_plane(i, normal);
          }
    }
  } // namespace



  void MultigridHierarchy::truncate_expected(const HierarchyParts &parts, NodalTransfer &transfer)
  {
    MultigridLevel    &fine    = *levels.front();
    Vector             v       = *parts.start;
    const ContactState contact = find_active(fine, parts.problem->half_spaces, parts.problem->rhs, v);
    Vector             planes, changed;
    if (set_truncated(fine, contact.half_spaces(), contact.active(), planes, changed))
      truncate_transfer(transfer, fine.matrix.partition().n_local(), planes, changed);
  }



  bool MultigridHierarchy::set_truncated(MultigridLevel &fine, const HalfSpaces &half_spaces,
                                         const std::vector<unsigned char> &active, Vector &planes,
                                         Vector &changed)
  {
    const NodePartition        &partition = fine.matrix.partition();
    std::vector<unsigned char> &truncated = fine.truncated;
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



  bool MultigridHierarchy::truncate(const unsigned int level_index, const HalfSpaces &half_spaces,
                                    const std::vector<unsigned char> &active)
  {
    MultigridLevel        &finest = level(level_index);
    const NodeBlockMatrix &matrix = finest.matrix;
    Vector                 planes, changed;
    if (!set_truncated(finest, half_spaces, active, planes, changed))
      return false;
    truncate_transfer(level(level_index - 1).to_finer, matrix.partition().n_local(), planes, changed);

    // Of the levels up to this one: the rows that are new or were filled.
    std::vector<std::vector<unsigned int>> rows(level_index + 1);
    for (unsigned int l = 0; l <= level_index; ++l)
      rows[l] = level(l).empty.restore(level(l).matrix);
    std::vector<unsigned int> changed_rows = matrix.rows_with_column(
        [&](const unsigned int column) { return changed.local_element(dim * column) != 0.; });
    for (unsigned int l = level_index; l-- > 0;)
      {
        MultigridLevel &coarse = level(l);
        const auto      marked = mark_coarse_nodes(coarse.to_finer, changed_rows);
        compute_galerkin(coarse.matrix, level(l + 1).matrix, coarse.to_finer, marked);
        changed_rows.clear();
        for (unsigned int i = 0; i < coarse.matrix.n_rows(); ++i)
          if (marked[i])
            changed_rows.push_back(i);
        eliminate_fixed_components(coarse.matrix, coarse.fixed, changed_rows, coarse.scale);
        rows[l].insert(rows[l].end(), changed_rows.begin(), changed_rows.end());
      }
    for (unsigned int l = 0; l <= level_index; ++l)
      level(l).empty.fill(level(l).matrix, rows[l], level(l).scale);
    for (unsigned int l = 0; l < level_index; ++l)
      level(l).smoother->update(rows[l]);
    level_zero_changed = true;
    return true;
  }
} // namespace Signorini
