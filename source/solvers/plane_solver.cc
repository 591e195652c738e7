// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/algebra/block_row.h>
#include <signorini/solvers/plane_solver.h>

namespace Signorini
{
  NodeBlockMatrix matrix_on_planes(const NodeBlockMatrix &matrix, const HalfSpaces &half_spaces,
                                   const std::vector<unsigned char> &active)
  {
    NodeBlockMatrix result = matrix;
    result.join();
    const NodePartition &partition = result.partition();
    Vector               planes;
    partition.reinit(planes);
    for (std::size_t p = 0; p < half_spaces.size(); ++p)
      if (active[p])
        half_spaces.add_normal(planes, p, 1.);
    planes.update_ghost_values();
    const auto plane = [&](const unsigned int node) {
      Vector3 n;
      for (unsigned int c = 0; c < dim; ++c)
        n[c] = planes.local_element(dim * node + c);
      return n;
    };
    for (unsigned int i = 0; i < result.n_rows(); ++i)
      {
        const Vector3 row_normal = plane(i);
        for (const BlockRange &range : result.stored(i))
          for (std::size_t k = range.begin; k < range.end; ++k)
            {
              const Vector3 column_normal = plane(result.column(k));
              if (row_normal.norm_square() == 0. && column_normal.norm_square() == 0.)
                continue;
              const Block block = restrict_to_planes(read_block(result.block(k)), row_normal, column_normal,
                                                     k == result.diagonal(i));
              write_block(result.block(k), block);
            }
      }
    return result;
  }



  FactoredPlanes::FactoredPlanes(const NodeBlockMatrix &matrix, const bool is_semidefinite)
    : matrix(matrix)
    , is_semidefinite(is_semidefinite)
    , factors(CoarseCholesky::Kind::supernodal)
  {
  }



  void FactoredPlanes::setup(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active)
  {
    factors.factorize(matrix_on_planes(matrix, half_spaces, active), is_semidefinite);
  }



  CycledPlanes::CycledPlanes(MultigridHierarchy &hierarchy, const unsigned int level,
                             const SmoothingParameters &smoothing)
    : hierarchy(hierarchy)
    , level(level)
    , smoothing(smoothing)
    , cycle(hierarchy, smoothing, level - 1)
  {
    for (Vector *vector : {&coarse_defect, &coarse_correction})
      hierarchy.level(level - 1).matrix.partition().reinit(*vector);
    for (Vector *vector : {&residual_left, &step})
      hierarchy.level(level).matrix.partition().reinit(*vector);
  }



  void CycledPlanes::setup(const HalfSpaces &half_spaces, const std::vector<unsigned char> &active)
  {
    hierarchy.truncate(level, half_spaces, active);
    const NodeBlockMatrix &matrix = hierarchy.level(level).matrix;
    smoother.reset();
    reduced  = matrix_on_planes(matrix, half_spaces, active);
    smoother = std::make_unique<StagedSmoother>(reduced, LevelInterface());
    if (hierarchy.has_strong_smoothers())
      smoother->strengthen();
    free    = ContactState(reduced);
    contact = ContactState(matrix, half_spaces);
    for (std::size_t p = 0; p < active.size(); ++p)
      contact.set_active(p, active[p]);
  }



  void CycledPlanes::correct(Vector &correction, const Vector &residual)
  {
    const MultigridLevel &coarse = hierarchy.level(level - 1);
    smoother->smooth_from_zero(correction, residual, free, smoothing, residual_left);
    coarse_defect = 0.;
    restrict_defect(coarse, coarse_defect, residual_left);
    cycle.apply(coarse_correction, coarse_defect);
    coarse.to_finer.prolongate(step, coarse_correction);
    contact.restrict_to_tangents(step);
    correction.zero_out_ghost_values();
    correction += step;
    smoother->smooth_to_residual(correction, residual, free, smoothing, nullptr);
  }
} // namespace Signorini
