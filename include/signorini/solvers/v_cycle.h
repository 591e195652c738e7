// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

#ifndef signorini_solvers_v_cycle_h
#define signorini_solvers_v_cycle_h

#include <signorini/solvers/multigrid_hierarchy.h>

#include <deal.II/multigrid/mg_base.h>
#include <deal.II/multigrid/multigrid.h>

#include <memory>

namespace Signorini
{
  /// The linear V-cycle on the levels of a hierarchy below a given one, run by dealii::Multigrid over our
  /// own matrix, transfer, smoother and coarse solver.
  class VCycle
  {
  public:
    /// The hierarchy must outlive the object. max_level is the finest level the cycle acts on.
    VCycle(MultigridHierarchy &hierarchy, const SmoothingParameters &smoothing, const unsigned int max_level);
    ~VCycle();

    /// Collective. correction = (approximate inverse) * defect, on max_level.
    void apply(Vector &correction, const Vector &defect);

  private:
    struct Components;
    std::unique_ptr<Components> components;
  };
} // namespace Signorini

#endif
