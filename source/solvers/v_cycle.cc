// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#include <signorini/solvers/v_cycle.h>

namespace Signorini
{
  using namespace dealii;

  namespace
  {
    class LevelMatrix : public MGMatrixBase<Vector>
    {
    public:
      explicit LevelMatrix(MultigridHierarchy &hierarchy)
        : hierarchy(hierarchy)
      {
      }

      void vmult(const unsigned int level, Vector &dst, const Vector &src) const override
      {
        hierarchy.level(level).matrix.vmult(dst, src);
      }

      void vmult_add(const unsigned int level, Vector &dst, const Vector &src) const override
      {
        Vector product;
        product.reinit(dst);
        vmult(level, product, src);
        dst += product;
      }

      // The matrices are symmetric.
      void Tvmult(const unsigned int level, Vector &dst, const Vector &src) const override
      {
        vmult(level, dst, src);
      }

      void Tvmult_add(const unsigned int level, Vector &dst, const Vector &src) const override
      {
        vmult_add(level, dst, src);
      }

      unsigned int get_minlevel() const override
      {
        return 0;
      }

      unsigned int get_maxlevel() const override
      {
        return hierarchy.n_levels() - 1;
      }

    private:
      MultigridHierarchy &hierarchy;
    };



    class LevelTransfer : public MGTransferBase<Vector>
    {
    public:
      explicit LevelTransfer(MultigridHierarchy &hierarchy)
        : hierarchy(hierarchy)
      {
      }

      void prolongate(const unsigned int to_level, Vector &dst, const Vector &src) const override
      {
        hierarchy.level(to_level - 1).to_finer.prolongate(dst, src);
      }

      void restrict_and_add(const unsigned int from_level, Vector &dst, const Vector &src) const override
      {
        restrict_defect(hierarchy.level(from_level - 1), dst, src);
      }

    private:
      MultigridHierarchy &hierarchy;
    };



    class LevelSmoother : public MGSmootherBase<Vector>
    {
    public:
      LevelSmoother(MultigridHierarchy &hierarchy, const SmoothingParameters &parameters, const bool is_pre)
        : hierarchy(hierarchy)
        , parameters(parameters)
        , is_pre(is_pre)
      {
      }

      void clear() override
      {
      }

      void smooth(const unsigned int level, Vector &u, const Vector &rhs) const override
      {
        hierarchy.level(level).smoother->smooth(
            u, rhs, parameters, is_pre ? ProjectedGaussSeidel::forward : ProjectedGaussSeidel::backward);
      }

      void apply(const unsigned int level, Vector &u, const Vector &rhs) const override
      {
        u = 0.;
        smooth(level, u, rhs);
      }

    private:
      MultigridHierarchy        &hierarchy;
      const SmoothingParameters &parameters;
      const bool                 is_pre;
    };



    class CoarsestLevel : public MGCoarseGridBase<Vector>
    {
    public:
      explicit CoarsestLevel(const MultigridHierarchy &hierarchy)
        : hierarchy(hierarchy)
      {
      }

      void operator()(const unsigned int, Vector &dst, const Vector &src) const override
      {
        hierarchy.coarse_solver().solve(dst, src);
      }

    private:
      const MultigridHierarchy &hierarchy;
    };
  } // namespace



  struct VCycle::Components
  {
    Components(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing,
               const unsigned int max_level)
      : hierarchy(hierarchy)
      , smoothing(smoothing)
      , matrix(hierarchy)
      , transfer(hierarchy)
      , pre(hierarchy, this->smoothing, true)
      , post(hierarchy, this->smoothing, false)
      , coarse(hierarchy)
      , multigrid(matrix, coarse, transfer, pre, post, 0, max_level)
    {
    }

    MultigridHierarchy       &hierarchy;
    const SmoothingParameters smoothing;
    LevelMatrix               matrix;
    LevelTransfer             transfer;
    LevelSmoother             pre, post;
    CoarsestLevel             coarse;
    Multigrid<Vector>         multigrid;
  };



  VCycle::VCycle(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing,
                 const unsigned int max_level)
    : components(std::make_unique<Components>(hierarchy, smoothing, max_level))
  {
    for (unsigned int l = 0; l <= max_level; ++l)
      hierarchy.level(l).matrix.partition().reinit(components->multigrid.defect[l]);
  }



  VCycle::~VCycle() = default;



  void VCycle::apply(Vector &correction, const Vector &defect)
  {
    auto              &multigrid = components->multigrid;
    const unsigned int max_level = multigrid.get_maxlevel();
    for (unsigned int l = 0; l < max_level; ++l)
      multigrid.defect[l] = 0.;
    multigrid.defect[max_level].copy_locally_owned_data_from(defect);
    multigrid.cycle();
    correction.copy_locally_owned_data_from(multigrid.solution[max_level]);
  }
} // namespace Signorini
